import assert from "node:assert/strict";
import { test } from "node:test";
import { AcceptedPoints } from "../../acquisition/console/page/accepted_points.js";
import { nice_step, plot_of, point_at, value_range } from "../../acquisition/console/page/plot_geometry.js";
import { point_of } from "./page_under_test.mjs";

const view = Object.freeze({ width: 800, height: 400, factor: 1, next: 5 });
const event_of = (from, points, run = "a") => ({ run, from, count: from + points.length, points });

test("points are added behind those that are there, and a new run begins anew", () => {
    const accepted = new AcceptedPoints();
    assert.equal(accepted.take(event_of(0, [point_of(0), point_of(1)])), true);
    assert.equal(accepted.take(event_of(2, [point_of(2)])), true);
    assert.equal(accepted.points.length, 3);
    assert.equal(accepted.take(event_of(0, [point_of(0)], "b")), true);
    assert.deepEqual([accepted.run, accepted.points.length], ["b", 1]);
    assert.equal(accepted.take({ run: null, from: 0, count: 0, points: [] }), true);
    assert.deepEqual([accepted.run, accepted.points], [null, []]);
});

test("points of another run, or with a hole before them, are not taken", () => {
    const accepted = new AcceptedPoints();
    accepted.take(event_of(0, [point_of(0)]));
    assert.equal(accepted.take(event_of(5, [point_of(5)])), false);
    assert.equal(accepted.take(event_of(1, [point_of(1)], "b")), false);
    assert.equal(accepted.points.length, 1);
});

test("of a point that was taken again the last one counts, and the first is still drawn", () => {
    const accepted = new AcceptedPoints();
    accepted.take(event_of(0, [point_of(0), point_of(1), point_of(110, { target: 0 })]));
    assert.deepEqual(accepted.judged().map(({ counts }) => counts), [false, true, true]);
    assert.equal(plot_of(accepted.judged(), view).dots.length, 3);
});

test("steps are 1, 2 or 5 times a power of ten", () => {
    assert.equal(nice_step(10, 5), 2);
    assert.equal(nice_step(11, 5), 5);
    assert.ok(Math.abs(nice_step(0.3, 6) - 0.05) < 1e-12);
});

test("the range holds every value and zero, and is never so small that noise fills it", () => {
    for (const values of [[], [0.01, -0.01], [3.2, 17.9], [-400, -399.9], [1e-9]]) {
        const { low, high, step } = value_range(values, 6);
        assert.ok(low <= Math.min(0, ...values) && high >= Math.max(0, ...values), String(values));
        assert.ok(high - low >= 2 && (high - low) / step <= 8.001, String(values));
    }
});

test("every point lies within the frame, the two directions beside each other", () => {
    const points = [0, 1, 2, 3].flatMap((target) =>
        ["positive", "negative"].map((direction) => point_of(target, { direction, deviation_um: target * 7 - 11 })),
    );
    const plot = plot_of(points.map((point) => ({ point, counts: true })), view);
    for (const dot of plot.dots) assert.ok(dot.x > plot.left && dot.x < plot.right && dot.y >= plot.top && dot.y <= plot.bottom);
    assert.ok(plot.dots[0].x < plot.dots[1].x);
    assert.ok(plot.next_x > plot.dots.at(-1).x);
});

test("a plot without points has a frame and no dot", () => {
    const plot = plot_of([], { ...view, next: null });
    assert.deepEqual([plot.dots, plot.next_x], [[], null]);
    assert.ok(plot.lines.length >= 2 && plot.lines.every(({ y }) => Number.isFinite(y)));
});

test("two hundred targets have as many names as have room", () => {
    const points = Array.from({ length: 200 }, (_, step) => ({ point: point_of(step), counts: true }));
    const { targets } = plot_of(points, view);
    assert.ok(targets.length <= 800 / 40);
});

test("a finger means the nearest point within half a finger, and of two in one place the later", () => {
    const dots = [{ x: 10, y: 10, point: point_of(0) }, { x: 10, y: 10, point: point_of(1) }, { x: 40, y: 10, point: point_of(2) }];
    assert.equal(point_at(dots, 12, 10)?.step, 1);
    assert.equal(point_at(dots, 33, 10)?.step, 2);
    assert.equal(point_at(dots, 200, 200), null);
});
