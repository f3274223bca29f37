import assert from "node:assert/strict";
import { test } from "node:test";
import { Catalogue, choose_language, languages, pseudo_table, pseudo_text } from "../../acquisition/console/page/catalogue.js";
import { sources, table_of, words_of } from "./page_under_test.mjs";

const fields_of = (text) => (text.match(/\{\w+\}/g) ?? []).sort();

test("every language has every key, and in each the same fields", () => {
    const english = table_of("en");
    for (const language of languages) {
        const table = table_of(language);
        assert.deepEqual(Object.keys(table).sort(), Object.keys(english).sort(), language);
        for (const [key, text] of Object.entries(table)) {
            assert.deepEqual(fields_of(text), fields_of(english[key]), `${language}: ${key}`);
            assert.notEqual(text.trim(), "", `${language}: ${key}`);
        }
    }
});

test("every key that a module names is in the catalogue", () => {
    const english = table_of("en");
    for (const [name, source] of Object.entries(sources()))
        for (const [, key] of source.matchAll(/\.text\("(\w+)"/g)) assert.ok(Object.hasOwn(english, key), `${name}: ${key}`);
});

test("no text of a module stands outside the catalogue: no markup is built from texts", () => {
    for (const [name, source] of Object.entries(sources()))
        assert.ok(!/innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\(|new Function/.test(source), name);
});

test("no module asks another host", () => {
    for (const [name, source] of Object.entries(sources()))
        assert.doesNotMatch(source, /https?:\/\//, name);
});

test("the pseudo language is longer by two fifths and keeps the fields", () => {
    const text = pseudo_text("{done} of {of} points");
    assert.deepEqual(fields_of(text), ["{done}", "{of}"]);
    assert.ok(pseudo_text("No verdict before the run ends.").length >= "No verdict before the run ends.".length * 1.4);
    assert.equal(pseudo_table(table_of("en"))._tag, "en");
});

test("a key that is missing is seen, and a field that is missing stays", () => {
    const words = new Catalogue({ a: "{x} and {y}" });
    assert.equal(words.text("b"), "⟦b⟧");
    assert.equal(words.text("constructor"), "⟦constructor⟧");
    assert.equal(words.text("a", { x: 1 }), "1 and {y}");
    assert.equal(words.text("a", { x: "$&", y: "{x}" }), "$& and {x}");
});

test("the language is what was chosen, else what the browser wishes, else English", () => {
    assert.equal(choose_language("ru", ["de"]), "ru");
    assert.equal(choose_language("pseudo", []), "pseudo");
    assert.equal(choose_language("xx", ["fr", "de-AT", "en"]), "de");
    assert.equal(choose_language(null, ["zh-Hant-TW"]), "zh");
    assert.equal(choose_language(null, []), "en");
});

test("ages are told in each language", () => {
    assert.equal(words_of("de").age({ key: "age_s", number: "3" }), "3 s");
    assert.equal(words_of("ru").age(null), "никогда");
});
