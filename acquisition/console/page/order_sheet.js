// The sheet on which an order is written. It asks the station and shows what that says; it judges no field itself.

import { make, set_text } from "./dom.js";
import { refusal_lines } from "./orders.js";
import { number_text, typed_number } from "./number_text.js";

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {{name: string, label: string, kind: "text" | "number" | "code" | "choice", value?: string, decimals?: number, choices?: [string, string][]}} Field
 *   decimals: of a number that is shown as it was understood; choices: value, text */

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
            if (!form.isConnected) return this.late(answer_text(got, title, words));
            if (got.done) return this.close();
            set_text(answer, answer_text(got, title, words));
            answer.scrollIntoView({ block: "nearest" });
            for (const field of further(got)) {
                if (inputs.some(({ name }) => name === field.name)) continue;
                const input = input_of(field, words);
                inputs.push(input);
                send_button.before(input.label);
            }
        });
        close_button.addEventListener("click", () => this.close());
        form.addEventListener("keydown", (event) => {
            if (event.key === "Escape") this.close();
        });
        this.place.replaceChildren(make("h2", "", [title]), form);
        this.place.hidden = false;
        this.cover(true);
        (inputs[0]?.input ?? send_button).focus();
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
