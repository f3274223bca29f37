// What is told uPlot of a plot, and where marks stand once it has made the scales. Nothing is computed of points and means but
// their place on the screen. No DOM.

import { band_values, bands_of } from "./plot_bands.js";

/** @typedef {import("./accepted_points.js").Point} Point */
/** @typedef {import("./accepted_points.js").Judged} Judged */
/** @typedef {import("./accepted_points.js").TargetSoFar} TargetSoFar */

/** Around the frame, in pixels: names on the left and below. */
export const margins = Object.freeze({ left: 64, right: 12, top: 12, bottom: 32 });
const least_span = 2; // µm or seconds of arc: noise of one reading must not fill the plot
const end_room = 28; // beside the outermost targets: a ring around a point
const least_step = 24; // pixels between two lines of the grid: their names stand apart

/** Steps of the grid: 1, 2 or 5 times a power of ten, so that names have few digits. */
export const steps = Object.freeze([-3, -2, -1, 0, 1, 2, 3, 4, 5, 6].flatMap((power) => [1, 2, 5].map((nice) => Number(`${nice}e${power}`))));

/** @param {number} height  of the frame @returns {number} pixels between two lines of the grid at least */
export function step_room(height) {
    return Math.max(least_step, height / (height < 156 ? 4 : 6));
}

/** @param {number} step  of the grid @returns {number} */
export function decimals_of(step) {
    return Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
}

/**
 * @param {number | null} low @param {number | null} high  null: there is nothing yet
 * @returns {[number, number]} with 0 in it
 */
export function least_range(low, high) {
    const lowest = Math.min(0, low ?? 0);
    const highest = Math.max(0, high ?? 0);
    const lacking = Math.max(0, least_span - (highest - lowest));
    return [lowest - lacking / 2, highest + lacking / 2];
}

/**
 * Where each target stands: at its place, or one beside the other where the station does not tell the places.
 * @param {Drawn} drawn @param {number | null} next
 * @returns {{order: {target: number, place: number}[], by_place: boolean}} from left to right
 */
export function places_of({ judged, nominals }, next) {
    const last = Math.max(-1, next ?? -1, ...judged.map(({ point }) => point.target));
    const by_place = nominals !== null && nominals.length > last && nominals.length > 0;
    const places = by_place ? nominals : Array.from({ length: Math.max(2, last + 1) }, (_, target) => target);
    const order = places.map((place, target) => ({ target, place })).sort((a, b) => a.place - b.place);
    return { order, by_place };
}

/** @typedef {ReturnType<typeof places_of>} Places */

/**
 * What the axis of places reaches over: the outermost targets have room beside them.
 * @param {Places} places @param {number} width  of the frame @returns {[number, number]}
 */
export function place_range({ order, by_place }, width) {
    const low = order[0].place;
    const high = order[order.length - 1].place;
    if (low === high) return [low - 1, high + 1];
    const room = by_place ? Math.min(end_room, width / 4) : width / (2 * order.length);
    const beyond = ((high - low) * room) / (width - 2 * room);
    return [low - beyond, high + beyond];
}

/**
 * @typedef {object} Drawn
 * @property {Judged[]} judged
 * @property {readonly number[] | null} nominals  places of the plan's targets
 * @property {ReadonlyMap<number, TargetSoFar>} targets
 * @property {import("./plot_limits.js").LimitLines | null} limits
 */

/**
 * What uPlot makes its scales of: places, and of each the lowest and the highest value that has to have room.
 * @param {Drawn} drawn @param {Places} places @param {number} factor  from µm to the unit shown
 * @returns {(number | null)[][]}
 */
export function data_of({ judged, targets, limits }, { order }, factor) {
    /** @type {Map<number, number[]>} */
    const values = new Map(order.map(({ target }) => [target, []]));
    for (const { point } of judged) values.get(point.target)?.push(point.deviation_um);
    for (const row of targets.values()) values.get(row.target)?.push(...band_values([row]));
    if (limits !== null) values.get(order[0].target)?.push(limits.low_um, limits.high_um);
    const each = (find) => order.map(({ target }) => {
        const all = values.get(target) ?? [];
        return all.length === 0 ? null : find(...all) * factor;
    });
    return [order.map(({ place }) => place), each(Math.min), each(Math.max)];
}

/**
 * @typedef {object} Scales  as uPlot has made them
 * @property {(place: number) => number} x_of  in pixels
 * @property {(value: number) => number} y_of  in pixels, of a value in the unit shown
 * @property {number} width  of the frame
 * @property {number} factor  from µm to the unit shown
 */

/** @param {Drawn} drawn @param {Places} places @param {number | null} next  the target that is next, from 0 @param {Scales} scales */
export function marks_of({ judged, targets, limits }, { order, by_place }, next, { x_of, y_of, width, factor }) {
    const x_by_target = new Map(order.map(({ target, place }) => [target, x_of(place)]));
    const x_of_target = (target) => x_by_target.get(target) ?? x_of(order[0].place);
    const beside = Math.min(10, (width / order.length) * 0.2); // the two directions stand side by side
    const x_of_side = (target, direction) => x_of_target(target) + (direction === "positive" ? -beside : beside);
    const dots = judged.map(({ point, counts, left_out }, nth) => ({
        x: x_of_side(point.target, point.direction),
        y: y_of(point.deviation_um * factor),
        direction: point.direction,
        counts,
        left_out,
        latest: nth === judged.length - 1,
        point,
    }));
    return {
        dots,
        sides: bands_of(order, targets, x_of_side, (um) => y_of(um * factor)),
        next_x: next === null ? null : x_of_target(next),
        zero_y: y_of(0),
        limit_ys: limits === null ? [] : [limits.high_um, limits.low_um].map((um) => y_of(um * factor)),
        targets: order.map(({ target }) => ({ target, x: x_of_target(target) })),
        ends: by_place ? { first: order[0].place, last: order[order.length - 1].place } : null,
    };
}

/** @typedef {ReturnType<typeof marks_of>} Marks */

/**
 * The point that a finger means.
 * @param {{x: number, y: number, point: Point}[]} dots
 * @returns {Point | null} the nearest one within half a finger; of two as near the later one
 */
export function point_at(dots, x, y, reach = 36) {
    let best = null;
    let nearest = reach;
    for (const dot of dots) {
        const away = Math.hypot(dot.x - x, dot.y - y);
        if (away <= nearest) {
            nearest = away;
            best = dot.point;
        }
    }
    return best;
}
