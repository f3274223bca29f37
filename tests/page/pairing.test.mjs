import assert from "node:assert/strict";
import { test } from "node:test";
import { buttons_of } from "../../acquisition/console/page/actions.js";
import { delete_order } from "../../acquisition/console/page/orders.js";
import { ask_session, not_asked, refusal_of } from "../../acquisition/console/page/pairing.js";
import { status_of } from "./page_under_test.mjs";

const answers = (body, status = 200) => async () => new Response(JSON.stringify(body), { status });
const how = "Type 'axiscal pair' at the station and enter the code here.";

test("a browser that is not paired has its orders off and says how it is paired", async () => {
    const session = await ask_session(answers({ paired: false, how }));
    assert.equal(refusal_of(session), how);
    const { arm } = buttons_of({ contact: true, asleep: false, refusal: refusal_of(session), status: status_of(), picked: false });
    assert.deepEqual(arm, { on: false, reason: "off_rights", sentence: how });
});

test("a paired one is told by what name its orders go", async () => {
    const session = await ask_session(answers({ paired: true, name: "tablet 2", until_utc: "2026-12-01T00:00:00Z" }));
    assert.equal(refusal_of(session), "");
    assert.equal(session.name, "tablet 2");
});

test("before the station was asked, and where it does not answer, nothing is claimed", async () => {
    assert.equal(refusal_of(not_asked()), "");
    assert.equal(await ask_session(async () => Promise.reject(new TypeError("gone"))), null);
    assert.equal(await ask_session(answers({}, 404)), null);
});

test("what is no clear yes is no right", async () => {
    assert.equal((await ask_session(answers({ paired: "yes" }))).paired, false);
});

test("a session is ended by DELETE", async () => {
    const asked = [];
    const answer = await delete_order("/v1/session", async (path, options) => {
        asked.push([path, options.method]);
        return new Response(JSON.stringify({ paired: false, how }));
    });
    assert.deepEqual(asked, [["/v1/session", "DELETE"]]);
    assert.equal(answer.done, true);
});
