"""The page at the machine in a real Chromium: unmodified programs around a simulated machine, and a finger."""

import signal

from page_bench import ABORT_S, bench, expect, fill, is_on, opened, pair, quiet, sentence, wait_until, with_page

FIRST_SCREEN_BYTES = 150_000
MARK = "document.querySelector('#now_reading').getAttribute('data-mark')"
STRUCK = "getComputedStyle(document.querySelector('#now_reading .number')).textDecorationLine"


@sentence("FirstScreenIsSmallAndAsksNoOtherHost")
def first_screen(b):
    address = with_page(b)
    b.begin_run(hold_after=3)
    b.wait_for_points(3)
    with opened(address) as page:
        page.wait_for_text("#now_so_far", "3 of 20")
        expect("mm" in page.text("#now_reading .big"), page.text("#now_reading"))
        loaded = page.ask("performance.getEntriesByType('resource').concat(performance.getEntriesByType('navigation'))"
                          ".map((one) => [one.name, one.transferSize])")
        expect(all(name.startswith(address) for name, _ in loaded), f"{loaded}")
        size = sum(size for _, size in loaded)
        expect(20_000 < size < FIRST_SCREEN_BYTES, f"{size} bytes for the first screen: {loaded}")
        shown = page.ask("[...document.querySelectorAll('#now_plot .positive, #now_plot .negative')].length")
        expect(shown == 3, f"{shown} points in the plot")


@sentence("SilentStationIsStruckThroughAndComesBackQuietly")
def silent_station(b):
    address = with_page(b)
    b.begin_run(hold_after=3)
    b.wait_for_points(3)
    with opened(address) as page:
        page.wait("a good reading", lambda: page.ask(MARK) == "good")
        number = page.text("#now_reading .number")
        # Noted by the page's own clock: what the test's computer does meanwhile does not count.
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
            const fetched = window.fetch;
        """)
        silent_from = page.ask("performance.now()")
        b.processes["axiscald"].send_signal(signal.SIGSTOP)
        try:
            page.wait("the strip about the link", lambda: page.ask("window.seen.strip !== undefined"))
            seen = page.ask("window.seen")
            after = {name: (at - silent_from) / 1000 for name, at in seen.items()}
            expect(after["stale"] < 2.5 and after["dim"] < 2.5, f"seconds after the station fell silent: {after}")
            expect(seen["strip"] - seen["dim"] > 700, f"the strip comes 1 s after the values dim: {after}")
            expect(page.ask(STRUCK) == "line-through" and page.text("#now_reading .number") == number, page.text("#now_reading"))
            page.keys("g", "r")
            page.wait("orders are off", lambda: not is_on(page, "abort"))
            page.wait_for_text("[data-order=abort]", "no contact with the station")
            page.keys("g", "n")
        finally:
            b.processes["axiscald"].send_signal(signal.SIGCONT)
        page.wait("a good reading again, without loading anew", lambda: page.ask(MARK) == "good" and page.ask("window.seen !== undefined"))
        page.wait("the strip is gone", lambda: page.ask("document.querySelector('#strip').dataset.rank") == "well")


@sentence("LostBeamIsDashesAndTheFirstThingToDo")
def lost_beam(b):
    address = with_page(b)
    b.begin_run(hold_after=3)
    b.wait_for_points(3)
    with opened(address) as page:
        page.wait("a good reading", lambda: page.ask(MARK) == "good")
        b.sim("beam off")
        page.wait("the reading is lost", lambda: page.ask(MARK) == "lost")
        expect(page.text("#now_reading .big .number") == "– – –", page.text("#now_reading"))
        page.wait_for_text("#strip", "Restore the beam")
        page.keys("g", "m")
        page.wait_for_text("#more_tasks li[data-rank=stop]", "beam")
        said = b.axiscal("status")
        expect(page.text("#more_tasks .action").removeprefix("→ ") in said, f"the command line says\n{said}\nthe page {page.text('#more_tasks')}")


@sentence("WholeCalibrationIsDoneByThePageAlone")
def whole(b):
    address = with_page(b)
    b.start()
    b.write_program()
    b.go_to_datum()
    with opened(address) as page:
        pair(b, page, "tablet 2")
        page.wait("the orders are on", lambda: is_on(page, "arm"))
        page.click("[data-order=arm]")
        fill(page, 0, str(b.plan["datum_mm"]))
        page.click("#run_sheet button[type=submit]")
        page.wait("the sheet is gone", lambda: page.ask("document.querySelector('#run_sheet').hidden"))
        page.wait_for_text("#run_so_far", "20 of 20", 90)
        page.wait_for_text("#run_so_far", "certificate", 60)
        expect(b.run()["state"] == "complete" and b.certificate()["completeness"]["status"] == "complete", f"{b.run()}")
        notes = "\n".join(b.status()["notes"])
        expect("armed by page tablet 2" in notes, f"who ordered is named: {notes}")


@sentence("AbortIsHeldAndAShortTouchDoesNothing")
def hold(b):
    address = with_page(b)
    b.begin_run(hold_after=3)
    b.wait_for_points(3)
    with opened(address) as page:
        pair(b, page, "panel")
        page.wait("abort is on", lambda: is_on(page, "abort"))
        page.hold("[data-order=abort]", ABORT_S / 4)
        expect(b.status()["run_open"], "a short touch has aborted the run")
        page.hold("[data-order=abort]", 3 * ABORT_S)
        wait_until("the run is closed", lambda: not b.status()["run_open"], 30)
        page.wait_for_text("#run_so_far", "incomplete")


@sentence("RunGoesOnWithThePageOverARestartOfTheStation")
def restarted(b):
    address = with_page(b)
    b.begin_run(hold_after=3)
    b.wait_for_points(3)
    with opened(address) as page:
        pair(b, page, "panel")
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
    address = with_page(b)
    b.begin_run(hold_after=3)
    b.wait_for_points(3)
    with opened(address) as one, opened(address) as other:
        b.sim("go")
        for page in (one, other):
            page.wait_for_text("#now_so_far", "20 of 20", 90)
        points = "document.querySelectorAll('#now_plot .positive, #now_plot .negative').length"
        for page in (one, other):
            page.wait("every point is shown", lambda page=page: page.ask(points) == 20)


def clipped(page):
    """Texts that are cut off: of elements that hide what does not fit and can not be scrolled."""
    return page.ask("""[...document.querySelectorAll('body *')].filter((one) => {
        if (one.clientWidth === 0 || one.closest('[hidden], svg, .unseen, .cell .label') || one.innerText === undefined) return false;
        const style = getComputedStyle(one);
        const hides = (way) => way === 'hidden' || way === 'clip';
        const button = one.localName === 'button';
        return ((hides(style.overflowX) || button) && one.scrollWidth > one.clientWidth + 1) ||
               ((hides(style.overflowY) || button) && one.scrollHeight > one.clientHeight + 1);
    }).map((one) => `${one.id || one.className || one.localName}: ${one.innerText}`)""")


@sentence("EveryLanguageHasRoomOnEveryScreen")
def languages(b):
    address = with_page(b)
    b.begin_run(hold_after=13)
    b.wait_for_points(13)
    with opened(address) as page:
        for language in ["en", "de", "ru", "zh", "pseudo"] * 2:
            if language == "en" and page.ask("localStorage.getItem('axiscal.language')") == "pseudo":
                page.driver.execute_script("localStorage.setItem('axiscal.language', 'en')")
                page.open(address)
                pair(b, page, "panel")  # the buttons say other things then
            page.driver.execute_script(f"localStorage.setItem('axiscal.language', '{language}')")
            page.open(address)
            page.wait("the page shows the station", lambda: page.text("#now_reading"))
            for size in [(1280, 800), (800, 480), (390, 844)]:
                page.resize(size)
                for screen in ["now", "run", "more"]:
                    page.driver.execute_script(f"document.querySelector('[data-screen={screen}]').click()")
                    page.wait(f"the screen {screen}", lambda screen=screen: not page.ask(f"document.querySelector('#screen_{screen}').hidden"))
                    cut = clipped(page)
                    expect(not cut, f"{language}, {size}, {screen}: {cut}")


if __name__ == "__main__":
    bench.main()
