import assert from "node:assert/strict";
import { test } from "node:test";
import { EventLink } from "../../acquisition/console/page/event_link.js";
import { EventText } from "../../acquisition/console/page/event_text.js";
import { LinkState } from "../../acquisition/console/page/link_state.js";

const stream = "retry: 1000\n\nevent: status\ndata: {\"a\":1}\n\nevent: points\nid: 1-2-3\ndata: {}\n\nevent: heartbeat\ndata: {}\n\n";

test("events come out the same wherever the text is cut", () => {
    const whole = new EventText().take(stream);
    assert.deepEqual(whole.map(({ event, id }) => [event, id]), [["status", ""], ["points", "1-2-3"], ["heartbeat", "1-2-3"]]);
    for (let cut = 0; cut <= stream.length; ++cut) {
        const text = new EventText();
        assert.deepEqual([...text.take(stream.slice(0, cut)), ...text.take(stream.slice(cut))], whole);
    }
});

test("comments, unknown fields and ends of lines of other systems do no harm", () => {
    const events = new EventText().take(": hello\r\nfoo: bar\r\nevent:status\r\ndata:a\r\ndata: b\r\n\r\n\r\n");
    assert.deepEqual(events, [{ event: "status", data: "a\nb", id: "" }]);
});

test("an event without an end is given up", () => {
    assert.throws(() => new EventText().take("data: " + "x".repeat(8 * 1024 * 1024 + 1)));
});

/** A station whose answers a test lists; the link ends when they are used up. */
function listened(answers, take = () => true) {
    const asked = [];
    let time = 0;
    const link = new LinkState(0);
    const events = new EventLink({
        link,
        now: () => time,
        take,
        fetcher: async (path, options) => {
            asked.push({ path, ...options.headers });
            const answer = answers[asked.length - 1];
            if (answer === undefined) throw new TypeError("no network");
            return answer;
        },
        later: (call) => call(),
    });
    return { events, link, asked, set_time: (at) => (time = at) };
}

test("a page that comes back names the last event it has whole", async () => {
    const torn = stream + "event: points\nid: 1-2-9\ndata: {";
    const { events, asked } = listened([new Response(torn), new Response("")]);
    await events.listen();
    await events.listen();
    assert.equal(asked[0]["Last-Event-ID"], undefined);
    assert.equal(asked[1]["Last-Event-ID"], "1-2-3");
});

test("where points are missing all are asked for anew", async () => {
    const { events, asked } = listened([new Response(stream), new Response("")], ({ event }) => event !== "points");
    await events.listen();
    await events.listen();
    assert.equal(asked[1]["Last-Event-ID"], undefined);
});

test("a refusal is told in the station's words, and tried again", async () => {
    const body = JSON.stringify({ error: { fault: "busy", sentence: "all places are taken" } });
    const { events, link } = listened([new Response(body, { status: 503 })]);
    await events.listen();
    assert.equal(link.refusal, "all places are taken");
    await events.listen(); // no network: no exception
    assert.equal(link.has_contact(0), false);
});

test("a connection on which nothing comes is ended", () => {
    const { events, link, set_time } = listened([]);
    events.abort = new AbortController();
    events.heard_here = true;
    link.heard(0);
    set_time(2000);
    events.watch();
    assert.equal(events.abort.signal.aborted, false);
    set_time(2001);
    events.watch();
    assert.equal(events.abort.signal.aborted, true);
});

/** A station whose connections stand until the page ends them. */
function held_open() {
    const asked = [];
    const link = new LinkState(0);
    const fetcher = (path, { signal }) => {
        asked.push(signal);
        return new Promise((_, reject) => signal.addEventListener("abort", () => reject(signal.reason)));
    };
    return { asked, events: new EventLink({ link, now: () => 0, take: () => true, fetcher, later: (call) => void call() }) };
}

const soon = () => new Promise((resolve) => setImmediate(resolve));

test("a page that nobody looks at holds no connection, and asks anew when it is looked at", async () => {
    const { asked, events } = held_open();
    events.run();
    events.rest();
    await soon();
    assert.deepEqual(asked.map(({ aborted }) => aborted), [true]);
    events.resume();
    await soon();
    assert.deepEqual(asked.map(({ aborted }) => aborted), [true, false]);
});

test("a page that was never looked at does not ask", async () => {
    const { asked, events } = held_open();
    events.rest();
    events.run();
    await soon();
    assert.equal(asked.length, 0);
    events.resume();
    await soon();
    assert.equal(asked.length, 1);
});

test("a page that is looked at again before its connection has ended asks anew", async () => {
    const { asked, events } = held_open();
    events.run();
    events.rest();
    events.resume();
    await soon();
    assert.deepEqual(asked.map(({ aborted }) => aborted), [true, false]);
});
