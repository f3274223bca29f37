// The station's list of what to do (docs/to-do.md), as it sends it. This page judges nothing of it. No DOM.

import { since_text } from "./time_text.js";

/**
 * @typedef {object} Task
 * @property {string} id  stays the same as long as the trouble lasts
 * @property {"stop" | "look" | "note"} rank  the run cannot go on; a result may suffer; to know
 * @property {string} seen  what is seen
 * @property {string} since_utc  ISO time; empty: not known
 * @property {string} next  the one action
 * @property {string} command  the shell's line that does it; empty: none does
 * @property {string} undo  the line that undoes that; empty: nothing does
 */

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */

const rank_shapes = Object.freeze({ stop: "✕", look: "▲", note: "–" });

/** @param {any} status  of a daemon of before, too, which sends no list @returns {Task[]} what holds the CNC first */
export function what_to_do(status) {
    return status.to_do ?? [];
}

/** What is seen, and the one thing to do next: for the strip. @param {Task} task @param {Catalogue} words */
export function task_line(task, words) {
    return `${task_head(task, words)} ${task.next}`;
}

/** @param {Task} task @param {Catalogue} words */
export function task_head(task, words) {
    const since = task.since_utc === "" ? "" : ` (${words.text("since", { time: since_text(task.since_utc, words) })})`;
    return `${rank_shapes[task.rank]} ${words.text(`rank_${task.rank}`)}: ${task.seen}${since}`;
}

/**
 * What stands below its head, each with the class of its line: the action, its command, and its undo, which is named so.
 * @param {Task} task @param {Catalogue} words @returns {[string, string][]}
 */
export function task_lines(task, words) {
    /** @type {[string, string][]} */
    const lines = [[`→ ${task.next}`, "action"]];
    if (task.command !== "" && !task.next.includes(task.command)) lines.push([task.command, "command"]);
    if (task.undo !== "") lines.push([words.text("undo", { command: task.undo }), "command"]);
    return lines;
}
