// The sheet on which an order is written. It asks the station and shows what that says; it judges no field itself.

import { make, set_text } from "./dom.js";
import { refusal_lines } from "./orders.js";
import { number_text, typed_number } from "./number_text.js";

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {{name: string, label: string, kind: "text" | "number" | "code" | "choice", value?: string, choices?: [string, string][]}} Field  choices: value, text */

export class OrderSheet {
    /** @param {HTMLElement} place */
    constructor(place) {
        this.place = place;
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
     */
    open(title, fields, send, words) {
        this.opener = document.activeElement;
        const inputs = fields.map((field) => input_of(field, words));
        const answer = make("p", "answer");
        answer.setAttribute("role", "alert");
        const send_button = button_of("submit", title);
        const close_button = button_of("button", words.text("close"));
        const form = make("form", "", [...inputs.map(({ label }) => label), send_button, close_button, answer]);
        form.noValidate = true;
        form.setAttribute("aria-label", title);
        form.addEventListener("submit", async (event) => {
            event.preventDefault();
            if (send_button.disabled) return; // one order at a time
            send_button.disabled = true;
            set_text(answer, words.text("order_waits"));
            const got = await send(Object.fromEntries(inputs.map(({ name, read }) => [name, read()])));
            send_button.disabled = false;
            set_text(answer, answer_text(got, title, words));
            if (got.done) this.close();
        });
        close_button.addEventListener("click", () => this.close());
        form.addEventListener("keydown", (event) => {
            if (event.key === "Escape") this.close();
        });
        this.place.replaceChildren(make("h2", "", [title]), form);
        this.place.hidden = false;
        (inputs[0]?.input ?? send_button).focus();
    }

    close() {
        this.place.hidden = true;
        this.place.replaceChildren();
        if (this.opener instanceof HTMLElement) this.opener.focus();
    }
}

/** @param {import("./orders.js").Answer} answer @param {string} order @param {Catalogue} words */
export function answer_text(answer, order, words) {
    if (answer.done) return words.text("order_done", { order });
    if (answer.status === 0) return words.text("order_unknown");
    return refusal_lines(answer).join(" ");
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
    return { name: field.name, label: make("label", "", [field.label, input]), input, read: () => input.value };
}

/** What is no number is sent as it was typed: the station refuses it in its own words. @param {Field} field */
function input_of(field, words) {
    if (field.kind === "choice") return choice_of(field);
    const input = make("input");
    input.type = "text";
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
        set_text(understood, value === null ? "" : words.text("understood", { value: number_text(value, 4, style).trim() }));
    });
    return { name: field.name, label, input, read: () => typed_number(input.value) ?? input.value.trim() };
}
