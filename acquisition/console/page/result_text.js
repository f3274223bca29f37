// What Result and History say of a stored run. Verdicts, figures and reasons are those of the certificate; the page judges
// nothing. No DOM.

import { is_number } from "./freshness.js";
import { no_number, number_text } from "./number_text.js";
import { paper_path } from "./stored_runs.js";
import { date_text } from "./time_text.js";

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {import("./stored_runs.js").StoredRun} StoredRun */
/** @typedef {import("./stored_runs.js").StoredResult} StoredResult */
/** @typedef {import("./stored_runs.js").Figure} Figure */
/** @typedef {{shape: string, word: string, verdict: string}} Said */

const verdict_shapes = Object.freeze({ pass: "✓", fail: "✕", not_provable: "▲", not_evaluated: "–" });

/** A verdict as a shape and a word; one that this page does not know as it came. @param {string} verdict @param {Catalogue} words @returns {Said} */
function said_verdict(verdict, words) {
    if (!Object.hasOwn(verdict_shapes, verdict)) return { shape: "–", word: verdict, verdict: "other" };
    return { shape: verdict_shapes[verdict], word: words.text(`verdict_${verdict}`), verdict };
}

/** What stands first: the verdict, or why there is none. @param {StoredRun} run @param {Catalogue} words @returns {Said} */
export function verdict_of(run, words) {
    if (run.status === "open") return { shape: "◐", word: words.text("stored_open"), verdict: "none" };
    if (run.status === "incomplete") return { shape: "▲", word: words.text("stored_incomplete"), verdict: "none" };
    if (run.status !== "complete") return { shape: "✕", word: words.text("stored_unreadable"), verdict: "none" };
    if (run.paper === "none") return { shape: "–", word: words.text("no_certificate"), verdict: "none" };
    if (run.verdict === "") return { shape: "–", word: words.text("no_limits"), verdict: "none" };
    return said_verdict(run.verdict, words);
}

/** From the unit of a certificate to that of its paper. @param {string} unit */
export function paper_unit(unit) {
    if (unit === "mm") return { factor: 1000, unit: "µm" };
    if (unit === "deg") return { factor: 3600, unit: "″" };
    if (unit === "arcsec") return { factor: 1, unit: "″" };
    return { factor: 1, unit: unit.replace(/^um/, "µm") };
}

const decimals = 2; // as on the paper

/** Away from zero: no U is told smaller than it is. */
const up = (value) => Math.ceil(value * 10 ** decimals - 1e-9) / 10 ** decimals;

function number_of(value, words) {
    return is_number(value) ? number_text(value, decimals, { decimal_mark: words.decimal_mark }).trim() : no_number;
}

/** "A ↑" of "A_forward": upward arrows are approaches from smaller coordinates, as on the paper. @param {string} name */
export function parameter_text(name) {
    return name.replace(/_forward$/, " ↑").replace(/_backward$/, " ↓").replaceAll("_", " ");
}

/** "R 4.60 ± 1.20 µm" @param {Figure} figure @param {string} unit @param {Catalogue} words */
export function figure_text(figure, unit, words) {
    const { factor, unit: shown } = paper_unit(unit);
    const value = is_number(figure.value) ? number_of(figure.value * factor, words) : no_number;
    const spread = is_number(figure.U) ? ` ± ${number_of(up(figure.U * factor), words)}` : "";
    return `${parameter_text(figure.parameter)} ${value}${spread} ${words.unit(shown)}`;
}

/** A figure with its limit and verdict, in the certificate's own words. @param {Figure} figure @param {string} unit @param {Catalogue} words */
function limit_line(figure, unit, words) {
    const { factor } = paper_unit(unit);
    const said = said_verdict(figure.verdict, words);
    const without_U = is_number(figure.U) ? "" : ` (${words.text("without_U")})`;
    const limit = is_number(figure.limit) ? words.text("limit_words", { limit: number_of(figure.limit * factor, words) }) : words.text("limit_unknown");
    const reason = figure.reason === "" ? "" : `: ${figure.reason}`;
    return { ...said, text: `${figure_text(figure, unit, words)}${without_U}, ${limit}: ${said.word}${reason}` };
}

const joined = (parts) => parts.filter((part) => part !== "").join(" · ");

/** "M-10442 (4711) · X · as found · positioning" @param {StoredRun} run @param {Catalogue} words */
function subject_of(run, words) {
    const serial = run.machine_serial === "" || run.machine_serial === run.machine ? "" : `(${run.machine_serial})`;
    const kind = run.kind === "" ? "" : words.text(`kind_${run.kind}`);
    return joined([[run.machine, serial].filter((part) => part !== "").join(" "), run.axis, run.machine_state, kind]);
}

/** @param {StoredRun} run @param {Catalogue} words */
function counts_of(run, words) {
    const left_out = run.left_out > 0 ? words.text("excluded", { count: run.left_out }) : "";
    const points = run.planned > 0 ? words.text("points_done", { done: run.points, of: run.planned }) : "";
    return joined([points, left_out]);
}

const most_figures_in_row = 4;

/** @param {StoredRun} run @param {Catalogue} words */
function row_figures(run, words) {
    const judged = run.figures.filter(({ verdict }) => verdict !== "");
    const shown = (judged.length > 0 ? judged : run.figures).slice(0, most_figures_in_row);
    return shown.map((figure) => figure_text({ ...figure, U: null }, run.unit, words)).join(" · ");
}

/** A row of History. @param {StoredRun} run @param {Catalogue} words */
export function row_of(run, words) {
    const said = verdict_of(run, words);
    const paper = run.paper === "none" ? "" : words.text(`paper_${run.paper}`);
    return {
        id: run.id,
        said,
        head: joined([date_text(run.started_utc, words), subject_of(run, words)]) || run.id,
        line: joined([row_figures(run, words), counts_of(run, words), paper, run.sentence]),
    };
}

/** @param {StoredResult} run @param {Catalogue} words */
function papers_of(run, words) {
    return run.papers.map(({ name, bytes }) => ({
        href: paper_path(run.id, name),
        opens: name.endsWith(".pdf"),
        text: words.text("paper_link", { name: name.endsWith(".axiscal") ? words.text("run_file") : name.replace(/^certificate\./, "").toUpperCase(), size: size_text(bytes, words) }),
    }));
}

/** @param {number} bytes @param {Catalogue} words */
function size_text(bytes, words) {
    const million = bytes >= 1e6;
    const size = number_text(bytes / (million ? 1e6 : 1e3), million ? 1 : 0, { decimal_mark: words.decimal_mark }).trim();
    return `${size} ${million ? "MB" : "kB"}`;
}

/**
 * The screen Result as texts. Without a verdict there is no line with one.
 * @param {StoredResult} run @param {Catalogue} words
 */
export function result_of(run, words) {
    const said = verdict_of(run, words);
    const judged = run.verdict === "" ? [] : run.figures.filter(({ verdict }) => verdict !== "");
    const others = run.figures.filter((figure) => !judged.includes(figure));
    const agreed = run.verdict === "" ? "" : words.text("limits_agreed", { limits: run.limits, rule: run.rule });
    const remarks = run.certificate?.run?.remarks;
    return {
        title: joined([subject_of(run, words), date_text(run.started_utc, words), run.standard, run.number]),
        counts: counts_of(run, words),
        said,
        limits: judged.map((figure) => limit_line(figure, run.unit, words)),
        figures: others.map((figure) => figure_text(figure, run.unit, words)),
        notes: [run.sentence, run.paper_sentence, agreed].filter((text) => text !== ""),
        remarks: Array.isArray(remarks) ? remarks.filter((text) => typeof text === "string") : [],
        papers: papers_of(run, words),
    };
}
