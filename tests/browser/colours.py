"""What the page says does not depend on colour: in the colours that a person forces on every page, in dark, and in grey."""

import contextlib

from page_bench import bench, expect, in_mid_run, is_on, opened, pair_with, sentence

# Of text in large digits less would do (WCAG 2, 1.4.3).
LEAST_CONTRAST = 4.5
COLOURS = {
    "forced": ([{"name": "forced-colors", "value": "active"}], ""),
    "forced, dark": ([{"name": "forced-colors", "value": "active"}, {"name": "prefers-color-scheme", "value": "dark"}], ""),
    "dark": ([{"name": "prefers-color-scheme", "value": "dark"}], ""),
    "grey": ([{"name": "prefers-color-scheme", "value": "light"}], "grey"),
}
# What is known of a text: its words, and how it is drawn.
DRAWN = """((one) => {
    if (!one?.checkVisibility()) return null;
    const style = getComputedStyle(one);
    const channels = (text) => text.match(/[\\d.]+/g).map(Number);
    const light = (text) => channels(text).slice(0, 3).map((part) => part / 255)
        .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4))
        .reduce((sum, part, nth) => sum + part * [0.2126, 0.7152, 0.0722][nth], 0);
    let ground = one;
    while (ground.parentElement && channels(getComputedStyle(ground).backgroundColor)[3] === 0)
        ground = ground.parentElement;
    const ratio = (...two) => {
        const [dark, bright] = two.map(light).sort((one, other) => one - other);
        return (bright + 0.05) / (dark + 0.05);
    };
    return {text: one.innerText.replace(/\\s+/g, ' ').trim(), border: `${style.borderTopWidth} ${style.borderTopStyle}`, outline: style.outlineStyle, ring: ratio(style.outlineColor, getComputedStyle(document.body).backgroundColor), ground: getComputedStyle(ground).backgroundColor,
            line: style.textDecorationLine, weight: Number(style.fontWeight), contrast: ratio(style.color, getComputedStyle(ground).backgroundColor)};
})"""


@contextlib.contextmanager
def in_colours(page, name):
    features, theme = COLOURS[name]
    page.tell("Emulation.setEmulatedMedia", features=features)
    if theme:
        page.driver.execute_script("document.documentElement.dataset.theme = arguments[0]", theme)
    yield
    page.driver.execute_script("delete document.documentElement.dataset.theme")


def drawn(page, expression):
    return page.wait(f"{expression} is seen", lambda: page.ask(f"{DRAWN}({expression})"))


def part_of_cell(name, part):
    return f"[...document.querySelectorAll('#now_cells .cell')]"\
           f".find((one) => one.querySelector('.label').textContent === '{name}').querySelector('{part}')"


def expect_quality(page, number, mark, shown):
    """shown: (shape and word, how its number looks)."""
    word, look = shown
    number, mark = drawn(page, number), drawn(page, mark)
    expect(mark["text"].startswith(word), f"{word} is not told: {mark}")
    expect((number["line"] == "line-through") == (look == "struck") and (number["text"] == "– – –") == (look == "dashes"), f"{word}: {number}")
    for one in (number, mark):
        expect(one["contrast"] >= LEAST_CONTRAST, f"{word} can hardly be read: {one}")


@sentence("FreshStaleAndLostAreToldByShapeAndWordInAnyColours")
def qualities(b):
    b.station["axis"]["air"]["oldest"] = "2 s"
    address = in_mid_run(b)
    with opened(address) as page:
        b.sim("sensor material off")
        b.sim("beam off")
        page.wait("one is stale", lambda: "▲ stale" in page.text("#now_cells"))
        page.wait("one is lost", lambda: "✕ beam lost" in page.text("#now_reading"))
        for name in COLOURS:
            with in_colours(page, name):
                page.wait("one is fresh", lambda: page.ask(f"{part_of_cell('air temperature', '.mark')}.innerText").startswith("● good"))
                expect_quality(page, part_of_cell("air temperature", ".number"), part_of_cell("air temperature", ".mark"), ("● good", "plain"))
                expect_quality(page, part_of_cell("contact 1", ".number"), part_of_cell("contact 1", ".mark"), ("▲ stale", "struck"))
                expect_quality(page, "document.querySelector('#now_reading .number')", "document.querySelector('#now_reading .facts')",
                               ("✕ beam lost", "dashes"))


def order(name):
    return f"document.querySelector('[data-order={name}]')"


@sentence("ButtonThatIsOffHasAnotherBorderAndSaysWhyInAnyColours")
def buttons(b):
    address = in_mid_run(b)
    with opened(address) as page:
        pair_with(b, page, "panel")
        for name in COLOURS:
            with in_colours(page, name):
                page.wait("abort is on", lambda: is_on(page, "abort") or page.click("nav [data-screen=run]"))
                on, off = drawn(page, order("abort")), drawn(page, order("arm"))
                expect((on["border"], off["border"]) == ("2px solid", "2px dashed"), f"{name}: {on}, {off}")
                expect("a run is open" in off["text"] and on["text"] == "Hold: abort", f"{name}: {on}, {off}")
                expect(min(one["contrast"] for one in (on, off)) >= LEAST_CONTRAST, f"{name}: {on}, {off}")
                fill = page.ask(f"getComputedStyle({order('abort')}.querySelector('.fill')).backgroundColor")
                ground = page.ask(f"getComputedStyle({order('abort')}).backgroundColor")
                expect(fill != ground, f"{name}: nobody sees how far abort is held: {fill} on {ground}")


@sentence("ButtonOfTheScreenThatIsShownStandsOutInAnyColours")
def current(b):
    address = in_mid_run(b)
    with opened(address) as page:
        for name in COLOURS:
            with in_colours(page, name):
                here, elsewhere = (drawn(page, f"document.querySelector('nav [data-screen={screen}]')") for screen in ("now", "run"))
                expect(min(one["contrast"] for one in (here, elsewhere)) >= LEAST_CONTRAST, f"{name}: {here}, {elsewhere}")
                page.element("nav [data-screen=now]").send_keys("")  # the focus
                ring = page.ask(f"{DRAWN}(document.querySelector('nav [data-screen=now]'))")
                expect(ring["ring"] >= 3, f"{name}: nobody sees where the keys are: {ring}")
                expect(here["ground"] != elsewhere["ground"], f"{name}: {here}, {elsewhere}")


def told_of_beam(strip):
    return strip if strip["text"].startswith("✕ Stop: The laser beam was lost.") else None


@sentence("StripTellsItsRankByShapeAndWordInAnyColours")
def strip(b):
    address = in_mid_run(b)
    with opened(address) as page:
        strip_text = "document.querySelector('#strip_text')"
        for name in COLOURS:
            with in_colours(page, name):
                page.wait_for_text("#strip", "● all well")
                expect(drawn(page, strip_text)["weight"] == 400, f"{name}: {drawn(page, strip_text)}")
        b.sim("beam off")
        for name in COLOURS:
            with in_colours(page, name):
                told = page.wait("the strip tells of the beam", lambda: told_of_beam(drawn(page, strip_text)))
                expect(told["weight"] >= 600 and told["contrast"] >= LEAST_CONTRAST, f"{name}: {told}")
                around = drawn(page, "document.querySelector('#strip')")["outline"]
                expect(around == ("double" if name.startswith("forced") else "none"), f"{name}: a line around it that is {around}")


if __name__ == "__main__":
    bench.main()
