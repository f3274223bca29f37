"""A page that stands for long holds no more than in the beginning: what it holds is counted, and no clock judges it."""

from page_bench import EVERY_SCREEN_IS_MADE, REPEATING, Browser, bench, expect, in_mid_run, points_drawn, sentence

SECOND_FRAMES = 20  # as many as the station sends at most
FRAMES = 300 * SECOND_FRAMES  # as many as five minutes have
HEAP_KIB = 512
COUNTED = ("documents", "nodes", "jsEventListeners")


def held(page):
    """Once what nobody holds is collected."""
    page.tell("HeapProfiler.collectGarbage")
    return {**page.tell("Memory.getDOMCounters"), "heap_kib": page.tell("Runtime.getHeapUsage")["usedSize"] / 1024}


def hear(page, frames):
    page.ask("void (window.times = 100)")
    page.ask("void (window.heard = 0)")
    page.wait(f"{frames} frames are heard", lambda: page.ask("window.heard") >= frames, 120)
    page.ask("void (window.times = 1)")
    page.wait("the page is at rest", lambda: points_drawn(page, "now") == 3)


@sentence("SixThousandFramesLeaveNothingBehind")
def frames(b):
    address = in_mid_run(b)
    with Browser() as page:
        page.tell("Page.addScriptToEvaluateOnNewDocument", source=REPEATING)
        page.open(address)
        page.wait("three points are drawn", lambda: points_drawn(page, "now") == 3)
        page.wait("every screen is made", lambda: page.ask(EVERY_SCREEN_IS_MADE), 120)
        hear(page, FRAMES // 10)  # what is made once is made
        before = held(page)
        hear(page, FRAMES)
        # A warning may stand there for a moment on a busy computer: it goes, what is left behind stays.
        page.wait(f"no more than {before}", lambda: all(held(page)[kind] <= before[kind] for kind in COUNTED), 60)
        after = held(page)
        print(f"before {FRAMES} frames {before}, after them {after}")
        expect(after["heap_kib"] - before["heap_kib"] <= HEAP_KIB, f"heap: {before['heap_kib']:.0f} KiB before, {after['heap_kib']:.0f} after")
        expect("mm" in page.text("#now_reading .big"), page.text("#now_reading"))
        expect(not page.complaints(), "the console of the browser is not silent")


if __name__ == "__main__":
    bench.main()
