// The stored runs, as the station lists them (docs/api.md, Stored runs). No DOM.

import { asked } from "./orders.js";

/** @typedef {{parameter: string, value: number | null, U: number | null, limit: number | null, verdict: string, reason: string}} Figure */

/**
 * @typedef {object} StoredRun
 * @property {string} id
 * @property {"open" | "complete" | "incomplete" | "unreadable"} status
 * @property {string} sentence  why it is incomplete, or cannot be read
 * @property {string} kind @property {string} axis @property {string} machine @property {string} machine_serial
 * @property {string} machine_state  "as found"
 * @property {string} started_utc
 * @property {number} points @property {number} planned @property {number} left_out
 * @property {string} verdict  pass, fail, not_provable, not_evaluated; empty: there is none
 * @property {string} limits @property {string} rule @property {string} standard @property {string} unit
 * @property {Figure[]} figures
 * @property {"none" | "waiting" | "published"} paper @property {string} paper_sentence @property {string} number
 */

/** @typedef {StoredRun & {papers: {name: string, bytes: number}[], certificate: any}} StoredResult */

const rows_wanted = 20;
const most_questions = 25; // of one search: the station looks into some hundred files for each

/**
 * @template Body @param {string} path @param {typeof fetch} fetcher
 * @returns {Promise<{body: Body | null, sentence: string}>} sentence: the station's own; empty with no body: no answer came
 */
async function found(path, fetcher) {
    try {
        const { response, body } = await asked(path, fetcher);
        if (response.ok) return { body, sentence: "" };
        return { body: null, sentence: body.error?.sentence ?? "" };
    } catch {
        return { body: null, sentence: "" };
    }
}

/** @param {{text: string, before: string, limit: number}} wanted */
function list_path({ text, before, limit }) {
    const fields = [`limit=${limit}`, ...(before === "" ? [] : [`before=${encodeURIComponent(before)}`])];
    return `/v1/runs?${[...fields, ...(text === "" ? [] : [`text=${encodeURIComponent(text)}`])].join("&")}`;
}

/** The list that is shown, with what was searched for. A newer search ends an older one. */
export class RunList {
    /** @param {typeof fetch} fetcher */
    constructor(fetcher) {
        this.fetcher = fetcher;
        this.text = "";
        /** @type {StoredRun[]} */
        this.rows = [];
        this.next = ""; // more are there
        this.passed_over = 0;
        this.state = /** @type {"new" | "asking" | "done" | "failed"} */ ("new");
        this.sentence = "";
        this.version = 0; // another one with each change
        this.search_number = 0;
    }

    /** From the newest on. @param {string} text */
    async search(text) {
        const wanted = text.trim();
        if (wanted !== this.text) this.rows = []; // asked anew, they stay until the answer has come
        this.text = wanted;
        this.next = "";
        await this.fill([]);
    }

    /** Nobody asked for more than the first rows: to ask anew moves nothing away. */
    is_short() {
        return this.rows.length <= rows_wanted;
    }

    /** What follows the last row. */
    async more() {
        if (this.next !== "" && this.state !== "asking") await this.fill(this.rows);
    }

    /** @param {StoredRun[]} before  rows that stay before what comes */
    async fill(before) {
        const number = ++this.search_number;
        let rows = before;
        const wanted = rows.length + rows_wanted;
        this.change("asking", "");
        for (let question = 0; question < most_questions; ++question) {
            const path = list_path({ text: this.text, before: this.next, limit: wanted - rows.length });
            const { body, sentence } = await found(path, this.fetcher);
            if (number !== this.search_number) return;
            if (body === null) return this.change("failed", sentence);
            this.rows = rows = rows.concat(body.runs);
            this.next = body.next;
            this.passed_over = body.passed_over;
            if (this.next === "" || rows.length >= wanted) break;
            this.change("asking", "");
        }
        this.change("done", "");
    }

    change(state, sentence) {
        this.state = state;
        this.sentence = sentence;
        this.version += 1;
    }
}

/**
 * One run with its papers.
 * @param {string} id  empty: the newest that is not going on
 * @param {typeof fetch} fetcher
 * @returns {Promise<{found: StoredResult | null, sentence: string, none: boolean}>} none: nothing is stored
 */
export async function ask_result(id, fetcher) {
    const wanted = id === "" ? await newest_id(fetcher) : { id, sentence: "", none: false };
    if (wanted.id === "") return { found: null, sentence: wanted.sentence, none: wanted.none };
    const { body, sentence } = await found(`/v1/runs/${encodeURIComponent(wanted.id)}`, fetcher);
    return { found: body, sentence, none: false };
}

/** @param {typeof fetch} fetcher */
async function newest_id(fetcher) {
    const { body, sentence } = await found(list_path({ text: "", before: "", limit: 5 }), fetcher);
    if (body === null) return { id: "", sentence, none: false };
    const closed = body.runs.find(({ status }) => status !== "open") ?? body.runs[0];
    return { id: closed?.id ?? "", sentence: "", none: closed === undefined };
}

/** @param {string} id @param {string} name */
export function paper_path(id, name) {
    return `/v1/runs/${encodeURIComponent(id)}/${encodeURIComponent(name)}`;
}
