"""A bench whose station shows its page, and what the tests of the page share."""

import contextlib
import os
import sys
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / "simulation"), str(TESTS / "support")]

import bench  # noqa: E402
from bench import SOURCE, expect, sentence  # noqa: E402, F401
from browser import Browser  # noqa: E402
from page_hands import MAY_ONLY_LOOK, arm, code_of, go, is_on, is_shown, open_sheet, pair, points_drawn, state_machine  # noqa: E402, F401

PAGE = Path(os.environ["AXISCAL_PATH"]).resolve().parent / "share/axiscal/page"  # where the programs of the build find it
ABORT_S = 0.8  # for so long abort is held
SIZES = [(1280, 800), (800, 480), (390, 844)]
SCREENS = ["now", "setup", "run", "result", "history", "doctor"]
# The screens behind the first one are made in one step, by who goes there or half a minute later.
EVERY_SCREEN_IS_MADE = "document.querySelector('#doctor_settings').childElementCount > 0"
# A script for the page: by how much its own timer has been late, which on a busy computer is no fault of the page's.
NOTE_LATENESS = """
window.late_ms = 0;
{
    let before = performance.now();
    setInterval(() => {
        const at = performance.now();
        window.late_ms = Math.max(window.late_ms, at - before - 20);
        before = at;
    }, 20);
}
"""
# A script for the page, before its own: `hear_through(change)` lets each event of the station, a text, pass through change, which gives back
# a list of events in its place.
HEAR_THROUGH = r"""
const hear_through = (change) => {
    const asked_itself = window.fetch;
    window.fetch = async (...asked) => {
        const answer = await asked_itself(...asked);
        if (asked[0] !== '/v1/events' || !answer.ok) return answer;
        const decoder = new TextDecoder(), encoder = new TextEncoder();
        let rest = '';
        const between = new TransformStream({transform(bytes, onward) {
            const events = (rest + decoder.decode(bytes, {stream: true})).split('\n\n');
            rest = events.pop();
            for (const event of events.flatMap(change)) onward.enqueue(encoder.encode(event + '\n\n'));
        }});
        return new Response(answer.body.pipeThrough(between), answer);
    };
};
const is_status = (event) => /^event: status$/m.test(event);
const data_of = (event, change) => event.replace(/^data: (.*)$/m, (_, data) => 'data: ' + JSON.stringify(change(JSON.parse(data))));
"""
# Hands each status that the station sends to the page as often as window.times says, as if it had come so often.
REPEATING = HEAR_THROUGH + """
window.times = 1;
window.heard = 0;
hear_through((event) => {
    const times = is_status(event) ? window.times : 1;
    window.heard += times;
    return Array(times).fill(event);
});
"""


def with_page(b):
    """Before b.start(): the page as it ships, with its packed files, at a port of its own. Gives back its address."""
    b.station["console"]["port"] = bench.free_port()
    return f"http://127.0.0.1:{b.station['console']['port']}/"


def in_mid_run(b, points=3):
    """A run whose CNC holds after so many points, all of them durable. Gives back the page's address."""
    address = with_page(b)
    b.begin_run(hold_after=points)
    b.wait_for_points(points)
    return address


def before_arming(b, address):
    """The station runs, the CNC has its program and waits at the datum."""
    b.start()
    b.write_program()
    b.go_to_datum()
    return address


@contextlib.contextmanager
def opened(address, planted="", **words):
    """A browser with the page, once it shows a reading; planted: a script that runs before the page's own. At the end its console must have been silent."""
    with Browser(**words) as page:
        if planted:
            page.tell("Page.addScriptToEvaluateOnNewDocument", source=planted)
        page.open(address)
        page.wait("the page shows the station", lambda: page.text("#now_reading"))
        yield page
        said = page.complaints()
        expect(not said, f"the console of the browser: {said}")


def press(page, kind, place):
    """kind: mousePressed or mouseReleased, of the first finger at a place of the page."""
    page.tell("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], button="left", buttons=1, clickCount=1)


def pair_with(b, page, name):
    pair(page, code_of(b.axiscal("pair", name)))
