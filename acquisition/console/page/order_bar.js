// The five orders of a run. A button that is off stays where it is, can be reached, and says why.

import { make, set_attribute, set_text } from "./dom.js";
import { Hold } from "./hold.js";

/** @typedef {import("./actions.js").Button} Button */
/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {"arm" | "trigger" | "retake" | "exclude" | "abort"} Order */

/** @type {readonly Order[]} */
const orders = ["arm", "trigger", "retake", "exclude", "abort"];

export class OrderBar {
    /** @param {HTMLElement} place @param {(order: Order) => void} give */
    constructor(place, give) {
        this.give = give;
        this.hold = new Hold();
        /** @type {Record<string, boolean>} */
        this.on = {};
        /** @type {Record<string, HTMLButtonElement>} */
        this.buttons = {};
        for (const order of orders) {
            const button = make("button", "", [make("span", "name"), make("span", "why")]);
            button.type = "button";
            button.dataset.order = order;
            this.buttons[order] = button;
            place.append(button);
            if (order === "abort") this.hold_to_give(button);
            else button.addEventListener("click", () => this.on[order] && this.give(order));
        }
    }

    /** Held by finger or by key; whatever ends the touch ends it. @param {HTMLButtonElement} button */
    hold_to_give(button) {
        button.append(make("span", "fill"));
        const press = () => {
            if (this.on.abort) this.hold.press(performance.now());
        };
        button.addEventListener("pointerdown", (event) => event.isPrimary && press());
        button.addEventListener("keydown", (event) => {
            if ((event.key === " " || event.key === "Enter") && !event.repeat) press();
        });
        for (const end of ["pointerup", "pointercancel", "pointerleave", "keyup", "blur", "contextmenu"])
            button.addEventListener(end, (event) => {
                if (end === "contextmenu") event.preventDefault(); // a long touch opens none
                this.hold.release();
            });
    }

    /** With each tick: the ring of the held button. */
    tick() {
        const part = this.hold.progress(performance.now());
        const fill = /** @type {HTMLElement} */ (this.buttons.abort.querySelector(".fill"));
        fill.style.transform = `scaleX(${part})`;
        if (part === 1) this.give("abort");
    }

    /** @param {Record<Order, Button>} states @param {Catalogue} words */
    paint(states, words) {
        for (const order of orders) {
            const { on, reason, sentence } = states[order];
            const button = this.buttons[order];
            this.on[order] = on;
            set_attribute(button, "aria-disabled", on ? null : "true");
            set_text(/** @type {Element} */ (button.querySelector(".name")), words.text(order));
            const why = on ? "" : words.text(reason);
            set_text(/** @type {Element} */ (button.querySelector(".why")), why);
            set_attribute(button, "title", sentence || why || null);
        }
        if (!this.on.abort) this.hold.release();
    }
}
