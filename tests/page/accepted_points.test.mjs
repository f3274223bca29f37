import assert from "node:assert/strict";
import { test } from "node:test";
import { AcceptedPoints, still_picked } from "../../acquisition/console/page/accepted_points.js";
import { table_of } from "../../acquisition/console/page/point_table.js";
import { plot_of, point_of, side_of, target_of, words_of } from "./page_under_test.mjs";

const view = Object.freeze({ width: 800, height: 400, factor: 1, next: 5 });
const event_of = (from, points, changed = {}) => ({ run: "a", from, count: from + points.length, points, ...changed });
const told = (step, changed = {}) => point_of(step, { nominal_mm: step * 100.5, excluded: false, ...changed });
const units = Object.freeze({ factor: 1, deviation: "µm", place: "mm" });

function taken(...events) {
    const accepted = new AcceptedPoints();
    for (const event of events) assert.equal(accepted.take(event), true);
    return accepted;
}

test("points are added behind those that are there, and a new run begins anew", () => {
    const accepted = taken(event_of(0, [point_of(0), point_of(1)]), event_of(2, [point_of(2)]));
    assert.equal(accepted.points.length, 3);
    assert.equal(accepted.take(event_of(0, [point_of(0)], { run: "b" })), true);
    assert.deepEqual([accepted.run, accepted.points.length], ["b", 1]);
    assert.equal(accepted.take({ run: null, from: 0, count: 0, points: [] }), true);
    assert.deepEqual([accepted.run, accepted.points], [null, []]);
});

test("points of another run, or with a hole before them, are not taken", () => {
    const accepted = taken(event_of(0, [point_of(0)]));
    assert.equal(accepted.take(event_of(5, [point_of(5)])), false);
    assert.equal(accepted.take(event_of(1, [point_of(1)], { run: "b" })), false);
    assert.equal(accepted.points.length, 1);
});

test("places of the plan come once, and are those of that run alone", () => {
    const accepted = taken(event_of(0, [], { target_nominals_mm: [0, 100] }), event_of(0, [], { target_nominals_mm: [0, 100] }), event_of(0, [told(0)], { target_nominals_mm: [0, 100] }));
    assert.equal(accepted.take(event_of(1, [told(1)])), true);
    assert.deepEqual(accepted.nominals, [0, 100]);
    accepted.take(event_of(0, [], { run: "b" }));
    assert.equal(accepted.nominals, null);
});

test("means of a target are those that came last; those of other targets stay until all come anew", () => {
    const accepted = taken(event_of(0, [told(0)], { targets: [target_of(0, side_of(1)), target_of(1, side_of(5))] }));
    accepted.take(event_of(1, [told(1, { target: 0 })], { targets: [target_of(0, side_of(2, 0.1))] }));
    assert.deepEqual([accepted.targets.get(0).positive.mean_um, accepted.targets.get(1).positive.mean_um], [2, 5]);
    accepted.take(event_of(0, [told(0)], { targets: [] }));
    assert.equal(accepted.targets.size, 0);
});

test("of a point that was taken again the last one counts, and the first is still drawn", () => {
    const accepted = taken(event_of(0, [point_of(0), point_of(1), point_of(110, { target: 0 })]));
    assert.deepEqual(accepted.judged().map(({ counts }) => counts), [false, true, true]);
    const { nominals, targets } = accepted;
    assert.equal(plot_of({ judged: accepted.judged(), nominals, targets, limits: null }, view).dots.length, 3);
});

test("a point that is left out does not count, is still drawn, and can be picked", () => {
    const accepted = taken(event_of(0, [told(0), told(1, { excluded: true })], { target_nominals_mm: [0, 100.5] }));
    const { nominals, targets } = accepted;
    const { dots } = plot_of({ judged: accepted.judged(), nominals, targets, limits: null }, view);
    assert.deepEqual(dots.map(({ counts, left_out }) => [counts, left_out]), [[true, false], [false, true]]);
    assert.equal(still_picked(accepted.points[1], accepted), accepted.points[1]);
});

test("where a point that was taken again is left out, the one of before does not count instead", () => {
    const accepted = taken(event_of(0, [told(0), told(110, { target: 0, excluded: true })]));
    assert.deepEqual(accepted.judged().map(({ counts }) => counts), [false, false]);
});

test("an event of the same run from the beginning keeps the picked point, as it stands now", () => {
    const accepted = taken(event_of(0, [told(0), told(1)]));
    const picked = accepted.points[1];
    const { run, version } = accepted;
    accepted.take(event_of(0, [told(0), told(1, { excluded: true })]));
    assert.equal(accepted.run, run);
    assert.notEqual(accepted.version, version); // what is left out is drawn anew, though nothing was added
    assert.equal(still_picked(picked, accepted)?.excluded, true);
    accepted.take(event_of(0, [told(0)]));
    assert.equal(still_picked(picked, accepted), null);
    assert.equal(still_picked(null, accepted), null);
});

test("the table tells the place of each point, and which are left out or taken again", () => {
    const accepted = taken(event_of(0, [told(0), told(1, { excluded: true }), told(110, { target: 0, nominal_mm: 0 })]));
    const { heads, rows } = table_of(accepted, units, words_of("en"));
    assert.deepEqual(heads, ["Target", "Place mm", "Side", "Approach", "Deviation µm", "Left out"]);
    assert.deepEqual(rows.map(({ cells }) => cells.map((cell) => cell.trim())), [
        ["P1", "0.000", "from below", "1", "0.00 (taken again)", ""],
        ["P2", "100.500", "from below", "1", "+0.50", "left out"],
        ["P1", "0.000", "from below", "1", "+55.00", ""],
    ]);
    assert.deepEqual([rows[1].point, rows[1].label], [accepted.points[1], "P2 from below 1"]);
});

test("of a station of before the table has neither of the two columns", () => {
    const { heads, rows } = table_of(taken(event_of(0, [point_of(0)])), units, words_of("en"));
    assert.deepEqual(heads, ["Target", "Side", "Approach", "Deviation µm"]);
    assert.equal(rows[0].cells.length, 4);
});
