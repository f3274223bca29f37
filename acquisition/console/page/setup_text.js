// What Set-up says of devices, beam and checks, as text with its mark. No DOM.

import { is_number, judge, shapes } from "./freshness.js";
import { age_of, number_text } from "./number_text.js";
import { asked } from "./orders.js";
import { channel_shown, key_of, reading_channel } from "./status_view.js";

/** @typedef {import("./freshness.js").Heard} Heard */
/** @typedef {import("./freshness.js").KeptValues} KeptValues */
/** @typedef {import("./freshness.js").Mark} Mark */
/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {import("./status_view.js").Shown} Shown */
/** @typedef {{mark: string, shape: string, head: string, word: string, lines: string[]}} Row  of a device or a check */
/** @typedef {{name: string, passed: boolean, warning: boolean, verdict: string, override: string}} Check */
/** @typedef {{list: Check[], sentence: string, at: number}} Judged  as the station answered; at: ms of the page's clock */

const device_states = Object.freeze({ available: "good", unavailable: "lost", faulty: "lost", tape: "warn" });
const row_shapes = Object.freeze({ ...shapes, warn: "▲" });
const from_worst = Object.freeze(["lost", "warn", "good"]);
const from_best = Object.freeze(["good", "stale", "lost", "none"]);

/** @param {any} status @param {Heard} heard @param {Catalogue} words @returns {Row[]} in the order of the station file */
export function devices_shown(status, heard, words) {
    return status.instruments.map((device) => device_shown(device, status.channels, heard, words));
}

function device_shown(device, channels, heard, words) {
    const newest = newest_of(channels.filter(({ instrument }) => instrument === device.name), heard);
    const mark = device_mark(device.state, newest.mark, heard);
    return {
        mark,
        shape: row_shapes[mark],
        head: device.name,
        word: device_word(device.state, mark, words),
        lines: [identity_line(device, words), age_line(newest.age_s, words), device.tape, device.note].filter(Boolean),
    };
}

/** The best of its readings. @param {any[]} channels @param {Heard} heard @returns {{mark: Mark, age_s: number | null}} */
function newest_of(channels, heard) {
    const judged = channels.map((channel) => judge(channel, heard));
    const ages = judged.map(({ age_s }) => age_s).filter(is_number);
    const mark = from_best.find((one) => judged.some((each) => each.mark === one)) ?? "none";
    return { mark: /** @type {Mark} */ (mark), age_s: ages.length === 0 ? null : Math.min(...ages) };
}

/** Without contact nobody knows what has become of it. A state that this page does not know is no good one. */
function device_mark(state, readings, heard) {
    if (!heard.contact) return "stale";
    const own = device_states[state] ?? "lost";
    return own === "good" ? readings : own;
}

function device_word(state, mark, words) {
    if (mark === "stale") return words.text("mark_stale");
    if (!Object.hasOwn(device_states, state)) return state;
    if (state === "available" && mark !== "good") return words.text(mark === "none" ? "device_waits" : "mark_lost");
    return words.text(`device_${state}`);
}

/** What it says of itself, and until when its certificate counts. */
function identity_line(device, words) {
    const of = (key, value) => (value ? words.text(key, { value }) : "");
    const model = [device.maker, device.model].filter(Boolean).join(" ") || device.driver;
    return [model, of("serial", device.serial), of("firmware", device.firmware), of("due", device.due_on)].filter(Boolean).join(" · ");
}

function age_line(age_s, words) {
    return age_s === null ? "" : words.text("age_words", { age: words.age(age_of(age_s)) });
}

/** What reads the axis, or else the ballbar. @param {any} status */
const read_by = (status) => reading_channel(status, "axis") ?? reading_channel(status, "ballbar");

/** The channel on which the instrument of the axis tells its strength. @param {any} status @returns {any} null: it tells none */
export function strength_channel(status) {
    const reads = read_by(status);
    if (reads === null) return null;
    return status.channels.find(({ kind, instrument }) => kind === "strength" && instrument === reads.instrument) ?? null;
}

/**
 * The beam: its reading, its strength, and what the tone may follow.
 * @param {any} status @param {KeptValues} kept @param {Heard} heard @param {Catalogue} words
 * @returns {{reading: Shown | null, strength: Shown, weak: boolean, bar: number | null, limit: number | null, sounds: number | null}}
 *   bar: percent that is drawn; limit: percent below which the check does not hold; sounds: percent that is fresh
 */
export function beam_shown(status, kept, heard, words) {
    const reads = read_by(status);
    const reading = reads === null ? null : channel_shown(reads, kept, heard, words);
    const channel = strength_channel(status);
    const limit = status.axis.least_strength_percent ?? null;
    if (channel === null) {
        const untold = { label: words.text("strength"), text: "", unit: "", mark: /** @type {const} */ ("none"), word: words.text("strength_untold"), age: "" };
        return { reading, strength: untold, weak: false, bar: null, limit: null, sounds: null };
    }
    const shown = { ...channel_shown(channel, kept, heard, words), label: words.text("strength") };
    const value = shown.mark === "good" || shown.mark === "stale" ? (kept.values.get(key_of(channel)) ?? null) : null;
    const sounds = shown.mark === "good" ? value : null;
    const weak = sounds !== null && is_number(limit) && sounds < limit;
    return { reading, strength: { ...shown, word: strength_word(shown, sounds, limit, words) }, weak, bar: value, limit, sounds };
}

/** Strong enough is what the station's check asks for. */
function strength_word(shown, fresh, limit, words) {
    if (fresh === null || !is_number(limit)) return shown.word;
    const limit_text = number_text(limit, 0, { decimal_mark: words.decimal_mark }).trim();
    return words.text(fresh < limit ? "strength_weak" : "strength_enough", { limit: limit_text });
}

/** Why nothing is heard, or that something is. @param {{on: boolean, failed: boolean}} tone @param {number | null} sounds @param {boolean} told  the laser tells a strength */
export function tone_word(tone, sounds, told, words) {
    if (!told) return words.text("tone_untold");
    if (tone.failed) return words.text("tone_failed");
    if (!tone.on) return words.text("tone_off");
    return words.text(sounds === null ? "tone_silent" : "tone_follows");
}

/**
 * The checks as they were judged last: what does not hold stands first, else in the station's order.
 * @param {Judged | null} judged @param {boolean} run_open @param {{contact: boolean, at: number}} now @param {Catalogue} words
 * @returns {{note: string, rows: Row[]}}
 */
export function checks_shown(judged, run_open, now, words) {
    if (run_open) return { note: words.text("checks_open"), rows: [] };
    if (judged === null) return { note: words.text(now.contact ? "order_waits" : "off_no_contact"), rows: [] };
    if (judged.sentence !== "") return { note: judged.sentence, rows: [] };
    const age = age_line((now.at - judged.at) / 1000, words);
    const note = now.contact ? age : `${shapes.stale} ${words.text("mark_stale")} · ${age}`;
    const rows = judged.list.map((check) => check_row(check, words));
    return { note, rows: from_worst.flatMap((mark) => rows.filter((row) => row.mark === mark)) };
}

/** @param {Check} check @returns {Row} */
function check_row(check, words) {
    const overridden = !check.passed && check.override !== "";
    const kind = check.warning || overridden ? "warn" : check.passed ? "good" : "lost";
    const word = overridden ? "check_overridden" : check.warning ? "check_warns" : check.passed ? "check_holds" : "check_fails";
    return {
        mark: kind,
        shape: row_shapes[kind],
        head: check.name,
        word: words.text(word),
        lines: [check.verdict, check.override].filter(Boolean),
    };
}

/** @param {typeof fetch} fetcher @param {number} at @returns {Promise<Judged>} */
export async function ask_checks(fetcher, at) {
    const { response, body } = await asked("/v1/preflight", fetcher);
    return { list: response.ok ? body.checks : [], sentence: response.ok ? "" : (body.error?.sentence ?? `HTTP ${response.status}`), at };
}
