// The first touch after waking only wakes: whoever wakes a dark screen must not stop a run by it. No DOM.

/** A screen that nobody touched for so long may be dark. */
const idle_limit_ms = 120000;
/** Ticks come every 80 ms; a longer hole is a computer that slept, or a page that was frozen. */
const hole_limit_ms = 2000;

export class Wakefulness {
    /** @param {number} now  ms of a clock that goes on while the computer sleeps */
    constructor(now) {
        this.ticked_at = now;
        this.touched_at = now;
        this.asleep = false;
    }

    /** The page is shown: what it took to load was no sleep. @param {number} now */
    begin(now) {
        this.ticked_at = now;
        this.touched_at = now;
    }

    /** @param {number} now */
    tick(now) {
        if (now - this.ticked_at > hole_limit_ms || now - this.touched_at > idle_limit_ms) this.asleep = true;
        this.ticked_at = now;
    }

    /** The page went out of sight: when it is back it has to be woken. */
    hide() {
        this.asleep = true;
    }

    /**
     * A finger or a key goes down.
     * @param {number} now
     * @returns {boolean} true: it may act; false: it has only woken the page
     */
    touch(now) {
        this.tick(now);
        const may_act = !this.asleep;
        this.asleep = false;
        this.touched_at = now;
        return may_act;
    }
}
