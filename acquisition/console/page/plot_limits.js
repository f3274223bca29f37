// The limits that were agreed on, as two lines in the plot. No DOM.

import { directions } from "./plot_bands.js";
import { is_number } from "./freshness.js";

/** @typedef {import("./accepted_points.js").TargetSoFar} TargetSoFar */
/** @typedef {{parameter: string, limit_um: number | null, value_um: number | null}} Limit */
/** @typedef {{parameter: string, limit_um: number, low_um: number, high_um: number}} LimitLines */

/** Of one side, what each figure is the width of (ISO 230-2: A of mean ± 2 s, E of the means). */
const widths = Object.freeze({ A: (side) => [side.low_um, side.high_um], E: (side) => [side.mean_um] });
const widest = 4; // times the figure: beyond that the marks would lie flat between the lines
const rounding_um = 0.06; // a figure comes rounded

/** @param {Iterable<TargetSoFar>} targets @param {(side: any) => (number | null)[]} values_of */
function reach_of(targets, values_of) {
    const values = [...targets].flatMap((row) => directions.flatMap((direction) => values_of(row[direction]).filter(is_number)));
    return values.length === 0 ? null : { low: Math.min(...values), high: Math.max(...values) };
}

/**
 * A limit is that of a width and has no place of its own: its lines lie as far above what was measured as below it, so that bands which
 * reach beyond one of them also reach beyond the other. Only where the figure is as wide as what is drawn: not before every target has
 * its points, and not for a standard that computes it otherwise.
 * @param {Iterable<TargetSoFar>} targets @param {readonly Limit[]} limits
 * @returns {LimitLines | null} of A, else of E
 */
export function limit_lines(targets, limits) {
    const rows = [...targets];
    for (const [parameter, values_of] of Object.entries(widths)) {
        const reach = reach_of(rows, values_of);
        const limit = limits.find((one) => one.parameter === parameter);
        if (reach === null || !limit || !is_number(limit.limit_um) || !is_number(limit.value_um)) continue;
        const { limit_um, value_um } = limit;
        if (Math.abs(reach.high - reach.low - value_um) > rounding_um || limit_um > widest * value_um) continue;
        const beyond = (limit_um - (reach.high - reach.low)) / 2;
        return { parameter, limit_um, low_um: reach.low - beyond, high_um: reach.high + beyond };
    }
    return null;
}
