// What the screens show of a status, as text with its mark. No DOM.

import { judge, is_number, mark_of } from "./freshness.js";
import { age_of, axis_units, minutes_text, no_number, number_text, shop_unit } from "./number_text.js";
import { so_far_lines } from "./so_far_text.js";

/** @typedef {import("./freshness.js").Mark} Mark */
/** @typedef {import("./freshness.js").Heard} Heard */
/** @typedef {import("./freshness.js").KeptValues} KeptValues */
/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {{text: string, unit: string, mark: Mark, word: string, age: string, label: string}} Shown */

const axis_values = Object.freeze(["position_mm", "deviation_um", "displacement_mm", "spread_um", "strength_percent"]);

/** @param {any} status @param {string} role @returns {any} what the axis, or the ballbar, is read by; null: nothing */
export function reading_channel(status, role) {
    return status.channels.find((one) => one.used && one.role === role) ?? null;
}

export const key_of = (channel) => `${channel.instrument}/${channel.channel}`;

/** Once for each status that comes. @param {any} status @param {KeptValues} kept */
export function keep(status, kept) {
    for (const channel of status.channels) kept.take(key_of(channel), channel.value, mark_of(channel.quality));
    const axis = reading_channel(status, "axis");
    const mark = axis ? mark_of(axis.quality) : "none";
    for (const name of axis_values) kept.take(`axis/${name}`, status.axis[name], mark);
}

/** The word beside a mark: why it is lost, where the station says so. @param {Mark} mark @param {string} quality */
function word_of(mark, quality, words) {
    const known = ["beam_lost", "signal_error", "absent"].includes(quality);
    return words.text(mark === "lost" && known ? `quality_${quality}` : `mark_${mark}`);
}

/** @param {number | null} value @param {Mark} mark @returns {number | null} what may stand there */
const shown_if = (value, mark) => (mark === "lost" || mark === "none" ? null : value);

/**
 * @param {any} channel @param {KeptValues} kept @param {Heard} heard @param {Catalogue} words
 * @returns {Shown}
 */
export function channel_shown(channel, kept, heard, words) {
    const { mark, age_s } = judge(channel, heard);
    const { factor, decimals, unit } = shop_unit(channel.unit);
    const value = shown_if(kept.values.get(key_of(channel)) ?? null, mark);
    return {
        label: channel.name || channel.channel,
        text: value === null ? no_number : number_text(value * factor, decimals, { decimal_mark: words.decimal_mark }),
        unit: words.unit(unit),
        mark,
        word: word_of(mark, channel.quality, words),
        age: words.age(age_of(age_s)),
    };
}

/** With age and limit of the reading that the axis is shown by, where the station tells them. @param {any} status */
function axis_reading(status) {
    const channel = reading_channel(status, "axis");
    if (channel === null) return null;
    const { age_s = channel.age_s, stale_after_s = channel.stale_after_s } = status.axis;
    return { ...channel, age_s, stale_after_s };
}

/**
 * The axis as it is read now, each part with the mark of what it is read by.
 * @param {any} status @param {KeptValues} kept @param {Heard} heard @param {Catalogue} words
 * @returns {{position: Shown, deviation: Shown, spread: Shown}}
 */
export function axis_shown(status, kept, heard, words) {
    const channel = axis_reading(status);
    const { mark, age_s } = channel ? judge(channel, heard) : { mark: /** @type {Mark} */ ("none"), age_s: null };
    const units = axis_units(status.axis);
    const shown = (name, factor, decimals, unit, label, plus) => {
        const value = kept.values.get(`axis/${name}`) ?? null;
        const moving = mark === "good" && value !== null && status.axis.still !== true;
        const own = mark === "good" && value === null ? "none" : moving ? "moving" : mark;
        const number = shown_if(value, own);
        const without_datum = own === "none" && mark === "good" && !kept.values.has("axis/position_mm");
        return {
            label,
            text: number === null ? no_number : number_text(number * factor, decimals, { decimal_mark: words.decimal_mark, plus }),
            unit: words.unit(unit),
            mark: own,
            word: without_datum ? words.text("mark_no_datum") : word_of(own, channel?.quality ?? "none", words),
            age: words.age(age_of(age_s)),
        };
    };
    return {
        position: shown("position_mm", 1, 4, units.coordinate, status.axis.name, false),
        deviation: shown("deviation_um", units.deviation.factor, 2, units.deviation.unit, words.text("deviation"), true),
        spread: shown("spread_um", units.reading.factor, 2, units.reading.unit, words.text("spread"), false),
    };
}

/** @returns {boolean} circles are read by the ballbar: the axis has no place then that could be told */
function shows_ballbar(status) {
    const circular = status.run !== null && status.run.pass === "circular" && status.run_open === true;
    return reading_channel(status, "ballbar") !== null && (circular || reading_channel(status, "axis") === null);
}

/**
 * The big number, and what stands beside it.
 * @returns {{main: Shown, beside: Shown[]}}
 */
export function reading_shown(status, kept, heard, words) {
    if (shows_ballbar(status))
        return { main: channel_shown(reading_channel(status, "ballbar"), kept, heard, words), beside: [] };
    const axis = axis_shown(status, kept, heard, words);
    return { main: axis.position, beside: [axis.deviation, axis.spread] };
}

/** What the run is computed with, then what else gives a value, or gave one and is lost. @returns {Shown[]} */
export function cells_shown(status, kept, heard, words) {
    const rest = status.channels.filter((one) => one.role !== "axis" && one.role !== "ballbar");
    const needed = rest.filter((one) => one.used);
    const others = rest.filter((one) => !one.used && kept.gave.has(key_of(one)));
    return [...needed, ...others].map((one) => channel_shown(one, kept, heard, words));
}

/**
 * What comes next.
 * @returns {{target: string, place: string, side: string, direction: "positive" | "negative" | "", approach: string}}
 */
export function next_shown(status, words) {
    const nothing = { target: words.text("next_none"), place: "", side: "", direction: /** @type {const} */ (""), approach: "" };
    const { run } = status;
    if (run === null || status.run_open !== true) return nothing;
    if (run.circle !== null) return circle_shown(run, words);
    if (run.next === null) return nothing;
    const { next } = run;
    const unit = words.unit(axis_units(status.axis).coordinate);
    const place = is_number(next.nominal_mm)
        ? `${number_text(next.nominal_mm, 3, { decimal_mark: words.decimal_mark }).trim()} ${unit}`
        : no_number;
    const side = next.direction === null ? "" : words.text(`side_${next.direction}`);
    const approach = is_number(next.approach) ? words.text("approach", { number: next.approach + 1 }) : "";
    return { target: `P${next.target + 1}`, place, side, direction: next.direction ?? "", approach };
}

function circle_shown(run, words) {
    const { circle } = run;
    return {
        target: words.text("circle", { number: circle.number, of: run.steps }),
        place: words.text(circle.sense),
        side: words.text(circle.warm_up ? "circle_warm_up" : "circle_repeat", { number: circle.repeat }),
        direction: /** @type {const} */ (""),
        approach: words.text(circle.begun ? "circle_begun" : "circle_waits"),
    };
}

const states = ["tying datum", "armed", "settling", "stopped", "complete", "incomplete", "recording"];

/** @param {string} state @returns {string} one that this page does not know stands as the station says it */
export function state_text(state, words) {
    return states.includes(state) ? words.text(`state_${state.replaceAll(" ", "_")}`) : state;
}

/**
 * How far the run is, and what the station says of it so far. This page computes no figure.
 * @returns {{title: string, state: string, lines: string[], sentence: string, fault: boolean, so_far: import("./so_far_text.js").SoFarLine[], part: number}}
 */
export function run_shown(status, words) {
    const { run } = status;
    if (run === null) return { title: words.text("run_none"), state: "", lines: [], sentence: "", fault: false, so_far: [], part: 0 };
    const units = axis_units(status.axis);
    const lines = [words.text("points_done", { done: run.step, of: run.steps })];
    if (is_number(run.last_deviation_um))
        lines.push(
            words.text("last_deviation", {
                number: number_text(run.last_deviation_um * units.deviation.factor, 2, { decimal_mark: words.decimal_mark, plus: true }).trim(),
                unit: words.unit(units.deviation.unit),
            }),
        );
    if (is_number(run.seconds_left)) lines.push(words.text("time_left", { time: minutes_text(run.seconds_left) }));
    if (run.retakes_asked > 0) lines.push(words.text("retakes_left", { left: run.retakes_left, of: run.retakes_asked }));
    if (run.excluded > 0) lines.push(words.text("excluded", { count: run.excluded }));
    if (run.skipped > 0) lines.push(words.text("skipped", { count: run.skipped }));
    if (run.certificate !== "") lines.push(words.text("certificate", { folder: run.certificate }));
    return {
        title: run.id,
        state: state_text(run.state, words),
        lines,
        sentence: run.sentence,
        fault: run.fault !== "",
        so_far: so_far_lines(run, status.run_open === true, units.deviation, words),
        part: run.steps > 0 ? Math.min(1, run.step / run.steps) : 0,
    };
}
