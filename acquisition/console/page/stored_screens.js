// Result and History together: what is asked of the station, when, and which of its answers is shown.

import { Barcode } from "./barcode.js";
import { by_id } from "./dom.js";
import { HistoryView } from "./history_view.js";
import { ResultView } from "./result_view.js";
import { RunList, ask_result } from "./stored_runs.js";

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */

export class StoredScreens {
    /** @param {typeof fetch} fetcher @param {(screen: string) => void} go_to */
    constructor(fetcher, go_to) {
        this.fetcher = fetcher;
        this.go_to = go_to;
        this.list = new RunList(fetcher);
        this.barcode = new Barcode();
        this.wanted = ""; // id of the run that Result shows; empty: the newest
        /** @type {import("./stored_runs.js").StoredResult | null} */
        this.result = null;
        this.is_new = false; // the view has not taken it yet
        this.answer = { sentence: "", none: false, asked: false };
        this.question = 0;
        this.seen = ""; // of the status: its change makes another certificate
        this.result_view = new ResultView({
            head: by_id("result_head"), said: by_id("result_said"), plot: by_id("result_plot"), table: by_id("result_table"), papers: by_id("result_papers"),
        });
        this.history_view = new HistoryView(by_id("history_search"), by_id("history_rows"),
            (text) => void this.list.search(text), (id) => this.open(id), () => void this.list.more());
    }

    /** A row of History was chosen. @param {string} id */
    open(id) {
        this.wanted = id;
        this.result = null;
        this.answer = { sentence: "", none: false, asked: false };
        this.go_to("result");
    }

    /** Somebody goes there: what is shown is what is there now. @param {string} screen  before: the one that was left @param {string} before */
    enter(screen, before) {
        if (screen === "result") {
            if (before !== "history" && before !== "result") this.wanted = ""; // by the button: the newest
            void this.ask();
        }
        if (screen === "history") void this.list.search(this.list.text);
    }

    async ask() {
        const question = ++this.question;
        const { found, sentence, none } = await ask_result(this.wanted, this.fetcher);
        if (question !== this.question) return;
        const same = JSON.stringify(found) === JSON.stringify(this.result);
        this.answer = { sentence, none, asked: true };
        if (found === null && sentence === "" && !none) return; // no answer came: what is shown stays, the strip tells of it
        this.result = found;
        if (found !== null && !same) this.is_new = true; // else an open table stays open
    }

    /** Asks anew when a run has begun, ended or got its certificate. @param {string} screen @param {any} status @param {boolean} contact */
    hear(screen, status, contact) {
        const seen = JSON.stringify([contact, status.run?.id, status.run?.state, status.run?.certificate, status.drift?.id, status.drift?.certificate, status.outbox?.waiting]);
        if (seen === this.seen) return;
        const first = this.seen === "";
        this.seen = seen;
        if (first || !contact) return;
        if (screen === "result") void this.ask();
        if (screen === "history" && this.list.is_short()) void this.list.search(this.list.text);
    }

    /** Never while a finger is down. @param {string} screen @param {Catalogue} words */
    paint(screen, words) {
        if (screen === "history") return this.history_view.paint(this.list, words);
        const { is_new } = this;
        this.is_new = false;
        if (is_new && this.result !== null) this.result_view.take(this.result);
        const { sentence, none, asked } = this.answer;
        const told = sentence !== "" ? sentence : words.text(none ? "no_runs" : asked ? "no_answer" : "order_waits");
        this.result_view.paint(this.result, told, words);
    }

    /**
     * A key on History outside of its field. @param {string} key @param {number} at  ms
     * @returns {boolean} it belongs to a barcode: nothing else may come of it
     */
    take_key(key, at) {
        const fast = this.barcode.is_fast(at);
        const read = this.barcode.take(key, at);
        if (read === null) return fast && key !== "Enter";
        this.history_view.input.value = read;
        void this.list.search(read);
        return true;
    }
}
