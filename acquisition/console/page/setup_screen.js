// The screen Set-up: devices, the beam with its tone, and what arming would meet now.

import { AlignmentView } from "./alignment_view.js";
import { by_id, keep_children, make, set_attribute, set_text } from "./dom.js";
import { shapes } from "./freshness.js";
import { beam_shown, checks_shown, devices_shown, strength_channel, tone_word } from "./setup_text.js";
import { Tone } from "./tone.js";

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {import("./setup_text.js").Row} Row */

export class SetupScreen {
    /** @param {() => void} judge_again  somebody wants the checks judged now @param {import("./alignment_view.js").Send} send  an order */
    constructor(judge_again, send) {
        this.tone = new Tone(() => new AudioContext());
        this.told = false; // the laser tells a strength
        this.may_judge = false;
        this.reading = make("div", "reads", value_parts([make("span", "mark")]));
        this.strength = make("div", "strength", value_parts([]));
        this.word = make("div", "mark");
        this.fill = make("div", "fill");
        this.limit = make("div", "limit");
        this.meter = make_meter([this.fill, this.limit]);
        this.signal = make("div", "signal", [this.strength, this.word, this.meter]);
        this.button = button_with("tone", () => this.toggle(), [make("span", "name"), make("span", "why")]);
        by_id("setup_beam").append(this.reading, this.signal, this.button);
        this.devices = list_in(by_id("setup_devices"));
        const alignment = make("div", "alignment");
        by_id("setup_checks").append(alignment);
        this.alignment = new AlignmentView(alignment, send, (path, options) => fetch(path, options));
        this.checks = list_in(by_id("setup_checks"));
        this.note = make("p", "note");
        this.checks.title.after(this.note);
        this.again = button_with("again", () => this.may_judge && judge_again(), []);
        by_id("setup_checks").append(this.again);
    }

    toggle() {
        if (this.tone.is_on()) this.tone.stop();
        else if (this.told) this.tone.start();
        this.paint_pressed();
    }

    paint_pressed() {
        set_attribute(this.button, "aria-pressed", String(this.tone.is_on()));
    }

    /** The screen was left, or is out of sight: only a touch makes it sound again. */
    leave() {
        this.tone.stop();
        this.paint_pressed();
        set_attribute(this.button, "data-hz", null);
    }

    /**
     * @param {any} status @param {import("./freshness.js").KeptValues} kept @param {import("./freshness.js").Heard} heard
     * @param {{judged: import("./setup_text.js").Judged | null, at: number, pressed: boolean, refusal: string}} now  pressed: nothing may move;
     *   refusal: why this browser may not order
     * @param {Catalogue} words
     */
    paint(status, kept, heard, now, words) {
        this.told = strength_channel(status) !== null;
        if (!this.told && this.tone.is_on()) this.leave();
        const beam = beam_shown(status, kept, heard, words);
        this.paint_beam(beam, words);
        if (now.pressed) return;
        this.reading.hidden = beam.reading === null;
        this.alignment.paint({ contact: heard.contact, refusal: now.refusal, run_open: status.run_open, at: now.at }, words);
        this.devices.paint(words.text("devices"), devices_shown(status, heard, words), words.text("no_devices"));
        const checks = checks_shown(now.judged, status.run_open, { contact: heard.contact, at: now.at }, words);
        this.checks.paint(words.text("checks"), checks.rows, "");
        set_text(this.note, checks.note);
        this.may_judge = heard.contact && !status.run_open;
        set_attribute(this.again, "aria-disabled", this.may_judge ? null : "true");
        const why = words.text(heard.contact ? "off_run_open" : "off_no_contact");
        set_text(this.again, this.may_judge ? words.text("checks_again") : `${words.text("checks_again")}: ${why}`);
    }

    /** @param {ReturnType<typeof beam_shown>} beam @param {Catalogue} words */
    paint_beam(beam, words) {
        const { reading, strength, bar, limit, sounds } = beam;
        this.reading.style.visibility = reading === null ? "hidden" : ""; // its room goes once no finger is down
        if (reading !== null) {
            paint_value(this.reading, reading, reading.mark);
            set_text(this.reading.children[3], `${shapes[reading.mark]} ${reading.word} · ${reading.age}`);
        }
        paint_value(this.strength, strength, strength.mark);
        set_attribute(this.signal, "data-mark", beam.weak ? "warn" : strength.mark);
        const shape = beam.weak ? "▲" : shapes[strength.mark];
        set_text(this.word, [`${shape} ${strength.word}`, strength.age].filter(Boolean).join(" · "));
        this.paint_meter(bar, limit, strength, words);
        this.paint_tone(sounds, words);
    }

    paint_meter(bar, limit, strength, words) {
        set_attribute(this.meter, "aria-label", words.text("strength"));
        set_attribute(this.meter, "aria-valuenow", bar === null ? "0" : bar.toFixed(0));
        set_attribute(this.meter, "aria-valuetext", `${strength.text} ${strength.unit} ${strength.word}`.trim());
        const part = bar === null ? 0 : Math.min(1, Math.max(0, bar / 100));
        this.fill.style.transform = `scaleX(${part})`;
        this.limit.hidden = limit === null;
        this.limit.style.left = `${limit ?? 0}%`;
    }

    paint_tone(sounds, words) {
        const pitch = this.tone.follow(sounds);
        this.paint_pressed();
        set_attribute(this.button, "data-hz", pitch === null ? null : pitch.toFixed(0));
        set_attribute(this.button, "aria-disabled", this.told ? null : "true");
        const [name, why] = this.button.children;
        set_text(name, words.text("tone"));
        set_text(why, tone_word({ on: this.tone.is_on(), failed: this.tone.failed }, sounds, this.told, words));
    }
}

/** Label, number and unit, and what else. @param {Node[]} more */
const value_parts = (more) => [make("span", "label"), " ", make("span", "number"), " ", make("span", "unit"), " ", ...more];

/** @param {Element} element @param {import("./status_view.js").Shown} shown @param {string} mark */
function paint_value(element, shown, mark) {
    set_attribute(element, "data-mark", mark);
    [shown.label, shown.text, shown.unit].forEach((text, nth) => set_text(element.children[nth], text));
}

/** @param {Node[]} inside */
function make_meter(inside) {
    const meter = make("div", "meter", inside);
    for (const [name, value] of [["role", "meter"], ["aria-valuemin", "0"], ["aria-valuemax", "100"]]) meter.setAttribute(name, value);
    return meter;
}

/** @param {string} class_name @param {() => void} act @param {Node[]} inside */
function button_with(class_name, act, inside) {
    const button = make("button", class_name, inside);
    button.type = "button";
    button.addEventListener("click", act);
    return button;
}

/** A heading and rows; those that stay are kept, so that reading and scrolling are not disturbed. @param {HTMLElement} place */
function list_in(place) {
    const title = make("h2");
    const list = make("ul", "rows");
    place.append(title, list);
    /** @param {string} text @param {Row[]} rows @param {string} none */
    const paint = (text, rows, none) => {
        set_text(title, text);
        const shown = rows.length === 0 && none !== "" ? [{ mark: "none", shape: shapes.none, head: none, word: "", lines: [] }] : rows;
        keep_children(list, shown.length, make_row).forEach((element, nth) => paint_row(element, shown[nth]));
    };
    return { title, paint };
}

const make_row = () => make("li", "", [make("div", "head", [make("span", "name"), " ", make("span", "mark")])]);

/** @param {Element} element @param {Row} row */
function paint_row(element, row) {
    set_attribute(element, "data-mark", row.mark);
    set_attribute(element, "data-name", row.head);
    const [name, mark] = element.children[0].children;
    set_text(name, row.head);
    set_text(mark, `${row.shape} ${row.word}`.trim());
    while (element.childElementCount - 1 > row.lines.length) element.lastElementChild?.remove();
    while (element.childElementCount - 1 < row.lines.length) element.append(make("div", "line"));
    row.lines.forEach((line, nth) => set_text(element.children[nth + 1], line));
}
