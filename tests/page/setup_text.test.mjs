import assert from "node:assert/strict";
import { test } from "node:test";
import { KeptValues } from "../../acquisition/console/page/freshness.js";
import { ask_checks, beam_shown, checks_shown, devices_shown, strength_channel, tone_word } from "../../acquisition/console/page/setup_text.js";
import { keep } from "../../acquisition/console/page/status_view.js";
import { channel_of, hears, laser_of, status_of, words_of } from "./page_under_test.mjs";
import { station_that } from "./stored_under_test.mjs";

const words = words_of();
const silent = { contact: false, status_age_ms: 4000 };

function strength_of(changed = {}) {
    return channel_of({
        instrument: "laser", channel: "contrast", name: "contrast", kind: "strength", medium: "none", value: 82, unit: "%",
        age_s: 0.5, stale_after_s: 2, used: false, role: "", ...changed,
    });
}

function with_strength(changed = {}, least = 20) {
    const status = status_of({ channels: [laser_of(), strength_of(changed), channel_of()] });
    return { ...status, axis: { ...status.axis, least_strength_percent: least } };
}

function beam_of(status, heard = hears, kept = new KeptValues()) {
    keep(status, kept);
    return beam_shown(status, kept, heard, words);
}

const device_of = (changed = {}) => ({
    name: "laser", driver: "ids3010", state: "available", tape: "", maker: "attocube", model: "IDS3010", serial: "S-7", firmware: "1.9",
    due_on: "2027-03-31", note: "", ...changed,
});
const row_of = (changed, heard = hears, channels = [laser_of()]) =>
    devices_shown(status_of({ instruments: [device_of(changed)], channels }), heard, words)[0];

test("a device says its state in shape and word, its serial number, firmware, certificate and the age of its newest reading", () => {
    const row = row_of({}, hears, [laser_of({ age_s: 3.2, stale_after_s: 60 }), strength_of({ age_s: 1.2 })]);
    assert.deepEqual(row, {
        mark: "good", shape: "●", head: "laser", word: "answers",
        lines: ["attocube IDS3010 · serial number S-7 · firmware 1.9 · certificate until 2027-03-31", "age 1 s"],
    });
});

test("what a device does not tell is left out, and its driver stands for a model without a name", () => {
    assert.deepEqual(row_of({ maker: "", model: "", serial: "", firmware: "", due_on: "" }).lines, ["ids3010", "age 0 s"]);
});

test("a device that is gone, faulty or a tape is none that answers, and says why", () => {
    const gone = row_of({ state: "unavailable", note: "The instrument does not answer." }, hears, []);
    assert.deepEqual([gone.mark, gone.shape, gone.word, gone.lines.at(-1)], ["lost", "✕", "not there", "The instrument does not answer."]);
    assert.equal(row_of({ state: "faulty" }).word, "faulty");
    const tape = row_of({ state: "tape", tape: "/var/lib/x.tape" });
    assert.deepEqual([tape.mark, tape.shape, tape.lines.at(-1)], ["warn", "▲", "/var/lib/x.tape"]);
    const unknown = row_of({ state: "dreaming" });
    assert.deepEqual([unknown.mark, unknown.word], ["lost", "dreaming"]);
});

test("a device that answers with old, bad or no readings is not good", () => {
    assert.deepEqual([row_of({}, hears, [laser_of({ age_s: 9 })]).mark, row_of({}, hears, [laser_of({ quality: "beam_lost", value: null })]).word], ["stale", "lost"]);
    assert.equal(row_of({}, hears, []).word, "no reading yet");
    assert.equal(row_of({}, hears, [laser_of({ age_s: 9 }), strength_of()]).mark, "good");
});

test("without contact no device is good and none is gone: what is known is old", () => {
    for (const state of ["available", "unavailable", "tape"]) assert.deepEqual([row_of({ state }, silent).mark, row_of({ state }, silent).word], ["stale", "stale"]);
});

test("the strength is that of the instrument that reads the axis, and of no other", () => {
    const other = strength_of({ instrument: "bar" });
    assert.equal(strength_channel(status_of({ channels: [other, laser_of(), strength_of()] })).instrument, "laser");
    assert.equal(strength_channel(status_of({ channels: [other, laser_of()] })), null);
    assert.equal(strength_channel(status_of({ channels: [] })), null);
    const ballbar = laser_of({ instrument: "bar", role: "ballbar" });
    assert.equal(strength_channel(status_of({ channels: [ballbar, other] })).instrument, "bar");
});

test("the strength has figure, unit, age, and the word of the station's own limit", () => {
    const strong = beam_of(with_strength());
    assert.deepEqual([strong.strength.text.trim(), strong.strength.unit, strong.strength.word, strong.strength.age], ["82.0", "%", "strong enough", "0 s"]);
    assert.deepEqual([strong.bar, strong.limit, strong.sounds, strong.weak], [82, 20, 82, false]);
    const weak = beam_of(with_strength({ value: 5.3 }));
    assert.deepEqual([weak.strength.word, weak.weak, weak.sounds], ["too weak: at least 20 %", true, 5.3]);
});

test("a strength of nothing is 0.0 and never −0.0", () => {
    assert.equal(beam_of(with_strength({ value: -0.01 })).strength.text.trim(), "0.0");
});

test("a station of before, which tells no limit, gets no word about it", () => {
    assert.equal(beam_of(with_strength({}, null)).strength.word, "good");
});

test("a stale strength stays as it was, is marked, and is not heard", () => {
    const kept = new KeptValues();
    beam_of(with_strength(), hears, kept);
    const by_station = beam_of(with_strength({ value: null, quality: "stale", age_s: 2.4 }), hears, kept);
    assert.deepEqual([by_station.strength.mark, by_station.strength.text.trim(), by_station.bar, by_station.sounds], ["stale", "82.0", 82, null]);
    const by_clock = beam_of(with_strength(), { contact: true, status_age_ms: 1600 });
    assert.deepEqual([by_clock.strength.mark, by_clock.sounds], ["stale", null]);
    assert.deepEqual([beam_of(with_strength(), silent).strength.mark, beam_of(with_strength(), silent).sounds], ["stale", null]);
});

test("a lost strength is dashes, an empty bar, and not heard", () => {
    const lost = beam_of(with_strength({ value: null, quality: "signal_error" }));
    assert.deepEqual([lost.strength.text, lost.bar, lost.sounds, lost.strength.word], ["– – –", null, null, "signal error"]);
});

test("an instrument that tells no strength says so, and its reading shows whether the beam is there", () => {
    const beam = beam_of(status_of({ channels: [laser_of({ quality: "beam_lost", value: null })] }));
    assert.deepEqual([beam.strength.text, beam.strength.word, beam.bar], ["", "This instrument does not tell its strength.", null]);
    assert.deepEqual([beam.reading?.text, beam.reading?.word], ["– – –", "beam lost"]);
    assert.equal(beam_of(status_of({ channels: [] })).reading, null);
});

test("the tone says why it is silent", () => {
    const said = (on, sounds, told = true, failed = false) => tone_word({ on, failed }, sounds, told, words);
    assert.equal(said(false, 82), "off");
    assert.equal(said(true, 82), "follows the strength");
    assert.equal(said(true, null), "silent: no strength");
    assert.equal(said(false, null, false), "no strength to follow");
    assert.equal(said(false, 82, true, true), "this browser has no sound");
});

const check = (changed = {}) => ({ name: "soak", passed: true, warning: false, verdict: "All stand still.", override: "", ...changed });
const judged = (list) => ({ list, sentence: "", at: 1000 });
const now = { contact: true, at: 13500 };

test("each check has shape, word and sentence, and what does not hold stands first", () => {
    const list = [check(), check({ name: "clock", warning: true }), check({ name: "strength", passed: false, verdict: "Too weak." })];
    const { rows, note } = checks_shown(judged(list), false, now, words);
    assert.deepEqual(rows.map(({ shape, head, word }) => [shape, head, word]), [["✕", "strength", "does not hold"], ["▲", "clock", "warning"], ["●", "soak", "holds"]]);
    assert.deepEqual(rows[0].lines, ["Too weak."]);
    assert.equal(note, "age 12 s");
});

test("a check that was overridden bears its reason", () => {
    const [row] = checks_shown(judged([check({ passed: false, override: "the customer waits" })]), false, now, words).rows;
    assert.deepEqual([row.shape, row.word, row.lines.at(-1)], ["▲", "does not hold, with a reason", "the customer waits"]);
});

test("without contact the checks are old, and before they are judged, or while a run is open, none is claimed", () => {
    assert.match(checks_shown(judged([check()]), false, { ...now, contact: false }, words).note, /^▲ stale · age 12 s$/);
    assert.deepEqual(checks_shown(null, false, now, words), { note: "The station is asked …", rows: [] });
    assert.deepEqual(checks_shown(judged([check()]), true, now, words).rows, []);
});

test("what the station refuses to judge stands in its words", async () => {
    const refuses = station_that({ "/v1/preflight": [409, { error: { fault: "busy", sentence: "A run is being armed." } }] });
    const refused = await ask_checks(refuses.fetcher, 5);
    assert.equal(checks_shown(refused, false, now, words).note, "A run is being armed.");
    const answers = station_that({ "/v1/preflight": [200, { checks: [check()] }] });
    assert.deepEqual(await ask_checks(answers.fetcher, 5), { list: [check()], sentence: "", at: 5 });
});
