// A value on the screen: number, unit, age, and its quality in shape, word and colour.

import { make, keep_children, set_attribute, set_text } from "./dom.js";
import { shapes } from "./freshness.js";

/** @typedef {import("./status_view.js").Shown} Shown */
/** @typedef {import("./catalogue.js").Catalogue} Catalogue */

/** @param {Element} parent @param {string} selector @returns {Element} */
function part(parent, selector) {
    return /** @type {Element} */ (parent.querySelector(selector));
}

/** @param {Shown} shown @param {Catalogue} words @returns {string} "● good · age 0 s" */
function quality_text(shown, words) {
    return `${shapes[shown.mark]} ${shown.word} · ${words.text("age_words", { age: shown.age })}`;
}

/** Where there is little room. */
function short_quality(shown) {
    return `${shapes[shown.mark]} ${shown.word} · ${shown.age}`;
}

function make_value(class_name) {
    return make("div", class_name, [
        make("span", "label"),
        make("span", "value", [make("span", "number"), " ", make("span", "unit")]),
        make("span", "mark"),
    ]);
}

/** With its word apart, for which there is not room everywhere. */
function make_side() {
    const side = make_value("value");
    side.append(make("span", "said"));
    return side;
}

/** @param {Element} element @param {Shown} shown */
function paint_value(element, shown) {
    set_attribute(element, "data-mark", shown.mark);
    set_text(part(element, ".label"), shown.label);
    set_text(part(element, ".number"), shown.text);
    set_text(part(element, ".unit"), shown.unit);
    set_text(part(element, ".mark"), short_quality(shown));
}

/** @param {Element} parent @param {{main: Shown, beside: Shown[]}} reading @param {Catalogue} words */
export function paint_reading(parent, reading, words) {
    if (parent.childElementCount === 0)
        parent.append(
            make("div", "big", [make("span", "label"), " ", make("span", "number"), " ", make("span", "unit")]),
            make("div", "beside"),
            make("div", "facts"),
        );
    const { main, beside } = reading;
    set_attribute(parent, "data-mark", main.mark);
    set_text(part(parent, ".big .label"), main.label);
    set_text(part(parent, ".big .number"), main.text);
    set_text(part(parent, ".big .unit"), main.unit);
    set_text(part(parent, ".facts"), quality_text(main, words));
    const sides = keep_children(part(parent, ".beside"), beside.length, make_side);
    sides.forEach((side, nth) => {
        paint_value(side, beside[nth]);
        set_text(part(side, ".label"), `${beside[nth].label} `);
        set_text(part(side, ".mark"), ` ${shapes[beside[nth].mark]}`);
        set_text(part(side, ".said"), beside[nth].word); // its age is that of the reading
    });
}

/** @param {Element} parent @param {Shown[]} cells */
export function paint_cells(parent, cells) {
    keep_children(parent, cells.length, () => make_value("cell")).forEach((cell, nth) => paint_value(cell, cells[nth]));
}

const arrows = Object.freeze({ positive: "▶", negative: "◀" });

/** @param {Element} parent @param {ReturnType<typeof import("./status_view.js").next_shown>} next @param {Catalogue} words */
export function paint_next(parent, next, words) {
    if (parent.childElementCount === 0)
        parent.append(make("div", "word"), make("div", "target"), make("div", "side"));
    set_attribute(parent, "data-direction", next.direction);
    set_text(part(parent, ".word"), [words.text("next"), next.approach].filter(Boolean).join(" · "));
    set_text(part(parent, ".target"), [next.target, next.place].filter(Boolean).join(" = "));
    set_text(part(parent, ".side"), `${arrows[next.direction] ?? ""} ${next.side}`.trim());
}

/** @param {Element} parent @param {ReturnType<typeof import("./status_view.js").run_shown>} run @param {string[]} extra  of the last order */
export function paint_so_far(parent, run, extra) {
    const line = (text, name, title = "") => ({ text, name, title });
    const lines = [
        ...extra.map((text) => line(text, "fault")),
        line(run.state, "state"),
        ...run.lines.map((text) => line(text, "line")),
        line(run.sentence, run.fault ? "fault" : "remark"),
        ...run.so_far.map(({ text, basis }) => line(text, "remark", basis)),
        line(run.title, "title"),
    ].filter(({ text }) => text !== "");
    keep_children(parent, lines.length, () => make("div")).forEach((element, nth) => {
        const { text, name, title } = lines[nth];
        set_text(element, text);
        set_attribute(element, "class", name);
        set_attribute(element, "title", title === "" ? null : title);
    });
}
