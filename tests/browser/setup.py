"""The screen Set-up: the strength of the beam, the tone that follows it, and the alignment."""

import signal

from page_beam import FAR_MM, STRUCK_STRENGTH, WATCH_AUDIO, aligned, at_far_end, jog, signal_mark, steered_away, strength_shown, tone_hz
from page_bench import bench, expect, go, opened, pair_with, sentence, with_page


@sentence("SetUpShowsTheStrengthOfTheBeamAndHowItFalls")
def strength(b):
    address = at_far_end(b)
    with opened(address) as page:
        go(page, "setup")
        page.wait("the strength of a beam that is aligned", lambda: (strength_shown(page) or 0) > 80)
        page.wait_for_text("#setup_beam .signal .mark", "strong enough")
        page.wait_for_text("#setup_devices li[data-name=laser]", "answers")
        page.wait_for_text("#setup_checks li[data-name=strength]", "● holds")
        left = steered_away(b)
        page.wait(f"{left:.1f} % are left", lambda: abs((strength_shown(page) or 100) - left) < 0.2)
        expect(signal_mark(page) == "warn", page.text("#setup_beam"))
        page.wait_for_text("#setup_beam .signal .mark", "too weak: at least 20 %")
        bar = page.ask("Number(document.querySelector('#setup_beam .meter').getAttribute('aria-valuenow'))")
        expect(abs(bar - left) < 1, f"the bar stands at {bar}")
        # The first touch may only wake the page.
        page.wait("the check does not hold", lambda: "does not hold" in page.text("#setup_checks li[data-name=strength]")
                  or page.click("#setup_checks .again"))
        b.sim("sensor laser off")
        page.wait("a strength that is stale", lambda: signal_mark(page) == "stale")
        expect(page.ask(STRUCK_STRENGTH) == "line-through" and strength_shown(page) is not None, page.text("#setup_beam"))


@sentence("ToneFollowsTheStrengthOnlyAfterATouchAndEndsWithTheScreen")
def tone(b):
    address = at_far_end(b)
    with opened(address) as page:
        page.driver.execute_script(WATCH_AUDIO)
        go(page, "setup")
        page.wait("the strength of a beam that is aligned", lambda: (strength_shown(page) or 0) > 80)
        expect(page.ask("window.heard.length") == 0 and tone_hz(page) is None, "a tone before any touch")
        page.wait("a touch starts the tone", lambda: page.ask("window.heard.length > 0") or page.click("#setup_beam .tone"))
        strong_hz = page.wait("it sounds", lambda: tone_hz(page))
        steered_away(b)
        page.wait("it falls with the strength", lambda: (tone_hz(page) or strong_hz) < strong_hz / 4)
        b.sim("sensor laser off")
        page.wait("it is silent without a fresh strength", lambda: tone_hz(page) is None)
        expect(signal_mark(page) in ("stale", "lost"), page.text("#setup_beam"))
        b.sim("sensor laser on")
        page.wait("it is back with the strength", lambda: tone_hz(page), 60)
        b.processes["axiscald"].send_signal(signal.SIGSTOP)
        try:
            page.wait("it is silent without contact", lambda: tone_hz(page) is None)
        finally:
            b.processes["axiscald"].send_signal(signal.SIGCONT)
        page.wait("it is back with the contact", lambda: tone_hz(page))
        go(page, "now")
        page.wait("it has ended with the screen", lambda: page.ask("window.heard.at(-1).state") == "closed")
        go(page, "setup")
        page.wait("a strength", lambda: strength_shown(page))
        expect(page.ask("window.heard.length") == 1 and tone_hz(page) is None, "the tone came back without a touch")


@sentence("AlignmentIsBegunAndKeptByThePage")
def alignment_kept(b):
    """The hidden angle of the beam is that of Simulation.Align*; here the orders and their answers are looked at."""
    address = with_page(b)
    b.start()
    jog(b, 0)
    with opened(address) as page:
        pair_with(b, page, "tablet")
        go(page, "setup")
        page.wait_for_text("#setup_checks .lines", "None was kept")
        page.wait("it is begun", lambda: aligned(b)["running"] or page.element("[data-align=begin]").click())
        page.wait_for_text("#setup_checks .lines", "Drive away from the laser")
        jog(b, FAR_MM)
        page.wait_for_text("#setup_checks .lines", f"Highest at {FAR_MM:.0f}.")
        page.wait("it is kept", lambda: not aligned(b)["running"] or page.element("[data-align=keep]").click())
        page.wait_for_text("#setup_checks .lines", "kept ")
        expect(abs(aligned(b)["record"]["far"]["distance_mm"] - FAR_MM) < 1, f"{aligned(b)}")


if __name__ == "__main__":
    bench.main()
