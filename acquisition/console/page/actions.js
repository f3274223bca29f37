// Which buttons are on, and why one is off. The station alone decides what an order does; a button is off only where
// its answer is known: no contact, no right, or no run to which the order could belong. No DOM.

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
