// The page: hears the station, and shows what it says. Everything that can be judged without a browser stands in the
// modules beside this one.

import { AcceptedPoints, still_picked } from "./accepted_points.js";
import { buttons_of } from "./actions.js";
import { Catalogue, choose_language, pseudo_language, pseudo_table } from "./catalogue.js";
import { SleeplessClock } from "./clock.js";
import { by_id, make, set_attribute, set_text } from "./dom.js";
import { EventLink } from "./event_link.js";
import { KeptValues } from "./freshness.js";
import { LinkState } from "./link_state.js";
import { OrderBar } from "./order_bar.js";
import { arming_fields, arming_of, override_fields, revising_fields, revision_of, without_empty } from "./order_fields.js";
import { OrderSheet, answer_text } from "./order_sheet.js";
import { delete_order, lacks_rights, send_order } from "./orders.js";
import { ask_session, not_asked, refusal_of } from "./pairing.js";
import { PlotView, TableView, point_text } from "./plot_view.js";
import { remember, remembered, use_theme } from "./settings.js";
import { cells_shown, keep, next_shown, reading_shown, run_shown, state_text } from "./status_view.js";
import { TouchGuard } from "./touch_guard.js";
import { paint_cells, paint_next, paint_reading, paint_so_far } from "./value_view.js";
import { Wakefulness } from "./wakefulness.js";
import { task_line, what_to_do } from "./what_to_do.js";

const tick_ms = 80; // stale values are marked within 2.1 s of their last reading
const paint_every_ms = 160; // nobody reads what changes faster
const calm_until_ms = 1500; // nothing is stale before 2 s
const load_later_after_ms = 30000;
const checks_every_ms = 60000; // and whenever somebody goes to a screen that shows what arming would meet

const clock = new SleeplessClock(
    () => performance.now(),
    () => Date.now(),
);
const now = () => clock.now();
const started_at = now();
const link = new LinkState(now());
const wake = new Wakefulness(now());
// Letters on History search and do nothing else: a barcode must not lose its first one.
const guard = new TouchGuard(wake, now, ({ key }) => shown.screen === "history" && key.length === 1 && key !== " ");
const kept = new KeptValues();
const accepted = new AcceptedPoints();

/** What is shown; nothing of it is decided here. */
const shown = {
    /** @type {any} */ status: null,
    status_at: 0,
    painted_at: -Infinity,
    heard_wall: Date.now(),
    checks_at: -checks_every_ms,
    /** @type {import("./setup_text.js").Judged | null} */ judged: null,
    screen: "now",
    /** @type {import("./accepted_points.js").Point | null} */ picked: null,
    revises: false, // the open sheet is about the picked point
    session: not_asked(),
    contact: false,
    message: "",
    rights_are_new: false, // since the settings were painted
    rights_said: "", // what the station answered to an end of the pairing that failed
    version: "",
};

/** @type {Catalogue} */
let words = new Catalogue({});
let language = choose_language(remembered("language"), navigator.languages ?? []);
let theme = remembered("theme") ?? "auto";

// --- what the station says ---------------------------------------------------------------------

/** @param {import("./event_text.js").StationEvent} event */
function take(event) {
    shown.heard_wall = Date.now();
    if (event.event === "status") take_status(JSON.parse(event.data));
    if (event.event === "points") return take_points(JSON.parse(event.data));
    return true;
}

function take_status(status) {
    if (shown.status !== null && shown.status.station !== status.station) kept.clear();
    shown.version ||= status.version;
    shown.status = status;
    shown.status_at = now();
    keep(status, kept);
}

/** With the first word of the station, when it is back (it may have forgotten this browser), and when it refused an order. */
async function ask_rights() {
    const session = await ask_session((path, options) => fetch(path, options));
    shown.session = session ?? shown.session;
    shown.rights_are_new = true; // a finger may lie on the settings
}

function take_points(event) {
    const run = accepted.run;
    if (!accepted.take(event)) return false;
    if (accepted.run !== run) {
        forget_picked(); // the same place of another run is another point
        shown.message = "";
    }
    const picked = still_picked(shown.picked, accepted);
    if (shown.picked !== null && picked === null) forget_picked();
    shown.picked = picked;
    const last = event.points.at(-1);
    if (event.from > 0 && last && shown.status !== null)
        set_text(by_id("spoken"), words.text("point_accepted", { point: point_text(last, shown.status, words) }));
    return true;
}

function forget_picked() {
    if (sheet.is_open() && shown.revises) sheet.close();
    shown.picked = null;
}

const events = new EventLink({
    link,
    now,
    take,
    fetcher: (path, options) => fetch(path, options),
    later: (call, ms) => setTimeout(call, ms),
});

/** While somebody looks and no run is open, the station judges anew what arming would meet, and puts it into its list. */
async function judge_checks(at) {
    if (shown.status?.run_open) judge_again(); // once it is closed
    const wanted = ["run", "setup", "doctor"].includes(shown.screen) && shown.status !== null && !shown.status.run_open && link.has_contact(at);
    if (!wanted || at - shown.checks_at < checks_every_ms) return;
    shown.checks_at = at;
    try {
        const { ask_checks } = await import("./setup_text.js");
        shown.judged = await ask_checks((path, options) => fetch(path, options), now());
    } catch {
        // The strip tells of a link that is lost.
    }
}

function judge_again() {
    shown.checks_at = -checks_every_ms;
}

// --- orders ------------------------------------------------------------------------------------

const sheet = new OrderSheet(by_id("run_sheet"), (text) => (shown.message = text));
const bar = new OrderBar(by_id("run_orders"), give);

/** @param {import("./order_bar.js").Asked} order */
function give(order) {
    if (order === "pair") return pair();
    const by = remembered("by") ?? "";
    const { picked } = shown;
    shown.revises = order === "retake" || order === "exclude";
    if (order === "abort") return void send_at_once("/v1/run/abort", without_empty({ by }), order);
    if (order === "trigger") return void send_at_once("/v1/run/trigger", null, order);
    if (order === "arm") {
        const fields = arming_fields(shown.status, by, words);
        return sheet.open(words.text(order), fields, (values) => send("/v1/run", arming_of(values)), words, (answer) => override_fields(answer, words));
    }
    if (picked === null) return;
    /** @param {Record<string, string | number>} typed */
    const revise = ({ reason, by: who }) => send(`/v1/run/${order}`, revision_of(picked, String(reason), String(who)));
    sheet.open(`${words.text(order)}: ${point_text(picked, shown.status, words)}`, revising_fields(by, words), revise, words);
}

/** The code is shown at the station; what it answers to a wrong one stands on the sheet. */
function pair() {
    const code = { name: "code", label: words.text("pair_code"), kind: /** @type {const} */ ("code") };
    shown.revises = false;
    if (shown.screen !== "run") go_to("run"); // where the sheet lies
    sheet.open(words.text("pair"), [code], async (values) => {
        const answer = await send("/v1/session", values);
        if (answer.done) await ask_rights();
        return answer;
    }, words);
}

async function unpair() {
    const answer = link.has_contact(now()) ? await delete_order("/v1/session", (input, options) => fetch(input, options)) : no_contact();
    await ask_rights(); // an order without an answer may have been carried out
    shown.rights_said = answer.done || !shown.session.paired ? "" : answer_text(answer, words.text("unpair"), words);
}

/** A sheet may have been opened while there was contact. */
const no_contact = () => ({ done: false, status: -1, sentence: words.text("off_no_contact"), body: null });

async function send(path, body) {
    if (!link.has_contact(now())) return no_contact();
    if (body?.by) remember("by", String(body.by));
    const answer = await send_order(path, body, (input, options) => fetch(input, options));
    if (lacks_rights(answer) && path !== "/v1/session") await ask_rights();
    return answer;
}

async function send_at_once(path, body, order) {
    shown.message = words.text("order_waits");
    shown.message = answer_text(await send(path, body), words.text(order === "abort" ? "abort_order" : order), words);
}

// --- screens -----------------------------------------------------------------------------------

function pick(point) {
    shown.picked = point;
    by_id("run_table").hidden = true;
}

const now_plot = new PlotView(by_id("now_plot"), null);
const run_plot = new PlotView(by_id("run_plot"), pick);
const table = new TableView(by_id("run_table"), pick, () => (by_id("run_table").hidden = true));
const table_button = document.createElement("button");
table_button.type = "button";
table_button.className = "table_button";
table_button.addEventListener("click", (event) => {
    event.stopPropagation(); // it lies on the plot
    by_id("run_table").hidden = false;
});
by_id("run_plot").append(table_button);

const screens = Object.freeze(["now", "setup", "run", "result", "history", "doctor"]);
const shows_stored = () => shown.screen === "result" || shown.screen === "history";
/** @type {import("./stored_screens.js").StoredScreens | null} */
let stored = null;
/** @type {import("./setup_screen.js").SetupScreen | null} */
let setup = null;
/** @type {typeof import("./doctor_screen.js") | null} */
let doctor = null;
let later_asked = false;

/** What is neither Now nor Run is loaded by who goes there, or a while later: the first screen is not to wait for them. */
async function load_later() {
    if (later_asked || !link.has_contact(now())) return;
    later_asked = true;
    try {
        const [{ SetupScreen }, { StoredScreens }, doctor_screen] = await Promise.all([
            import("./setup_screen.js"), import("./stored_screens.js"), import("./doctor_screen.js"), later_style(),
        ]);
        setup = new SetupScreen(judge_again, send);
        doctor = doctor_screen;
        paint_settings();
        stored = new StoredScreens((path, options) => fetch(path, options), go_to);
        stored.enter(shown.screen, "now");
        paint(now());
    } catch {
        later_asked = false; // the next tick tries again
    }
}

/** @returns {Promise<Event>} once it holds */
function later_style() {
    return new Promise((done, failed) => {
        const link = make("link");
        link.rel = "stylesheet";
        link.href = "/page/later.css";
        link.onload = done;
        link.onerror = (event) => {
            link.remove();
            failed(event);
        };
        document.head.append(link);
    });
}

/** @param {string} screen */
function go_to(screen) {
    const before = shown.screen;
    if (before !== screen) {
        judge_again();
        shown.message = ""; // it was about what somebody did there
        shown.rights_said = "";
    }
    if (before === "setup" && screen !== "setup") setup?.leave();
    shown.screen = screen;
    for (const name of screens) by_id(`screen_${name}`).hidden = name !== screen;
    for (const button of document.querySelectorAll("nav button"))
        set_attribute(button, "aria-current", button.getAttribute("data-screen") === screen ? "page" : null);
    if (screen === "doctor") paint_settings();
    stored?.enter(screen, before);
    paint(now());
}

function paint_settings() {
    shown.rights_are_new = false;
    const { session, version, rights_said } = shown;
    doctor?.make_settings(by_id("doctor_settings"), { language, theme, version, session, rights_said }, { choose, pair, unpair }, words);
}

/** One strip: the link, else the worst of what to do. Notes are for the list alone. */
function paint_strip(view, all_tasks) {
    const tasks = all_tasks.filter(({ rank }) => rank !== "note");
    const strip = by_id("strip");
    const text = by_id("strip_text");
    const about_link = view.strip !== "none";
    const first = tasks[0];
    const rank = about_link ? "link" : (first?.rank ?? "well");
    set_attribute(strip, "data-rank", rank);
    set_attribute(text, "role", rank === "link" || rank === "stop" ? "alert" : "status");
    set_text(by_id("strip_shape"), about_link ? "✕" : first ? "" : "●");
    set_text(text, about_link ? link_text(view) : first ? task_line(first, words) : words.text("all_well"));
    const more = tasks.length - (about_link ? 0 : 1);
    set_text(by_id("strip_more"), more > 0 ? words.text("more_tasks", { count: more }) : "");
}

function link_text(view) {
    const time = new Intl.DateTimeFormat(words.date_tag, { hour: "2-digit", minute: "2-digit", second: "2-digit", timeZoneName: "short" });
    const said = words.text(`strip_${view.strip}`, { time: time.format(shown.heard_wall) });
    return view.refusal === "" ? said : `${said} ${view.refusal}`;
}

function paint_head(status) {
    set_text(by_id("station"), `${status.station} · ${status.axis.name}`);
    const state = status.run === null ? words.text("run_none") : state_text(status.run.state, words);
    set_text(by_id("head_state"), state);
}

/** Fresh values wait for the second tick; what is about to be stale is looked at with each. @param {number} at */
function may_wait(at) {
    const { status, painted_at } = shown;
    // The second tick may be a little less late than the first.
    if (status === null || at - painted_at >= paint_every_ms - tick_ms / 2 || !link.has_contact(at)) return false;
    return at - shown.status_at + 1000 * (status.axis.age_s ?? Infinity) < calm_until_ms;
}

/** @param {number} at */
function paint(at) {
    shown.painted_at = at;
    const view = link.view(at);
    document.documentElement.classList.toggle("no-contact", !view.contact);
    if (view.contact && !shown.contact) ask_rights();
    shown.contact = view.contact;
    const { status } = shown;
    const tasks = status === null ? [] : what_to_do(status);
    if (status !== null || view.strip !== "none") paint_strip(view, tasks);
    if (status === null) return;
    paint_head(status);
    const heard = { contact: view.contact, status_age_ms: at - shown.status_at };
    if (shown.screen === "doctor") return guard.is_pressed() ? undefined : paint_doctor(tasks, status.notes, view.contact);
    if (shown.screen === "setup") return setup?.paint(status, kept, heard, { judged: shown.judged, at, pressed: guard.is_pressed(), refusal: refusal_of(shown.session) }, words);
    stored?.hear(shown.screen, status, view.contact);
    const name = shown.screen;
    if (shows_stored()) return guard.is_pressed() ? undefined : stored?.paint(name, words);
    paint_reading(by_id(`${name}_reading`), reading_shown(status, kept, heard, words), words);
    paint_next(by_id(`${name}_next`), next_shown(status, words), words);
    if (name === "run") paint_orders(status, view.contact);
    else paint_now_cells(cells_shown(status, kept, heard, words));
    if (guard.is_pressed()) return; // nothing moves under a finger
    const extra = name === "run" ? [shown.message, refusal_of(shown.session)].filter((line, nth, all) => line !== "" && all.indexOf(line) === nth) : [];
    paint_so_far(by_id(`${name}_so_far`), run_shown(status, words), extra);
    (name === "run" ? run_plot : now_plot).paint(accepted, status, shown.picked, words);
    if (name === "run" && !by_id("run_table").hidden) table.paint(accepted, status, words);
}

function paint_doctor(tasks, notes, contact) {
    if (shown.rights_are_new) paint_settings();
    doctor?.paint_tasks(by_id("doctor_tasks"), tasks, notes, contact, words);
}

function paint_now_cells(cells) {
    const place = by_id("now_cells");
    if (!guard.is_pressed() || place.childElementCount === cells.length) paint_cells(place, cells);
}

function paint_orders(status, contact) {
    const { picked, session } = shown;
    bar.paint(buttons_of({ contact, asleep: wake.asleep, refusal: refusal_of(session), status, picked: picked !== null }), guard.is_pressed(), words);
    set_text(by_id("run_picked"), picked === null ? "" : words.text("picked", { point: point_text(picked, status, words) }));
}

/** Another version stands behind the same address now. Never while somebody writes or holds. */
function load_anew_if_replaced() {
    if (shown.status === null || shown.status.version === shown.version) return;
    if (!sheet.is_open() && !guard.is_pressed()) location.reload();
}

function tick() {
    const at = now();
    wake.tick(at);
    events.watch();
    bar.tick();
    if (document.hidden) return; // nobody looks: nothing is painted
    if (!may_wait(at)) paint(at);
    judge_checks(at);
    if (at - started_at > load_later_after_ms || !["now", "run"].includes(shown.screen)) load_later();
    load_anew_if_replaced();
}

// --- language, colours, keys -------------------------------------------------------------------

async function load_words(name) {
    const file = name === pseudo_language ? "en" : name;
    for (;;) {
        try {
            const response = await fetch(`/page/languages/${file}.json`);
            if (response.ok) {
                const found = await response.json();
                return new Catalogue(name === pseudo_language ? pseudo_table(found) : found);
            }
        } catch {
            // The station is starting, or the network is: there is nothing to show without words.
        }
        await new Promise((resolve) => setTimeout(resolve, 1000));
    }
}

async function use_language(name) {
    words = await load_words(name);
    language = name;
    document.documentElement.lang = words.tag;
    for (const element of document.querySelectorAll("[data-text]")) set_text(element, words.text(element.getAttribute("data-text") ?? ""));
    for (const element of document.querySelectorAll("[data-label]")) set_attribute(element, "aria-label", words.text(element.getAttribute("data-label") ?? ""));
    set_text(table_button, words.text("show_table"));
    go_to(shown.screen);
}

/** @param {"language" | "theme"} name @param {string} value */
function choose(name, value) {
    remember(name, value);
    if (name === "language") return void use_language(value);
    theme = value;
    use_theme(theme);
    paint_settings();
}

const keys = Object.freeze({ n: "now", u: "setup", r: "run", s: "result", h: "history", d: "doctor" });
let after_g = false;

document.addEventListener("keydown", (event) => {
    if (event.target instanceof HTMLInputElement || event.ctrlKey || event.altKey || event.metaKey) return;
    if (shown.screen === "history" && stored?.take_key(event.key, now())) {
        after_g = false;
        return event.preventDefault();
    }
    if (after_g && Object.hasOwn(keys, event.key)) go_to(keys[event.key]);
    after_g = event.key === "g";
});
by_id("strip").addEventListener("click", () => go_to("doctor")); // where all of it stands, as the button of that name has it
for (const button of document.querySelectorAll("nav button"))
    button.addEventListener("click", () => go_to(button.getAttribute("data-screen") ?? "now"));
document.addEventListener("visibilitychange", () => {
    if (document.hidden) {
        setup?.leave(); // no tone of a page that nobody sees
        events.rest();
        return wake.hide();
    }
    events.resume();
    tick(); // ages first: what stood there when it was hidden is old
});

use_theme(theme);
await use_language(language);
by_id("begin").hidden = true;
by_id("page").hidden = false;
go_to("now");
wake.begin(now());
setInterval(tick, tick_ms);
if (document.hidden) events.rest();
events.run();
