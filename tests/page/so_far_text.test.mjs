import assert from "node:assert/strict";
import { test } from "node:test";
import { languages } from "../../acquisition/console/page/catalogue.js";
import { run_shown } from "../../acquisition/console/page/status_view.js";
import { run_of, so_far_of, status_of, words_of } from "./page_under_test.mjs";

function shown(run, changed = {}, language = "en") {
    return run_shown(status_of({ run: run_of(run), ...changed }), words_of(language)).so_far;
}

const texts = (...given) => shown(...given).map(({ text }) => text);

test("how the run stands is said in the station's own sentence, its limits in words, and the other figures", () => {
    assert.deepEqual(texts({ so_far: so_far_of() }), [
        "So far already outside: A 14.2 of 12.0 um.",
        "A 14.2 of 12.0 um so far",
        "So far by ISO 230-2:2014: B_mean \u22122.60 µm",
    ]);
});

test("the basis of every figure can be read", () => {
    for (const { basis } of shown({ so_far: so_far_of() })) assert.equal(basis, "as shown at the machine: without U");
});

test("before there are figures of a standard, range and reversal are told as such", () => {
    const early = so_far_of({ standing: "not judged", sentence: "So far not judged: no limits were agreed on.", figures: null, limits: [] });
    assert.deepEqual(texts({ so_far: early }), [
        "So far not judged: no limits were agreed on.",
        "deviations so far within 13.10 µm · largest reversal so far 2.60 µm",
    ]);
    assert.deepEqual(texts({ so_far: { ...early, reversal_max_um: null, deviation_range_um: null } }), [early.sentence]);
});

test("a figure whose limit does not hold for this travel is told among the figures", () => {
    const limits = [{ parameter: "A", limit_um: null, value_um: null, standing: "not judged", sentence: "A not judged so far: no limit" }];
    assert.equal(texts({ so_far: so_far_of({ limits }) })[2], "So far by ISO 230-2:2014: A 14.20 · B_mean \u22122.60 µm");
});

test("when every figure has its limit, none is told twice", () => {
    const figures = [{ parameter: "A", value_um: 14.2 }];
    assert.equal(texts({ so_far: so_far_of({ figures }) }).length, 2);
});

test("of a rotary axis figures are told in seconds of arc", () => {
    const { axis } = status_of();
    const line = texts({ so_far: so_far_of({ limits: [] }) }, { axis: { ...axis, kind: "rotary", reading: "angle" } }).at(-1);
    assert.equal(line, "So far by ISO 230-2:2014: A 51.12 · B_mean \u22129.36 ″");
});

test("without anything so far there is no verdict before the end, and nothing is said after it", () => {
    for (const so_far of [null, undefined]) {
        assert.deepEqual(shown({ so_far }), [{ text: "No verdict before the run ends.", basis: "" }]);
        assert.deepEqual(shown({ so_far }, { run_open: false }), []);
    }
    assert.deepEqual(run_shown(status_of({ run: null, run_open: false }), words_of()).so_far, []);
});

test("a run that ended without a certificate yet still says how it stood", () => {
    assert.equal(texts({ so_far: so_far_of() }, { run_open: false })[0], "So far already outside: A 14.2 of 12.0 um.");
});

test("once there is a certificate it alone says the result", () => {
    for (const so_far of [so_far_of(), null, undefined])
        assert.deepEqual(texts({ so_far, certificate: "X-1" }, { run_open: false }), ["The result stands on the certificate."]);
});

test("each language has its words, and nothing sounds like a verdict", () => {
    const early = so_far_of({ figures: null });
    for (const language of languages)
        for (const run of [{ so_far: so_far_of() }, { so_far: early }, { certificate: "X-1" }, {}])
            for (const text of texts(run, {}, language)) assert.doesNotMatch(text, /[⟦{}]|conform|\bpass|\bfail/i, language);
    assert.equal(texts({ so_far: so_far_of() }, {}, "ru").at(-1), "Пока по ISO 230-2:2014: B_mean \u22122,60 мкм");
});
