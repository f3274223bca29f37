"""The page at the machine is for everybody: axe-core finds nothing to mend on any screen. It looks through the debugger, so that the page
keeps its policy."""

import json
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import axe

AXE = axe.require(os.environ["AXISCAL_AXE_FOLDER"])  # before a bench is made

from page_bench import EVERY_SCREEN_IS_MADE, SCREENS, bench, expect, in_mid_run, is_on, opened, pair_with, sentence, with_page  # noqa: E402
from page_hands import go, open_sheet, pick_first_point  # noqa: E402

SIZES = [(390, 844), (1280, 800)]
PANEL = (800, 480)
COLOURS = ["light", "dark", "grey"]
# Every rule that is not deprecated, also those that axe has switched off until it is asked for them.
JUDGE = """axe.run(document, {
    resultTypes: ['violations'],
    rules: Object.fromEntries(axe.getRules().filter(({tags}) => !tags.includes('deprecated')).map(({ruleId}) => [ruleId, {enabled: true}])),
}).then(({violations, passes}) => JSON.stringify({
    findings: violations.flatMap(({id, nodes}) => nodes.map(({target, failureSummary}) => `${id}: ${target.join(' ')}: ${failureSummary}`)),
    passed: passes.map(({id}) => id),
}))"""


def judged(page):
    return json.loads(page.evaluate(JUDGE))


def in_colours(page, colours):
    """Light and dark as the computer has them, grey as it is chosen on the page."""
    page.tell("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if colours == "dark" else "light"}])
    page.driver.execute_script("const root = document.documentElement; if (arguments[0]) root.dataset.theme = 'grey'; else delete root.dataset.theme;",
                               colours == "grey")


def look(page, what, found, sizes):
    """Adds to `found` what axe finds in each size and colour."""
    for size in sizes:
        page.resize(size)
        for colours in COLOURS:
            in_colours(page, colours)
            # What the page paints with its next tick belongs to it.
            page.evaluate("new Promise((done) => setTimeout(() => requestAnimationFrame(() => done(0)), 100))")
            found += [f"{what}, {size[0]}x{size[1]}, {colours}: {one}" for one in judged(page)["findings"]]


def look_at_screens(page, what, sizes=SIZES):
    found = []
    for screen in SCREENS:
        go(page, screen)
        look(page, f"{what}, {screen}", found, sizes)
    expect(not found, "\n".join(found))


@sentence("AxeFindsNothingOnAnyScreenInMidRun")
def mid_run(b):
    address = in_mid_run(b)
    with opened(address) as page:
        page.evaluate(AXE + "; 0")
        look_at_screens(page, "in mid-run")
        found = []
        go(page, "run")
        page.wait("the table", lambda: not page.ask("document.querySelector('#run_table').hidden") or page.click("#run_plot .table_button"))
        page.wait("its rows", lambda: page.ask("document.querySelectorAll('#run_table tbody tr').length === 3"))
        look(page, "table of the run", found, SIZES)
        page.wait("the table is closed", lambda: page.ask("document.querySelector('#run_table').hidden") or page.click("#run_table > button"))
        open_sheet(page, "arm")
        look(page, "sheet", found, SIZES)
        expect(not found, "\n".join(found))


@sentence("AxeFindsNothingOnASmallPanelInMidRun")
def small_panel(b):
    address = in_mid_run(b)
    with opened(address) as page:
        page.evaluate(AXE + "; 0")
        page.resize(PANEL)
        pair_with(b, page, "panel")
        look_at_screens(page, "in mid-run", [PANEL])
        found = []
        go(page, "run")
        pick_first_point(page)
        page.wait("the point may be taken again", lambda: is_on(page, "retake"))
        open_sheet(page, "retake")
        look(page, "sheet of an order", found, [PANEL])
        expect(not found, "\n".join(found))


def choose_theme(page, theme):
    """By the button on Doctor, as people do."""
    go(page, "doctor")
    wanted = f"document.documentElement.dataset.theme === '{theme}'"
    button = f"[...document.querySelectorAll('#doctor_settings button')].find((one) => one.innerText.toLowerCase().startsWith('{theme}'))"
    page.wait("its button", lambda: page.ask(button))
    page.wait(f"the colours are {theme}", lambda: page.ask(wanted) or page.ask(button).click())


@sentence("AxeFindsNothingInTheColoursThatAreChosenOnDoctor")
def chosen_colours(b):
    b.station["axis"]["air"]["oldest"] = "2 s"
    address = in_mid_run(b)
    with opened(address) as page:
        page.evaluate(AXE + "; 0")
        b.sim("sensor material off")  # stale
        b.sim("beam off")  # lost
        page.wait("what is stale", lambda: page.ask("document.querySelector('#now_cells [data-mark=stale]') !== null"))
        page.wait("what is lost", lambda: page.ask("document.querySelector('#now_reading').dataset.mark") == "lost")
        found = []
        for theme in ("dark", "grey"):
            choose_theme(page, theme)
            for screen in SCREENS:
                go(page, screen)
                found += [f"{theme}, {screen}: {one}" for one in judged(page)["findings"]]
        expect(not found, "\n".join(found))


@sentence("AxeFindsNothingWhenTheBeamIsLost")
def beam_lost(b):
    address = in_mid_run(b)
    with opened(address) as page:
        page.evaluate(AXE + "; 0")
        b.sim("beam off")
        page.wait("the strip says so", lambda: page.ask("document.querySelector('#strip').dataset.rank") == "stop")
        page.wait("the reading is lost", lambda: page.ask("document.querySelector('#now_reading').dataset.mark") == "lost")
        look_at_screens(page, "beam lost")


@sentence("AxeFindsNothingWithoutARun")
def no_run(b):
    address = with_page(b)
    b.start()
    with opened(address) as page:
        page.evaluate(AXE + "; 0")
        look_at_screens(page, "without a run")


@sentence("AxeFindsNothingWhenTheLinkIsLost")
def no_link(b):
    address = in_mid_run(b)
    with opened(address) as page:
        page.evaluate(AXE + "; 0")
        go(page, "result")  # the modules of what is neither Now nor Run are loaded
        page.wait("every screen is made", lambda: page.ask(EVERY_SCREEN_IS_MADE))
        b.end("axiscald")
        page.wait("the strip about the link", lambda: page.ask("document.querySelector('#strip').dataset.rank") == "link")
        look_at_screens(page, "no link")
        page.open("about:blank")  # it asks no more
        page.complaints()  # the browser itself tells of connections that were refused


@sentence("AxeSeesWhatWasPlanted")
def planted(b):
    """A judge that finds nothing is worth as much as what it finds where there is something."""
    address = with_page(b)
    b.start()
    with opened(address) as page:
        page.evaluate(AXE + "; 0")
        page.driver.execute_script("""
            const button = document.createElement('button');
            button.style.cssText = 'min-width: 0; min-height: 0; width: 8px; height: 8px; padding: 0';
            const grey = ['#999', '#6b6b6b'].map((colour) => {
                const text = document.createElement('p');
                text.textContent = 'hardly to be read';
                text.style.cssText = `color: ${colour}; background: #fff; font-size: 16px`;
                return text;
            });
            document.querySelector('#screen_now').prepend(button, ...grey);
        """)
        found = " ".join(judged(page)["findings"])
        for rule in ["button-name", "color-contrast", "color-contrast-enhanced"]:
            expect(f"{rule}: " in found, f"{rule} is not found: {found}")


if __name__ == "__main__":
    bench.main()
