// Whether the page hears the station, and what it says about that. No DOM, no socket.

import { contact_limit_ms } from "./freshness.js";

/** A break that is shorter is not worth a strip; the values are dimmed before. Since the last word of the station. */
const strip_after_ms = 3000;
/** The strip stays so long after the contact is back: it must not flap. */
const strip_stays_ms = 2000;
const first_pause_ms = 250;
const longest_pause_ms = 4000;

/** @typedef {"none" | "starting" | "lost" | "back"} Strip */

export class LinkState {
    /** @param {number} now  ms of a clock that goes on while the computer sleeps */
    constructor(now) {
        this.began_at = now;
        /** @type {number | null} */
        this.heard_at = null;
        /** @type {number | null} */
        this.back_at = null;
        this.rested_quietly = false;
        this.quiet_from = now;
        this.pause_ms = first_pause_ms;
        this.refusal = "";
    }

    /** An event came, of whatever kind. @param {number} now */
    heard(now) {
        if (this.is_strip_up(now)) this.back_at = now;
        this.heard_at = now;
        this.pause_ms = first_pause_ms;
        this.refusal = "";
    }

    /** The page ends the connection itself, because nobody looks. @param {number} now */
    rest(now) {
        this.rested_quietly = !this.is_strip_up(now);
    }

    /** Somebody looks again: the silence since rest() was no break. @param {number} now */
    resume(now) {
        if (this.rested_quietly) this.quiet_from = now;
        this.rested_quietly = false;
        this.pause_ms = first_pause_ms;
    }

    /** The station answered, and gives no events: its sentence says why. @param {string} sentence */
    refused(sentence) {
        this.refusal = sentence;
    }

    /** @returns {number} ms until the next try: 0.25 s, doubled up to 4 s, for ever */
    next_pause() {
        const pause = this.pause_ms;
        this.pause_ms = Math.min(longest_pause_ms, pause * 2);
        return pause;
    }

    /** @param {number} now */
    has_contact(now) {
        return this.heard_at !== null && now - this.heard_at <= contact_limit_ms;
    }

    /** @param {number} now @returns {boolean} a strip about a break stands there */
    is_strip_up(now) {
        return now - Math.max(this.heard_at ?? this.began_at, this.quiet_from) > strip_after_ms;
    }

    /** @param {number} now @returns {{contact: boolean, strip: Strip, refusal: string}} */
    view(now) {
        const up = this.is_strip_up(now);
        const back = this.back_at !== null && now - this.back_at < strip_stays_ms;
        /** @type {Strip} */
        const strip = up ? (this.heard_at === null ? "starting" : "lost") : back ? "back" : "none";
        return { contact: this.has_contact(now), strip, refusal: this.refusal };
    }
}
