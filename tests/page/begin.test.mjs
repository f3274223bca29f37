import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import vm from "node:vm";
import { folder } from "./page_under_test.mjs";

const source = readFileSync(join(folder, "begin.js"), "utf8");
const html = readFileSync(join(folder, "index.html"), "utf8");
const needed = source.match(/needed = \[([^\]]+)\]/)[1].match(/[\w.]+/g);

class Place {
    constructor(id) {
        this.id = id;
        this.hidden = id !== "begin";
        this.textContent = "";
    }
    setAttribute(name) {
        this.hidden ||= name === "hidden";
    }
    removeAttribute(name) {
        this.hidden &&= name !== "hidden";
    }
}

/** A browser as far as the script asks it; without what `lacks` names. */
function begun({ lacks = [], modules = true } = {}) {
    const places = Object.fromEntries(["begin", "begin_wait", "begin_old", "begin_lacks"].map((id) => [id, new Place(id)]));
    const heard = {};
    const started = [];
    const document = {
        getElementById: (id) => places[id],
        createElement: () => (modules ? { noModule: false } : {}),
        body: { appendChild: (script) => started.push(script.src) },
    };
    const window = { addEventListener: (name, call) => (heard[name] = call) };
    for (const path of needed.filter((one) => !lacks.includes(one))) {
        const names = path.split(".");
        let within = window;
        for (const name of names) within = within[name] ??= {};
    }
    vm.runInNewContext(source, { window, document, SyntaxError });
    return { places, heard, started, shown: Object.values(places).filter(({ hidden }) => !hidden).map(({ id }) => id) };
}

test("a browser that has everything is told to wait, and the page is started", () => {
    const { shown, started } = begun();
    assert.deepEqual(started, ["/page/libraries/uplot.js", "/page/main.js"]); // in this order
    assert.ok(shown.includes("begin_wait") && !shown.includes("begin_old"));
});

test("a browser without one thing that the page needs says so, names it, and starts nothing", () => {
    for (const one of needed) {
        const { places, shown, started } = begun({ lacks: [one] });
        assert.equal(places.begin_lacks.textContent, one);
        assert.ok(shown.includes("begin_old") && !shown.includes("begin_wait"), one);
        assert.deepEqual(started, []);
    }
    assert.equal(begun({ modules: false }).places.begin_lacks.textContent, "modules");
});

test("a grammar that the browser does not know is age, any other error is none", () => {
    const { places, heard } = begun();
    heard.error({ error: new TypeError("x") });
    assert.equal(places.begin_old.hidden, true);
    heard.error({ error: new SyntaxError("Unexpected token") });
    assert.equal(places.begin_old.hidden, false);
    assert.equal(places.begin_wait.hidden, true);
    assert.match(places.begin_lacks.textContent, /Unexpected token/);
});

test("an error of the running page is not told as age", () => {
    const { places, heard } = begun();
    places.begin.hidden = true;
    heard.error({ error: new SyntaxError("of some JSON") });
    assert.equal(places.begin_old.hidden, true);
});

test("the first script has the grammar of old browsers, and no other script stands in the page", () => {
    const code = source.replace(/\/\*\*.*?\*\/|\/\/.*/g, "");
    for (const newer of [/=>/, /`/, /(?<!\.)\b(?:const|let|class|async|await|import|of)\b/, /\?\?|\?\./, /\.\.\./])
        assert.doesNotMatch(code, newer);
    assert.deepEqual([...html.matchAll(/<script[^>]*>/g)].map(([tag]) => tag), ['<script src="/page/begin.js">']);
});

test("what is said before the page starts is said in each language", () => {
    const parts = [...html.matchAll(/<(?:noscript|div id="begin_(?:wait|old)" hidden)>(.*?)<\/(?:noscript|div)>/gs)];
    assert.equal(parts.length, 3);
    for (const [, part] of parts)
        for (const tag of ["en", "de", "ru", "zh-Hans"]) assert.ok(part.includes(`<p lang="${tag}">`), `${tag}: ${part}`);
});
