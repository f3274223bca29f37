// Between the finger and the page: the touch that wakes does nothing else, and what lies under a finger stays.

/** A hand that rests on the screen must not keep it from changing for ever. */
const longest_press_ms = 1500;

export class TouchGuard {
    /**
     * @param {import("./wakefulness.js").Wakefulness} wake @param {() => number} now
     * @param {(event: KeyboardEvent) => boolean} is_harmless  keys that may do what they do, and wake
     */
    constructor(wake, now, is_harmless = () => false) {
        this.wake = wake;
        this.now = now;
        this.is_harmless = is_harmless;
        this.swallows_click = false;
        this.swallowed_key = "";
        /** @type {number | null} */
        this.pressed_at = null;
        const listen = (name, call) => document.addEventListener(name, call, { capture: true });
        listen("pointerdown", (event) => this.on_down(event));
        for (const end of ["pointerup", "pointercancel"]) listen(end, () => (this.pressed_at = null));
        listen("click", (event) => this.on_click(event));
        listen("keydown", (event) => this.on_key_down(event));
        listen("keyup", (event) => this.on_key_up(event));
    }

    is_pressed() {
        return this.pressed_at !== null && this.now() - this.pressed_at < longest_press_ms;
    }

    on_down(event) {
        this.pressed_at = this.now();
        this.swallows_click = !this.wake.touch(this.now());
        if (this.swallows_click) end(event);
    }

    /** Without a pointer (a key, a screen reader) a click is a touch of its own. */
    on_click(event) {
        const swallow = event.detail === 0 ? !this.wake.touch(this.now()) : this.swallows_click;
        this.swallows_click = false;
        if (swallow) end(event);
    }

    on_key_down(event) {
        if (!this.wake.touch(this.now()) && !this.is_harmless(event)) this.swallowed_key = event.key;
        if (this.swallowed_key === event.key) end(event);
    }

    on_key_up(event) {
        if (this.swallowed_key === "" || event.key !== this.swallowed_key) return;
        this.swallowed_key = "";
        end(event);
    }
}

function end(event) {
    event.preventDefault();
    event.stopImmediatePropagation();
}
