"""Everything goes by the keyboard alone: the page meets no pointer, from the code of its pairing to a run in History."""

import contextlib

from selenium.webdriver.common.keys import Keys

from page_bench import ABORT_S, HEAR_THROUGH, MAY_ONLY_LOOK, before_arming, bench, code_of, expect, in_mid_run, is_on, is_shown, opened, sentence, with_page

# Counts what a finger or a mouse does.
WATCH_POINTERS = """
    window.pointers = 0;
    for (const touch of ['pointerdown', 'mousedown', 'touchstart'])
        window.addEventListener(touch, () => (window.pointers += 1), {capture: true});
"""


@contextlib.contextmanager
def by_keys(address):
    """The page, to which nothing but keys may come."""
    with opened(address) as page:
        page.driver.execute_script(WATCH_POINTERS)
        yield page
        expect(page.ask("window.pointers") == 0, "a pointer has touched the page")


def tab_to(page, wanted):
    """By Tab alone, as often as there are places."""
    for _ in range(60):
        if page.ask(f"((one) => {wanted})(document.activeElement)"):
            return
        page.keys(Keys.TAB)
    raise AssertionError(f"Tab never comes to {wanted}")


def go_by_keys(page, screen, letter):
    page.wait(f"{letter} goes to {screen}", lambda: is_shown(page, screen) or page.keys("g", letter))


def open_by_keys(page, order):
    tab_to(page, f"one.dataset.order === '{order}'")
    page.keys(Keys.ENTER)
    page.wait("the sheet has the focus", lambda: page.ask("document.activeElement.closest('#run_sheet input') !== null"))


def pair_by_keys(b, page, name):
    go_by_keys(page, "run", "r")
    page.wait("this browser may only look", lambda: page.ask(MAY_ONLY_LOOK))
    open_by_keys(page, "arm")
    page.keys(code_of(b.axiscal("pair", name)), Keys.ENTER)
    page.wait("its orders are its own", lambda: not page.ask(MAY_ONLY_LOOK))


def arm_by_keys(b, page):
    page.wait("a run may be armed", lambda: is_on(page, "arm"))
    open_by_keys(page, "arm")
    page.keys(str(b.plan["datum_mm"]), Keys.ENTER)


def pick_by_keys(page):
    tab_to(page, "one.className === 'table_button'")
    page.keys(Keys.ENTER)
    page.wait("the table", lambda: not page.ask("document.querySelector('#run_table').hidden"))
    tab_to(page, "one.closest('#run_table td') !== null")
    page.keys(Keys.ENTER)
    page.wait("a point is picked", lambda: page.text("#run_picked"))


@sentence("KeyboardAloneArmsPicksAPointAndAborts")
def arms_and_aborts(b):
    address = before_arming(b, with_page(b))
    b.sim("hold 3")
    with by_keys(address) as page:
        pair_by_keys(b, page, "keyboard")
        for screen, letter in {"setup": "u", "result": "s", "doctor": "d", "now": "n", "run": "r"}.items():
            go_by_keys(page, screen, letter)
        arm_by_keys(b, page)
        page.wait_for_text("#run_so_far", "3 of 20", 60)
        pick_by_keys(page)
        be_refused_and_escape(page)
        open_by_keys(page, "retake")
        page.keys("coolant", Keys.ENTER)
        page.wait("the point is to be taken again", lambda: b.status()["to_do"] and b.run()["retakes_left"] == 1)
        page.wait_for_text("#run_so_far", "to take again")
        page.wait("the run is closed", lambda: not b.status()["run_open"] or hold_abort_by_keys(page))


def hold_abort_by_keys(page):
    """A page that was frozen meanwhile has not seen it held."""
    tab_to(page, "one.dataset.order === 'abort'")
    page.hold_key(Keys.SPACE, 3 * ABORT_S)


def be_refused_and_escape(page):
    """One of two readings may not be left out."""
    open_by_keys(page, "exclude")
    page.keys("coolant", Keys.ENTER)
    page.wait_for_text("#run_sheet .answer", "At least two readings of each target and direction must remain")
    said = page.complaints()
    expect(len(said) == 1 and "status of 400" in said[0], f"the browser tells of an order that was refused: {said}")
    page.keys(Keys.ESCAPE)
    page.wait("the sheet is gone", lambda: page.ask("document.querySelector('#run_sheet').hidden"))


def search_by_keys(page, text):
    tab_to(page, "one.matches('#history_search input')")
    page.keys(text, Keys.ENTER)


@sentence("KeyboardAlonePairsCalibratesAndReadsTheResultOutOfHistory")
def calibrates(b):
    address = before_arming(b, with_page(b))
    with by_keys(address) as page:
        pair_by_keys(b, page, "keyboard")
        arm_by_keys(b, page)
        page.wait_for_text("#run_so_far", "certificate", 120)
        go_by_keys(page, "history", "h")
        page.wait_for_text("#history_rows li", "SIM-1")
        search_by_keys(page, "SIM-999")
        page.wait_for_text("#history_rows .note", "SIM-999")
        search_by_keys(page, "SIM-1")  # takes the place of what was searched
        page.wait_for_text("#history_rows li", "SIM-1")
        tab_to(page, "one.closest('#history_rows li') !== null")
        page.keys(Keys.ENTER)
        page.wait("Result is shown", lambda: is_shown(page, "result") and page.text("#result_head .verdict"))
        number = b.certificate()["certificate"]["number"]
        page.wait_for_text("#result_head", number)
        tab_to(page, "one.matches('#result_papers a')")
        expect(page.ask("getComputedStyle(document.activeElement).outlineStyle") == "solid", "nobody sees where the keys are")


# The station says that one more result waits, while window.says_other holds: the rows of History are asked for anew.
ANOTHER_WAITS = HEAR_THROUGH + """
window.says_other = false;
const with_another = (status) => ({...status, outbox: {...status.outbox, waiting: status.outbox.waiting + 1}});
hear_through((event) => [window.says_other && is_status(event) ? data_of(event, with_another) : event]);
"""


@sentence("KeyboardKeepsItsPlaceWhereRowsAreMadeAnew")
def keeps_its_place(b):
    address = in_mid_run(b)
    with opened(address, planted=ANOTHER_WAITS) as page:
        go_by_keys(page, "history", "h")
        page.wait_for_text("#history_rows li", "open")
        tab_to(page, "one.closest('#history_rows li') !== null")
        page.ask("void (window.row = document.activeElement, window.says_other = true)")
        page.wait("the rows are made anew", lambda: page.ask("!window.row.isConnected"))
        expect(page.ask("document.activeElement.dataset.id === window.row.dataset.id"), "the focus is lost")


if __name__ == "__main__":
    bench.main()
