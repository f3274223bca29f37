// The plot of accepted points, drawn by uPlot (begin.js loads it), and the same points as a table.

import { keep_children, make, set_attribute, set_text } from "./dom.js";
import { number_text, axis_units } from "./number_text.js";
import { data_of, decimals_of, least_range, margins, marks_of, place_range, places_of, point_at, step_room, steps } from "./plot_geometry.js";
import { labels_of } from "./plot_labels.js";
import { limit_lines } from "./plot_limits.js";
import { PlotPen, colour_names, mark_names } from "./plot_pen.js";
import { table_of } from "./point_table.js";
import { on_colours } from "./settings.js";

/** @typedef {import("./accepted_points.js").Point} Point */
/** @typedef {import("./accepted_points.js").AcceptedPoints} AcceptedPoints */
/** @typedef {import("./catalogue.js").Catalogue} Catalogue */

/** "P7, from above, approach 2: −3.10 µm" @param {Point} point @param {any} status @param {Catalogue} words */
export function point_text(point, status, words) {
    const { deviation } = axis_units(status.axis);
    return words.text("point_words", {
        target: point.target + 1,
        side: words.text(`side_${point.direction}`),
        approach: point.approach + 1,
        number: number_text(point.deviation_um * deviation.factor, 2, { decimal_mark: words.decimal_mark, plus: true }).trim(),
        unit: words.unit(deviation.unit),
    });
}

/** Without the zeros behind the last digit: there is little room below the plot. @param {number} place @param {Catalogue} words */
export function short_place(place, words) {
    const text = number_text(place, 3, { decimal_mark: words.decimal_mark }).trim();
    return text.replace(/0+$/, "").replace(/[.,]$/, "");
}

/**
 * @typedef {object} Content  what is to be drawn
 * @property {import("./plot_geometry.js").Drawn} drawn
 * @property {import("./plot_geometry.js").Places} places
 * @property {number | null} next
 * @property {number} factor
 * @property {number | undefined} picked  step of the point
 * @property {{deviation: string, place: string}} units
 * @property {Catalogue} words
 */

/** uPlot has scales, grid, values of the axis and the canvas; the marks are ours, drawn when it has drawn. */
export class PlotView {
    /** @param {HTMLElement} place @param {((point: Point | null) => void) | null} pick */
    constructor(place, pick) {
        this.shown = "";
        /** @type {{x: number, y: number, point: Point}[]} */
        this.dots = [];
        /** How many marks of each kind are on the canvas; empty while nothing is. @type {Record<string, number>} */
        this.drawn = {};
        /** @type {Record<string, string>} */
        this.colours = {};
        /** @type {any} */
        this.chart = null;
        /** @type {Content | null} */
        this.content = null;
        this.room = make("div", "drawing");
        this.room.setAttribute("role", "img");
        place.append(this.room);
        this.width = 0;
        this.height = 0;
        new ResizeObserver(([{ contentRect }]) => {
            this.width = Math.round(contentRect.width);
            this.height = Math.round(contentRect.height);
        }).observe(this.room);
        on_colours(() => (this.shown = ""));
        if (pick !== null) place.addEventListener("click", (event) => pick(this.under(event)));
    }

    /** @param {MouseEvent} event */
    under(event) {
        const box = this.room.getBoundingClientRect();
        return point_at(this.dots, event.clientX - box.left, event.clientY - box.top);
    }

    /**
     * Draws only what is new.
     * @param {AcceptedPoints} accepted @param {any} status @param {Point | null} picked @param {Catalogue} words
     */
    paint(accepted, status, picked, words) {
        const { width, height } = this;
        if (this.room.getAttribute("aria-label") === null) set_attribute(this.room, "aria-label", words.text("points_accepted")); // before it has a size, too
        if (width < 120 || height < 60) return;
        const { deviation, coordinate } = axis_units(status.axis);
        const next = status.run_open && status.run?.next && status.run.id === accepted.run ? status.run.next.target : null;
        const limits = limit_lines(accepted.targets.values(), limits_of(status, accepted));
        const key = [accepted.version, next, picked?.step, JSON.stringify(limits), width, height, deviation.unit, words.tag, words.text("no_points")].join("|");
        if (key === this.shown) return;
        this.shown = key;
        const drawn = { judged: accepted.judged(), nominals: accepted.nominals, targets: accepted.targets, limits };
        const units = { deviation: words.unit(deviation.unit), place: words.unit(coordinate) };
        this.content = { drawn, places: places_of(drawn, next), next, factor: deviation.factor, picked: picked?.step, units, words };
        set_attribute(this.room, "aria-label", said_of(accepted, drawn.judged, status, words));
        this.show(this.content);
    }

    /** @param {Content} content */
    show({ drawn, places, factor, words }) {
        const { uPlot } = /** @type {any} */ (globalThis);
        if (uPlot === undefined) return set_text(this.room, words.text("plot_missing"));
        const data = data_of(drawn, places, factor);
        if (this.chart === null) {
            this.chart = this.begin(uPlot, data);
            return;
        }
        this.chart.batch(() => {
            this.chart.setSize({ width: this.width, height: this.height }); // also where it is the same: colours are set anew
            this.chart.setData(data);
        });
    }

    begin(uPlot, data) {
        const none = { show: false };
        const extreme = { scale: "y", paths: () => null, points: none };
        return new uPlot({
            width: this.width, height: this.height, padding: [margins.top, margins.right, margins.bottom, 0],
            legend: none,
            cursor: { show: false, drag: { click: () => {} } }, // its own keeps clicks to itself
            select: { show: false, left: 0, top: 0, width: 0, height: 0 },
            scales: {
                x: { time: false, range: () => place_range(this.now().places, this.width - margins.left - margins.right) },
                y: { range: (_, low, high) => uPlot.rangeNum(...least_range(low, high), 0.05, true) },
            },
            series: [{}, extreme, extreme],
            axes: [none, this.axis()],
            hooks: { drawClear: [() => this.forget()], draw: [(chart) => this.draw(chart, uPlot.pxRatio)] },
        }, data, this.room);
    }

    axis() {
        const text_of = (value, step) => number_text(value, decimals_of(step), { decimal_mark: this.now().words.decimal_mark }).trim();
        return {
            scale: "y", size: margins.left, gap: 6, font: this.font(), stroke: () => this.colours.ink,
            grid: { stroke: () => this.colours.line, width: 1 }, ticks: { show: false },
            incrs: steps,
            space: (chart, axis, low, high, height) => step_room(height),
            values: (chart, values, axis, space, step) => values.map((value) => text_of(value, step)),
        };
    }

    font() {
        return `18px ${getComputedStyle(this.room).fontFamily}`;
    }

    now() {
        return /** @type {Content} */ (this.content);
    }

    /** The canvas is empty. A canvas has no colours of its own: they are asked for with each drawing. */
    forget() {
        this.dots = [];
        this.drawn = {};
        for (const name of mark_names) this.room.removeAttribute(`data-${name}`);
        const style = getComputedStyle(this.room);
        this.colours = Object.fromEntries(colour_names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
    }

    /** After grid and axis. @param {any} chart @param {number} ratio  pixels of the canvas for one of the page */
    draw(chart, ratio) {
        const { drawn, places, next, factor, picked } = this.now();
        const { left, top, width, height } = Object.fromEntries(Object.entries(chart.bbox).map(([name, value]) => [name, value / ratio]));
        const frame = { left, right: left + width, top, bottom: top + height };
        const x_of = (place) => left + chart.valToPos(place, "x");
        const y_of = (value) => top + chart.valToPos(value, "y");
        const marks = marks_of(drawn, places, next, { x_of, y_of, width, factor });
        const pen = new PlotPen(chart.ctx, this.colours, this.font());
        chart.ctx.save(); // it remembers what it has set
        chart.ctx.scale(ratio, ratio);
        this.write(pen, marks, frame);
        pen.draw_all(marks, picked, frame);
        chart.ctx.restore();
        this.dots = marks.dots;
        this.drawn = pen.drawn;
        for (const name of mark_names) this.room.setAttribute(`data-${name}`, String(pen.drawn[name]));
    }

    /** @param {PlotPen} pen @param {import("./plot_geometry.js").Marks} marks */
    write(pen, { targets, ends, limit_ys }, frame) {
        const { units, words, drawn } = this.now();
        const foot = frame.bottom + 24;
        pen.write(units.deviation, 4, foot, "start");
        const places = ends && { first: short_place(ends.first, words), last: `${short_place(ends.last, words)} ${units.place}` };
        const room = { left: 16 + pen.width_of(units.deviation), right: frame.right + 12, width_of: (text) => pen.width_of(text) };
        for (const { text, x, anchor } of labels_of(targets, places, room)) pen.write(text, x, foot, anchor);
        if (drawn.limits !== null) pen.write(limit_text(drawn.limits, this.now()), frame.left + 6, limit_foot(limit_ys[0], frame), "start");
        const above_zero = frame.top + 0.375 * (frame.bottom - frame.top) + 6; // between two lines of the empty grid
        if (drawn.judged.length === 0) pen.write(words.text("no_points"), (frame.left + frame.right) / 2, above_zero, "middle");
    }
}

/** Of the run whose points are drawn. @param {any} status @param {AcceptedPoints} accepted @returns {import("./plot_limits.js").Limit[]} */
function limits_of(status, accepted) {
    return (status.run?.id === accepted.run && status.run?.so_far?.limits) || [];
}

/** "A ≤ 12.25 µm" @param {import("./plot_limits.js").LimitLines} limits @param {Content} content */
function limit_text({ parameter, limit_um }, { factor, units, words }) {
    return `${parameter} ≤ ${number_text(limit_um * factor, 2, { decimal_mark: words.decimal_mark }).trim()} ${units.deviation}`;
}

/** Foot of the text: above the line, below it where there is no room. @param {number} y @param {{top: number}} frame */
function limit_foot(y, { top }) {
    return y - top >= 26 ? y - 6 : y + 20;
}

/** What a screen reader says of the plot; the table has the rest. @param {AcceptedPoints} accepted @param {any} status @param {Catalogue} words */
function said_of(accepted, judged, status, words) {
    const latest = accepted.points.at(-1);
    const said = latest ? point_text(latest, status, words) : words.text("no_points");
    const left_out = judged.filter((one) => one.left_out).length;
    const also = left_out > 0 ? ` ${words.text("excluded", { count: left_out })}.` : "";
    return `${words.text("points_accepted")}: ${accepted.points.length}.${also} ${said}`;
}

export class TableView {
    /** @param {HTMLElement} place @param {(point: Point) => void} pick @param {() => void} close */
    constructor(place, pick, close) {
        this.pick = pick;
        this.shown = "";
        this.head = make("tr");
        this.body = make("tbody");
        this.close_button = make("button");
        this.close_button.type = "button";
        this.close_button.addEventListener("click", close);
        place.append(this.close_button, make("table", "", [make("thead", "", [this.head]), this.body]));
    }

    /** @param {AcceptedPoints} accepted @param {any} status @param {Catalogue} words */
    paint(accepted, status, words) {
        const { deviation, coordinate } = axis_units(status.axis);
        const key = [accepted.version, deviation.unit, words.tag, words.text("no_points")].join("|");
        if (key === this.shown) return;
        this.shown = key;
        set_text(this.close_button, words.text("show_plot"));
        const units = { factor: deviation.factor, deviation: words.unit(deviation.unit), place: words.unit(coordinate) };
        const { heads, rows } = table_of(accepted, units, words);
        keep_children(this.head, heads.length, () => make("th")).forEach((one, nth) => set_text(one, heads[nth]));
        this.body.replaceChildren(...rows.map((row) => this.row(row)));
    }

    row({ point, label, cells }) {
        const [target, ...others] = cells;
        const button = make("button", "", [target]);
        button.type = "button";
        button.setAttribute("aria-label", label);
        button.addEventListener("click", () => this.pick(point));
        return make("tr", "", [make("td", "", [button]), ...others.map((text) => make("td", "", [text]))]);
    }
}
