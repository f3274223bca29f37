"""The sheet that arms, where the station asks for more than it was told: nothing goes by the page that goes by no command."""

from page_bench import before_arming, bench, expect, is_on, open_sheet, opened, pair_with, sentence, state_machine, with_page


def open_arming(b, page, name):
    """The sheet, with the datum on it, of a browser that may order."""
    pair_with(b, page, name)
    page.wait("a run may be armed", lambda: is_on(page, "arm"))
    open_sheet(page, "arm")
    page.element("#run_sheet input").send_keys(str(b.plan["datum_mm"]))


def refusals_were(page, count):
    said = page.complaints()
    expect(len(said) == count and all("status of 409" in line for line in said), f"the browser tells of {count} orders that were refused: {said}")


@sentence("MachineIsStatedOnTheSheetWhereTheStationFileSaysNothing")
def stated(b):
    for key in ("state", "control_compensation"):
        b.station["certificate"].pop(key)
    address = before_arming(b, with_page(b))
    with opened(address) as page:
        open_arming(b, page, "tablet")
        page.click("#run_sheet [type=submit]")
        page.wait_for_text("#run_sheet .answer", "The state of the machine is not stated")
        state_machine(page, "as left", "none")
        page.click("#run_sheet [type=submit]")
        page.wait_for_text("#run_so_far", "certificate", 120)
        refusals_were(page, 1)
    shown = b.certificate()["run"]["statements"]
    expect((shown["state"], shown["control_compensation"]) == ("as left", "none"), f"{shown}")


@sentence("CheckThatFailsIsOverriddenOnTheSheetByAReasonThatIsPrinted")
def overridden(b):
    b.station["preflight"]["soak_window"] = "10 min"
    b.station["instrument"][1]["due_on"] = "2020-01-01"
    address = before_arming(b, with_page(b))
    with opened(address) as page:
        open_arming(b, page, "tablet")
        fields = len(page.driver.find_elements("css selector", "#run_sheet input"))
        page.click("#run_sheet [type=submit]")
        page.wait_for_text("#run_sheet .answer", "soak: ")
        page.wait_for_text("#run_sheet .answer", "certificates: ")
        asked = page.driver.find_elements("css selector", "#run_sheet input")[fields:]
        expect(len(asked) == 2, f"{len(asked)} reasons are asked for, where two checks fail")
        asked[0].send_keys("the customer waits")
        page.click("#run_sheet [type=submit]")  # one of them is not enough
        page.wait("the other check alone keeps it", lambda: "soak: " not in page.text("#run_sheet .answer") and "certificates: " in page.text("#run_sheet .answer"))
        asked[1].send_keys("the new one is on its way")
        page.click("#run_sheet [type=submit]")
        page.wait_for_text("#run_so_far", "certificate", 120)
        refusals_were(page, 2)
    told = " ".join(b.certificate()["run"]["remarks"])
    for words in ("the customer waits", "the new one is on its way"):
        expect(words in told, f"'{words}' is not printed: {told}")


@sentence("ReasonThatNobodyGaveGoesWithItsCheckAndTheOthersStay")
def reason_goes(b):
    b.station["preflight"]["soak_window"] = "10 min"
    for key in ("state", "control_compensation"):
        b.station["certificate"].pop(key)
    address = before_arming(b, with_page(b))
    reasons = "[...document.querySelectorAll('#run_sheet [name^=override]')].map((one) => one.name).sort().join()"
    with opened(address) as page:
        open_arming(b, page, "tablet")
        page.click("#run_sheet [type=submit]")
        page.wait("both checks ask for a reason", lambda: page.ask(reasons) == "override compensation,override soak")
        state_machine(page, "as left", "none")
        page.click("#run_sheet [type=submit]")
        page.wait("the check that holds asks for none", lambda: page.ask(reasons) == "override soak")
        expect(page.ask("document.querySelector('#run_sheet').contains(document.activeElement)"), "the keys have fallen out of the sheet")
        refusals_were(page, 2)


@sentence("SeedOfThePartProgramIsAskedForWhereTheStationFileNamesNone")
def seed(b):
    b.station["cycle"].pop("seed", None)
    address = before_arming(b, with_page(b))
    with opened(address) as page:
        open_arming(b, page, "tablet")
        page.element("#run_sheet [name=seed]").send_keys(str(b.plan["seed"]))
        page.wait_for_text("#run_sheet", f"understood: {b.plan['seed']}")
        page.click("#run_sheet [type=submit]")
        page.wait_for_text("#run_so_far", "certificate", 120)
    expect(b.certificate()["completeness"]["status"] == "complete", f"{b.run()}")


if __name__ == "__main__":
    bench.main()
