"""A bench whose station shows its page, and what the tests of the page share."""

import contextlib
import sys
from pathlib import Path

SUPPORT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(SUPPORT / "simulation"), str(SUPPORT / "support")]

import bench  # noqa: E402
from bench import SOURCE, expect, sentence, wait_until  # noqa: E402, F401
from browser import Browser  # noqa: E402

ABORT_S = 0.8  # for so long abort is held


def with_page(b):
    """Before b.start(): the page as it lies in the sources, at a port of its own. Gives back its address."""
    b.environment["AXISCAL_PAGE_PATH"] = str(SOURCE / "acquisition/console/page")
    b.station["console"]["port"] = bench.free_port()
    return f"http://127.0.0.1:{b.station['console']['port']}/"


@contextlib.contextmanager
def opened(address, **words):
    """A browser with the page, once it shows a reading. At the end its console must have been silent."""
    with Browser(**words) as page:
        page.open(address)
        page.wait("the page shows the station", lambda: page.text("#now_reading") or page.text("#run_reading"))
        yield page
        quiet(page)


def quiet(page):
    said = page.complaints()
    expect(not said, f"the console of the browser: {said}")


def pair(b, page, name):
    """By the code that the command line shows, typed on the page as a person does it."""
    code = b.axiscal("pair", name).split("Code:")[1].split("counts")[0].strip()
    page.keys("g", "r")
    page.wait("the Run screen", lambda: not page.ask("document.querySelector('#screen_run').hidden"))
    page.wait("this browser may only look", lambda: page.ask("document.querySelector('[data-order=arm]').getAttribute('title')?.includes('axiscal pair')"))
    page.click("[data-order=arm]")
    page.wait("the sheet asks for the code", lambda: page.ask("document.activeElement?.inputMode === 'numeric'"))
    page.keys(code)
    page.click("#run_sheet button[type=submit]")
    page.wait("the sheet is gone", lambda: page.ask("document.querySelector('#run_sheet').hidden"))


def is_on(page, order):
    return page.ask(f"document.querySelector('[data-order={order}]').getAttribute('aria-disabled') === null")


def fill(page, number, text):
    """Field of the open sheet, from 0."""
    field = page.driver.find_elements("css selector", "#run_sheet input")[number]
    field.clear()
    field.send_keys(text)
