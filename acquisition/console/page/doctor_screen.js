// The screen Doctor: the one list of what to do, and what one browser may choose for itself.

import { languages, pseudo_language } from "./catalogue.js";
import { make, set_attribute } from "./dom.js";
import { themes } from "./settings.js";
import { task_head, task_lines } from "./what_to_do.js";

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */
/** @typedef {import("./what_to_do.js").Task} Task */

let tasks_shown = "";

/** What to do, and below it what people were told, the latest first. @param {HTMLElement} place @param {Task[]} tasks @param {string[]} notes @param {boolean} contact  without it nobody knows @param {Catalogue} words */
export function paint_tasks(place, tasks, notes, contact, words) {
    const key = JSON.stringify([contact, words.text("what_to_do"), words.tag, tasks, notes]);
    if (key === tasks_shown) return;
    tasks_shown = key;
    const rows = tasks.map((task) => task_row(task, words));
    const told = notes.map((note) => make("li", "", [note])).reverse();
    place.replaceChildren(
        make("h2", "", [words.text("what_to_do")]),
        make("ul", "to_do", rows.length === 0 ? [make("li", "", [contact ? `● ${words.text("all_well")}` : `– ${words.text("off_no_contact")}`])] : rows),
        ...(told.length === 0 ? [] : [make("h2", "", [words.text("told")]), make("ul", "told", told)]),
    );
}

/** @param {Task} task @param {Catalogue} words */
function task_row(task, words) {
    const lines = task_lines(task, words).map(([text, kind]) => make("div", kind, [text]));
    const row = make("li", "", [make("div", "seen", [task_head(task, words)]), ...lines]);
    row.dataset.rank = task.rank;
    row.dataset.id = task.id;
    return row;
}

/**
 * @param {HTMLElement} place
 * @param {{language: string, theme: string, version: string, session: import("./pairing.js").Session, rights_said: string}} chosen
 * @param {{choose: (name: "language" | "theme", value: string) => void, pair: () => void, unpair: () => void}} does
 * @param {Catalogue} words
 */
export function make_settings(place, chosen, does, words) {
    const names = { en: "English", de: "Deutsch", ru: "Русский", zh: "中文", [pseudo_language]: words.text("pseudo") };
    const button = (name, value, text, lang) => {
        const made = make("button", "", [text]);
        made.type = "button";
        if (lang) made.lang = lang;
        set_attribute(made, "aria-pressed", String(chosen[name] === value));
        made.addEventListener("click", () => does.choose(name, value));
        return made;
    };
    const focused = [...place.querySelectorAll("button")].findIndex((one) => one === document.activeElement);
    place.replaceChildren(
        ...rights_of(chosen, does, words),
        make("p", "", [words.text("language")]),
        ...[...languages, pseudo_language].map((one) => button("language", one, names[one], one === "zh" ? "zh-Hans" : languages.includes(one) ? one : "")),
        make("p", "", [words.text("theme")]),
        ...themes.map((one) => button("theme", one, words.text(`theme_${one}`), "")),
        make("p", "", [words.text("version", { version: chosen.version })]),
    );
    if (focused >= 0) place.querySelectorAll("button")[focused].focus(); // keys go on from where they were
}

/** Who may order, the one thing to do about it, and why that failed. @param {{session: import("./pairing.js").Session, rights_said: string}} chosen */
function rights_of({ session, rights_said }, does, words) {
    const paired = session.paired && session.name !== "";
    const made = make("button", "", [words.text(paired ? "unpair" : "pair")]);
    made.type = "button";
    made.addEventListener("click", paired ? does.unpair : does.pair);
    const told = paired ? words.text("paired_as", { name: session.name }) : session.how;
    const said = make("p", "answer", [rights_said]);
    said.setAttribute("role", "alert");
    return [make("p", "", [words.text("rights")]), make("p", "rights", [told]), made, said];
}
