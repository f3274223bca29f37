import assert from "node:assert/strict";
import { test } from "node:test";
import { AcceptedPoints } from "../../acquisition/console/page/accepted_points.js";
import { points_of_certificate } from "../../acquisition/console/page/result_points.js";
import { certificate_of } from "./stored_under_test.mjs";

const near = (value, wanted) => assert.ok(Math.abs(value - wanted) < 1e-9, `${value}, not ${wanted}`);

function taken(document) {
    const accepted = new AcceptedPoints();
    assert.equal(accepted.take(points_of_certificate(document).event), true);
    return accepted;
}

test("each reading of a certificate is a point of the plot, with its place", () => {
    const { points, nominals } = taken(certificate_of());
    assert.deepEqual(points.map(({ target, direction, approach, nominal_mm }) => [target, direction, approach, nominal_mm]), [
        [0, "positive", 0, 0], [0, "positive", 1, 0], [1, "positive", 0, 100], [0, "negative", 0, 0], [1, "negative", 0, 100],
    ]);
    near(points[1].deviation_um, 1.5);
    assert.deepEqual(nominals, [0, 100]);
});

test("means are the certificate's; without its s there is no band", () => {
    const { targets } = taken(certificate_of());
    near(targets.get(0).positive.mean_um, 1);
    near(targets.get(0).positive.low_um, 0);
    near(targets.get(0).positive.high_um, 2);
    assert.deepEqual([targets.get(1).positive.low_um, targets.get(1).negative.high_um], [null, null]);
});

test("of a rotary axis degrees become thousandths of a degree, as in the events", () => {
    const { axis, event } = points_of_certificate(certificate_of({ unit: "deg" }));
    assert.equal(axis.kind, "rotary");
    near(event.points[0].deviation_um, 0.5);
});

test("across an axis the readings are micrometres, and the rows bear their own names", () => {
    const row = { target_mm: 2, mean_forward_um: 0.4, s_forward_um: 0.1, mean_backward_um: null, s_backward_um: null };
    const run = { id: "s", set_aside: undefined, deviations: { targets_mm: [2], forward: [[0.5, 0.3]] } };
    const document = { format: "axiscal.squareness/1", unit: "um/m", positions: [row], run };
    const { points, targets } = taken(document);
    near(points[0].deviation_um, 0.5);
    near(targets.get(0).positive.low_um, 0.2);
    assert.equal(targets.get(0).negative.mean_um, null);
});

test("a reading that a person left out is crossed, and the others keep their approach", () => {
    const run = {
        ...certificate_of().run,
        set_aside: [{ target: 0, direction: "positive", approach: 0, step: 0, deviation: 0.09, why: "excluded", reason: "coolant" }],
    };
    const completeness = { left_out: [{ target: 0, direction: "positive", approaches: [0], why: "excluded" }] };
    const judged = taken(certificate_of({ run, completeness })).judged();
    assert.deepEqual([judged[0].left_out, judged[0].counts], [true, false]);
    assert.deepEqual(judged.filter(({ counts, point }) => counts && point.target === 0 && point.direction === "positive").map(({ point }) => point.approach), [1, 2]);
});

test("a reading that was taken again counts no more", () => {
    const run = {
        ...certificate_of().run,
        set_aside: [{ target: 0, direction: "positive", approach: 1, step: 1, deviation: 0.04, why: "superseded", reason: "" }],
    };
    const judged = taken(certificate_of({ run })).judged();
    assert.deepEqual(judged.filter(({ counts }) => !counts).map(({ point }) => Math.round(point.deviation_um)), [40]);
    assert.equal(judged.filter(({ counts }) => counts).length, 5);
});

test("a test without readings at targets has no plot", () => {
    for (const document of [null, {}, { run: {} }, { run: { deviations: {} } }, { format: "axiscal.drift/1", run: { id: "d" } }])
        assert.equal(points_of_certificate(document), null);
});

test("what has another form than ours is left out, and ends nothing", () => {
    const run = { id: "x", plan: { targets: ["a", 1] }, set_aside: [{ target: "0", deviation: 1 }], deviations: { forward: [null, ["x", 0.001]], backward: 7 } };
    const { event } = points_of_certificate({ format: "axiscal.result/1", unit: "mm", positions: "none", completeness: { left_out: 3 }, run });
    assert.equal(event.points.length, 1);
    assert.deepEqual(event.targets, []);
});
