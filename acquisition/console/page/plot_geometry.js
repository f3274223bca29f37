// Where things of the plot stand. Nothing is computed of points and means but their place on the screen. No DOM.

import { band_values, bands_of } from "./plot_bands.js";

/** @typedef {import("./accepted_points.js").Point} Point */
/** @typedef {import("./accepted_points.js").Judged} Judged */
/** @typedef {import("./accepted_points.js").TargetSoFar} TargetSoFar */

const least_span = 2; // µm or seconds of arc: noise of one reading must not fill the plot
const margins = Object.freeze({ left: 64, right: 12, top: 12, bottom: 32 });
const end_room = 28; // beside the outermost targets: a ring around a point

/** @param {number} span @param {number} most  steps at most @returns {number} 1, 2 or 5 times a power of ten */
export function nice_step(span, most) {
    const rough = span / most;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].find((nice) => nice * power >= rough * (1 - 1e-9)) ?? 10;
    return step * power;
}

/**
 * @param {number[]} values
 * @param {number} most  steps at most
 * @returns {{low: number, high: number, step: number}} whole steps around all values and 0
 */
export function value_range(values, most) {
    let low = Math.min(0, ...values);
    let high = Math.max(0, ...values);
    const lacking = least_span - (high - low);
    if (lacking > 0) {
        low -= lacking / 2;
        high += lacking / 2;
    }
    const step = nice_step(high - low, most);
    return { low: Math.floor(low / step) * step, high: Math.ceil(high / step) * step, step };
}

/**
 * Where each target stands: at its place, or one beside the other where the station does not tell the places.
 * @param {Drawn} drawn @param {number | null} next
 * @returns {{order: {target: number, place: number}[], by_place: boolean}} from left to right
 */
function places_of({ judged, nominals }, next) {
    const last = Math.max(-1, next ?? -1, ...judged.map(({ point }) => point.target));
    const by_place = nominals !== null && nominals.length > last && nominals.length > 0;
    const places = by_place ? nominals : Array.from({ length: Math.max(2, last + 1) }, (_, target) => target);
    const order = places.map((place, target) => ({ target, place })).sort((a, b) => a.place - b.place);
    return { order, by_place };
}

/** @param {ReturnType<typeof places_of>} places @param {number} width  within the frame @returns {(target: number) => number} */
function scale_of({ order, by_place }, width) {
    const low = order[0].place;
    const span = order[order.length - 1].place - low;
    const pad = by_place ? Math.min(end_room, width / 4) : width / (2 * order.length);
    const x_by_target = new Map(order.map(({ target, place }) => {
        const part = span === 0 ? 0.5 : (place - low) / span;
        return [target, margins.left + pad + (width - 2 * pad) * part];
    }));
    return (target) => x_by_target.get(target) ?? margins.left;
}

/**
 * @typedef {object} Drawn
 * @property {Judged[]} judged
 * @property {readonly number[] | null} nominals  places of the plan's targets
 * @property {ReadonlyMap<number, TargetSoFar>} targets
 */

/**
 * @param {Drawn} drawn
 * @param {{width: number, height: number, factor: number, next: number | null}} view
 *        `factor` from µm to the unit shown; `next`: the target that is next, from 0
 */
export function plot_of(drawn, view) {
    const { judged, targets } = drawn;
    const values = [...judged.map(({ point }) => point.deviation_um), ...band_values(targets.values())].map((um) => um * view.factor);
    const range = value_range(values, view.height < 200 ? 4 : 6);
    const inner_width = view.width - margins.left - margins.right;
    const inner_height = view.height - margins.top - margins.bottom;
    const places = places_of(drawn, view.next);
    const x_of = scale_of(places, inner_width);
    const y_of = (value) => margins.top + (inner_height * (range.high - value)) / (range.high - range.low);
    const beside = Math.min(10, (inner_width / places.order.length) * 0.2); // the two directions stand side by side
    const x_of_side = (target, direction) => x_of(target) + (direction === "positive" ? -beside : beside);
    const dots = judged.map(({ point, counts, left_out }, nth) => ({
        x: x_of_side(point.target, point.direction),
        y: y_of(point.deviation_um * view.factor),
        direction: point.direction,
        counts,
        left_out,
        latest: nth === judged.length - 1,
        point,
    }));
    return {
        dots,
        sides: bands_of(places.order, targets, x_of_side, (um) => y_of(um * view.factor)),
        next_x: view.next === null ? null : x_of(view.next),
        zero_y: y_of(0),
        lines: lines_of(range).map((value) => ({ value, y: y_of(value) })),
        targets: places.order.map(({ target }) => ({ target, x: x_of(target) })),
        ends: places.by_place ? { first: places.order[0].place, last: places.order[places.order.length - 1].place } : null,
        decimals: Math.max(0, -Math.floor(Math.log10(range.step) + 1e-9)),
        left: margins.left,
        right: view.width - margins.right,
        top: margins.top,
        bottom: view.height - margins.bottom,
    };
}

function lines_of(range) {
    const count = Math.round((range.high - range.low) / range.step);
    return Array.from({ length: count + 1 }, (_, nth) => range.low + nth * range.step);
}

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
