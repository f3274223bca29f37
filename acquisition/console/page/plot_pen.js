// Draws the marks of a plot on its canvas, and counts what it has put there.

/** @typedef {import("./plot_geometry.js").Marks} Marks */
/** @typedef {Record<string, string>} Colours  by the name of their property in the style: `ink` is --ink */
/** @typedef {{fill?: string, alpha?: number, stroke?: string, width?: number, dash?: number[]}} Style  colours by their names */

/** From the lowest to the uppermost. @type {Readonly<Record<string, Style>>} */
const styles = Object.freeze({
    zero: { stroke: "ink", width: 2 },
    limit: { stroke: "ink", width: 2.5, dash: [14, 5, 3, 5] },
    next_line: { stroke: "dim", width: 2, dash: [4, 6] },
    band_positive: { fill: "positive", alpha: 0.14, stroke: "positive", width: 1 }, // clear enough to show each other
    band_negative: { fill: "negative", alpha: 0.14, stroke: "negative", width: 1, dash: [8, 5] },
    mean_positive: { stroke: "positive", width: 2.5 },
    mean_negative: { stroke: "negative", width: 2.5, dash: [8, 5] },
    positive: { fill: "positive" },
    negative: { stroke: "negative", width: 2.5 },
    replaced: { stroke: "dim", width: 2 },
    left_out: { stroke: "ink", width: 2.5 },
    latest: { stroke: "ink", width: 3 },
    picked_ring: { stroke: "ink", width: 3 },
});

export const mark_names = Object.freeze(Object.keys(styles));
export const colour_names = Object.freeze(["ink", "dim", "line", "positive", "negative"]);

/** Approach from below points right and is filled, from above left and hollow: the two differ without colour. */
function arrow_path({ x, y, direction }) {
    const ahead = direction === "positive" ? 7 : -7;
    return `M${x - ahead} ${y - 7}L${x + ahead} ${y}L${x - ahead} ${y + 7}Z`;
}

const cross_path = ({ x, y }, reach) =>
    `M${x - reach} ${y - reach}L${x + reach} ${y + reach}M${x - reach} ${y + reach}L${x + reach} ${y - reach}`;

const ring_path = ({ x, y }, r) => `M${x - r} ${y}A${r} ${r} 0 1 1 ${x + r} ${y}A${r} ${r} 0 1 1 ${x - r} ${y}Z`;

export class PlotPen {
    /** @param {CanvasRenderingContext2D} context  in pixels of the page @param {Colours} colours @param {string} font */
    constructor(context, colours, font) {
        this.context = context;
        this.colours = colours;
        this.font = font;
        /** How many of each kind are on the canvas. @type {Record<string, number>} */
        this.drawn = Object.fromEntries(mark_names.map((name) => [name, 0]));
    }

    /** @param {string} name @param {string} path  as SVG writes it */
    draw(name, path) {
        const { context, colours } = this;
        const { fill, alpha = 1, stroke, width = 1, dash = [] } = styles[name];
        const shape = new Path2D(path);
        if (fill !== undefined) {
            context.globalAlpha = alpha;
            context.fillStyle = colours[fill];
            context.fill(shape);
            context.globalAlpha = 1;
        }
        if (stroke !== undefined) {
            context.strokeStyle = colours[stroke];
            context.lineWidth = width;
            context.setLineDash(dash);
            context.stroke(shape);
        }
        this.drawn[name] += 1;
    }

    /** @param {string} text @returns {number} pixels of the page */
    width_of(text) {
        this.context.font = this.font;
        return this.context.measureText(text).width;
    }

    /** @param {string} text @param {number} x @param {number} y  of its foot @param {"start" | "middle" | "end"} anchor */
    write(text, x, y, anchor) {
        const { context } = this;
        context.font = this.font;
        context.fillStyle = this.colours.ink;
        context.textAlign = anchor === "middle" ? "center" : anchor === "end" ? "right" : "left";
        context.textBaseline = "alphabetic";
        context.fillText(text, x, y);
    }

    /**
     * Taken again: a cross in its place. Left out: its arrow stays, and is crossed out above all others.
     * @param {Marks} marks @param {number | undefined} picked  step of the point
     * @param {{left: number, right: number, top: number, bottom: number}} frame
     */
    draw_all({ dots, sides, next_x, zero_y, limit_ys }, picked, frame) {
        this.draw("zero", `M${frame.left} ${zero_y}L${frame.right} ${zero_y}`);
        for (const y of limit_ys) this.draw("limit", `M${frame.left} ${y}L${frame.right} ${y}`);
        if (next_x !== null) this.draw("next_line", `M${next_x} ${frame.top}L${next_x} ${frame.bottom}`);
        for (const { direction, bands } of sides) for (const path of bands) this.draw(`band_${direction}`, path);
        for (const { direction, means } of sides) for (const path of means) this.draw(`mean_${direction}`, path);
        for (const dot of dots)
            if (dot.counts || dot.left_out) this.draw(dot.direction, arrow_path(dot));
            else this.draw("replaced", cross_path(dot, 6));
        for (const dot of dots) if (dot.left_out) this.draw("left_out", cross_path(dot, 10));
        for (const dot of dots) if (dot.latest) this.draw("latest", ring_path(dot, 13));
        for (const dot of dots) if (dot.point.step === picked) this.draw("picked_ring", ring_path(dot, 18));
    }
}
