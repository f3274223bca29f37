import assert from "node:assert/strict";
import { test } from "node:test";
import { Barcode } from "../../acquisition/console/page/barcode.js";

/** Each key `ms` behind the one before. */
function typed(text, ms, barcode = new Barcode(), from = 1000) {
    let read = null;
    [...text, "Enter"].forEach((key, nth) => (read = barcode.take(key, from + nth * ms) ?? read));
    return read;
}

test("what a reader types is read with its Enter", () => {
    assert.equal(typed("M-10442", 5), "M-10442");
    assert.equal(typed("gs4711", 20), "gs4711");
});

test("what a hand types is no barcode", () => {
    assert.equal(typed("M-10442", 90), null);
    assert.equal(typed("M", 5), null);
});

test("an Enter of its own, later, ends nothing that was read", () => {
    const barcode = new Barcode();
    for (const [nth, key] of [..."M-10442"].entries()) assert.equal(barcode.take(key, nth * 5), null);
    assert.equal(barcode.take("Enter", 400), null);
    assert.equal(typed("X-1", 5, barcode, 500), "X-1");
});

test("the Shift of a capital letter parts no barcode", () => {
    const barcode = new Barcode();
    const keys = ["Shift", "M", "1", "Shift", "B", "Enter"];
    assert.deepEqual(keys.map((key, nth) => barcode.take(key, nth * 5)), [null, null, null, null, null, "M1B"]);
});

test("keys faster than a hand are known from the second one on", () => {
    const barcode = new Barcode();
    assert.equal(barcode.is_fast(1000), false);
    barcode.take("g", 1000);
    assert.equal(barcode.is_fast(1010), true);
    assert.equal(barcode.is_fast(1200), false);
});
