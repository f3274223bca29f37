// How the run stands, in the station's own words and figures (docs/api.md, So far). Never a statement of conformity: that
// needs U, a decision rule and a complete run, and stands on the certificate. No DOM.

import { is_number } from "./freshness.js";
import { number_text } from "./number_text.js";

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {{text: string, basis: string}} SoFarLine  basis: what the figures are, and what they lack; empty: no figure */
/** @typedef {{factor: number, unit: string}} Unit  from µm to what is shown */

/** @param {any} run @param {boolean} open @param {Unit} unit @param {Catalogue} words @returns {SoFarLine[]} */
export function so_far_lines(run, open, unit, words) {
    const without_figure = (key) => [{ text: words.text(key), basis: "" }];
    if (run.certificate !== "") return without_figure("on_certificate");
    const so_far = run.so_far ?? null; // a station of before has none
    if (so_far === null) return open ? without_figure("no_verdict") : [];
    const texts = [so_far.sentence, limits_text(so_far), figures_text(so_far, unit, words)];
    return texts.filter((text) => text !== "").map((text) => ({ text, basis: so_far.basis }));
}

/** All of them in words: most hold for a width that no plot shows (plot_limits.js has the others). */
function limits_text(so_far) {
    return so_far.limits.map(({ sentence }) => sentence).join(" · ");
}

/** Those without a limit; before there are any, what no standard names. */
function figures_text(so_far, unit, words) {
    const number = (um) => number_text(um * unit.factor, 2, { decimal_mark: words.decimal_mark }).trim();
    const with_unit = (um) => ({ number: number(um), unit: words.unit(unit.unit) });
    if (so_far.figures === null) {
        const range = is_number(so_far.deviation_range_um) ? [words.text("range_so_far", with_unit(so_far.deviation_range_um))] : [];
        const reversal = is_number(so_far.reversal_max_um) ? [words.text("reversal_so_far", with_unit(so_far.reversal_max_um))] : [];
        return [...range, ...reversal].join(" · ");
    }
    const judged = new Set(so_far.limits.filter(({ value_um }) => is_number(value_um)).map(({ parameter }) => parameter));
    const others = so_far.figures.filter(({ parameter }) => !judged.has(parameter));
    if (others.length === 0) return "";
    const figures = others.map(({ parameter, value_um }) => `${parameter} ${number(value_um)}`).join(" · ");
    return words.text("figures_so_far", { standard: so_far.standard, figures, unit: words.unit(unit.unit) });
}
