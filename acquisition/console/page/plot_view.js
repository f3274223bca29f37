// The plot of accepted points as SVG, and its twin as a table.

import { keep_children, make, make_svg, set_attribute, set_text } from "./dom.js";
import { number_text, axis_units } from "./number_text.js";
import { plot_of, point_at } from "./plot_geometry.js";
import { labels_of } from "./plot_labels.js";
import { table_of } from "./point_table.js";

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

/** Approach from below points right and is filled, from above left and hollow: the two differ without colour. */
function arrow_path(x, y, direction) {
    const ahead = direction === "positive" ? 7 : -7;
    return `M${x - ahead} ${y - 7}L${x + ahead} ${y}L${x - ahead} ${y + 7}Z`;
}

const cross_path = (x, y, reach) =>
    `M${x - reach} ${y - reach}L${x + reach} ${y + reach}M${x - reach} ${y + reach}L${x + reach} ${y - reach}`;

export class PlotView {
    /** @param {HTMLElement} place @param {((point: Point | null) => void) | null} pick */
    constructor(place, pick) {
        this.place = place;
        this.shown = "";
        /** @type {{x: number, y: number, point: Point}[]} */
        this.dots = [];
        this.svg = make_svg("svg", { role: "img" });
        place.append(this.svg);
        this.width = 0;
        this.height = 0;
        new ResizeObserver(([{ contentRect }]) => {
            this.width = Math.round(contentRect.width);
            this.height = Math.round(contentRect.height);
        }).observe(this.svg);
        if (pick !== null) place.addEventListener("click", (event) => pick(this.under(event)));
    }

    /** @param {MouseEvent} event */
    under(event) {
        const box = this.svg.getBoundingClientRect();
        return point_at(this.dots, event.clientX - box.left, event.clientY - box.top);
    }

    /**
     * Draws only what is new.
     * @param {AcceptedPoints} accepted @param {any} status @param {Point | null} picked @param {Catalogue} words
     */
    paint(accepted, status, picked, words) {
        const { width, height } = this;
        if (!this.svg.hasAttribute("aria-label")) set_attribute(this.svg, "aria-label", words.text("points_accepted")); // before it has a size, too
        if (width < 120 || height < 60) return;
        const { deviation, coordinate } = axis_units(status.axis);
        const next = status.run_open && status.run?.next && status.run.id === accepted.run ? status.run.next.target : null;
        const count = accepted.points.length;
        const key = [accepted.version, next, picked?.step, width, height, deviation.unit, words.tag, words.text("no_points")].join("|");
        if (key === this.shown) return;
        this.shown = key;
        const { nominals, targets } = accepted;
        const plot = plot_of({ judged: accepted.judged(), nominals, targets }, { width, height, factor: deviation.factor, next });
        this.dots = plot.dots;
        set_attribute(this.svg, "viewBox", `0 0 ${width} ${height}`);
        const latest = plot.dots.at(-1);
        const said = latest ? point_text(latest.point, status, words) : words.text("no_points");
        const left_out = plot.dots.filter((dot) => dot.left_out).length;
        const also = left_out > 0 ? ` ${words.text("excluded", { count: left_out })}.` : "";
        set_attribute(this.svg, "aria-label", `${words.text("points_accepted")}: ${count}.${also} ${said}`);
        const units = { deviation: words.unit(deviation.unit), place: words.unit(coordinate) };
        this.svg.replaceChildren(
            ...this.frame(plot, units.deviation, words),
            ...this.labels(plot, units, words),
            ...plot.sides.flatMap(({ direction, bands }) => bands.map((d) => make_svg("path", { class: `band_${direction}`, d }))),
            ...plot.sides.flatMap(({ direction, means }) => means.map((d) => make_svg("path", { class: `mean_${direction}`, d }))),
            ...this.dots_of(plot.dots, picked),
            ...(count === 0 ? [make_svg("text", { x: width / 2, y: height / 2, "text-anchor": "middle" }, words.text("no_points"))] : []),
        );
    }

    frame(plot, unit, words) {
        const style = { decimal_mark: words.decimal_mark };
        const every = plot.lines.length * 22 > plot.bottom - plot.top ? 2 : 1;
        return [
            ...plot.lines.map(({ y }) => make_svg("line", { class: "grid", x1: plot.left, x2: plot.right, y1: y, y2: y })),
            ...plot.lines
                .filter((_, nth) => nth % every === 0)
                .map(({ value, y }) =>
                    make_svg("text", { x: plot.left - 6, y: y + 6, "text-anchor": "end" }, number_text(value, plot.decimals, style).trim()),
                ),
            make_svg("line", { class: "zero", x1: plot.left, x2: plot.right, y1: plot.zero_y, y2: plot.zero_y }),
            make_svg("text", { x: 4, y: plot.bottom + 24 }, unit),
            ...(plot.next_x === null ? [] : [make_svg("line", { class: "next_line", x1: plot.next_x, x2: plot.next_x, y1: plot.top, y2: plot.bottom })]),
        ];
    }

    labels(plot, units, words) {
        const { ends } = plot;
        const places = ends && { first: short_place(ends.first, words), last: `${short_place(ends.last, words)} ${units.place}` };
        const room = { left: 12 + 12 * units.deviation.length, right: plot.right + 12 };
        return labels_of(plot.targets, places, room).map(({ text, x, anchor }) =>
            make_svg("text", { x, y: plot.bottom + 24, "text-anchor": anchor }, text),
        );
    }

    /** Taken again: a cross in its place. Left out: its arrow stays, and is crossed out above all others. */
    dots_of(dots, picked) {
        const cross = ({ x, y }, name, reach) => make_svg("path", { class: name, d: cross_path(x, y, reach) });
        const arrow = ({ x, y, direction }) => make_svg("path", { class: direction, d: arrow_path(x, y, direction) });
        const ring = ({ x, y }, name, r) => make_svg("circle", { class: name, cx: x, cy: y, r });
        return [
            ...dots.map((dot) => (dot.counts || dot.left_out ? arrow(dot) : cross(dot, "replaced", 6))),
            ...dots.filter((dot) => dot.left_out).map((dot) => cross(dot, "left_out", 10)),
            ...dots.filter((dot) => dot.latest).map((dot) => ring(dot, "latest", 13)),
            ...dots.filter((dot) => dot.point.step === picked?.step).map((dot) => ring(dot, "picked_ring", 18)),
        ];
    }
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
