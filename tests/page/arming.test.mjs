import assert from "node:assert/strict";
import { test } from "node:test";
import { arming_of } from "../../acquisition/console/page/actions.js";

test("what is stated of the machine stands apart, as the interface has it", () => {
    assert.deepEqual(arming_of({ datum_mm: -5, pass: "whole", by: "", state: "as found", control_compensation: "none" }),
        { datum_mm: -5, pass: "whole", statements: { state: "as found", control_compensation: "none" } });
});

test("what is left empty is the station file's to say", () => {
    assert.deepEqual(arming_of({ datum_mm: -5, pass: "", by: "Jo", state: "", control_compensation: "" }), { datum_mm: -5, by: "Jo" });
});
