import assert from "node:assert/strict";
import { test } from "node:test";
import { KeptValues } from "../../acquisition/console/page/freshness.js";
import { no_number } from "../../acquisition/console/page/number_text.js";
import { axis_shown, cells_shown, keep, next_shown, reading_shown, run_shown, state_text } from "../../acquisition/console/page/status_view.js";
import { channel_of, hears, laser_of, run_of, status_of, words_of } from "./page_under_test.mjs";

const words = words_of("en");
const silent = Object.freeze({ contact: false, status_age_ms: 4000 });

function kept_of(...statuses) {
    const kept = new KeptValues();
    for (const status of statuses) keep(status, kept);
    return kept;
}

/** What the station says once the laser went silent. */
function silenced(quality) {
    const status = status_of({ channels: [laser_of({ quality, value: null, age_s: 5 }), channel_of()] });
    status.axis = { ...status.axis, position_mm: null, deviation_um: null, spread_um: null };
    return status;
}

test("the reading has number, unit, age and quality", () => {
    const status = status_of();
    const { main, beside } = reading_shown(status, kept_of(status), hears, words);
    assert.deepEqual(main, { label: "X", text: "\u2007301.4112", unit: "mm", mark: "good", word: "good", age: "0 s" });
    assert.equal(beside[0].text, "\u22120.80");
    assert.equal(beside[0].unit, "µm");
});

test("a stale reading keeps its last number and is marked; its age grows", () => {
    const status = silenced("stale");
    const { position } = axis_shown(status, kept_of(status_of(), status), hears, words);
    assert.deepEqual([position.text, position.mark, position.age], ["\u2007301.4112", "stale", "5 s"]);
});

test("without contact the last reading is stale", () => {
    const status = status_of();
    const { main } = reading_shown(status, kept_of(status), silent, words);
    assert.deepEqual([main.text, main.mark, main.age], ["\u2007301.4112", "stale", "4 s"]);
});

test("the axis has the age and the limit of the reading it is shown by, where the station tells them", () => {
    const shown_with = (changed) => {
        const status = status_of();
        status.axis = { ...status.axis, ...changed };
        const { position } = axis_shown(status, kept_of(status), hears, words);
        return [position.mark, position.age];
    };
    assert.deepEqual(shown_with({}), ["good", "0 s"]); // the channel's, 0.01 s
    assert.deepEqual(shown_with({ age_s: 1.5, stale_after_s: 2 }), ["good", "1 s"]);
    assert.deepEqual(shown_with({ age_s: 1.5, stale_after_s: 1 }), ["stale", "1 s"]);
    assert.deepEqual(shown_with({ age_s: 2.5 }), ["stale", "2 s"]);
    assert.deepEqual(shown_with({ age_s: null, position_mm: null }), ["none", "never"]);
});

test("a lost reading is dashes and never a number, also after the contact broke", () => {
    const status = silenced("beam_lost");
    const kept = kept_of(status_of(), status);
    for (const heard of [hears, silent])
        for (const shown of Object.values(axis_shown(status, kept, heard, words)))
            assert.deepEqual([shown.text, shown.mark, shown.word], [no_number, "lost", "beam lost"]);
});

test("a stale reading that was never good shows no number", () => {
    const status = silenced("stale");
    assert.equal(axis_shown(status, kept_of(status), hears, words).position.text, no_number);
});

test("a good laser without a datum has no position, and says so", () => {
    const status = status_of();
    status.axis.position_mm = null;
    const { position } = axis_shown(status, kept_of(status), hears, words);
    assert.deepEqual([position.text, position.mark, position.word], [no_number, "none", "no datum"]);
});

test("an axis that stands at no target has no deviation, and yet a datum", () => {
    const status = status_of();
    status.axis.deviation_um = null;
    const { position, deviation } = axis_shown(status, kept_of(status), hears, words);
    assert.equal(position.mark, "good");
    assert.deepEqual([deviation.text, deviation.mark, deviation.word], [no_number, "none", "none"]);
});

test("an axis in motion is marked as moving", () => {
    const status = status_of();
    status.axis.still = false;
    assert.equal(axis_shown(status, kept_of(status), hears, words).position.mark, "moving");
});

test("a station without a laser shows no position", () => {
    const status = status_of({ channels: [] });
    const { position } = axis_shown(status, kept_of(status), hears, words);
    assert.deepEqual([position.text, position.mark, position.age], [no_number, "none", "never"]);
});

test("a circular test is read by the ballbar", () => {
    const ballbar = laser_of({ instrument: "ballbar", name: "ballbar", role: "ballbar", value: -0.0000012 });
    const status = status_of({ channels: [laser_of(), ballbar], run: run_of({ pass: "circular" }) });
    const { main, beside } = reading_shown(status, kept_of(status), hears, words);
    assert.deepEqual([main.label, main.text, main.unit], ["ballbar", "\u22120.0012", "mm"]);
    assert.deepEqual(beside, []);
});

test("what the run needs comes first; what never gave a number takes no room", () => {
    const other = channel_of({ channel: "temperature", name: "hall", unit: "degC", value: 21.126, used: false, role: "" });
    const mute = channel_of({ channel: "co2", name: "carbon dioxide", value: null, quality: "none", age_s: null, used: false, role: "" });
    const status = status_of({ channels: [mute, other, channel_of(), laser_of()] });
    const cells = cells_shown(status, kept_of(status), hears, words);
    assert.deepEqual(cells.map(({ label, text, unit }) => [label, text.trim(), unit]), [["air pressure", "1013.3", "hPa"], ["hall", "21.13", "°C"]]);
});

test("what nobody computes with, and is lost, keeps its place and stands there as dashes", () => {
    const hall = { channel: "temperature", name: "hall", unit: "degC", used: false, role: "" };
    const kept = kept_of(status_of({ channels: [channel_of({ ...hall, value: 21.126 })] }));
    const lost = status_of({ channels: [channel_of({ ...hall, value: null, quality: "absent" })] });
    keep(lost, kept);
    const cells = cells_shown(lost, kept, hears, words);
    assert.deepEqual(cells.map(({ label, text, mark, word }) => [label, text, mark, word]), [["hall", no_number, "lost", words.text("quality_absent")]]);
});

test("the next target has its place, its side and its approach, all counted from one", () => {
    assert.deepEqual(next_shown(status_of(), words), {
        target: "P7", place: "301.412 mm", side: "from below", direction: "positive", approach: "approach 3",
    });
});

test("a closed run has no next target", () => {
    assert.equal(next_shown(status_of({ run_open: false }), words).target, "no target");
    assert.equal(next_shown(status_of({ run: null, run_open: false }), words).direction, "");
});

test("of a circular test the circle is what comes next", () => {
    const circle = { number: 2, sense: "clockwise", repeat: 1, warm_up: false, begun: true };
    const next = next_shown(status_of({ run: run_of({ circle, steps: 6 }) }), words);
    assert.deepEqual([next.target, next.place, next.side, next.approach], ["circle 2 of 6", "clockwise", "run 1", "being driven"]);
});

test("how far the run is, is said without a figure that the station did not give", () => {
    const run = run_shown(status_of({ run: run_of({ retakes_asked: 2, retakes_left: 1, excluded: 3 }) }), words);
    assert.equal(run.state, "armed");
    assert.deepEqual(run.lines, ["12 of 110 points", "last \u22123.10 µm", "18:05 left", "1 of 2 to take again", "3 left out"]);
    assert.equal(run_shown(status_of({ run: null }), words).lines.length, 0);
});

test("a state that this page does not know stands as the station says it", () => {
    assert.equal(state_text("tying datum", words), "tying the datum");
    assert.equal(state_text("dancing", words), "dancing");
});

test("in Russian numbers have a comma and units Russian letters", () => {
    const status = status_of();
    const { main, beside } = reading_shown(status, kept_of(status), hears, words_of("ru"));
    assert.deepEqual([main.text, main.unit, beside[0].unit], ["\u2007301,4112", "мм", "мкм"]);
});
