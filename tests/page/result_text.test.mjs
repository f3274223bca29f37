import assert from "node:assert/strict";
import { test } from "node:test";
import { languages } from "../../acquisition/console/page/catalogue.js";
import { figure_text, parameter_text, result_of, row_of, verdict_of } from "../../acquisition/console/page/result_text.js";
import { words_of } from "./page_under_test.mjs";
import { certificate_of, result_with, stored_of } from "./stored_under_test.mjs";

const words = words_of();
const minus = "\u2212";

test("the verdict stands first, as a shape and a word", () => {
    assert.deepEqual(verdict_of(stored_of(), words), { shape: "✕", word: "FAIL", verdict: "fail" });
    assert.deepEqual(verdict_of(stored_of({ verdict: "pass" }), words), { shape: "✓", word: "PASS", verdict: "pass" });
    assert.equal(verdict_of(stored_of({ verdict: "not_provable" }), words).word, "NOT PROVABLE");
    assert.equal(verdict_of(stored_of({ verdict: "" }), words).word, "no limits agreed: no verdict");
});

test("a verdict that this page does not know is shown as it came, and never as a pass", () => {
    assert.deepEqual(verdict_of(stored_of({ verdict: "constructor" }), words), { shape: "–", word: "constructor", verdict: "other" });
});

test("a run that is not complete, or has no certificate here, has no verdict, whatever its figures say", () => {
    for (const changed of [{ status: "open" }, { status: "incomplete" }, { status: "unreadable" }, { paper: "none" }]) {
        const said = verdict_of(stored_of({ ...changed, verdict: "pass" }), words);
        assert.equal(said.verdict, "none", JSON.stringify(changed));
    }
});

test("a figure stands in the unit of the paper, and no U smaller than it is", () => {
    const [repeatability] = stored_of().figures;
    assert.equal(figure_text(repeatability, "mm", words), "R 4.60 ± 1.21 µm");
    assert.equal(figure_text({ ...repeatability, value: 0.001, U: 0.0005 }, "deg", words), "R 3.60 ± 1.80 ″");
    assert.equal(figure_text({ ...repeatability, value: 118.9, U: null }, "um/m", words), "R 118.90 µm/m");
    assert.equal(figure_text({ ...repeatability, value: null, U: null }, "mm", words), "R – – – µm");
});

test("a figure bears the arrow of its direction, as on the paper", () => {
    assert.deepEqual(["A", "A_forward", "R_backward", "B_mean", "straightness_least_squares_forward"].map(parameter_text),
        ["A", "A ↑", "R ↓", "B mean", "straightness least squares ↑"]);
});

test("each limit has its figure, its limit and the certificate's word and reason", () => {
    const figures = [...stored_of().figures, { parameter: "M", value: null, U: null, limit: null, verdict: "not_evaluated", reason: "one direction alone" }];
    const { limits, figures: others } = result_of(result_with({ figures }), words);
    assert.deepEqual(limits.map(({ shape, text }) => `${shape} ${text}`), [
        "✕ R 4.60 ± 1.21 µm, limit 4.00: FAIL",
        "✓ A 16.40 µm (U not evaluated), limit 20.00: PASS",
        "– M – – – µm (U not evaluated), no limit for this travel: NO VERDICT: one direction alone",
    ]);
    assert.deepEqual(others, [`B mean ${minus}2.40 µm`]);
});

test("an incomplete run shows no line with a verdict, and says why it has none", () => {
    const shown = result_of(result_with({ status: "incomplete", verdict: "", paper: "none", sentence: "coolant on the mirror", paper_sentence: "The run is incomplete." }, null), words);
    assert.deepEqual(shown.limits, []);
    assert.deepEqual(shown.notes, ["coolant on the mirror", "The run is incomplete."]);
    assert.equal(shown.said.word, "incomplete: no verdict");
});

test("readings that a person left out are counted in the head", () => {
    assert.equal(result_of(result_with({ left_out: 2 }), words).counts, "4 of 4 points · 2 left out");
});

test("the papers are links of the station, with their size", () => {
    assert.deepEqual(result_of(result_with(), words).papers, [
        { href: "/v1/runs/demo-20260102T081500Z-X/certificate.pdf", opens: true, text: "PDF, 123 kB" },
        { href: "/v1/runs/demo-20260102T081500Z-X/demo.axiscal", opens: false, text: "run file, 2.3 MB" },
    ]);
});

test("remarks that are no text are none", () => {
    const run = { ...certificate_of().run, remarks: ["a", 3, null] };
    assert.deepEqual(result_of(result_with({}, certificate_of({ run })), words).remarks, ["a"]);
    assert.deepEqual(result_of(result_with({}, null), words).remarks, []);
});

test("a row of History tells machine, axis, state, verdict, figures and where its paper is", () => {
    const { said, head, line } = row_of(stored_of(), words);
    assert.equal(said.word, "FAIL");
    assert.ok(head.endsWith("M-10442 (4711) · X · as found · positioning"), head);
    assert.equal(line, "R 4.60 µm · A 16.40 µm · 4 of 4 points · published");
});

test("a file that cannot be read is a row by its name, with its sentence", () => {
    const damaged = stored_of({ status: "unreadable", kind: "", axis: "", machine: "", machine_serial: "", machine_state: "", started_utc: "",
        points: 0, planned: 0, verdict: "", figures: [], paper: "none", sentence: "x.axiscal: damaged" });
    const { said, head, line } = row_of(damaged, words);
    assert.deepEqual([said.word, head, line], ["cannot be read", "demo-20260102T081500Z-X", "x.axiscal: damaged"]);
});

test("every language says every verdict, and what is missing in none", () => {
    for (const language of languages) {
        const own = words_of(language);
        for (const verdict of ["pass", "fail", "not_provable", "not_evaluated", ""])
            for (const status of ["open", "complete", "incomplete", "unreadable"])
                for (const kind of ["positioning", "circular", "drift", "probing", "straightness", "squareness"])
                    for (const paper of ["none", "waiting", "published"]) {
                        const shown = JSON.stringify([result_of(result_with({ verdict, status, kind, paper }), own), row_of(stored_of({ verdict, status, kind, paper }), own)]);
                        assert.ok(!shown.includes("⟦") && !/\{\w+\}/.test(shown.replaceAll(/"\w+":/g, "")), `${language}: ${shown}`);
                    }
    }
});
