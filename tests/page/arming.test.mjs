import assert from "node:assert/strict";
import { test } from "node:test";
import { arming_of, override_fields } from "../../acquisition/console/page/actions.js";
import { words_of } from "./page_under_test.mjs";

const check_of = (name, changed = {}) => ({ name, passed: false, warning: false, verdict: "not yet", override: "", ...changed });

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
