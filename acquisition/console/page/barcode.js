// What a barcode reader types: many keys, faster than any hand, then Enter. No DOM.

const fastest_hand_ms = 50; // between two keys; readers need 1 to 20
const shortest = 3; // characters

export class Barcode {
    constructor() {
        this.text = "";
        this.last_at = -Infinity;
    }

    /** Whether a key at this time comes from a reader, as far as it can be known. @param {number} at  ms */
    is_fast(at) {
        return at - this.last_at < fastest_hand_ms;
    }

    /**
     * @param {string} key  of the event @param {number} at  ms
     * @returns {string | null} what was read, with its Enter; null: nothing yet
     */
    take(key, at) {
        const fast = this.is_fast(at);
        if (key === "Enter") {
            const read = fast && this.text.length >= shortest ? this.text : null;
            this.text = "";
            return read;
        }
        if (key.length !== 1) return null; // Shift belongs to the letter that follows
        this.text = fast ? this.text + key : key;
        this.last_at = at;
        return null;
    }
}
