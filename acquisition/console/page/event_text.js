// From the text of an event stream to its events (HTML Living Standard, 9.2.6). No DOM, no socket.

const most_characters = 8 * 1024 * 1024;

/** @typedef {{event: string, data: string, id: string}} StationEvent */

export class EventText {
    constructor() {
        this.rest = "";
        this.last_id = "";
        this.event = "";
        /** @type {string[]} */
        this.data = [];
    }

    begin() {
        this.event = "";
        this.data = [];
    }

    /**
     * @param {string} text  the next piece, cut anywhere
     * @returns {StationEvent[]} those that are complete now
     */
    take(text) {
        const lines = (this.rest + text).split("\n"); // the station ends each line with one
        this.rest = lines.pop() ?? "";
        if (this.rest.length > most_characters) throw new Error("an event is too long");
        /** @type {StationEvent[]} */
        const events = [];
        for (const line of lines) this.take_line(line.endsWith("\r") ? line.slice(0, -1) : line, events);
        return events;
    }

    /** @param {string} line @param {StationEvent[]} events */
    take_line(line, events) {
        if (line === "") {
            if (this.data.length > 0)
                events.push({ event: this.event || "message", data: this.data.join("\n"), id: this.last_id });
            this.begin();
            return;
        }
        const colon = line.indexOf(":");
        const name = colon < 0 ? line : line.slice(0, colon);
        const value = colon < 0 ? "" : line.slice(colon + 1).replace(/^ /, "");
        if (name === "event") this.event = value;
        else if (name === "data") this.data.push(value);
        else if (name === "id" && !value.includes("\0")) this.last_id = value;
    }
}
