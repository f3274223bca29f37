"""A tab that nobody looks at: it holds none of the six connections that a browser has for one address, and none of the station's places."""

from pathlib import Path

from page_bench import bench, expect, in_mid_run, opened, sentence

TABS = 8  # two more than the connections that a browser has for one address
GONE_S = 60  # the stream ends at once; what else the browser keeps open the station ends after 30 s


def streams(b):
    """How many connections stand at the port of the page."""
    port = f":{b.station['console']['port']:04X}"
    rows = (line.split() for line in Path(f"/proc/{b.processes['axiscald'].pid}/net/tcp").read_text(encoding="ascii").splitlines()[1:])
    return sum(1 for row in rows if row[1].endswith(port) and row[3] == "01")


def new_tab(page, address):
    page.driver.switch_to.new_window("tab")
    page.open(address)
    page.wait("it shows a reading", lambda: "mm" in page.text("#now_reading .big"))


@sentence("EighthTabOfOneBrowserShowsTheReading")
def eight_tabs(b):
    address = in_mid_run(b)
    with opened(address) as page:
        for _ in range(TABS - 1):
            new_tab(page, address)
        expect(page.ask("document.visibilityState") == "visible", "the last tab is not the one that is shown")


@sentence("TabThatNobodyLooksAtHoldsNoConnectionAndShowsTheStationWhenItIsLookedAt")
def hidden(b):
    address = in_mid_run(b)
    with opened(address) as page:
        first = page.driver.current_window_handle
        page.wait("its stream is open", lambda: streams(b) > 0)
        page.driver.switch_to.new_window("tab")
        page.wait("no connection is left", lambda: streams(b) == 0, GONE_S)
        page.driver.switch_to.window(first)
        page.wait("it is looked at", lambda: page.ask("document.visibilityState") == "visible")
        page.wait("the reading is fresh", lambda: page.ask("document.querySelector('#now_reading').dataset.mark") in ("good", "moving"))
        b.sim("beam off")
        page.wait("what happens is shown again", lambda: page.ask("document.querySelector('#now_reading').dataset.mark") == "lost")


if __name__ == "__main__":
    bench.main()
