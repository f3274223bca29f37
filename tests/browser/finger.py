"""Nothing moves under a finger, whatever the station says meanwhile; once the finger is gone, it is shown."""

import json

from page_bench import HEAR_THROUGH, SIZES, bench, expect, go, in_mid_run, is_on, opened, pair_with, press, sentence

LONGEST_PRESS_MS = 1500  # a hand that rests on the screen does not keep it from changing for ever (touch_guard.js)
ROUNDS = 20  # of presses, until one was as short as that: a computer that is busy looks late
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
hear_through((event) => [window.says_other && is_status(event) ? data_of(event, other) : event]);
window.places = () => [...document.querySelectorAll('nav *, main *')].filter((one) => one.checkVisibility() && !one.closest('.reading, .next, .drawing, .orders button *'))
    .map((one) => ({one, at: one.getBoundingClientRect(), text: one.innerText}));
window.moved = () => window.held.filter(({one, at}) => {
    const now = one.getBoundingClientRect();
    const sides = one.localName === 'button' ? ['left', 'top', 'right', 'bottom'] : ['left', 'top'];
    return !one.isConnected || sides.some((side) => Math.abs(now[side] - at[side]) > 0.5);
}).map(({one, text}) => `${one.localName} ${one.id || one.className}: ${text?.slice(0, 40)}`);
const lively = '.reading, .next, .beam, .cells, .drawing, .orders'; // painted under the finger, too: numbers, which nobody touches, and orders that go off
window.is_shown = () => window.held.some(({one, text}) => !one.isConnected || (!one.closest(lively) && !one.querySelector(lively) && one.innerText !== text));
window.presses = 0;
document.addEventListener('pointerdown', () => (window.presses += 1), {capture: true});
"""


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


# What the page orders goes to nobody and is counted.
ORDERS_COUNTED = OTHER_WORDS + """
window.ordered = 0;
const asked_anything = window.fetch;
window.fetch = (path, ...others) => {
    if (path !== '/v1/run/trigger') return asked_anything(path, ...others);
    window.ordered += 1;
    return Promise.resolve(new Response('{}', {headers: {'Content-Type': 'application/json'}}));
};
"""


def say(page, other):
    page.ask(f"void (window.says_other = {json.dumps(other)})")
    page.wait("the page has painted what the station says now",
              lambda: page.ask("document.querySelector('#strip').dataset.rank") == ("look" if other else "well"))


def trigger_touched(page, other_before, other_after):
    """(whether it was on before the release, orders given by it), where the station speaks under the finger; None where that was down for too long."""
    say(page, other_before)
    page.wait("the order is as the station says", lambda: is_on(page, "trigger") is not other_before)
    place = middle_of(page, "[data-order=trigger]")
    ordered = page.ask("window.ordered")
    pressed_at = page.ask("performance.now()")
    press(page, "mousePressed", place)
    say(page, other_after)
    was_on = is_on(page, "trigger")
    press(page, "mouseReleased", place)
    if page.ask("performance.now()") - pressed_at >= LONGEST_PRESS_MS:
        return None
    return was_on, page.ask("window.ordered") - ordered


@sentence("OrderIsGivenOnlyWhereItWasOnFromTouchToRelease")
def orders(b):
    address = in_mid_run(b)
    with opened(address, planted=ORDERS_COUNTED) as page:
        pair_with(b, page, "panel")
        for before, after, wanted in [(True, False, (False, 0)), (False, True, (False, 0)), (False, False, (True, 1))]:
            touched = next(filter(None, (trigger_touched(page, before, after) for _ in range(ROUNDS))), None)
            expect(touched is not None, f"each of {ROUNDS} presses has lasted too long")
            expect(touched == wanted, f"no run: {before} at the touch, {after} at the release: on and ordered are {touched}")


if __name__ == "__main__":
    bench.main()
