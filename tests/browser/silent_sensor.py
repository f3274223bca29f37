"""One sensor falls silent while the station goes on: its own values are struck through, and no others."""

import json

from page_bench import HEAR_THROUGH, NOTE_LATENESS, bench, expect, go, in_mid_run, opened, sentence

OLDEST_S = 2  # of air and material, as this station file has it
TICKS_S = 0.2  # for so long the page may wait until it looks again (docs/page.md)
SILENT, OTHER = "contact 1", "air temperature"

# Notes by the page's own clock how long after its last reading the cell was marked. What the station sends says how old a reading is. A cell
# that is good again was not marked for good.
WATCH = HEAR_THROUGH + """
window.after_ms = null;
let read_at = -Infinity;
hear_through((event) => {
    if (is_status(event)) {
        const {channels} = JSON.parse(/^data: (.*)$/m.exec(event)[1]);
        read_at = performance.now() - 1000 * (channels.find(({channel}) => channel === SILENT).age_s ?? Infinity);
    }
    return [event];
});
const cell = () => [...document.querySelectorAll('#now_cells .cell')].find((one) => one.querySelector('.label').textContent === SILENT);
new MutationObserver(() => {
    const stale = cell()?.dataset.mark === 'stale';
    window.after_ms = stale ? (window.after_ms ?? performance.now() - read_at) : null;
}).observe(document, {attributes: true, childList: true, subtree: true});
""".replace("SILENT", json.dumps(SILENT)) + NOTE_LATENESS


def cell(page, name):
    """(mark, text, line through its number) of a cell on Now."""
    return page.ask(f"""(([one]) => one && [one.dataset.mark, one.innerText.replace(/\\s+/g, ' '),
                                         getComputedStyle(one.querySelector('.number')).textDecorationLine])(
        [...document.querySelectorAll('#now_cells .cell')].filter((one) => one.querySelector('.label').textContent === '{name}'))""")


def is_marked(page, name, mark):
    return (cell(page, name) or [""])[0] == mark


def expect_in_time(page):
    """Since its last reading, both by the page's own clock; a busy computer may let that clock's ticks come late."""
    after_s, late_s = (page.ask(f"({what}) / 1000") for what in ("window.after_ms", "window.late_ms"))
    told = f"struck through {after_s:.3f} s after its last reading; the page's own timer was {late_s:.3f} s late"
    print(told)
    expect(OLDEST_S - 0.1 < after_s < OLDEST_S + TICKS_S + late_s, told)


@sentence("SensorThatFallsSilentIsStruckThroughWhileTheOthersStayFresh")
def silent_sensor(b):
    b.station["axis"]["air"]["oldest"] = f"{OLDEST_S} s"
    address = in_mid_run(b)
    with opened(address, planted=WATCH) as page:
        page.wait("it is good", lambda: is_marked(page, SILENT, "good"))
        page.ask("void (window.late_ms = 0)")
        b.sim("sensor material off")
        page.wait("it is stale", lambda: is_marked(page, SILENT, "stale"))
        page.wait("another one is fresh beside it", lambda: is_marked(page, OTHER, "good") and is_marked(page, SILENT, "stale"))
        expect_in_time(page)
        _, text, line = cell(page, SILENT)
        expect(line == "line-through" and "▲ stale" in text and "23.0" in text, f"{text}, {line}")
        _, text, line = cell(page, OTHER)
        expect(line == "none" and "● good" in text, f"{text}, {line}")


@sentence("SilentSensorIsNamedByItsDeviceAndComesBack")
def comes_back(b):
    b.station["axis"]["air"]["oldest"] = f"{OLDEST_S} s"
    address = in_mid_run(b)
    with opened(address) as page:
        page.wait("it is good", lambda: is_marked(page, SILENT, "good"))
        b.sim("sensor material off")
        go(page, "setup")
        page.wait_for_text("#setup_devices li[data-name=material][data-mark=lost]", "does not answer")
        expect("✕" in page.text("#setup_devices li[data-name=material] .mark"), page.text("#setup_devices"))
        page.wait_for_text("#setup_devices li[data-name=air][data-mark=good]", "answers")
        go(page, "now")
        page.wait("its last value stays struck through", lambda: cell(page, SILENT)[2] == "line-through")
        b.sim("sensor material on")
        page.wait("it is good again", lambda: is_marked(page, SILENT, "good"), 60)


if __name__ == "__main__":
    bench.main()
