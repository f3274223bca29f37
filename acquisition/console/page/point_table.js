// The accepted points as a table. No DOM.

import { is_number } from "./freshness.js";
import { no_number, number_text } from "./number_text.js";

/** @typedef {import("./accepted_points.js").AcceptedPoints} AcceptedPoints */
/** @typedef {import("./accepted_points.js").Judged} Judged */
/** @typedef {import("./accepted_points.js").Point} Point */
/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {{head: string, cell: (one: Judged) => string}} Column */

/**
 * A station of before tells no places and not what was left out: then there are no such columns.
 * @param {AcceptedPoints} accepted @param {{factor: number, deviation: string, place: string}} units @param {Catalogue} words
 * @returns {{heads: string[], rows: {point: Point, label: string, cells: string[]}[]}} the first cell of a row is the target's name
 */
export function table_of(accepted, units, words) {
    const columns = columns_of(accepted, units, words);
    const rows = accepted.judged().map((one) => ({
        point: one.point,
        label: `P${one.point.target + 1} ${words.text(`side_${one.point.direction}`)} ${one.point.approach + 1}`,
        cells: columns.map(({ cell }) => cell(one)),
    }));
    return { heads: columns.map(({ head }) => head), rows };
}

/** @returns {Column[]} */
function columns_of(accepted, units, words) {
    const { points } = accepted;
    const style = { decimal_mark: words.decimal_mark };
    const place = (value) => (is_number(value) ? number_text(value, 3, style) : no_number);
    const deviation = ({ point }) => number_text(point.deviation_um * units.factor, 2, { ...style, plus: true });
    const again = ({ counts, left_out }) => (counts || left_out ? "" : ` (${words.text("point_replaced")})`);
    const places = { head: `${words.text("place_head")} ${units.place}`, cell: ({ point }) => place(point.nominal_mm) };
    const left_out = { head: words.text("left_out_head"), cell: (one) => (one.left_out ? words.text("point_left_out") : "") };
    return [
        { head: words.text("target_head"), cell: ({ point }) => `P${point.target + 1}` },
        ...(points.some(({ nominal_mm }) => nominal_mm !== undefined) ? [places] : []),
        { head: words.text("side_head"), cell: ({ point }) => words.text(`side_${point.direction}`) },
        { head: words.text("approach_head"), cell: ({ point }) => String(point.approach + 1) },
        { head: `${words.text("deviation")} ${units.deviation}`, cell: (one) => deviation(one) + again(one) },
        ...(points.some(({ excluded }) => excluded !== undefined) ? [left_out] : []),
    ];
}
