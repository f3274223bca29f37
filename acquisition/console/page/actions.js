// Which buttons are on, and why one is off. The station alone decides what an order does; a button is off only where
// its answer is known: no contact, no right, or no run to which the order could belong. No DOM.

import { failed_checks } from "./orders.js";

/**
 * @typedef {object} Situation
 * @property {boolean} contact
 * @property {boolean} asleep  the first touch only wakes
 * @property {string} refusal  the station's sentence when it refused this browser an order for want of rights, or empty
 * @property {any} status  null before the first one
 * @property {boolean} picked  a point is picked in the plot
 */

/**
 * @typedef {object} Button
 * @property {boolean} on
 * @property {string} reason  key of the catalogue; empty where it is on
 * @property {string} sentence  the station's own words to it, or empty
 */

const on = Object.freeze({ on: true, reason: "", sentence: "" });
const off = (reason, sentence = "") => ({ on: false, reason, sentence });

/** @param {Situation} now @returns {Record<"arm" | "trigger" | "retake" | "exclude" | "abort", Button>} */
export function buttons_of(now) {
    const general = off_for_all(now);
    if (general) return { arm: general, trigger: general, retake: general, exclude: general, abort: general };
    const { status } = now;
    const revise = status.run === null ? off("off_no_run") : now.picked ? on : off("off_pick_point");
    const open = status.run_open === true;
    const drifts = status.drift !== null && status.drift.state === "recording";
    return {
        arm: open || drifts ? off("off_run_open") : on,
        trigger: open ? on : off("off_no_open_run"),
        retake: revise,
        exclude: revise,
        abort: open || drifts ? on : off("off_no_open_run"),
    };
}

/** @param {Situation} now @returns {Button | null} */
function off_for_all(now) {
    if (!now.contact || now.status === null) return off("off_no_contact");
    if (now.refusal !== "") return off("off_rights", now.refusal);
    if (now.asleep) return off("off_asleep");
    return null;
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
 * @param {import("./orders.js").Answer} answer @param {import("./catalogue.js").Catalogue} words
 * @returns {import("./order_sheet.js").Field[]}
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
