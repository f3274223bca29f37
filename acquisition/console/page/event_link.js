// Listens to GET /v1/events, for ever. By fetch and not by EventSource: that hides why it was refused, and stays silent
// on a connection that is dead.

import { EventText } from "./event_text.js";
import { contact_limit_ms } from "./freshness.js";

const longest_opening_ms = 4000;

/** @typedef {import("./link_state.js").LinkState} LinkState */
/** @typedef {import("./event_text.js").StationEvent} StationEvent */

export class EventLink {
    /**
     * @param {object} parts
     * @param {LinkState} parts.link
     * @param {() => number} parts.now
     * @param {(event: StationEvent) => boolean} parts.take  false: something is missing, all is asked for anew
     * @param {typeof fetch} parts.fetcher
     * @param {(call: () => void, ms: number) => unknown} parts.later  as setTimeout
     */
    constructor({ link, now, take, fetcher, later }) {
        this.link = link;
        this.now = now;
        this.take = take;
        this.fetcher = fetcher;
        this.later = later;
        this.last_id = "";
        this.began_at = now();
        this.heard_here = false;
        /** @type {AbortController | null} */
        this.abort = null;
        this.resting = false;
        this.hurry = () => {};
    }

    async run() {
        for (;;) {
            if (this.resting) await this.woken();
            await this.listen();
            if (!this.resting) await this.pause(this.link.next_pause());
        }
    }

    /** Nobody looks: the connection is left to others. A browser has six for one address, the station 32 for all. */
    rest() {
        if (this.resting) return;
        this.resting = true;
        this.link.rest(this.now());
        this.abort?.abort();
    }

    /** Somebody looks again: what was missed comes at once. */
    resume() {
        if (this.resting) this.link.resume(this.now());
        this.resting = false;
        this.hurry();
    }

    woken() {
        return new Promise((resolve) => {
            this.hurry = () => resolve(undefined);
        });
    }

    /** Ends a connection on which nothing comes. Called with each tick. */
    watch() {
        const now = this.now();
        const since = this.heard_here ? Math.max(this.link.heard_at ?? 0, this.began_at) : this.began_at;
        if (now - since > (this.heard_here ? contact_limit_ms : longest_opening_ms)) this.abort?.abort();
    }

    /** @param {number} ms */
    pause(ms) {
        return new Promise((resolve) => {
            this.hurry = () => resolve(undefined);
            this.later(this.hurry, ms);
        });
    }

    async listen() {
        this.abort = new AbortController();
        this.began_at = this.now();
        this.heard_here = false;
        try {
            const response = await this.fetcher("/v1/events", {
                cache: "no-store",
                credentials: "same-origin",
                headers: this.last_id === "" ? {} : { "Last-Event-ID": this.last_id },
                signal: this.abort.signal,
            });
            if (!response.ok || response.body === null) this.link.refused(await sentence_of(response));
            else await this.read(response.body.getReader());
        } catch {
            // No network, or watch() has ended it: the next try comes after the pause.
        } finally {
            this.abort.abort();
            this.abort = null;
        }
    }

    /** @param {ReadableStreamDefaultReader<Uint8Array>} reader */
    async read(reader) {
        const decoder = new TextDecoder();
        const text = new EventText();
        text.last_id = this.last_id;
        for (;;) {
            const { done, value } = await reader.read();
            if (done) return;
            for (const event of text.take(decoder.decode(value, { stream: true }))) {
                this.heard_here = true;
                this.link.heard(this.now());
                if (!this.take(event)) {
                    this.last_id = "";
                    return;
                }
                this.last_id = event.id; // of what is complete: a torn event is sent again
            }
        }
    }
}

/** @param {Response} response */
async function sentence_of(response) {
    try {
        return (await response.json()).error.sentence;
    } catch {
        return `HTTP ${response.status}`;
    }
}
