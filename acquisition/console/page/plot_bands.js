// The means of each direction as lines, and mean ± 2 s as bands, both as the station computed them. No DOM.

import { is_number } from "./freshness.js";

/** @typedef {import("./accepted_points.js").TargetSoFar} TargetSoFar */
/** @typedef {"positive" | "negative"} Direction */
/** @typedef {{direction: Direction, means: string[], bands: string[]}} DrawnSide  paths of SVG */

export const directions = Object.freeze(/** @type {Direction[]} */ (["positive", "negative"]));

const nothing = Object.freeze({ points: 0, mean_um: null, low_um: null, high_um: null });
const half_alone = 5; // a mean that has no neighbour is a dash, and its band a bar

/** What has to have room in the plot, in µm. @param {Iterable<TargetSoFar>} targets @returns {number[]} */
export function band_values(targets) {
    return [...targets].flatMap(({ positive, negative }) =>
        [positive, negative].flatMap(({ mean_um, low_um, high_um }) => [mean_um, low_um, high_um].filter(is_number)),
    );
}

/**
 * Neighbours that have a value. A target without one parts them: nothing is drawn where nothing was measured.
 * @template Value @param {(Value | null)[]} values @returns {Value[][]}
 */
export function stretches_of(values) {
    /** @type {Value[][]} */
    const stretches = [];
    let open = false;
    for (const value of values) {
        if (value !== null && open) stretches[stretches.length - 1].push(value);
        else if (value !== null) stretches.push([value]);
        open = value !== null;
    }
    return stretches;
}

const line_through = (corners) => corners.map(([x, y], nth) => `${nth === 0 ? "M" : "L"}${x} ${y}`).join("");

/** @param {{x: number, y: number}[]} stretch */
function mean_path(stretch) {
    const [{ x, y }] = stretch;
    if (stretch.length === 1) return line_through([[x - half_alone, y], [x + half_alone, y]]);
    return line_through(stretch.map((one) => [one.x, one.y]));
}

/** @param {{x: number, low: number, high: number}[]} stretch */
function band_path(stretch) {
    const [{ x, low, high }] = stretch;
    const wide = stretch.length > 1 ? stretch : [{ x: x - half_alone, low, high }, { x: x + half_alone, low, high }];
    const above = wide.map((one) => [one.x, one.high]);
    const below = wide.map((one) => [one.x, one.low]).reverse();
    return `${line_through([...above, ...below])}Z`;
}

/**
 * @param {{target: number}[]} order  targets from left to right
 * @param {ReadonlyMap<number, TargetSoFar>} targets
 * @param {(target: number, direction: Direction) => number} x_of
 * @param {(um: number) => number} y_of
 * @returns {DrawnSide[]}
 */
export function bands_of(order, targets, x_of, y_of) {
    return directions.map((direction) => {
        const sides = order.map(({ target }) => ({ x: x_of(target, direction), side: targets.get(target)?.[direction] ?? nothing }));
        const means = sides.map(({ x, side }) => (is_number(side.mean_um) ? { x, y: y_of(side.mean_um) } : null));
        const bands = sides.map(({ x, side: { low_um, high_um } }) =>
            is_number(low_um) && is_number(high_um) ? { x, low: y_of(low_um), high: y_of(high_um) } : null,
        );
        return { direction, means: stretches_of(means).map(mean_path), bands: stretches_of(bands).map(band_path) };
    });
}
