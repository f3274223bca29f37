// What stands below the plot: names of the targets, and the place of the first and of the last one. No DOM.

const gap = 8;

/** @typedef {{text: string, x: number, anchor: "start" | "middle" | "end", width: number}} Label */
/** @typedef {{left: number, right: number, width_of: (text: string) => number}} Room  pixels */

/** @param {Label} label @returns {[number, number]} */
function reach_of({ x, anchor, width }) {
    const low = anchor === "start" ? x : anchor === "end" ? x - width : x - width / 2;
    return [low, low + width];
}

/**
 * In the middle below its target, or as near to that as the room allows.
 * @param {string} text @param {number} x @param {Room} room @returns {Label}
 */
function within(text, x, { left, right, width_of }) {
    const width = width_of(text);
    if (x - width / 2 < left) return { text, x: left, anchor: "start", width };
    if (x + width / 2 > right) return { text, x: right, anchor: "end", width };
    return { text, x, anchor: "middle", width };
}

/** @param {Label[]} labels  from left to right */
function is_clear(labels) {
    return labels.every((label, nth) => nth === 0 || reach_of(labels[nth - 1])[1] + gap <= reach_of(label)[0]);
}

const name_of = (target) => `P${target + 1}`;

/**
 * The two ends with name and place; without the names, then without the first, where there is less room.
 * @param {{target: number, x: number}[]} shown @param {{first: string, last: string}} places
 * @param {Room} room @returns {Label[]}
 */
function ends_of(shown, places, room) {
    const [first, last] = [shown[0], shown[shown.length - 1]];
    const named = ({ target }, place) => `${name_of(target)} = ${place}`;
    if (first === last) return [within(named(first, places.last), first.x, room)];
    const both = [within(named(first, places.first), first.x, room), within(named(last, places.last), last.x, room)];
    if (is_clear(both)) return both;
    const bare = [within(places.first, first.x, room), within(places.last, last.x, room)];
    return is_clear(bare) ? bare : bare.slice(1);
}

/**
 * As many names as have room: of every target, of every second, fifth, tenth, ...
 * @param {{target: number, x: number}[]} shown  from left to right
 * @param {{first: string, last: string} | null} places  null: not known
 * @param {Room} room
 * @returns {Label[]} from left to right
 */
export function labels_of(shown, places, room) {
    if (shown.length === 0) return [];
    const ends = places === null ? [] : ends_of(shown, places, room);
    const name_at = (text, x) => /** @type {Label} */ ({ text, x, anchor: "middle", width: room.width_of(text) });
    const names = shown.map(({ target, x }) => ({ target, label: name_at(name_of(target), x) }));
    for (let power = 1; power <= shown.length * 10; power *= 10)
        for (const every of [power, 2 * power, 5 * power]) {
            const some = names.filter(({ target }) => target % every === 0).map(({ label }) => label);
            if (is_clear(some)) return with_ends(some, ends);
        }
    return ends;
}

/** A name that would touch an end gives way. @param {Label[]} names @param {Label[]} ends */
function with_ends(names, ends) {
    const free = names.filter((name) => ends.every((end) => is_clear([name, end]) || is_clear([end, name])));
    return [...free, ...ends].sort((a, b) => reach_of(a)[0] - reach_of(b)[0]);
}
