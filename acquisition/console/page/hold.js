// Hold to confirm: what cannot be undone takes a held finger, not a tap. No DOM.

const hold_ms = 800;
/** A page that was frozen while the finger was down has not seen it held. */
const longest_look_ms = 300;

export class Hold {
    constructor() {
        /** @type {number | null} */
        this.began_at = null;
        this.looked_at = 0;
    }

    /** @param {number} now  ms */
    press(now) {
        this.began_at = now;
        this.looked_at = now;
    }

    release() {
        this.began_at = null;
    }

    /**
     * Asked many times a second while the finger is down.
     * @param {number} now
     * @returns {number} 0 to 1; 1 is given once, and then it must be pressed anew
     */
    progress(now) {
        if (this.began_at === null) return 0;
        if (now - this.looked_at > longest_look_ms) {
            this.release();
            return 0;
        }
        this.looked_at = now;
        const part = Math.min(1, Math.max(0, (now - this.began_at) / hold_ms));
        if (part === 1) this.release();
        return part;
    }
}
