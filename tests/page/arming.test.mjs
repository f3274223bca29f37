import assert from "node:assert/strict";
import { test } from "node:test";
import { arming_fields, arming_of, override_fields, revising_fields } from "../../acquisition/console/page/order_fields.js";
import { status_of, words_of } from "./page_under_test.mjs";

const check_of = (name, changed = {}) => ({ name, passed: false, warning: false, verdict: "not yet", override: "", ...changed });

test("the sheet that arms asks all that the interface takes, each by a label of its own", () => {
    const fields = arming_fields(status_of(), "Jo", words_of("en"));
    assert.deepEqual(fields.map(({ name }) => name), ["datum_mm", "pass", "seed", "by", "state", "control_compensation"]);
    assert.equal(new Set(fields.map(({ label }) => label)).size, fields.length);
    assert.equal(fields.find(({ name }) => name === "by")?.value, "Jo");
    assert.deepEqual(fields.find(({ name }) => name === "state")?.choices?.map(([value]) => value), ["", "as found", "as left", "raw"]);
});

test("the datum is asked in the unit of the axis", () => {
    const label_of = (kind) => arming_fields(status_of({ axis: { ...status_of().axis, kind } }), "", words_of("en"))[0].label;
    assert.match(label_of("linear"), /mm/);
    assert.match(label_of("rotary"), /°/);
});

test("the sheet that takes a point back asks why, and who", () => {
    assert.deepEqual(revising_fields("Jo", words_of("en")).map(({ name, value }) => [name, value]), [["reason", undefined], ["by", "Jo"]]);
});

test("what is stated of the machine stands apart, as the interface has it", () => {
    assert.deepEqual(arming_of({ datum_mm: -5, pass: "whole", by: "", state: "as found", control_compensation: "none" }),
        { datum_mm: -5, pass: "whole", statements: { state: "as found", control_compensation: "none" } });
});

test("what is left empty is the station file's to say", () => {
    assert.deepEqual(arming_of({ datum_mm: -5, pass: "", by: "Jo", state: "", control_compensation: "" }), { datum_mm: -5, by: "Jo" });
});

test("each check that keeps the run from being armed asks for a reason, and no other does", () => {
    const checks = [check_of("soak"), check_of("drift", { passed: true }), check_of("certificates", { override: "it is on its way" })];
    const fields = override_fields({ done: false, status: 409, sentence: "", body: { checks } }, words_of("en"));
    assert.deepEqual(fields, [{ name: "override soak", label: "Go on despite “soak”: reason", kind: "text" }]);
    assert.deepEqual(override_fields({ done: false, status: 0, sentence: "", body: null }, words_of("en")), []);
});

test("reasons are sent by the name of their check, and what has none is not overridden", () => {
    assert.deepEqual(arming_of({ datum_mm: -5, state: "", control_compensation: "", "override soak": "the customer waits", "override drift": "" }),
        { datum_mm: -5, overrides: { soak: "the customer waits" } });
});
