import assert from "node:assert/strict";
import { test } from "node:test";
import { alignment_lines, alignment_off } from "../../acquisition/console/page/alignment_text.js";
import { words_of } from "./page_under_test.mjs";

const words = words_of();
const record_of = (changed = {}) => ({
    ended: "", reached_mm: 392, travel_mm: 400, restarts: 0, cosine: null,
    far: { distance_mm: 392, highest_mm: 392.00125, last_mm: 392, scatter_um: 0.04, passed_maximum: false }, ...changed,
});
const view_of = (changed = {}) => ({ running: true, distance_mm: 391.99994, at_rest: true, record: record_of(), ...changed });

test("before the station has answered, and where none was kept, nothing is claimed", () => {
    assert.deepEqual(alignment_lines(null, words), [words.text("order_waits")]);
    assert.deepEqual(alignment_lines(view_of({ running: false, record: null }), words), ["None was kept since the station started."]);
});

test("while it goes on, it says where the axis is, what was seen and what to do next", () => {
    assert.deepEqual(alignment_lines(view_of({ at_rest: false, record: record_of({ far: null }) }), words), [
        "391.9999 mm, moving · seen 392.0 of 400.0 mm",
        "Drive away from the laser and let the axis stand there.",
    ]);
    assert.deepEqual(alignment_lines(view_of(), words).slice(1), [
        "Highest at 392.0 mm, now 1.25 µm below it, scatter 0.04 µm.",
        "Steer each tilt past its highest reading.",
    ]);
});

test("a cosine error without a bound is told as one that may be larger", () => {
    const cosine = { distance_mm: 392, error_um: 1.25, bound_um: null };
    const last = (bound_um) => alignment_lines(view_of({ record: record_of({ cosine: { ...cosine, bound_um } }) }), words).at(-1);
    assert.equal(last(null), "Cosine error 1.25 µm over 392 mm, or more.");
    assert.equal(last(1.31), "Cosine error 1.25 µm over 392 mm, at most 1.31 µm.");
});

test("what was kept asks for nothing more", () => {
    const lines = alignment_lines(view_of({ running: false, record: record_of({ ended: "2026-01-02T08:15:00Z", far: null, restarts: 2 }) }), words);
    assert.match(lines[0], /^kept 2026-01-0\d \d\d:\d\d · seen 392\.0 of 400\.0 mm$/);
    assert.deepEqual(lines.slice(1), ["Begun anew 2 ×: the counter lost its zero."]);
});

test("an order is off without contact, without rights and while a run is open, and says why", () => {
    const now = { contact: true, refusal: "", run_open: false };
    assert.equal(alignment_off(now, words), "");
    assert.equal(alignment_off({ ...now, contact: false }, words), words.text("off_no_contact"));
    assert.equal(alignment_off({ ...now, refusal: "Type 'axiscal pair'." }, words), "Type 'axiscal pair'.");
    assert.equal(alignment_off({ ...now, run_open: true }, words), words.text("off_run_open"));
});
