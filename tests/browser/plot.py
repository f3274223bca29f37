"""The plot on its canvas, as a person sees it: pixels in the colours of the page, and a finger on one of the points."""

from page_bench import bench, expect, go, in_mid_run, opened, points_drawn, press, sentence

# Counts the pixels of each colour of the page that stand on the canvas, and finds the leftmost one. A copy is read: the plot's own
# canvas stays where the browser put it.
SEEN = """((screen, names) => {
    const canvas = document.querySelector(`#${screen}_plot canvas`), copy = document.createElement('canvas');
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext('2d', {willReadFrequently: true});
    const style = getComputedStyle(canvas), box = canvas.getBoundingClientRect(), seen = {};
    for (const name of names) {
        context.fillStyle = style.getPropertyValue(`--${name}`).trim();
        context.fillRect(0, 0, 1, 1);
        const wanted = [...context.getImageData(0, 0, 1, 1).data];
        context.clearRect(0, 0, copy.width, copy.height);
        context.drawImage(canvas, 0, 0);
        const {data} = context.getImageData(0, 0, copy.width, copy.height);
        context.clearRect(0, 0, copy.width, copy.height);
        seen[name] = {count: 0, x: copy.width, y: 0};
        for (let at = 0; at < data.length; at += 4) {
            if (wanted.some((part, nth) => data[at + nth] !== part)) continue;
            const x = (at / 4) % copy.width, y = Math.floor(at / 4 / copy.width);
            seen[name].count += 1;
            if (x < seen[name].x) Object.assign(seen[name], {x, y});
        }
        seen[name].x = box.left + seen[name].x * box.width / copy.width;
        seen[name].y = box.top + seen[name].y * box.height / copy.height;
    }
    return seen;
})(arguments[0], arguments[1])"""
NAMES = ["positive", "ink", "line"]
ARROW = 40  # pixels of a filled one, at least, that no softened edge has changed


def seen(page, screen):
    return page.driver.execute_script(f"return {SEEN}", screen, NAMES)


@sentence("PlotIsDrawnInTheColoursOfThePageAndFollowsThem")
def colours(b):
    address = in_mid_run(b)
    with opened(address) as page:
        page.wait("three points are drawn", lambda: points_drawn(page, "now") == 3)
        colours_seen = set()
        for computer, chosen in [("light", None), ("dark", None), ("dark", "light"), ("dark", "grey"), ("light", "dark")]:
            page.tell("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": computer}])
            page.driver.execute_script("const {dataset} = document.documentElement;"
                                       "if (arguments[0]) dataset.theme = arguments[0]; else delete dataset.theme;", chosen)
            what = f"computer {computer}, chosen {chosen}"
            page.wait(f"the plot has the colours: {what}", lambda: all(seen(page, "now")[name]["count"] > ARROW for name in NAMES))
            colours_seen.add(page.ask("getComputedStyle(document.documentElement).getPropertyValue('--positive')"))
            expect(points_drawn(page, "now") == 3, f"{what}: {points_drawn(page, 'now')} points")
        expect(len(colours_seen) == 3, f"these are no three sets of colours: {colours_seen}")


@sentence("FingerOnAPointOfThePlotPicksIt")
def finger(b):
    address = in_mid_run(b)
    with opened(address) as page:
        go(page, "run")
        page.wait("three points are drawn", lambda: points_drawn(page, "run") == 3)

        def touch():
            at = seen(page, "run")["positive"]
            for kind in ["mousePressed", "mouseReleased"]:
                press(page, kind, (at["x"], at["y"]))
            return "P1" in page.text("#run_picked")

        page.wait("the leftmost point is picked", touch)
        page.wait("a ring stands around it", lambda: page.ask("document.querySelector('#run_plot .drawing').dataset.picked_ring === '1'"))


@sentence("PlotIsAsSharpAsTheScreenAndAsLargeAsItsPlace")
def sizes(b):
    address = in_mid_run(b)
    with opened(address) as page:
        for width, height, ratio in [(1280, 800, 1), (800, 480, 2), (390, 844, 3), (1280, 800, 1)]:
            page.tell("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=ratio, mobile=False)
            fits = """((canvas, place) => Math.abs(canvas.clientWidth - place.clientWidth) <= 1 && canvas.clientHeight <= place.clientHeight + 1 &&
                Math.abs(canvas.width / canvas.clientWidth - devicePixelRatio) < 0.02)
                (document.querySelector('#now_plot canvas'), document.querySelector('#now_plot .drawing'))"""
            page.wait(f"{width}x{height}, {ratio} pixels each", lambda fits=fits: page.ask(fits) and points_drawn(page, "now") == 3)


if __name__ == "__main__":
    bench.main()
