// The five orders of a run. A button that is off stays where it is, can be reached, and says why.

import { make, set_attribute, set_text } from "./dom.js";
import { Hold } from "./hold.js";

/** @typedef {import("./actions.js").Button} Button */
/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {"arm" | "trigger" | "retake" | "exclude" | "abort"} Order */
/** @typedef {Order | "pair"} Asked  "pair": an order was touched that this browser may not give yet */

/** @type {readonly Order[]} */
const orders = ["arm", "trigger", "retake", "exclude", "abort"];

export class OrderBar {
    /** @param {HTMLElement} place @param {(asked: Asked) => void} give */
    constructor(place, give) {
        this.give = give;
        this.hold = new Hold();
        this.fill = make("span", "fill");
        this.filled = 0;
        /** @type {Record<string, boolean>} */
        this.on = {};
        this.lacks_rights = false;
        /** @type {Record<string, HTMLButtonElement>} */
        this.buttons = {};
        for (const order of orders) {
            const button = make("button", "", [make("span", "name"), make("span", "why")]);
            button.type = "button";
            button.dataset.order = order;
            this.buttons[order] = button;
            place.append(button);
            if (order === "abort") this.hold_to_give(button);
            button.addEventListener("click", () => this.clicked(order));
        }
    }

    /** @param {Order} order */
    clicked(order) {
        if (this.lacks_rights) this.give("pair");
        else if (this.on[order] && order !== "abort") this.give(order);
    }

    /** Held by finger or by key; whatever ends the touch ends it. @param {HTMLButtonElement} button */
    hold_to_give(button) {
        button.append(this.fill);
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
        if (part !== this.filled) this.fill.style.transform = `scaleX(${part})`;
        this.filled = part;
        if (part === 1) this.give("abort");
    }

    /**
     * Under a finger an order goes off at once, and none comes on: what was off when it was touched is not given.
     * @param {Record<Order, Button>} states
     * @param {boolean} pressed
     * @param {Catalogue} words
     */
    paint(states, pressed, words) {
        if (!pressed) this.lacks_rights = orders.every((order) => states[order].reason === "off_rights");
        for (const order of orders) {
            const { on, reason, sentence } = states[order];
            if (pressed && on && !this.on[order]) continue;
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
