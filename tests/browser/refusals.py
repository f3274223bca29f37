"""What a sheet says of an order that is refused is what the command line says of the same order."""

from page_bench import MAY_ONLY_LOOK, before_arming, bench, code_of, expect, go, in_mid_run, is_on, open_sheet, opened, pair_with, sentence, with_page
from page_hands import SHEET_HIDDEN, pick_first_point

LONG = "x" * 81  # a name has 80 bytes at most
REFUSED = 4  # exit of the command line
# How many orders of the page the station has refused.
REFUSALS = "performance.getEntriesByType('resource').filter((one) => one.initiatorType === 'fetch' && one.responseStatus >= 400).length"


def fill(page, fields):
    """Text into the sheet's fields, in the place of what stands there; a choice by what is sent for it."""
    for name, text in fields.items():
        field = page.element(f"#run_sheet [name={name}]")
        if field.tag_name == "select":
            field.find_element("css selector", f"[value='{text}']").click()
        else:
            page.wait(f"{name} is written", lambda field=field, text=text: field.get_attribute("value") == text or write(field, text))


def write(field, text):
    """The first key may only wake the page."""
    field.clear()
    field.send_keys(text)


def submit(page):
    """Once: the first touch may only wake the page, and the next one must not order again."""
    page.ask("void (window.submitted ??= (document.addEventListener('submit', () => (window.submitted += 1), {capture: true}), 0))")
    before = page.ask("window.submitted")
    page.wait("the order is given", lambda: page.ask("window.submitted") > before or page.element("#run_sheet [type=submit]").click())


def refused(page, fields):
    """The sentence on the sheet that is open, once the station has answered."""
    fill(page, fields)
    before = page.ask(REFUSALS)
    submit(page)
    page.wait("the station has refused", lambda: page.ask(REFUSALS) > before)
    page.wait("the sheet has heard it", lambda: page.ask("document.querySelector('#run_sheet [type=submit]').disabled === false"))
    return page.text("#run_sheet .answer")


def expect_same(b, said, *words):
    b.axiscal(*words, code=REFUSED)
    by_line = " ".join(b.complaint.split())
    expect(said == by_line, f"the sheet says\n{said}\nthe command line\n{by_line}")


def refusals_were(page, count):
    said = page.complaints()
    expect(len(said) == count and all("status of 40" in line for line in said), f"the browser tells of {count} orders that were refused: {said}")


def open_arming(b, page):
    pair_with(b, page, "panel")
    page.wait("a run may be armed", lambda: is_on(page, "arm"))
    open_sheet(page, "arm")


@sentence("SheetThatArmsIsRefusedInTheWordsOfTheCommandLine")
def arming(b):
    address = before_arming(b, with_page(b))
    datum = str(b.plan["datum_mm"])
    with opened(address) as page:
        open_arming(b, page)
        said = refused(page, {"datum_mm": datum, "by": LONG})
        expect_same(b, said, "arm", "--datum", datum, "--by", LONG)
        for kind in ("circular", "straightness"):
            said = refused(page, {"pass": kind, "by": "Jo"})
            expect_same(b, said, "arm", "--datum", datum, "--pass", kind)
        b.arm()  # by another one, while the sheet is open
        said = refused(page, {"pass": "whole"})
        expect_same(b, said, "arm", "--datum", datum)
        refusals_were(page, 4)


@sentence("SheetsThatReviseAPointAreRefusedInTheWordsOfTheCommandLine")
def revising(b):
    address = in_mid_run(b)
    point = ("--target", "1", "--direction", "up", "--cycle", "1")
    with opened(address) as page:
        pair_with(b, page, "panel")
        pick_first_point(page)
        for order in ("retake", "exclude"):
            page.wait(f"{order} is on", lambda order=order: is_on(page, order))
            open_sheet(page, order)
            expect_same(b, refused(page, {"reason": "", "by": ""}), order, *point, "--reason", "")
            expect_same(b, refused(page, {"reason": "coolant", "by": LONG}), order, *point, "--reason", "coolant", "--by", LONG)
            if order == "exclude":
                expect_same(b, refused(page, {"reason": "coolant", "by": ""}), order, *point, "--reason", "coolant")
            page.wait("the sheet is closed", lambda: page.ask(SHEET_HIDDEN) or page.click("#run_sheet [type=button]"))
        refusals_were(page, 5)


@sentence("CheckThatFailsIsToldOnTheSheetInTheWordsOfTheCommandLine")
def check(b):
    b.station["certificate"].pop("state")
    address = before_arming(b, with_page(b))
    datum = str(b.plan["datum_mm"])
    with opened(address) as page:
        open_arming(b, page)
        said = refused(page, {"datum_mm": datum})
        by_line = " ".join(b.axiscal("arm", "--datum", datum, code=REFUSED).split()) + b.complaint
        expect(said.count("compensation: ") == 1, f"the sheet tells it more than once: {said}")
        verdict = said.split("compensation: ")[-1]
        expect("is not stated" in verdict and verdict in by_line, f"the sheet says\n{said}\nthe command line\n{by_line}")
        refusals_were(page, 1)


@sentence("SheetThatPairsCountsWrongCodesAndTakesTheRightOne")
def pairing(b):
    """Codes are entered in browsers alone: there is no command line that could say the same."""
    address = with_page(b)
    b.start()
    with opened(address) as page:
        go(page, "run")
        page.wait("this browser may only look", lambda: page.ask(MAY_ONLY_LOOK))
        open_sheet(page, "arm")
        code = code_of(b.axiscal("pair", "panel")).replace(" ", "")
        wrong = f"{(int(code) + 1) % 10**8:08}"
        for left in (4, 3):
            said = refused(page, {"code": wrong})
            expect(f"the code is wrong; {left} tries left" in said, said)
        fill(page, {"code": code})
        submit(page)
        page.wait("its orders are its own", lambda: not page.ask(MAY_ONLY_LOOK))
        refusals_were(page, 2)


if __name__ == "__main__":
    bench.main()
