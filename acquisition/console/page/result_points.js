// The readings of a certificate in the form that the plot draws, with mean and s as the certificate has them. No DOM.

import { is_number } from "./freshness.js";

/** @typedef {import("./accepted_points.js").PointsEvent} PointsEvent */
/** @typedef {import("./accepted_points.js").Point} Point */
/** @typedef {import("./accepted_points.js").Side} Side */
/** @typedef {{mean_um: number | null, s_um: number | null}} MeanOfSide */
/** @typedef {{target: number, place: number, positive: MeanOfSide, negative: MeanOfSide}} MeanRow */

const sides = Object.freeze(/** @type {const} */ ([["positive", "forward"], ["negative", "backward"]]));

/** To what the events call µm: of a rotary axis thousandths of a degree. @param {any} document */
function factor_of(document) {
    const across = ["axiscal.straightness/1", "axiscal.squareness/1"].includes(document.format);
    return across ? 1 : 1000;
}

const scaled = (value, factor) => (is_number(value) ? value * factor : null);
const list_or_none = (value) => (Array.isArray(value) ? value : []);

/** @param {any} run  of the certificate @returns {number[]} */
function places_of(run) {
    const places = run.deviations.targets ?? run.deviations.targets_mm ?? run.plan?.targets ?? run.plan?.targets_mm;
    return list_or_none(places).filter(is_number);
}

/** Approaches, from 0, of which no reading stands in the list: what stands there are the others, in their order. */
function without_reading(document, target, direction) {
    const rows = list_or_none(document.completeness?.left_out).filter((row) => row.target === target && row.direction === direction);
    return new Set(rows.flatMap(({ approaches }) => list_or_none(approaches)));
}

/** @returns {Omit<Point, "step" | "sequence">[]} */
function counting_points(document, places, factor) {
    return sides.flatMap(([direction, key]) =>
        list_or_none(document.run.deviations[key]).flatMap((values, target) => {
            const missing = without_reading(document, target, direction);
            let approach = -1;
            return list_or_none(values).filter(is_number).map((value) => {
                do approach += 1;
                while (missing.has(approach));
                return { target, nominal_mm: places[target], direction, approach, deviation_um: value * factor, excluded: false };
            });
        }),
    );
}

/** What no figure uses: left out by a person, or taken again since. It stands before what counts. */
function points_set_aside(document, places, factor) {
    return list_or_none(document.run.set_aside)
        .filter(({ deviation, target }) => is_number(deviation) && is_number(target))
        .map(({ target, direction, approach, deviation, why }) => ({
            target, nominal_mm: places[target], direction, approach, deviation_um: deviation * factor, excluded: why === "excluded",
        }));
}

/** @returns {MeanOfSide} */
function mean_of(row, key, factor) {
    const value_of = (name) => scaled(row[`${name}_${key}`] ?? row[`${name}_${key}_um`], factor);
    return { mean_um: value_of("mean"), s_um: value_of("s") };
}

/** @param {MeanOfSide} mean @param {number} points @returns {Side} */
function side_of({ mean_um, s_um }, points) {
    const known = mean_um !== null && s_um !== null;
    return { points, mean_um, low_um: known ? mean_um - 2 * s_um : null, high_um: known ? mean_um + 2 * s_um : null };
}

/** What was agreed on, with the figure that is held against it. @returns {import("./plot_limits.js").Limit[]} */
function limits_agreed(document, factor) {
    return list_or_none(document.verdicts).map(({ parameter, limit, value }) => ({ parameter, limit_um: scaled(limit, factor), value_um: scaled(value, factor) }));
}

/**
 * @param {any} document  a certificate, or null
 * @returns {{event: PointsEvent, axis: {kind: string}, means: MeanRow[], limits: import("./plot_limits.js").Limit[]} | null} null: this kind of test has no readings at targets
 */
export function points_of_certificate(document) {
    if (!Array.isArray(document?.run?.deviations?.forward)) return null;
    const factor = factor_of(document);
    const places = places_of(document.run);
    const found = [...points_set_aside(document, places, factor), ...counting_points(document, places, factor)];
    const points = found.map((point, nth) => ({ ...point, step: nth, sequence: nth + 1 }));
    const means = list_or_none(document.positions).map((row, target) => ({
        target, place: places[target], positive: mean_of(row, "forward", factor), negative: mean_of(row, "backward", factor),
    }));
    const counted = (target, direction) => points.filter((one) => one.target === target && one.direction === direction && !one.excluded).length;
    const targets = means.map(({ target, place, positive, negative }) => ({
        target, nominal_mm: place, positive: side_of(positive, counted(target, "positive")), negative: side_of(negative, counted(target, "negative")),
    }));
    const event = { run: document.run.id, count: points.length, from: 0, points, target_nominals_mm: places, targets };
    return { event, axis: { kind: document.unit === "deg" ? "rotary" : "linear" }, means, limits: limits_agreed(document, factor) };
}
