import assert from "node:assert/strict";
import { test } from "node:test";
import { note_of } from "../../acquisition/console/page/history_view.js";
import { RunList, ask_result, paper_path } from "../../acquisition/console/page/stored_runs.js";
import { words_of } from "./page_under_test.mjs";
import { result_with, station_that, stored_of } from "./stored_under_test.mjs";

const page_of = (ids, next = "", passed_over = 0) => [200, { runs: ids.map((id) => stored_of({ id })), next, passed_over }];

test("a search is sent as it was typed, and each row is kept", async () => {
    const { asked, fetcher } = station_that({ "/v1/runs": page_of(["a-1", "a-2"]) });
    const list = new RunList(fetcher);
    await list.search(" M-10442 & X ");
    assert.deepEqual(asked, ["/v1/runs?limit=20&text=M-10442%20%26%20X"]);
    assert.deepEqual([list.rows.map(({ id }) => id), list.state], [["a-1", "a-2"], "done"]);
});

test("a page without a row is followed by the next one until the list ends", async () => {
    const pages = [page_of([], "b"), page_of(["c"], "d"), page_of([])];
    const { asked, fetcher } = station_that({ "/v1/runs": () => pages.shift() });
    const list = new RunList(fetcher);
    await list.search("x");
    assert.deepEqual(asked.slice(1), ["/v1/runs?limit=20&before=b&text=x", "/v1/runs?limit=19&before=d&text=x"]);
    assert.deepEqual([list.rows.length, list.next], [1, ""]);
});

test("more rows follow the last one, and are asked for only where there are more", async () => {
    const ids = Array.from({ length: 20 }, (_, nth) => `r-${nth}`);
    const pages = [page_of(ids, "r-19"), page_of(["s"])];
    const { asked, fetcher } = station_that({ "/v1/runs": () => pages.shift() });
    const list = new RunList(fetcher);
    await list.search("");
    assert.equal(list.is_short(), true);
    await list.more();
    await list.more();
    assert.deepEqual([list.rows.length, asked.length, list.is_short()], [21, 2, false]);
});

test("a newer search ends an older one, whichever answer comes last", async () => {
    const waiting = [];
    const list = new RunList((path) => new Promise((resolve) => waiting.push({ path, resolve })));
    const [first, second] = [list.search("old"), list.search("new")];
    const answer = (id) => ({ ok: true, json: async () => page_of([id])[1] });
    waiting[1].resolve(answer("new-1"));
    waiting[0].resolve(answer("old-1"));
    await Promise.all([first, second]);
    assert.deepEqual(list.rows.map(({ id }) => id), ["new-1"]);
});

test("a refusal is told in the station's words, and silence as such", async () => {
    const words = words_of();
    const refusing = new RunList(station_that({ "/v1/runs": [400, { error: { sentence: "limit: is a whole number" } }] }).fetcher);
    await refusing.search("");
    assert.equal(note_of(refusing, words), "limit: is a whole number");
    const silent = new RunList(station_that({}).fetcher);
    await silent.search("");
    assert.equal(note_of(silent, words), "No answer came from the station.");
});

test("an empty list says whether nothing is stored or nothing was found, and what it does not list", async () => {
    const words = words_of();
    const list = new RunList(station_that({ "/v1/runs": page_of([], "", 2) }).fetcher);
    await list.search("");
    assert.equal(note_of(list, words), "No run is stored on this station yet. 2 files with other names are not listed.");
    await list.search("M-1");
    assert.ok(note_of(list, words).startsWith("Nothing was found for “M-1”."));
});

test("without a choice Result shows the newest run that is not going on", async () => {
    const rows = [200, { runs: [stored_of({ id: "now", status: "open" }), stored_of({ id: "last" })], next: "", passed_over: 0 }];
    const { asked, fetcher } = station_that({ "/v1/runs?": rows, "/v1/runs/last": [200, result_with({ id: "last" })] });
    const { found } = await ask_result("", fetcher);
    assert.equal(found.id, "last");
    assert.equal(asked.length, 2);
});

test("a run that is gone is told in the station's words, and an empty station as such", async () => {
    const gone = station_that({ "/v1/runs/x": [404, { error: { sentence: "no stored run is called x" } }] });
    assert.deepEqual(await ask_result("x", gone.fetcher), { found: null, sentence: "no stored run is called x", none: false });
    const empty = station_that({ "/v1/runs?": page_of([]) });
    assert.deepEqual(await ask_result("", empty.fetcher), { found: null, sentence: "", none: true });
});

test("no name becomes another path", () => {
    assert.equal(paper_path("../x", "a/b?c"), "/v1/runs/..%2Fx/a%2Fb%3Fc");
});
