import assert from "node:assert/strict";
import { test } from "node:test";
import { decimals_of, least_range, point_at, step_room, steps } from "../../acquisition/console/page/plot_geometry.js";
import { labels_of } from "../../acquisition/console/page/plot_labels.js";
import { stretches_of } from "../../acquisition/console/page/plot_bands.js";
import { short_place } from "../../acquisition/console/page/plot_view.js";
import { plot_of, point_of, side_of, target_of, words_of } from "./page_under_test.mjs";

const view = Object.freeze({ width: 800, height: 400, factor: 1, next: 5 });

/** @param points  all of them count */
function drawn_of(points, changed = {}) {
    const judged = points.map((point) => ({ point, counts: true, left_out: false }));
    return { judged, nominals: null, targets: new Map(), limits: null, ...changed };
}

const targets_of = (...rows) => new Map(rows.map((row) => [row.target, row]));
const corners_of = (path) => (path.match(/-?[\d.]+ -?[\d.]+/g) ?? []).map((pair) => pair.split(" ").map(Number));

test("lines of the grid stand at 1, 2 or 5 times a power of ten, with as many decimals as that needs", () => {
    assert.ok(steps.every((step, nth) => /^[125]e/.test(step.toExponential()) && (nth === 0 || step > steps[nth - 1])));
    assert.deepEqual([0.05, 0.1, 0.5, 1, 2, 50].map(decimals_of), [2, 1, 1, 0, 0, 0]);
});

test("the grid of a low plot has four steps at most, of a high one six, and names of lines stand apart", () => {
    assert.deepEqual([60, 120, 360].map((height) => Math.floor(height / step_room(height))), [2, 4, 6]);
    for (const height of [20, 60, 120, 360, 1000]) assert.ok(step_room(height) >= 24);
});

test("the range holds every value and zero, and is never so small that noise fills it", () => {
    for (const [least, most] of [[null, null], [-0.01, 0.01], [3.2, 17.9], [-400, -399.9], [1e-9, 1e-9]]) {
        const [low, high] = least_range(least, most);
        assert.ok(low <= Math.min(0, least ?? 0) && high >= Math.max(0, most ?? 0) && high - low >= 2, `${least} ${most}`);
    }
});

test("every point lies within the frame, the two directions beside each other", () => {
    const points = [0, 1, 2, 3].flatMap((target) =>
        ["positive", "negative"].map((direction) => point_of(target, { direction, deviation_um: target * 7 - 11 })),
    );
    const plot = plot_of(drawn_of(points), view);
    for (const dot of plot.dots) assert.ok(dot.x > plot.left && dot.x < plot.right && dot.y >= plot.top && dot.y <= plot.bottom);
    assert.ok(plot.dots[0].x < plot.dots[1].x);
    assert.ok(plot.next_x > plot.dots.at(-1).x);
});

test("the lines of a limit have room, the upper one first", () => {
    const limits = { parameter: "A", limit_um: 20, low_um: -8, high_um: 12 };
    const { limit_ys: [upper, lower], zero_y, top, bottom } = plot_of(drawn_of([point_of(0)], { limits }), { ...view, next: null });
    assert.ok(top <= upper && upper < zero_y && zero_y < lower && lower <= bottom);
    assert.ok(Math.abs((zero_y - upper) / (lower - zero_y) - 12 / 8) < 1e-9);
});

test("a plot without points has a frame and no dot", () => {
    const plot = plot_of(drawn_of([]), { ...view, next: null });
    assert.deepEqual([plot.dots, plot.next_x], [[], null]);
    assert.ok(plot.zero_y > plot.top && plot.zero_y < plot.bottom && plot.targets.every(({ x }) => Number.isFinite(x)));
});

test("targets stand at their places, also before the first point", () => {
    const nominals = [0, 100, 400];
    const { targets, ends, left, right } = plot_of(drawn_of([], { nominals }), { ...view, next: null });
    const [a, b, c] = targets.map(({ x }) => x);
    assert.ok(Math.abs((b - a) / (c - a) - 0.25) < 1e-9);
    assert.ok(a > left && c < right);
    assert.deepEqual(ends, { first: 0, last: 400 });
});

test("targets of a plan that runs downwards stand from the lowest place to the highest", () => {
    const { targets, ends } = plot_of(drawn_of([], { nominals: [0, -100, -400] }), { ...view, next: null });
    assert.deepEqual(targets.map(({ target }) => target), [2, 1, 0]);
    assert.deepEqual(ends, { first: -400, last: 0 });
});

test("one target, or several in one place, stand in the middle", () => {
    for (const nominals of [[250], [250, 250]]) {
        const { targets, left, right } = plot_of(drawn_of([point_of(0)], { nominals }), { ...view, next: null });
        for (const { x } of targets) assert.ok(Math.abs(x - (left + right) / 2) < 1e-9);
    }
});

test("of a station of before, targets stand one beside the other, and no place is told", () => {
    const { targets, ends } = plot_of(drawn_of([point_of(0), point_of(1), point_of(2)]), { ...view, next: 3 });
    const [a, b, c, d] = targets.map(({ x }) => x);
    assert.ok(Math.abs(b - a - (c - b)) < 1e-9 && Math.abs(b - a - (d - c)) < 1e-9);
    assert.equal(ends, null);
});

test("a target that the plan does not name has room beside the others", () => {
    const plot = plot_of(drawn_of([point_of(0), point_of(7)], { nominals: [0, 100] }), { ...view, next: null });
    assert.equal(plot.ends, null);
    assert.ok(plot.dots[0].x < plot.dots[1].x && plot.dots[1].x < plot.right);
});

test("the mean of each direction is a line through the middle of its points, and a band around it", () => {
    const rows = [target_of(0, side_of(1, 0.5), side_of(-2)), target_of(1, side_of(3, 0.5), side_of(-3))];
    const points = [point_of(0, { deviation_um: 1 }), point_of(1, { deviation_um: 3 })];
    const plot = plot_of(drawn_of(points, { nominals: [0, 100], targets: targets_of(...rows) }), view);
    const [positive, negative] = plot.sides;
    assert.deepEqual(corners_of(positive.means[0]), plot.dots.map(({ x, y }) => [x, y]));
    const [[x, high], , , [also_x, low]] = corners_of(positive.bands[0]);
    assert.equal(x, also_x);
    assert.ok(high < plot.dots[0].y && plot.dots[0].y < low);
    assert.equal(positive.bands.length, 1);
    assert.deepEqual([negative.means.length, negative.bands], [1, []]);
});

test("a band has room in the plot, in the unit that is shown", () => {
    const targets = targets_of(target_of(0, side_of(0, 10)));
    const { sides, top, bottom, high } = plot_of(drawn_of([point_of(0)], { nominals: [0], targets }), { ...view, factor: 3.6 });
    for (const [, y] of corners_of(sides[0].bands[0])) assert.ok(y >= top && y <= bottom);
    assert.ok(high >= 72);
});

test("no line and no band goes over a target that has no mean", () => {
    const targets = targets_of(target_of(0, side_of(1, 1)), target_of(1), target_of(2, side_of(2)), target_of(3, side_of(3, 1)));
    const { sides } = plot_of(drawn_of([], { nominals: [0, 100, 200, 300], targets }), view);
    assert.deepEqual(sides[0].means.map((path) => corners_of(path).length), [2, 2]); // a dash, a line
    assert.deepEqual(sides[0].bands.map((path) => corners_of(path).length), [4, 4]); // two bars
    assert.deepEqual(sides[1], { direction: "negative", means: [], bands: [] });
    assert.deepEqual(stretches_of([null, 1, 2, null, null, 3]), [[1, 2], [3]]);
});

test("a station of before has no lines of means", () => {
    const { sides } = plot_of(drawn_of([point_of(0)]), view);
    assert.deepEqual(sides.flatMap(({ means, bands }) => [...means, ...bands]), []);
});

// As wide as 18 pixels of DejaVu Sans: a digit takes 11.45 of them, an m 17.5.
const width_of = (text) => [...text].reduce((sum, one) => sum + (one === "m" ? 17.5 : one === " " || one === "." ? 5.7 : 11.45), 0);
const room = Object.freeze({ left: 40, right: 600, width_of });
const spread_over = (count, width = 500) =>
    Array.from({ length: count }, (_, target) => ({ target, x: 80 + (count === 1 ? 0 : (target * width) / (count - 1)) }));
const texts_of = (labels) => labels.map(({ text }) => text);

test("the first and the last target have their place, those between their names where there is room", () => {
    const ends = { first: "0", last: "500 mm" };
    assert.deepEqual(texts_of(labels_of(spread_over(3), ends, room)), ["P1 = 0", "P2", "P3 = 500 mm"]);
    const many = texts_of(labels_of(spread_over(21), ends, room));
    assert.deepEqual([many[0], many.at(-1)], ["P1 = 0", "P21 = 500 mm"]);
    assert.ok(many.slice(1, -1).every((text) => /^P\d+$/.test(text)) && many.length > 6);
});

test("with little room the two places stand without names, and then the last alone", () => {
    const ends = { first: "-1000.125", last: "1000.125 mm" };
    const narrow = { left: 40, right: 300, width_of };
    assert.deepEqual(texts_of(labels_of(spread_over(2, 200), ends, narrow)), ["-1000.125", "1000.125 mm"]);
    assert.deepEqual(texts_of(labels_of(spread_over(2, 60), ends, { left: 40, right: 180, width_of })), ["1000.125 mm"]);
});

test("a name that would touch the place of the last target gives way by the width of its letters", () => {
    // At 800 by 480, of five targets from 28.741 to 333.504 mm: P3 ended where the place began.
    const shown = [485, 531, 567, 600, 667].map((x, target) => ({ target, x }));
    const labels = labels_of(shown, { first: "28.741", last: "333.504 mm" }, { left: 40, right: 696, width_of });
    assert.deepEqual(texts_of(labels), ["28.741", "333.504 mm"]);
});

test("a plan of one target has one name with its place", () => {
    assert.deepEqual(texts_of(labels_of(spread_over(1), { first: "0", last: "0 mm" }, room)), ["P1 = 0 mm"]);
});

test("names stand apart, and within their room, of two hundred targets too", () => {
    for (const places of [null, { first: "0", last: "1990 mm" }])
        for (const count of [2, 7, 11, 50, 200]) {
            const labels = labels_of(spread_over(count), places, room);
            const reach = labels.map(({ text, x, anchor }) => {
                const wide = width_of(text);
                return anchor === "start" ? [x, x + wide] : anchor === "end" ? [x - wide, x] : [x - wide / 2, x + wide / 2];
            });
            assert.ok(labels.length >= 2, `${count}`);
            reach.forEach(([low, high], nth) => {
                assert.ok(low >= room.left && high <= room.right, `${count}: ${labels[nth].text}`);
                assert.ok(nth === 0 || reach[nth - 1][1] < low, `${count}: ${labels[nth].text}`);
            });
        }
});

test("a place below the plot has no zeros behind its last digit", () => {
    assert.deepEqual([0, 500, 301.412, -0.5, 1e-9].map((place) => short_place(place, words_of("en"))), ["0", "500", "301.412", "\u22120.5", "0"]);
    assert.equal(short_place(100.25, words_of("de")), "100,25");
});

test("a finger means the nearest point within half a finger, and of two in one place the later", () => {
    const dots = [{ x: 10, y: 10, point: point_of(0) }, { x: 10, y: 10, point: point_of(1) }, { x: 40, y: 10, point: point_of(2) }];
    assert.equal(point_at(dots, 12, 10)?.step, 1);
    assert.equal(point_at(dots, 33, 10)?.step, 2);
    assert.equal(point_at(dots, 200, 200), null);
});
