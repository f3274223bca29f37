// The durable points of the run that is shown, as GET /v1/events tells them. No DOM.

/**
 * @typedef {object} Point
 * @property {number} step
 * @property {number} target  from 0
 * @property {number} [nominal_mm]  place of the target, of a rotary axis in degrees; a station of before does not tell it
 * @property {"positive" | "negative"} direction
 * @property {number} approach  from 0
 * @property {number} deviation_um
 * @property {boolean} [excluded]  a person left it out
 * @property {number} sequence
 */

/**
 * @typedef {object} Side  what the points of one target that count give in one direction
 * @property {number} points
 * @property {number | null} mean_um
 * @property {number | null} low_um  mean − 2 s; null below two points
 * @property {number | null} high_um  mean + 2 s
 */

/** @typedef {{target: number, nominal_mm: number, positive: Side, negative: Side}} TargetSoFar */

/**
 * @typedef {object} PointsEvent
 * @property {string | null} run
 * @property {number} count
 * @property {number} from
 * @property {Point[]} points
 * @property {number[]} [target_nominals_mm]  of the plan; with `from` 0 alone
 * @property {TargetSoFar[]} [targets]  those of which a point is sent
 */

/** @typedef {{point: Point, counts: boolean, left_out: boolean}} Judged */

export class AcceptedPoints {
    constructor() {
        /** @type {string | null} */
        this.run = null;
        /** @type {Point[]} */
        this.points = [];
        /** @type {number[] | null} places of the plan's targets; null: the station does not tell them */
        this.nominals = null;
        /** @type {Map<number, TargetSoFar>} */
        this.targets = new Map();
        this.version = 0; // another one with each event: what is drawn of it is drawn anew
    }

    /**
     * With `from` 0 everything comes anew, also of the run that is shown: a person left points out.
     * @param {PointsEvent} event
     * @returns {boolean} false: something is missing between, and all of them have to be asked for anew
     */
    take(event) {
        if (event.from === 0) {
            this.run = event.run;
            this.points = event.points.slice();
            this.nominals = event.target_nominals_mm ?? null;
            this.targets.clear();
        } else if (event.run === this.run && event.from <= this.points.length) {
            this.points = this.points.slice(0, event.from).concat(event.points);
        } else return false;
        for (const row of event.targets ?? []) this.targets.set(row.target, row);
        this.version += 1;
        return this.points.length === event.count;
    }

    /**
     * Of the points of one target, direction and approach the last one counts: it was taken again. Where that one is
     * left out, none does.
     * @returns {Judged[]} in the order they were taken
     */
    judged() {
        /** @type {Map<string, Point>} */
        const last = new Map();
        for (const point of this.points) last.set(place_of(point), point);
        return this.points.map((point) => {
            const left_out = point.excluded === true;
            return { point, counts: !left_out && last.get(place_of(point)) === point, left_out };
        });
    }
}

/** @param {Point} point */
function place_of(point) {
    return `${point.target}/${point.direction}/${point.approach}`;
}

/** @param {Point | null} picked @param {AcceptedPoints} accepted @returns {Point | null} as it stands in the run now */
export function still_picked(picked, accepted) {
    if (picked === null) return null;
    return accepted.points.find((one) => one.step === picked.step && place_of(one) === place_of(picked)) ?? null;
}
