// The durable points of the run that is shown, as GET /v1/events tells them. No DOM.

/**
 * @typedef {object} Point
 * @property {number} step
 * @property {number} target  from 0
 * @property {"positive" | "negative"} direction
 * @property {number} approach  from 0
 * @property {number} deviation_um
 * @property {number} sequence
 */

export class AcceptedPoints {
    constructor() {
        /** @type {string | null} */
        this.run = null;
        /** @type {Point[]} */
        this.points = [];
    }

    /**
     * @param {{run: string | null, count: number, from: number, points: Point[]}} event
     * @returns {boolean} false: something is missing between, and all of them have to be asked for anew
     */
    take(event) {
        if (event.from === 0) {
            this.run = event.run;
            this.points = event.points.slice();
        } else if (event.run === this.run && event.from <= this.points.length) {
            this.points = this.points.slice(0, event.from).concat(event.points);
        } else return false;
        return this.points.length === event.count;
    }

    /**
     * Of the points of one target, direction and approach the last one counts: it was taken again.
     * @returns {{point: Point, counts: boolean}[]} in the order they were taken
     */
    judged() {
        /** @type {Map<string, Point>} */
        const last = new Map();
        for (const point of this.points) last.set(place_of(point), point);
        return this.points.map((point) => ({ point, counts: last.get(place_of(point)) === point }));
    }
}

/** @param {Point} point */
export function place_of(point) {
    return `${point.target}/${point.direction}/${point.approach}`;
}
