// The plot as uPlot draws it, on a canvas that notes what comes.
import assert from "node:assert/strict";
import { test } from "node:test";
import { AcceptedPoints } from "../../acquisition/console/page/accepted_points.js";
import { PlotView } from "../../acquisition/console/page/plot_view.js";
import { browser_with, may_be_missing } from "./canvas_under_test.mjs";
import { point_of, run_of, side_of, status_of, target_of, words_of } from "./page_under_test.mjs";

const light = { ink: "#111", dim: "#4d4d4d", line: "#bbb", positive: "#0072b2", negative: "#d55e00" };
const dark = { ink: "#f1f1f1", dim: "#b5b5b5", line: "#4a4e52", positive: "#56b4e9", negative: "#ff8a3d" };
const drawn_by_uplot = (sentence, proof) =>
    test(sentence, { skip: may_be_missing && "there is no uPlot: configure preset check first" }, proof);

function run_with_points() {
    const accepted = new AcceptedPoints();
    accepted.take({
        run: run_of().id, count: 5, from: 0, target_nominals_mm: [0, 100, 200, 300],
        points: [
            point_of(0, { deviation_um: 3.25 }), point_of(1, { deviation_um: -2 }), point_of(2, { target: 1, deviation_um: -1 }),
            point_of(3, { target: 2, direction: "negative", deviation_um: 1 }), point_of(4, { target: 3, excluded: true }),
        ],
        targets: [target_of(0, side_of(3.25, 0.5)), target_of(1, side_of(-1)), target_of(2, side_of(), side_of(1))],
    });
    return accepted;
}

const in_run = () => status_of({ run: run_of({ next: { target: 3, nominal_mm: 300, direction: "positive", approach: 0 } }) });

async function painted({ colours = light, accepted = run_with_points(), status = in_run(), words = words_of("en"), pick = null, ratio = 1, picked = null } = {}) {
    const browser = browser_with(colours, { ratio });
    const view = new PlotView(browser.place, pick);
    browser.resize(800, 400);
    const paint = (chosen = picked) => view.paint(accepted, status, chosen, words);
    paint();
    await browser.drawn();
    const canvas = () => browser.place.find("canvas").getContext();
    return { browser, view, paint, canvas, texts: () => canvas().done.filter(({ what }) => what === "text").map(({ text }) => text) };
}

drawn_by_uplot("each mark is on the canvas once, and is counted", async () => {
    const { view, canvas } = await painted();
    assert.deepEqual(view.drawn, {
        zero: 1, limit: 0, next_line: 1, band_positive: 1, band_negative: 0, mean_positive: 1, mean_negative: 1, positive: 3, negative: 1,
        replaced: 1, left_out: 1, latest: 1, picked_ring: 0,
    });
    const fills = canvas().done.filter(({ what, colour, alpha }) => what === "fill" && colour === light.positive && alpha === 1);
    assert.equal(fills.length, 3);
    assert.equal(view.room.getAttribute("data-positive"), "3");
    assert.equal(view.room.getAttribute("data-negative"), "1");
});

drawn_by_uplot("every mark lies within the frame, and on a finer screen in the same place", async () => {
    const places = [];
    for (const ratio of [1, 2]) {
        const { view } = await painted({ ratio });
        for (const { x, y } of view.dots) assert.ok(x > 64 && x < 788 && y >= 12 && y <= 368, `${x} ${y}`);
        places.push(view.dots.map(({ x, y }) => [x, y]));
    }
    assert.deepEqual(places[0], places[1]);
});

drawn_by_uplot("the grid has few lines with 0 among them, in the mark and the minus of the language", async () => {
    const { texts } = await painted({ words: words_of("de") });
    const values = texts().filter((text) => /^\u2212?\d+(,\d+)?$/.test(text));
    assert.ok(values.length >= 3 && values.length <= 8 && values.includes("0"), String(values));
    assert.ok(values.some((text) => text.startsWith("\u2212")), String(values));
    const { texts: fine } = await painted({ accepted: new AcceptedPoints(), words: words_of("de") });
    assert.ok(fine().includes("\u22121,0") && fine().includes("noch keine Punkte"), String(fine()));
});

drawn_by_uplot("the limit of A is two lines with its text, of the run that is drawn alone", async () => {
    const limits = [{ parameter: "A", limit_um: 12.25, value_um: 8 }];
    const accepted = new AcceptedPoints();
    const targets = [target_of(0, side_of(0, 0.5), side_of(-1, 0.5)), target_of(1, side_of(4, 1), side_of(2, 0.5))];
    accepted.take({ run: run_of().id, count: 1, from: 0, target_nominals_mm: [0, 100], points: [point_of(0)], targets });
    const { view, texts } = await painted({ accepted, status: status_of({ run: run_of({ so_far: { limits } }) }), words: words_of("de") });
    assert.equal(view.drawn.limit, 2);
    assert.ok(texts().includes("A ≤ 12,25 µm"), String(texts()));
    const { view: other } = await painted({ accepted, status: status_of({ run: run_of({ id: "another", so_far: { limits } }) }) });
    assert.equal(other.drawn.limit, 0);
});

drawn_by_uplot("a rotary axis has its own unit", async () => {
    const rotary = in_run();
    rotary.axis.kind = "rotary";
    const { texts } = await painted({ status: rotary });
    assert.ok(texts().includes("″"), String(texts()));
});

drawn_by_uplot("other colours are drawn at once, and nothing of the old ones stays", async () => {
    const colours = { ...light };
    const { browser, paint, canvas, view } = await painted({ colours });
    Object.assign(colours, dark);
    paint();
    assert.ok(canvas().done.some(({ colour }) => colour === light.positive), "nobody told of other colours");
    browser.recolour();
    paint();
    await browser.drawn();
    assert.deepEqual(canvas().done.filter(({ colour }) => Object.values(light).includes(colour)), []);
    assert.ok(canvas().done.some(({ colour }) => colour === dark.positive));
    assert.equal(view.drawn.positive, 3);
});

drawn_by_uplot("a new point, a new size and a point that is picked are drawn anew, what has not changed is not", async () => {
    const accepted = run_with_points();
    const { browser, paint, canvas, view } = await painted({ accepted });
    const before = canvas().done;
    paint();
    await browser.drawn();
    assert.equal(canvas().done, before);
    accepted.take({ run: accepted.run, count: 6, from: 5, points: [point_of(5, { target: 3, deviation_um: 40 })] });
    paint();
    assert.equal(view.drawn.positive, 4);
    assert.ok(view.dots.every(({ y }) => y >= 12 && y <= 368), "the axis reaches over the new point");
    paint(accepted.points[0]);
    assert.equal(view.drawn.picked_ring, 1);
    browser.resize(400, 300);
    paint(accepted.points[0]);
    assert.ok(view.dots.every(({ x, y }) => x > 64 && x < 388 && y >= 12 && y <= 268));
});

drawn_by_uplot("a touch on the plot picks the point that lies there", async () => {
    const picks = [];
    const { browser, view } = await painted({ pick: (point) => picks.push(point?.step ?? null) });
    const [, second] = view.dots;
    browser.place.dispatchEvent(Object.assign(new Event("click"), { clientX: second.x + 3, clientY: second.y }));
    browser.place.dispatchEvent(Object.assign(new Event("click"), { clientX: 2, clientY: 2 }));
    assert.deepEqual(picks, [1, null]);
});

test("without uPlot the plot says so, and claims no mark", () => {
    const browser = browser_with(light, { library: false });
    const view = new PlotView(browser.place, null);
    browser.resize(800, 400);
    view.paint(run_with_points(), in_run(), null, words_of("en"));
    assert.match(view.room.textContent, /not installed/);
    assert.deepEqual(view.drawn, {});
    assert.equal(view.room.getAttribute("data-positive"), null);
});
