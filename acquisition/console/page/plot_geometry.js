// Where things of the plot stand. Nothing is computed of the points but their place on the screen. No DOM.

/** @typedef {import("./accepted_points.js").Point} Point */

const least_span = 2; // µm or seconds of arc: noise of one reading must not fill the plot
const margins = Object.freeze({ left: 64, right: 12, top: 12, bottom: 32 });

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
 * @param {{point: Point, counts: boolean}[]} judged
 * @param {{width: number, height: number, factor: number, next: number | null}} view
 *        `factor` from µm to the unit shown; `next`: the target that is next, from 0
 */
export function plot_of(judged, view) {
    const values = judged.map(({ point }) => point.deviation_um * view.factor);
    const range = value_range(values, view.height < 200 ? 4 : 6);
    const last_target = Math.max(1, view.next ?? 0, ...judged.map(({ point }) => point.target));
    const inner_width = view.width - margins.left - margins.right;
    const inner_height = view.height - margins.top - margins.bottom;
    const x_of = (target) => margins.left + (inner_width * (target + 0.5)) / (last_target + 1);
    const y_of = (value) => margins.top + (inner_height * (range.high - value)) / (range.high - range.low);
    const beside = Math.min(10, (inner_width / (last_target + 1)) * 0.2); // the two directions stand side by side
    const dots = judged.map(({ point, counts }, nth) => ({
        x: x_of(point.target) + (point.direction === "positive" ? -beside : beside),
        y: y_of(point.deviation_um * view.factor),
        direction: point.direction,
        counts,
        latest: nth === judged.length - 1,
        point,
    }));
    return {
        dots,
        next_x: view.next === null ? null : x_of(view.next),
        zero_y: y_of(0),
        lines: lines_of(range).map((value) => ({ value, y: y_of(value) })),
        targets: targets_of(last_target, inner_width).map((target) => ({ target, x: x_of(target) })),
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

/** As many names as have room, each 40 wide. */
function targets_of(last_target, width) {
    const every = Math.max(1, Math.ceil(((last_target + 1) * 40) / Math.max(40, width)));
    return Array.from({ length: Math.floor(last_target / every) + 1 }, (_, nth) => nth * every);
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
