// What a value is worth now, by the station's own word and by the page's own clock. No DOM.

/** Nothing heard for so long is no contact, whatever the connection says (docs/api.md, Events). */
export const contact_limit_ms = 2000;
/** Of laser and ballbar, where a station of before does not tell its own limit. */
const reading_limit_of_before_s = 2;

/** @typedef {"good" | "moving" | "stale" | "lost" | "none"} Mark  shape, word and colour of a value */

/** Shapes that differ without colour. */
export const shapes = Object.freeze({ good: "●", moving: "◐", stale: "▲", lost: "✕", none: "–" });

const marks = Object.freeze({
    good: "good",
    stale: "stale",
    signal_error: "lost",
    beam_lost: "lost",
    absent: "lost",
    none: "none",
});

/**
 * @param {string} quality  as the station says it
 * @returns {Mark} a word that this page does not know is no good value
 */
export function mark_of(quality) {
    return Object.hasOwn(marks, quality) ? marks[quality] : "lost";
}

/** @param {unknown} value @returns {value is number} */
export function is_number(value) {
    return typeof value === "number" && Number.isFinite(value);
}

/**
 * @typedef {object} Heard  how the page hears the station now
 * @property {boolean} contact  something was heard within the limit
 * @property {number} status_age_ms  since the status that is shown came
 */

/**
 * The station's own limits, seen here without waiting for its word.
 * @param {{quality: string, age_s: number | null, value: number | null, role?: string, stale_after_s?: number | null}} channel
 * @param {Heard} heard
 * @returns {{mark: Mark, age_s: number | null}}
 */
export function judge(channel, heard) {
    const age_s = is_number(channel.age_s) ? Math.max(0, channel.age_s) + heard.status_age_ms / 1000 : null;
    let mark = mark_of(channel.quality);
    if (mark === "good" && !is_number(channel.value)) mark = "lost";
    if (mark === "good" && is_old(channel, age_s, heard)) mark = "stale";
    return { mark, age_s };
}

/** A status that stands still while its values have an age is old, even where heartbeats come. */
function is_old(channel, age_s, heard) {
    if (!heard.contact || heard.status_age_ms > contact_limit_ms) return true;
    const limit_s = stale_after_s(channel);
    return limit_s !== null && age_s !== null && age_s > limit_s;
}

/** @returns {number | null} null: age alone makes nothing stale here */
function stale_after_s(channel) {
    if (channel.stale_after_s !== undefined) return is_number(channel.stale_after_s) ? channel.stale_after_s : null;
    const reads = channel.role === "axis" || channel.role === "ballbar";
    return reads ? reading_limit_of_before_s : null;
}

/** The last good values: a stale one is shown struck through, a lost one is forgotten and never comes back. */
export class KeptValues {
    constructor() {
        /** @type {Map<string, number>} */
        this.values = new Map();
        /** @type {Set<string>} what ever gave a number: where it is lost, its place stays */
        this.gave = new Set();
    }

    /**
     * @param {string} key
     * @param {unknown} value  as the station sends it now
     * @param {Mark} mark  by the station's word
     * @returns {number | null} what may be shown
     */
    take(key, value, mark) {
        if (is_number(value)) this.gave.add(key);
        if (mark === "lost" || mark === "none") this.values.delete(key);
        else if (is_number(value)) this.values.set(key, value);
        else if (mark === "good" || mark === "moving") this.values.delete(key);
        return this.values.get(key) ?? null;
    }

    /** Another station, daemon or run: nothing of the old one may stand there. */
    clear() {
        this.values.clear();
        this.gave.clear();
    }
}
