"""Nothing moves under a finger, whatever the station says meanwhile; once the finger is gone, it is shown."""

import json

from page_bench import HEAR_THROUGH, bench, expect, go, in_mid_run, opened, pair_with, sentence

LONGEST_PRESS_MS = 1500  # a hand that rests on the screen does not keep it from changing for ever (touch_guard.js)
ROUNDS = 20  # of presses, until one was as short as that: a computer that is busy looks late
SIZES = [(1280, 800), (800, 480), (390, 844)]
# What a finger may mean on each screen: it is pressed in its middle.
UNDER = {"now": "#now_cells .cell", "setup": "#setup_devices li", "run": "[data-order=retake]", "doctor": "#doctor_tasks li"}

# Everything that a station can say anew at once, while window.says_other holds: the run is gone, troubles have come, a device is lost, another one is new.
OTHER_WORDS = HEAR_THROUGH + """
window.says_other = false;
const trouble = (nth) => ({id: `trouble/${nth}`, rank: 'look', source: 'test', seen: `Trouble ${nth} is seen. `.repeat(12), since_utc: '', next: 'Mend it.', command: 'mend', undo: ''});
const other = (status) => {
    const [first, ...rest] = status.instruments;
    const told = {...first, state: 'lost', fault: 'timeout', note: 'It does not answer. '.repeat(9)};
    return {...status, run: null, run_open: false, to_do: [1, 2, 3, 4].map(trouble), instruments: [{...told, name: 'new'}, told, ...rest],
            channels: status.channels.slice(3), notes: [...status.notes, 'A note. '.repeat(40)]};
};
const data_of = (event, change) => event.replace(/^data: (.*)$/m, (_, data) => 'data: ' + JSON.stringify(change(JSON.parse(data))));
hear_through((event) => [window.says_other && is_status(event) ? data_of(event, other) : event]);
window.places = () => [...document.querySelectorAll('nav *, main *')].filter((one) => one.checkVisibility() && !one.closest('.reading, .next, .drawing, .orders button *'))
    .map((one) => ({one, at: one.getBoundingClientRect(), text: one.innerText}));
window.moved = () => window.held.filter(({one, at}) => {
    const now = one.getBoundingClientRect();
    const sides = one.localName === 'button' ? ['left', 'top', 'right', 'bottom'] : ['left', 'top'];
    return !one.isConnected || sides.some((side) => Math.abs(now[side] - at[side]) > 0.5);
}).map(({one, text}) => `${one.localName} ${one.id || one.className}: ${text?.slice(0, 40)}`);
const lively = '.reading, .next, .beam, .cells, .drawing, .orders'; // painted under the finger, too: nobody touches a number
window.is_shown = () => window.held.some(({one, text}) => !one.isConnected || (!one.closest(lively) && !one.querySelector(lively) && one.innerText !== text));
window.presses = 0;
document.addEventListener('pointerdown', () => (window.presses += 1), {capture: true});
"""


def press(page, kind, place):
    page.tell("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], button="left", buttons=1, clickCount=1)


def middle_of(page, selector):
    return page.wait(selector, lambda: page.ask(f"""((one) => {{
        if (!one?.checkVisibility()) return null;
        one.scrollIntoView({{block: 'nearest'}});
        const {{left, right, top, bottom}} = one.getBoundingClientRect();
        return [(left + right) / 2, (top + bottom) / 2];
    }})(document.querySelector({json.dumps(selector)}))"""))


def moved_under_finger(page, place):
    """What moved while a finger was down; None where it was down for too long."""
    page.ask("void (window.held = window.places())")
    pressed_at = page.ask("performance.now()")
    presses = page.ask("window.presses")
    press(page, "mousePressed", place)
    expect(page.ask("window.presses") == presses + 1, f"{place} is not pressed")
    page.ask("void (window.says_other = true)")
    try:
        # The strip is painted by the same step as all else.
        page.wait("the page has painted what the station says now", lambda: page.ask("document.querySelector('#strip').dataset.rank === 'look'"))
        moved = page.ask("window.moved()")
        return moved if page.ask("performance.now()") - pressed_at < LONGEST_PRESS_MS else None
    finally:
        press(page, "mouseReleased", (2, 2))  # nowhere


def expect_stillness(page, told, selector):
    for _ in range(ROUNDS):
        moved = moved_under_finger(page, middle_of(page, selector))
        page.wait(f"{told}: what was said is shown", lambda: page.ask("window.is_shown()"))
        page.ask("void (window.says_other = false)")
        page.wait("the station says what is so", lambda: page.ask("document.querySelector('#strip').dataset.rank") == "well")
        if moved is not None:
            return expect(not moved, f"{told}: {moved}")
    raise AssertionError(f"{told}: each of {ROUNDS} presses has lasted too long")


@sentence("NothingMovesUnderAFingerWhateverTheStationSays")
def still(b):
    address = in_mid_run(b)
    with opened(address, planted=OTHER_WORDS) as page:
        pair_with(b, page, "panel")
        for size in SIZES:
            page.resize(size)
            for screen, selector in UNDER.items():
                go(page, screen)
                expect_stillness(page, f"{size}, {screen}", selector)


if __name__ == "__main__":
    bench.main()
