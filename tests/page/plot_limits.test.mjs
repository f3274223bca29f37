import assert from "node:assert/strict";
import { test } from "node:test";
import { limit_lines } from "../../acquisition/console/page/plot_limits.js";
import { side_of, target_of } from "./page_under_test.mjs";

// Means from −1 to 4 µm, mean ± 2 s from −2 to 6 µm: E is 5 µm wide and A 8 µm by their definitions in ISO 230-2.
const measured = [target_of(0, side_of(0, 0.5), side_of(-1, 0.5)), target_of(1, side_of(4, 1), side_of(2, 0.5))];
const limit = (parameter, limit_um, value_um) => ({ parameter, limit_um, value_um });

test("the lines of A are as far apart as its limit, with the bands in the middle", () => {
    assert.deepEqual(limit_lines(measured, [limit("R", 3, 2), limit("A", 12, 8)]), { parameter: "A", limit_um: 12, low_um: -4, high_um: 8 });
});

test("bands that are wider than the limit reach beyond both lines alike", () => {
    assert.deepEqual(limit_lines(measured, [limit("A", 6, 8)]), { parameter: "A", limit_um: 6, low_um: -1, high_um: 5 });
});

test("the lines of E hold the means, and those of A come first", () => {
    assert.deepEqual(limit_lines(measured, [limit("E", 10, 5)]), { parameter: "E", limit_um: 10, low_um: -3.5, high_um: 6.5 });
    assert.equal(limit_lines(measured, [limit("E", 10, 5), limit("A", 12, 8)])?.parameter, "A");
});

test("a figure comes rounded", () => {
    assert.equal(limit_lines(measured, [limit("A", 12, 8.04)])?.parameter, "A");
});

test("no line stands where the figure is not as wide as what is drawn", () => {
    assert.equal(limit_lines(measured, [limit("A", 12, 11)]), null, "A of another standard: mean ± 3 s");
    assert.equal(limit_lines(measured.slice(0, 1), [limit("A", 12, 8)]), null, "not every target is here");
    assert.equal(limit_lines(measured, [limit("A", 12, null)]), null, "there is no figure yet");
    assert.equal(limit_lines([], [limit("A", 12, 8)]), null);
});

test("limits of other figures, of no travel and of none at all have no line", () => {
    for (const limits of [[], [limit("R", 12, 8)], [limit("A_forward", 12, 8)], [limit("A", null, 8)]])
        assert.equal(limit_lines(measured, limits), null, JSON.stringify(limits));
});

test("a limit that is far wider than the figure is left to the words", () => {
    assert.equal(limit_lines(measured, [limit("A", 32, 8)])?.limit_um, 32);
    assert.equal(limit_lines(measured, [limit("A", 33, 8)]), null);
});
