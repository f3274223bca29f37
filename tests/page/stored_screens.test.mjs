import assert from "node:assert/strict";
import { test } from "node:test";
import { AcceptedPoints } from "../../acquisition/console/page/accepted_points.js";
import { ResultView } from "../../acquisition/console/page/result_view.js";
import { StoredScreens } from "../../acquisition/console/page/stored_screens.js";
import { words_of } from "./page_under_test.mjs";
import { certificate_of, result_with, station_that } from "./stored_under_test.mjs";

/** Without its views, which need a browser: one that notes what it takes stands in the place of Result's. */
function screens_that_show(results) {
    const taken = [];
    const { fetcher } = station_that({ "/v1/runs/": () => [200, results[0]] });
    const result_view = { take: (result) => taken.push(result.number), paint() {} };
    const bare = { fetcher, result_view, go_to() {}, wanted: "demo-1", result: null, is_new: false, answer: {}, question: 0, seen: "" };
    return { screens: Object.assign(Object.create(StoredScreens.prototype), bare), taken, paint: (screens) => screens.paint("result", words_of("en")) };
}

test("an answer that comes while a finger is down waits for the next paint, and is taken once", async () => {
    const { screens, taken, paint } = screens_that_show([result_with({ number: "C-7" })]);
    await screens.ask();
    assert.deepEqual(taken, []); // a table that is open there stays open under the finger
    paint(screens);
    paint(screens);
    assert.deepEqual(taken, ["C-7"]);
});

test("the same answer again is not taken, another one is", async () => {
    const results = [result_with({ number: "C-7" })];
    const { screens, taken, paint } = screens_that_show(results);
    for (const number of ["C-7", "C-7", "C-8"]) {
        results[0] = result_with({ number });
        await screens.ask();
        paint(screens);
    }
    assert.deepEqual(taken, ["C-7", "C-8"]);
});

test("a result that can not be drawn is tried once, and the page goes on", async () => {
    const { screens, paint } = screens_that_show([result_with()]);
    screens.result_view.take = () => {
        throw new TypeError("odd");
    };
    await screens.ask();
    assert.throws(() => paint(screens), /odd/);
    assert.doesNotThrow(() => paint(screens));
});

test("beside a certificate that is odd stands nothing of the one before", () => {
    const places = { table: { hidden: false } };
    const view = Object.assign(Object.create(ResultView.prototype), { places, readings: new AcceptedPoints(), shown: "of before", has_plot: false });
    view.take(result_with());
    assert.equal(view.has_plot, true);
    assert.throws(() => view.take(result_with({}, { ...certificate_of(), positions: [null] })));
    assert.deepEqual([view.has_plot, view.shown, places.table.hidden], [false, "", true]);
});
