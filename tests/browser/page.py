"""The page at the machine in a real Chromium: unmodified programs around a simulated machine, and a finger."""

import os
import re
import signal
import time

from page_bench import ABORT_S, NOTE_LATENESS, REPEATING, SCREENS, SIZES, arm, before_arming, bench, expect, go, in_mid_run, is_on, opened, pair_with, points_drawn, sentence, with_page

FIRST_SCREEN_BYTES = 150_000
SLEPT_S = 5.0
NUMBER = re.compile(r"\d+\.\d{4}")
MARK = "document.querySelector('#now_reading').getAttribute('data-mark')"
# What stands on a screen that is loaded by who goes there first.
HOLDS = {"setup": "document.querySelector('#setup_devices li')", "doctor": "document.querySelector('#doctor_settings button')",
         "result": "document.querySelector('#result_head *')", "history": "document.querySelector('#history_rows *')"}
STRUCK = "getComputedStyle(document.querySelector('#now_reading .number')).textDecorationLine"


@sentence("FirstScreenIsSmallAndAsksNoOtherHost")
def first_screen(b):
    address = in_mid_run(b)
    with opened(address) as page:
        page.wait_for_text("#now_so_far", "3 of 20")
        expect("mm" in page.text("#now_reading .big"), page.text("#now_reading"))
        loaded = page.ask("performance.getEntriesByType('resource').concat(performance.getEntriesByType('navigation'))"
                          ".map((one) => [one.name, one.transferSize])")
        expect(all(name.startswith(address) for name, _ in loaded), f"{loaded}")
        size = sum(size for _, size in loaded)
        expect(20_000 < size < FIRST_SCREEN_BYTES, f"{size} bytes for the first screen: {loaded}")
        page.wait("three points are drawn", lambda: points_drawn(page, "now") == 3)


@sentence("SilentStationIsStruckThroughAndComesBackQuietly")
def silent_station(b):
    address = in_mid_run(b)
    with opened(address) as page:
        page.wait("a good reading", lambda: page.ask(MARK) == "good")
        # Noted by the page's own clock, which is late where this computer is busy: so late is allowed.
        page.driver.execute_script("""
            window.seen = {};
            const reading = document.querySelector('#now_reading'), root = document.documentElement;
            const strip = document.querySelector('#strip');
            const look = () => {
                const at = performance.now();
                if (reading.dataset.mark === 'stale') window.seen.stale ??= at;
                if (root.classList.contains('no-contact')) window.seen.dim ??= at;
                if (strip.dataset.rank === 'link') window.seen.strip ??= at;
            };
            new MutationObserver(look).observe(root, {attributes: true, subtree: true});
        """ + NOTE_LATENESS)
        b.processes["axiscald"].send_signal(signal.SIGSTOP)
        silent_from = page.ask("performance.now()")  # or a little before
        try:
            page.wait("the strip about the link", lambda: page.ask("window.seen.strip !== undefined"))
            late_s = page.ask("window.late_ms") / 1000
            after = {name: (at - silent_from) / 1000 for name, at in page.ask("window.seen").items()}
            told = f"seconds after the station fell silent: {after}; the page's own timer was {late_s} s late"
            expect(max(after["stale"], after["dim"]) < 2.1 + late_s, told)
            expect(after["strip"] - after["dim"] > 0.9 - late_s, f"a short break is worth no strip; {told}")
            expect(page.ask(STRUCK) == "line-through" and NUMBER.fullmatch(page.text("#now_reading .number")), page.text("#now_reading"))
            go(page, "run")
            page.wait("orders are off", lambda: not is_on(page, "abort"))
            page.wait_for_text("[data-order=abort]", "no contact with the station")
            go(page, "now")
        finally:
            b.processes["axiscald"].send_signal(signal.SIGCONT)
        page.wait("a good reading again, without loading anew", lambda: page.ask(MARK) == "good" and page.ask("window.seen !== undefined"))
        page.wait("the strip is gone", lambda: page.ask("document.querySelector('#strip').dataset.rank") == "well")


@sentence("LostBeamIsDashesAndTheFirstThingToDo")
def lost_beam(b):
    address = in_mid_run(b)
    with opened(address) as page:
        page.wait("a good reading", lambda: page.ask(MARK) == "good")
        b.sim("beam off")
        page.wait("the reading is lost", lambda: page.ask(MARK) == "lost")
        expect(page.text("#now_reading .big .number") == "– – –", page.text("#now_reading"))
        page.wait_for_text("#strip", "Restore the beam")
        go(page, "doctor")
        page.wait_for_text("#doctor_tasks li[data-rank=stop]", "beam")
        said = b.axiscal("status")
        expect(page.text("#doctor_tasks .action").removeprefix("→ ") in said, f"the command line says\n{said}\nthe page {page.text('#doctor_tasks')}")


@sentence("WholeCalibrationIsDoneByThePageAlone")
def whole(b):
    address = before_arming(b, with_page(b))
    with opened(address) as page:
        pair_with(b, page, "tablet 2")
        arm(page, b.plan["datum_mm"])
        page.wait_for_text("#run_so_far", "20 of 20", 90)
        page.wait_for_text("#run_so_far", "certificate", 60)
        expect(b.run()["state"] == "complete" and b.certificate()["completeness"]["status"] == "complete", f"{b.run()}")
        notes = "\n".join(b.status()["notes"])
        expect("armed by page tablet 2" in notes, f"who ordered is named: {notes}")
        log = next(log for log in b.logs if log.name.startswith("axiscald")).read_text(errors="replace")
        expect("page tablet 2: POST /v1/run, answered by 201" in log, f"the order stands in the log with its name: {log}")


@sentence("AbortIsHeldAndAShortTouchDoesNothing")
def hold(b):
    address = in_mid_run(b)
    with opened(address) as page:
        pair_with(b, page, "panel")
        page.wait("abort is on", lambda: is_on(page, "abort"))
        page.hold("[data-order=abort]", ABORT_S / 4)
        expect(b.status()["run_open"], "a short touch has aborted the run")
        page.wait("the run is closed", lambda: not b.status()["run_open"] or page.hold("[data-order=abort]", 3 * ABORT_S))
        page.wait_for_text("#run_so_far", "incomplete")


@sentence("ComputerThatSleptShowsNothingOldAsNewAndItsFirstTouchOnlyWakes")
def slept(b):
    address = in_mid_run(b)
    with opened(address, planted=REPEATING) as page:
        pair_with(b, page, "laptop")
        page.wait("abort is on", lambda: is_on(page, "abort"))
        page.driver.execute_script("""
            window.marks = [];
            const reading = document.querySelector('#run_reading');
            let before = performance.now();
            const look = () => {
                const at = performance.now();
                window.marks.push([at - before, reading.dataset.mark]);
                before = at;
                setTimeout(look, 20);
            };
            look();
        """)
        b.processes["axiscald"].send_signal(signal.SIGSTOP)  # what it said meanwhile would be heard, and be new
        try:
            page.wait("nothing of that is on its way", lambda: page.ask(HEARS_NOTHING))
            sleep(page, SLEPT_S)
            (looks,) = page.wait("the page slept, and what stood there is marked", lambda: looks_until_stale(page))
        finally:
            b.processes["axiscald"].send_signal(signal.SIGCONT)
        expect(looks < 20, f"what stood there before it slept was good for {looks} looks")
        page.wait("a good reading again", lambda: page.ask("document.querySelector('#run_reading').dataset.mark") == "good")
        page.hold("[data-order=abort]", 3 * ABORT_S)  # the first touch
        expect(b.status()["run_open"], "the touch that woke the page has aborted the run")
        page.wait("the run is closed", lambda: not b.status()["run_open"] or page.hold("[data-order=abort]", 3 * ABORT_S))


# By the page's own clock: a quarter of a second, in which a station that speaks says its status.
HEARS_NOTHING = """((at) => {
    if (window.heard_before !== window.heard) [window.heard_before, window.quiet_since] = [window.heard, at];
    return at - window.quiet_since > 250;
})(performance.now())"""


def looks_until_stale(page):
    """(looks at the page since it slept, 20 ms or more apart, until it showed a stale value; a tick is 80 ms,); None until then."""
    marks = page.ask("window.marks")
    slept_at = next((nth for nth, (gap_ms, _) in enumerate(marks) if gap_ms > 1000 * SLEPT_S / 2), len(marks))
    since = [mark for _, mark in marks[slept_at:]]
    return (since.index("stale"),) if "stale" in since else None


def sleep(page, seconds):
    """As a laptop that is shut: nothing of the browser runs, and its connections stand."""
    pids = page.processes()
    for pid in pids:
        os.kill(pid, signal.SIGSTOP)
    time.sleep(seconds)  # the sleep itself
    for pid in pids:
        os.kill(pid, signal.SIGCONT)


@sentence("RunGoesOnWithThePageOverARestartOfTheStation")
def restarted(b):
    address = in_mid_run(b)
    with opened(address) as page:
        pair_with(b, page, "panel")
        b.end("axiscald", signal.SIGKILL)
        page.wait("the strip about the link", lambda: page.ask("document.querySelector('#strip').dataset.rank") == "link")
        b.start_daemon_again()
        page.wait("contact again", lambda: page.ask("document.querySelector('#strip').dataset.rank") != "link")
        page.wait("this browser is still paired", lambda: is_on(page, "abort"))
        b.plug_the_cable_in()
        b.sim("go")
        page.wait_for_text("#run_so_far", "20 of 20", 90)
        page.complaints()  # the browser itself tells of connections that were refused


@sentence("TwoPagesAtOnceShowTheSame")
def two_pages(b):
    address = in_mid_run(b)
    with opened(address) as one, opened(address) as other:
        b.sim("go")
        for page in (one, other):
            page.wait_for_text("#now_so_far", "20 of 20", 90)
        for page in (one, other):
            page.wait("every point is drawn", lambda page=page: points_drawn(page, "now") == 20)


def clipped(page):
    """Texts that are cut off: of elements that hide what does not fit and can not be scrolled."""
    return page.ask("""[...document.querySelectorAll('body *')].filter((one) => {
        if (one.clientWidth === 0 || one.closest('[hidden], .drawing, .unseen, .cell .label') || one.innerText === undefined) return false;
        const style = getComputedStyle(one);
        const hides = (way) => way === 'hidden' || way === 'clip';
        const button = one.localName === 'button';
        return ((hides(style.overflowX) || button) && one.scrollWidth > one.clientWidth + 1) ||
               ((hides(style.overflowY) || button) && one.scrollHeight > one.clientHeight + 1);
    }).map((one) => `${one.id || one.className || one.localName}: ${one.innerText}`)""")


def covered(page):
    """Texts of the reading that lie on one another, or beyond their screen."""
    return page.ask("""[...document.querySelectorAll('.screen:not([hidden]) .reading')].flatMap((reading) => {
        const screen = reading.closest('.screen').getBoundingClientRect();
        const parts = [...reading.querySelectorAll('.big span, .facts, .beside span')].filter((one) => one.checkVisibility() && one.childElementCount === 0 && one.innerText !== '');
        const drawn = parts.map((one) => {
            const range = document.createRange();
            range.selectNodeContents(one);
            return {text: one.innerText, place: range.getBoundingClientRect()};
        });
        const meet = (one, other) => Math.min(one.right, other.right) - Math.max(one.left, other.left) > 1 &&
            Math.min(one.bottom, other.bottom) - Math.max(one.top, other.top) > Math.min(one.height, other.height) / 2;
        return drawn.flatMap(({text, place}, nth) => [
            ...(place.right > screen.right + 1 ? [`${text} is beyond the screen`] : []),
            ...drawn.slice(nth + 1).filter((other) => meet(place, other.place)).map((other) => `${text} and ${other.text}`),
        ]);
    })""")


@sentence("OpenRunIsARowOfHistoryAndHasNoVerdict")
def open_run_in_history(b):
    address = in_mid_run(b)
    with opened(address) as page:
        go(page, "history")
        page.wait_for_text("#history_rows li", "open")
        page.wait("Result says that it is open", lambda: "open" in page.text("#result_head .verdict") or page.element("#history_rows li button").click())
        expect(page.ask("document.querySelectorAll('#result_papers a').length") == 0, "papers of an open run")


@sentence("EveryLanguageHasRoomOnEveryScreen")
def languages(b):
    address = in_mid_run(b, points=13)
    with opened(address) as page:
        for language in ["en", "de", "ru", "zh", "pseudo"] * 2:
            if language == "en" and page.ask("localStorage.getItem('axiscal.language')") == "pseudo":
                page.driver.execute_script("localStorage.setItem('axiscal.language', 'en')")
                page.open(address)
                pair_with(b, page, "panel")  # the buttons say other things then
            page.driver.execute_script(f"localStorage.setItem('axiscal.language', '{language}')")
            page.open(address)
            page.wait("the page shows the station", lambda: page.text("#now_reading"))
            for size in SIZES:
                page.resize(size)
                for screen in SCREENS:
                    go(page, screen)
                    page.wait("it is shown", lambda screen=screen: screen not in HOLDS or page.ask(f"{HOLDS[screen]} !== null"))
                    cut = clipped(page)
                    expect(not cut, f"{language}, {size}, {screen}: {cut}")
                    on_another = covered(page)
                    expect(not on_another, f"{language}, {size}, {screen}: {on_another}")


if __name__ == "__main__":
    bench.main()
