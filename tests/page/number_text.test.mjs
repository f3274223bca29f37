import assert from "node:assert/strict";
import { test } from "node:test";
import { age_of, axis_units, minutes_text, no_number, number_text, shop_unit, typed_number } from "../../acquisition/console/page/number_text.js";

test("what rounds to zero has no sign", () => {
    for (const value of [-0, 0, -0.004, 0.004, -0.0049999]) {
        assert.equal(number_text(value, 2), "\u20070.00");
        assert.equal(number_text(value, 2, { plus: true }), "\u20070.00");
    }
    assert.equal(number_text(-0.4, 0), "\u20070");
});

test("a negative number has a true minus, and a positive one room for it", () => {
    assert.equal(number_text(-3.2, 1), "\u22123.2");
    assert.equal(number_text(3.2, 1), "\u20073.2");
    assert.equal(number_text(3.2, 1, { plus: true }), "+3.2");
    assert.equal(number_text(-3.2, 1).length, number_text(3.2, 1).length);
});

test("what is no number is shown as dashes and never as 0", () => {
    for (const value of [null, undefined, NaN, Infinity, -Infinity, "0", "", [], 1e21]) assert.equal(number_text(value, 2), no_number);
    assert.ok(!/\d/.test(no_number));
});

test("the decimal mark is the language's", () => {
    assert.equal(number_text(-1.25, 2, { decimal_mark: "," }), "\u22121,25");
});

test("decimals are fixed and there is no exponent", () => {
    assert.equal(number_text(1e-9, 4), "\u20070.0000");
    assert.equal(number_text(123456.78949, 4), "\u2007123456.7895");
});

test("units are those of the shop floor, as in axiscal status", () => {
    assert.deepEqual(shop_unit("m"), { factor: 1e3, decimals: 4, unit: "mm" });
    assert.deepEqual(shop_unit("Pa"), { factor: 1e-2, decimals: 1, unit: "hPa" });
    assert.equal(shop_unit("degC").unit, "°C");
    assert.equal(shop_unit("%").decimals, 1);
    assert.equal(shop_unit("furlong").unit, "furlong");
});

test("of a rotary axis millimetres are degrees, and micrometres seconds of arc", () => {
    const units = axis_units({ kind: "rotary", reading: "length" });
    assert.equal(units.coordinate, "°");
    assert.deepEqual(units.deviation, { factor: 3.6, unit: "″" });
    assert.equal(units.reading.unit, "µm");
    assert.equal(axis_units({ kind: "rotary", reading: "angle" }).reading.unit, "″");
    assert.equal(axis_units({}).coordinate, "mm");
});

test("an age is told in the unit that fits", () => {
    assert.deepEqual(age_of(0.9), { key: "age_s", number: "0" });
    assert.deepEqual(age_of(119.9), { key: "age_s", number: "119" });
    assert.deepEqual(age_of(120), { key: "age_min", number: "2" });
    assert.deepEqual(age_of(7200), { key: "age_h", number: "2" });
    assert.equal(age_of(null), null);
    assert.equal(minutes_text(1085), "18:05");
    assert.equal(minutes_text(null), no_number);
});

test("a typed number may have comma or point and either minus", () => {
    assert.equal(typed_number("-5"), -5);
    assert.equal(typed_number(" \u22125,25 "), -5.25);
    assert.equal(typed_number("+.5"), 0.5);
    for (const typed of ["", "5 mm", "1e3", "1,2,3", "0x10", "-", ".", "NaN"]) assert.equal(typed_number(typed), null);
});
