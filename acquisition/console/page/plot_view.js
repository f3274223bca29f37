// The plot of accepted points as SVG, and its twin as a table.

import { keep_children, make, make_svg, set_attribute, set_text } from "./dom.js";
import { number_text, axis_units } from "./number_text.js";
import { place_of } from "./accepted_points.js";
import { plot_of, point_at } from "./plot_geometry.js";

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

/** Approach from below points right and is filled, from above left and hollow: the two differ without colour. */
function arrow_path(x, y, direction) {
    const ahead = direction === "positive" ? 7 : -7;
    return `M${x - ahead} ${y - 7}L${x + ahead} ${y}L${x - ahead} ${y + 7}Z`;
}

const cross_path = (x, y) => `M${x - 6} ${y - 6}L${x + 6} ${y + 6}M${x - 6} ${y + 6}L${x + 6} ${y - 6}`;

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
        if (width < 120 || height < 60) return;
        const next = status.run_open && status.run?.next ? status.run.next.target : null;
        const count = accepted.points.length;
        const key = [accepted.run, count, accepted.points[count - 1]?.step, next, picked?.step, width, height, words.tag, words.text("no_points")].join("|");
        if (key === this.shown) return;
        this.shown = key;
        const { deviation } = axis_units(status.axis);
        const plot = plot_of(accepted.judged(), { width, height, factor: deviation.factor, next });
        this.dots = plot.dots;
        set_attribute(this.svg, "viewBox", `0 0 ${width} ${height}`);
        const latest = plot.dots.at(-1);
        const said = latest ? point_text(latest.point, status, words) : words.text("no_points");
        set_attribute(this.svg, "aria-label", `${words.text("points_accepted")}: ${count}. ${said}`);
        this.svg.replaceChildren(
            ...this.frame(plot, words.unit(deviation.unit), words),
            ...plot.dots.flatMap((dot) => this.dot(dot, picked)),
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
            ...plot.targets.map(({ target, x }) => make_svg("text", { x, y: plot.bottom + 24, "text-anchor": "middle" }, `P${target + 1}`)),
            make_svg("text", { x: 4, y: plot.bottom + 24 }, unit),
            ...(plot.next_x === null ? [] : [make_svg("line", { class: "next_line", x1: plot.next_x, x2: plot.next_x, y1: plot.top, y2: plot.bottom })]),
        ];
    }

    dot(dot, picked) {
        const mark = dot.counts
            ? make_svg("path", { class: dot.direction, d: arrow_path(dot.x, dot.y, dot.direction) })
            : make_svg("path", { class: "replaced", d: cross_path(dot.x, dot.y) });
        const ring = (name, r) => make_svg("circle", { class: name, cx: dot.x, cy: dot.y, r });
        return [mark, ...(dot.latest ? [ring("latest", 13)] : []), ...(picked?.step === dot.point.step ? [ring("picked_ring", 18)] : [])];
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
        const key = [accepted.run, accepted.points.length, words.tag, words.text("no_points")].join("|");
        if (key === this.shown) return;
        this.shown = key;
        const { deviation } = axis_units(status.axis);
        set_text(this.close_button, words.text("show_plot"));
        const heads = ["target_head", "side_head", "approach_head"].map((one) => words.text(one));
        heads.push(`${words.text("deviation")} ${words.unit(deviation.unit)}`);
        keep_children(this.head, heads.length, () => make("th")).forEach((one, nth) => set_text(one, heads[nth]));
        this.body.replaceChildren(...accepted.judged().map((one) => this.row(one, deviation.factor, words)));
    }

    row({ point, counts }, factor, words) {
        const button = make("button", "", [`P${point.target + 1}`]);
        button.type = "button";
        button.setAttribute("aria-label", `P${point.target + 1} ${words.text(`side_${point.direction}`)} ${point.approach + 1}`);
        button.addEventListener("click", () => this.pick(point));
        const number = number_text(point.deviation_um * factor, 2, { decimal_mark: words.decimal_mark, plus: true });
        const note = counts ? "" : ` (${words.text("point_replaced")})`;
        const texts = [words.text(`side_${point.direction}`), String(point.approach + 1), number + note];
        return make("tr", "", [make("td", "", [button]), ...texts.map((text) => make("td", "", [text]))]);
    }
}

/** @param {Point | null} picked @param {AcceptedPoints} accepted @returns {Point | null} as it stands in the run now */
export function still_picked(picked, accepted) {
    if (picked === null) return null;
    return accepted.points.find((one) => one.step === picked.step && place_of(one) === place_of(picked)) ?? null;
}
