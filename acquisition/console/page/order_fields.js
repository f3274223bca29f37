// What the sheet of an order asks, and what is sent for what was answered. No DOM.

import { axis_units } from "./number_text.js";
import { failed_checks } from "./orders.js";

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {import("./order_sheet.js").Field} Field */

/**
 * Of the sheet that arms.
 * @param {any} status
 * @param {string} by  who ordered last
 * @param {Catalogue} words
 * @returns {Field[]}
 */
export function arming_fields(status, by, words) {
    const unit = words.unit(axis_units(status.axis).coordinate);
    /** @type {[string, string][]} */
    const passes = ["whole", "stretch", "circular", "straightness", "squareness"].map((pass) => [pass, words.text(`pass_${pass}`)]);
    return [
        { name: "datum_mm", label: words.text("datum", { unit }), kind: "number" },
        { name: "pass", label: words.text("pass"), kind: "choice", choices: passes },
        { name: "seed", label: words.text("seed"), kind: "number", decimals: 0 },
        field_of_name(by, words),
        ...fields_of_machine(words),
    ];
}

/**
 * What the certificate says of the machine, where the station file does not say it.
 * @param {Catalogue} words
 * @returns {Field[]}
 */
function fields_of_machine(words) {
    /** @type {[string, string][]} */
    const states = [["", words.text("as_in_file")], ["as found", words.text("state_as_found")], ["as left", words.text("state_as_left")], ["raw", words.text("state_raw")]];
    return [
        { name: "state", label: words.text("state_asked"), kind: "choice", choices: states },
        { name: "control_compensation", label: words.text("compensation_asked"), kind: "text" },
    ];
}

/**
 * Of the sheet that takes a point back.
 * @param {string} by  who ordered last
 * @param {Catalogue} words
 * @returns {Field[]}
 */
export function revising_fields(by, words) {
    return [{ name: "reason", label: words.text("reason"), kind: "text" }, field_of_name(by, words)];
}

/** @param {string} by @param {Catalogue} words @returns {Field} */
function field_of_name(by, words) {
    return { name: "by", label: words.text("by"), kind: "text", value: by };
}

/**
 * What is sent for a point: everything that names it, so that nothing else is meant.
 * @param {import("./accepted_points.js").Point} point
 * @param {string} reason
 * @param {string} by
 */
export function revision_of(point, reason, by) {
    return { target: point.target, direction: point.direction, cycle: point.approach, reason, ...(by === "" ? {} : { by }) };
}

/** A field that nobody filled in is left out: the station file's own statement holds. */
export function without_empty(values) {
    return Object.fromEntries(Object.entries(values).filter(([, value]) => value !== ""));
}

const override_mark = "override ";

/**
 * A reason may be given for each check that keeps a run from being armed: on the sheet, once the station has named them.
 * @param {import("./orders.js").Answer} answer @param {Catalogue} words
 * @returns {Field[]}
 */
export function override_fields(answer, words) {
    return failed_checks(answer).map(({ name }) => ({ name: override_mark + name, label: words.text("override_why", { check: name }), kind: "text" }));
}

/** What arming sends: what is stated of the machine, and reasons against checks, stand apart (docs/api.md). @param {Record<string, any>} values  of the sheet */
export function arming_of(values) {
    const { state, control_compensation, ...others } = values;
    const statements = without_empty({ state, control_compensation });
    const sent = /** @type {Record<string, any>} */ ({});
    const overrides = /** @type {Record<string, any>} */ ({});
    for (const [name, value] of Object.entries(without_empty(others)))
        if (name.startsWith(override_mark)) overrides[name.slice(override_mark.length)] = value;
        else sent[name] = value;
    if (Object.keys(statements).length > 0) sent.statements = statements;
    if (Object.keys(overrides).length > 0) sent.overrides = overrides;
    return sent;
}
