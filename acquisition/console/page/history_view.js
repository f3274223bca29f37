// The screen History: a search, and a row for each stored run.

import { kept_focus, make, set_text } from "./dom.js";
import { row_of } from "./result_text.js";

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {import("./stored_runs.js").RunList} RunList */

export class HistoryView {
    /** @param {HTMLElement} search @param {HTMLElement} rows @param {(text: string) => void} find @param {(id: string) => void} open @param {() => void} more */
    constructor(search, rows, find, open, more) {
        this.rows = rows;
        this.open = open;
        this.shown = "";
        this.input = make("input");
        this.input.type = "search";
        this.input.autocomplete = "off";
        this.input.spellcheck = false;
        this.label = make("span", "unseen");
        this.find_button = button_that("submit", () => {});
        this.more_button = button_that("button", more);
        const form = make("form", "", [make("label", "", [this.label, this.input]), this.find_button]);
        form.setAttribute("role", "search");
        form.addEventListener("submit", (event) => {
            event.preventDefault();
            find(this.input.value);
            this.input.select(); // what a reader types next takes its place
        });
        search.append(form);
        this.list = make("ul");
        this.note = make("p", "note");
        this.note.setAttribute("role", "status");
        rows.append(this.list, this.note, this.more_button);
    }

    /** @param {RunList} list @param {Catalogue} words */
    paint(list, words) {
        const key = [list.version, words.tag, words.text("search_runs")].join("|");
        if (key === this.shown) return;
        this.shown = key;
        set_text(this.label, words.text("search_runs"));
        this.input.placeholder = words.text("search_runs");
        set_text(this.find_button, words.text("find"));
        set_text(this.more_button, words.text("show_more"));
        this.more_button.hidden = list.next === "" || list.state === "asking";
        set_text(this.note, note_of(list, words));
        const focus_again = kept_focus(this.list, (one) => one.getAttribute("data-id"));
        this.list.replaceChildren(...list.rows.map((run) => this.row(row_of(run, words))));
        focus_again();
    }

    row({ id, said, head, line }) {
        const mark = make("span", "outcome", [`${said.shape} ${said.word}`]);
        mark.dataset.verdict = said.verdict;
        const button = make("button", "", [make("span", "head", [head]), mark, make("span", "line", [line])]);
        button.type = "button";
        button.dataset.id = id;
        button.addEventListener("click", () => this.open(id));
        return make("li", "", [button]);
    }
}

/** What is said of the list as a whole; empty: its rows say it. @param {RunList} list @param {Catalogue} words */
export function note_of(list, words) {
    if (list.state === "asking") return words.text("order_waits");
    if (list.state === "failed") return list.sentence === "" ? words.text("no_answer") : list.sentence;
    const passed_over = list.passed_over > 0 ? words.text("passed_over", { count: list.passed_over }) : "";
    const none = list.state === "done" && list.rows.length === 0 ? words.text(list.text === "" ? "no_runs" : "nothing_found", { text: list.text }) : "";
    return [none, passed_over].filter((text) => text !== "").join(" ");
}

function button_that(type, act) {
    const button = make("button");
    button.type = type;
    button.addEventListener("click", act);
    return button;
}
