// Time for judging ages. No DOM.

/**
 * Milliseconds that never fall and go on while the computer sleeps. A browser's own monotonic clock may stand still
 * then, and the wall clock may be set: of the two steps the longer one counts. A wall clock that is set forward makes
 * values look old for a moment, until the next event; none ever looks younger than it is.
 */
export class SleeplessClock {
    /**
     * @param {() => number} monotonic  as performance.now()
     * @param {() => number} wall  as Date.now()
     */
    constructor(monotonic, wall) {
        this.monotonic = monotonic;
        this.wall = wall;
        this.last_monotonic = monotonic();
        this.last_wall = wall();
        this.passed = 0;
    }

    /** @returns {number} milliseconds since it was made */
    now() {
        const monotonic = this.monotonic();
        const wall = this.wall();
        this.passed += Math.max(0, monotonic - this.last_monotonic, wall - this.last_wall);
        this.last_monotonic = monotonic;
        this.last_wall = wall;
        return this.passed;
    }
}
