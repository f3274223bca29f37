// The alignment of the beam as the station keeps it (docs/alignment.md), as text. Nothing of it is computed here. No DOM.

import { is_number } from "./freshness.js";
import { no_number, number_text } from "./number_text.js";
import { date_text } from "./time_text.js";

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {{distance_mm: number, error_um: number, bound_um: number | null}} Cosine */
/**
 * @typedef {object} Alignment  GET /v1/alignment
 * @property {boolean} running @property {number | null} distance_mm @property {boolean} at_rest
 * @property {{ended: string, reached_mm: number, travel_mm: number, restarts: number, cosine: Cosine | null,
 *   far: {distance_mm: number, highest_mm: number, last_mm: number, scatter_um: number, passed_maximum: boolean} | null} | null} record
 */

/** @param {number | null} value @param {number} decimals @param {Catalogue} words */
function number_of(value, decimals, words) {
    return is_number(value) ? number_text(value, decimals, { decimal_mark: words.decimal_mark }).trim() : no_number;
}

/** @param {Alignment | null} view  null: not asked yet @param {Catalogue} words @returns {string[]} */
export function alignment_lines(view, words) {
    if (view === null) return [words.text("order_waits")];
    const { record } = view;
    if (record === null) return [words.text("align_none")];
    const seen = words.text("align_seen", { reached: number_of(record.reached_mm, 1, words), travel: number_of(record.travel_mm, 1, words) });
    const anew = record.restarts > 0 ? [words.text("align_anew", { count: record.restarts })] : [];
    return [`${state_line(view, words)} · ${seen}`, ...anew, ...far_lines(record.far, view.running, words), ...cosine_lines(record.cosine, words)];
}

/** @param {Alignment} view */
function state_line(view, words) {
    if (!view.running) return words.text("align_kept", { time: date_text(view.record?.ended ?? "", words) });
    const motion = words.text(view.at_rest ? "align_rests" : "align_moves");
    return words.text("align_now", { distance: number_of(view.distance_mm, 4, words), motion });
}

function far_lines(far, running, words) {
    if (far === null) return running ? [words.text("align_drive")] : [];
    const fields = {
        distance: number_of(far.distance_mm, 1, words),
        below: number_of(1000 * (far.highest_mm - far.last_mm), 2, words),
        scatter: number_of(far.scatter_um, 2, words),
    };
    return [words.text("align_far", fields), ...(running && !far.passed_maximum ? [words.text("align_steer")] : [])];
}

/** @param {Cosine | null} found */
function cosine_lines(found, words) {
    if (found === null) return [];
    const fields = { error: number_of(found.error_um, 2, words), distance: number_of(found.distance_mm, 0, words) };
    if (!is_number(found.bound_um)) return [words.text("align_cosine_more", fields)];
    return [words.text("align_cosine", { ...fields, bound: number_of(found.bound_um, 2, words) })];
}

/**
 * Why no alignment can be ordered now; empty: it can.
 * @param {{contact: boolean, refusal: string, run_open: boolean}} now  refusal: the station's, for want of rights
 */
export function alignment_off(now, words) {
    if (!now.contact) return words.text("off_no_contact");
    if (now.refusal !== "") return now.refusal;
    return now.run_open ? words.text("off_run_open") : "";
}
