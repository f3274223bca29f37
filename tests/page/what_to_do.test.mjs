import assert from "node:assert/strict";
import { test } from "node:test";
import { buttons_of } from "../../acquisition/console/page/actions.js";
import { revision_of } from "../../acquisition/console/page/order_fields.js";
import { answer_text } from "../../acquisition/console/page/order_sheet.js";
import { lacks_rights, send_order } from "../../acquisition/console/page/orders.js";
import { task_head, task_line, task_lines, what_to_do } from "../../acquisition/console/page/what_to_do.js";
import { point_of, status_of, words_of } from "./page_under_test.mjs";

const trouble = (changed = {}) => ({
    id: "outbox", rank: "look", source: "outbox", seen: "2 results wait.", since_utc: "", next: "Start it.", command: "", undo: "", ...changed,
});

test("a station in order has nothing to do, and one of before sends no list", () => {
    assert.deepEqual(what_to_do(status_of({ to_do: [] })), []);
    assert.deepEqual(what_to_do(status_of({ to_do: undefined })), []);
});

test("the list stands in the station's order", () => {
    const list = [trouble({ id: "b", rank: "note" }), trouble({ id: "a", rank: "stop" })];
    assert.deepEqual(what_to_do(status_of({ to_do: list })), list);
});

test("each entry says its rank in shape and word, what is seen, since when, and what to do next", () => {
    const line = task_line(trouble({ rank: "stop", since_utc: "2020-03-04T05:06:07Z" }), words_of());
    assert.match(line, /^✕ Stop: 2 results wait\. \(since 2020-03-0\d \d\d:\d\d:07\) Start it\.$/);
    assert.equal(task_line(trouble(), words_of("de")), "▲ Nachsehen: 2 results wait. Start it.");
});

test("a time that is none stands as the station says it", () => {
    assert.match(task_head(trouble({ since_utc: "soon" }), words_of()), /\(since soon\)$/);
});

test("the undo of an action is named undo, and a command that the action names is not said twice", () => {
    const lines = task_lines(trouble({ command: "sudo start", undo: "sudo stop" }), words_of());
    assert.deepEqual(lines, [["→ Start it.", "action"], ["sudo start", "command"], ["undo: sudo stop", "command"]]);
    const named = task_lines(trouble({ next: "'axiscal arm' opens a run", command: "axiscal arm" }), words_of());
    assert.deepEqual(named, [["→ 'axiscal arm' opens a run", "action"]]);
});

const ready = () => ({ contact: true, asleep: false, refusal: "", status: status_of(), picked: false });

test("without contact every order is off and says why", () => {
    for (const now of [{ ...ready(), contact: false }, { ...ready(), status: null }])
        for (const button of Object.values(buttons_of(now))) assert.deepEqual(button, { on: false, reason: "off_no_contact", sentence: "" });
});

test("an open run can be aborted and not armed, a closed one the other way round", () => {
    const open = buttons_of(ready());
    assert.equal(open.abort.on, true);
    assert.equal(open.arm.reason, "off_run_open");
    const closed = buttons_of({ ...ready(), status: status_of({ run_open: false }) });
    assert.equal(closed.arm.on, true);
    assert.equal(closed.abort.reason, "off_no_open_run");
});

test("a drift test can be aborted, and nothing armed beside it", () => {
    const drifts = buttons_of({ ...ready(), status: status_of({ run_open: false, drift: { state: "recording" } }) });
    assert.equal(drifts.abort.on, true);
    assert.equal(drifts.arm.on, false);
});

test("a point is picked before it is taken again; also of a closed run, which the station may open", () => {
    assert.equal(buttons_of(ready()).retake.reason, "off_pick_point");
    const closed = { ...ready(), picked: true, status: status_of({ run_open: false }) };
    assert.equal(buttons_of(closed).retake.on, true);
    assert.equal(buttons_of({ ...closed, status: status_of({ run: null, run_open: false }) }).exclude.reason, "off_no_run");
});

test("a browser that may only look says so in the station's words", () => {
    const { abort } = buttons_of({ ...ready(), refusal: "Over TCP everybody only reads." });
    assert.deepEqual(abort, { on: false, reason: "off_rights", sentence: "Over TCP everybody only reads." });
});

test("an asleep page has its orders off", () => {
    assert.equal(buttons_of({ ...ready(), asleep: true }).abort.reason, "off_asleep");
});

test("an order for a point names that point whole", () => {
    assert.deepEqual(revision_of(point_of(5, { approach: 1, direction: "negative" }), "coolant", ""), {
        target: 5, direction: "negative", cycle: 1, reason: "coolant",
    });
    assert.equal(revision_of(point_of(5), "coolant", "Jo").by, "Jo");
});

test("a refusal is shown as the station says it, which names the checks that do not hold", async () => {
    const body = { error: { fault: "refused", sentence: "soak: Wait." }, checks: [{ name: "soak", passed: false, verdict: "Wait.", override: "" }] };
    const answer = await send_order("/v1/run", {}, async () => new Response(JSON.stringify(body), { status: 409 }));
    assert.equal(answer.done, false);
    assert.equal(answer_text(answer, "arm", words_of("en")), "soak: Wait.");
    assert.equal(lacks_rights(answer), false);
});

test("an order without an answer is neither done nor refused", async () => {
    const answer = await send_order("/v1/run/abort", {}, async () => Promise.reject(new TypeError("gone")));
    assert.deepEqual(answer, { done: false, status: 0, sentence: "", body: null });
});

test("missing rights are told from other refusals", async () => {
    const body = JSON.stringify({ error: { fault: "refused", sentence: "Over TCP everybody only reads." } });
    const answer = await send_order("/v1/run/trigger", null, async () => new Response(body, { status: 401 }));
    assert.equal(lacks_rights(answer), true);
    assert.equal(answer.sentence, "Over TCP everybody only reads.");
});

test("an order on a dead connection ends with the word that nobody knows whether it was carried out", async (t) => {
    const timer = globalThis.setTimeout;
    t.after(() => (globalThis.setTimeout = timer));
    const waited = [];
    globalThis.setTimeout = (call, ms) => (waited.push(ms), timer(call, 0));
    const silent = (_, { signal }) => new Promise((_, reject) => signal.addEventListener("abort", () => reject(signal.reason)));
    const answer = await send_order("/v1/run/abort", null, silent);
    assert.deepEqual([answer.done, answer.status, waited], [false, 0, [30000]]); // docs/page.md
    assert.equal(answer_text(answer, "abort", words_of("en")), words_of("en").text("order_unknown"));
});
