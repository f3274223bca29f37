// The screen Result: verdict first, then limits, plot and papers.

import { AcceptedPoints } from "./accepted_points.js";
import { kept_focus, make, set_attribute, set_text } from "./dom.js";
import { axis_units, no_number, number_text } from "./number_text.js";
import { PlotView, TableView, point_text } from "./plot_view.js";
import { points_of_certificate } from "./result_points.js";
import { result_of } from "./result_text.js";

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {import("./stored_runs.js").StoredResult} StoredResult */
/** @typedef {{head: HTMLElement, said: HTMLElement, plot: HTMLElement, table: HTMLElement, papers: HTMLElement}} Places */

export class ResultView {
    /** @param {Places} places */
    constructor(places) {
        this.places = places;
        this.readings = new AcceptedPoints();
        /** @type {any} as far as plot and table ask for one */
        this.status = { axis: { kind: "linear" }, run: null, run_open: false };
        /** @type {import("./result_points.js").MeanRow[]} */
        this.means = [];
        /** @type {import("./accepted_points.js").Point | null} */
        this.picked = null;
        this.plot = new PlotView(places.plot, (point) => (this.picked = point));
        this.table = new TableView(places.table, (point) => this.pick(point), () => (places.table.hidden = true));
        this.mean_table = make("table");
        places.table.append(this.mean_table);
        this.picked_line = make("p", "picked");
        this.table_button = this.button_to_table();
        this.shown = "";
        this.has_plot = false;
    }

    button_to_table() {
        const button = make("button", "table_button");
        button.type = "button";
        button.addEventListener("click", (event) => {
            event.stopPropagation(); // it lies on the plot
            this.places.table.hidden = false;
        });
        this.places.plot.append(button);
        return button;
    }

    pick(point) {
        this.picked = point;
        this.places.table.hidden = true;
    }

    /** Another run, or the same with another certificate. @param {StoredResult} result */
    take(result) {
        // First, also where the certificate is odd: nothing of what was shown before stands beside it.
        this.has_plot = false;
        this.shown = "";
        this.places.table.hidden = true;
        this.picked = null;
        const found = points_of_certificate(result.certificate);
        this.means = found?.means ?? [];
        const run = found && { id: found.event.run, so_far: { limits: found.limits } };
        this.status = { axis: found?.axis ?? { kind: "linear" }, run, run_open: false };
        this.readings.take(found?.event ?? { run: null, count: 0, from: 0, points: [] });
        this.has_plot = found !== null;
    }

    /** @param {StoredResult | null} result @param {string} sentence  where there is none @param {Catalogue} words */
    paint(result, sentence, words) {
        const key = JSON.stringify([result?.id, this.readings.version, sentence, words.tag, words.text("result_none")]);
        const shown = this.shown;
        this.shown = key; // what can not be drawn is tried once
        if (key !== shown) this.paint_texts(result, sentence, words);
        this.places.plot.hidden = result === null || !this.has_plot;
        if (this.places.plot.hidden) return;
        set_text(this.table_button, words.text("show_table"));
        set_text(this.picked_line, this.picked === null ? "" : words.text("picked", { point: point_text(this.picked, this.status, words) }));
        this.plot.paint(this.readings, this.status, this.picked, words);
        if (!this.places.table.hidden) this.table.paint(this.readings, this.status, words);
    }

    paint_texts(result, sentence, words) {
        const { head, said, papers } = this.places;
        const focus_again = kept_focus(papers, (one) => one.getAttribute("href"));
        for (const place of [head, said, papers]) place.replaceChildren(); // nothing of another run stays
        if (result === null) return head.replaceChildren(make("div", "title", [sentence]));
        const texts = result_of(result, words);
        const verdict = make("div", "verdict", [make("span", "shape", [texts.said.shape]), " ", texts.said.word]);
        set_attribute(verdict, "data-verdict", texts.said.verdict);
        set_attribute(verdict, "role", "status");
        head.replaceChildren(verdict, make("div", "title", [texts.title]), make("div", "counts", [texts.counts]));
        said.replaceChildren(...this.lines(texts, words), this.picked_line);
        papers.replaceChildren(...texts.papers.map(link_to));
        focus_again();
        this.paint_means(words);
    }

    lines(texts, words) {
        const limits = texts.limits.map(({ shape, text, verdict }) => {
            const row = make("li", "", [`${shape} ${text}`]);
            row.dataset.verdict = verdict;
            return row;
        });
        const paragraph = (text) => make("p", "", [text]);
        const remarks = texts.remarks.map((text) => make("li", "", [text]));
        return [
            ...(limits.length === 0 ? [] : [make("ul", "limits", limits)]),
            ...(texts.figures.length === 0 ? [] : [make("p", "figures", texts.figures.flatMap((text) => [make("span", "", [text]), " "]))]),
            ...texts.notes.map(paragraph),
            ...(remarks.length === 0 ? [] : [make("h2", "", [words.text("remarks")]), make("ul", "remarks", remarks)]),
        ];
    }

    /** The means of the plot as numbers. */
    paint_means(words) {
        const { deviation, coordinate } = axis_units(this.status.axis);
        const style = { decimal_mark: words.decimal_mark };
        const number = (um) => number_text(um === null ? null : um * deviation.factor, 2, style);
        const unit = words.unit(deviation.unit);
        const head = (side) => [`${words.text("mean_head")} ${side} ${unit}`, `s ${side} ${unit}`];
        const heads = [words.text("target_head"), `${words.text("place_head")} ${words.unit(coordinate)}`,
            ...head(words.text("side_positive")), ...head(words.text("side_negative"))];
        const rows = this.means.map(({ target, place, positive, negative }) => [
            `P${target + 1}`, place === undefined ? no_number : number_text(place, 3, style),
            ...[positive, negative].flatMap(({ mean_um, s_um }) => [number(mean_um), number(s_um)]),
        ]);
        const cells = (name, texts) => make("tr", "", texts.map((text) => make(name, "", [text])));
        this.mean_table.replaceChildren(make("thead", "", [cells("th", heads)]), make("tbody", "", rows.map((row) => cells("td", row))));
        this.mean_table.hidden = rows.length === 0;
    }
}

/** A PDF opens beside the page, which stays; what is no PDF is kept. @param {{href: string, opens: boolean, text: string}} paper */
function link_to({ href, opens, text }) {
    const link = make("a", "", [text]);
    link.href = href;
    if (opens) {
        link.target = "_blank";
        link.rel = "noopener";
    } else link.download = "";
    return link;
}
