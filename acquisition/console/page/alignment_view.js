// In Set-up: the alignment of the beam, and the orders to begin it, to keep it and to drop it.

import { alignment_lines, alignment_off } from "./alignment_text.js";
import { keep_children, make, set_attribute, set_text } from "./dom.js";
import { asked } from "./orders.js";

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {import("./alignment_text.js").Alignment} Alignment */
/** @typedef {(path: string, body: object) => Promise<import("./orders.js").Answer>} Send */

const path = "/v1/alignment";
const ask_running_ms = 250;
const ask_idle_ms = 2000;
const patience_ms = 4000; // a connection that is dead must not hold up the next question
const stale_ms = 2000; // what moves is struck through then, as each reading is
const actions = Object.freeze(["begin", "keep", "drop"]);

export class AlignmentView {
    /** @param {HTMLElement} place @param {Send} send @param {typeof fetch} fetcher */
    constructor(place, send, fetcher) {
        this.send = send;
        this.fetcher = fetcher;
        /** @type {Alignment | null} */
        this.view = null;
        this.asked_at = -Infinity;
        this.asking = false;
        this.heard_at = -Infinity;
        this.giving = false; // an order waits for its answer
        this.answer = "";
        this.unknown = ""; // what is said where no answer came
        this.title = make("h2");
        this.lines = make("div", "lines");
        this.said = make("p", "note");
        this.said.setAttribute("role", "status");
        this.buttons = actions.map((action) => this.button_for(action));
        place.append(this.title, make("div", "actions", this.buttons), this.lines, this.said); // lines come and go: the buttons stay in place
    }

    button_for(action) {
        const button = make("button");
        button.type = "button";
        button.dataset.align = action;
        button.addEventListener("click", () => button.getAttribute("aria-disabled") === null && this.give(action));
        return button;
    }

    /** Once, however often it is touched before the station has answered and the buttons are painted. */
    async give(action) {
        const running = this.view?.running === true;
        if (this.giving || (action === "begin") === running) return;
        this.giving = true;
        const { done, sentence, body } = await this.send(path, { action }).finally(() => (this.giving = false));
        if (done) this.view = body;
        this.answer = done ? "" : sentence || this.unknown;
    }

    /** Asked while somebody looks. @param {number} at */
    async ask(at) {
        if (this.asking || at - this.asked_at < (this.view?.running ? ask_running_ms : ask_idle_ms)) return;
        this.asked_at = at;
        this.asking = true;
        try {
            const { response, body } = await asked(path, this.fetcher, {}, patience_ms);
            if (response.ok) {
                this.view = body;
                this.heard_at = at;
            }
        } catch {
            // The strip tells of a link that is lost.
        } finally {
            this.asking = false;
        }
    }

    /** @param {{contact: boolean, refusal: string, run_open: boolean, at: number}} now @param {Catalogue} words */
    paint(now, words) {
        if (now.contact) this.ask(now.at);
        const off = alignment_off(now, words);
        set_text(this.title, words.text("alignment"));
        this.unknown = words.text("order_unknown");
        const lines = alignment_lines(this.view, words);
        keep_children(this.lines, lines.length, () => make("div")).forEach((line, nth) => set_text(line, lines[nth]));
        const running = this.view?.running === true;
        set_attribute(this.lines, "data-mark", running && now.at - this.heard_at > stale_ms ? "stale" : null);
        this.buttons.forEach((button, nth) => {
            const on = off === "" && (actions[nth] === "begin") !== running;
            set_attribute(button, "aria-disabled", on ? null : "true");
            set_text(button, words.text(`align_${actions[nth]}`));
        });
        set_text(this.said, off || this.answer);
    }
}
