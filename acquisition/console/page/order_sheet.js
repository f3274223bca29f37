// The sheet on which an order is written. It asks the station and shows what that says; it judges no field itself.

import { make, set_text } from "./dom.js";
import { number_text, typed_number } from "./number_text.js";

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {{name: string, label: string, kind: "text" | "number" | "code" | "choice", value?: string, decimals?: number, choices?: [string, string][]}} Field
 *   decimals: of a number that is shown as it was understood; choices: value, text */

/** The fields of an order, its two buttons, and what the station said. */
class OrderForm {
    /** @param {string} title @param {Field[]} fields @param {Catalogue} words @param {(answer: import("./orders.js").Answer) => Field[]} further */
    constructor(title, fields, words, further) {
        this.title = title;
        this.words = words;
        this.further = further;
        this.inputs = fields.map((field) => input_of(field, words));
        /** @type {Set<ReturnType<typeof input_of>>} */
        this.asked_later = new Set(); // by a refusal
        this.answer = make("p", "answer");
        this.answer.setAttribute("role", "alert");
        this.sending = button_of("submit", title);
        this.closing = button_of("button", words.text("close"));
        this.element = make("form", "", [...this.inputs.map(({ label }) => label), this.sending, this.closing, this.answer]);
        this.element.noValidate = true;
        this.element.setAttribute("aria-label", title);
    }

    waits() {
        return this.sending.disabled;
    }

    /** @param {(values: Record<string, string | number>) => Promise<import("./orders.js").Answer>} send */
    async sent_by(send) {
        this.sending.disabled = true;
        set_text(this.answer, this.words.text("order_waits"));
        const got = await send(Object.fromEntries(this.inputs.map(({ name, read }) => [name, read()])));
        this.sending.disabled = false;
        set_text(this.answer, answer_text(got, this.title, this.words));
        this.answer.scrollIntoView({ block: "nearest" });
        if (!got.done && got.body?.checks !== undefined) this.ask_further(this.further(got)); // it was judged
        return got;
    }

    /** What stands there stays, but for an empty field that nothing asks for any more. @param {Field[]} fields */
    ask_further(fields) {
        const wanted = (name) => fields.some((field) => field.name === name);
        for (const one of [...this.asked_later].filter(({ name, read }) => !wanted(name) && read() === "")) {
            one.label.remove();
            this.asked_later.delete(one);
            this.inputs.splice(this.inputs.indexOf(one), 1);
        }
        for (const field of fields.filter(({ name }) => !this.inputs.some((one) => one.name === name))) {
            const input = input_of(field, this.words);
            this.inputs.push(input);
            this.asked_later.add(input);
            this.sending.before(input.label);
        }
        if (!this.element.contains(document.activeElement)) this.sending.focus();
    }
}

export class OrderSheet {
    /** @param {HTMLElement} place @param {(text: string) => void} late  told what the station answered to a sheet that was closed meanwhile */
    constructor(place, late) {
        this.place = place;
        this.late = late;
        this.opener = null;
    }

    is_open() {
        return !this.place.hidden;
    }

    /**
     * @param {string} title
     * @param {Field[]} fields
     * @param {(values: Record<string, string | number>) => Promise<import("./orders.js").Answer>} send
     * @param {Catalogue} words
     * @param {(answer: import("./orders.js").Answer) => Field[]} further  fields that a refusal asks for; those that stand there stay
     */
    open(title, fields, send, words, further = () => []) {
        this.opener = document.activeElement;
        const form = new OrderForm(title, fields, words, further);
        form.element.addEventListener("submit", async (event) => {
            event.preventDefault();
            if (form.waits()) return; // one order at a time
            const got = await form.sent_by(send);
            if (!form.element.isConnected) this.late(answer_text(got, title, words));
            else if (got.done) this.close();
        });
        form.closing.addEventListener("click", () => this.close());
        form.element.addEventListener("keydown", (event) => {
            if (event.key === "Escape") this.close();
        });
        this.place.replaceChildren(make("h2", "", [title]), form.element);
        this.place.hidden = false;
        this.cover(true);
        (form.inputs[0]?.input ?? form.sending).focus();
    }

    /** What lies below the sheet is out of reach of keys, too. @param {boolean} covered */
    cover(covered) {
        for (const one of this.place.parentElement?.querySelectorAll(":scope > :not(h1)") ?? [])
            if (one instanceof HTMLElement && one !== this.place) one.inert = covered;
    }

    close() {
        this.place.hidden = true;
        this.cover(false);
        this.place.replaceChildren();
        if (this.opener instanceof HTMLElement) this.opener.focus();
    }
}

/** @param {import("./orders.js").Answer} answer @param {string} order @param {Catalogue} words */
export function answer_text(answer, order, words) {
    if (answer.done) return words.text("order_done", { order });
    if (answer.status === 0) return words.text("order_unknown");
    return answer.sentence;
}

function button_of(type, text) {
    const button = make("button", "", [text]);
    button.type = type;
    return button;
}

/** @param {Field} field */
function choice_of(field) {
    const input = make("select", "", (field.choices ?? []).map(([value, text]) => {
        const option = make("option", "", [text]);
        option.value = value;
        return option;
    }));
    input.name = field.name;
    return { name: field.name, label: make("label", "", [field.label, input]), input, read: () => input.value };
}

/** What is no number is sent as it was typed: the station refuses it in its own words. @param {Field} field */
function input_of(field, words) {
    if (field.kind === "choice") return choice_of(field);
    const input = make("input");
    input.type = "text";
    input.name = field.name;
    input.autocomplete = "off";
    input.value = field.value ?? "";
    const label = make("label", "", [field.label, input]);
    if (field.kind === "code") {
        input.inputMode = "numeric";
        input.autocomplete = "one-time-code";
    }
    if (field.kind !== "number") return { name: field.name, label, input, read: () => input.value.trim() };
    input.inputMode = "decimal";
    const understood = make("span", "understood");
    label.append(understood);
    input.addEventListener("input", () => {
        const value = typed_number(input.value);
        const style = { decimal_mark: words.decimal_mark };
        set_text(understood, value === null ? "" : words.text("understood", { value: number_text(value, field.decimals ?? 4, style).trim() }));
    });
    return { name: field.name, label, input, read: () => typed_number(input.value) ?? input.value.trim() };
}
