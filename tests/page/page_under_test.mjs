// What the tests of the page share: a status as the station sends it, and the words.
import { readFileSync, readdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { Catalogue } from "../../acquisition/console/page/catalogue.js";
import { data_of, least_range, margins, marks_of, place_range, places_of } from "../../acquisition/console/page/plot_geometry.js";

export const folder = join(dirname(fileURLToPath(import.meta.url)), "../../acquisition/console/page");

export function table_of(language) {
    return JSON.parse(readFileSync(join(folder, "languages", `${language}.json`), "utf8"));
}

export function words_of(language = "en") {
    return new Catalogue(table_of(language));
}

/** Every module of the page by name. */
export function sources() {
    const names = readdirSync(folder).filter((name) => name.endsWith(".js"));
    return Object.fromEntries(names.map((name) => [name, readFileSync(join(folder, name), "utf8")]));
}

export const hears = Object.freeze({ contact: true, status_age_ms: 0 });

export function channel_of(changed = {}) {
    return {
        instrument: "air", channel: "pressure", name: "air pressure", place: "", kind: "pressure", medium: "air",
        value: 101325, unit: "Pa", age_s: 0.4, quality: "good", used: true, role: "environment", due_on: "", ...changed,
    };
}

export function laser_of(changed = {}) {
    return channel_of({
        instrument: "laser", channel: "axis 1", name: "laser", kind: "displacement", medium: "none", value: 0.1234567, unit: "m",
        age_s: 0.01, role: "axis", ...changed,
    });
}

export function run_of(changed = {}) {
    return {
        id: "demo-20261121T100000Z-X", pass: "whole", state: "armed", file: "", step: 12, steps: 110, skipped: 0, done: 12,
        retakes_asked: 0, retakes_left: 0, excluded: 0, next: { target: 6, nominal_mm: 301.412, direction: "positive", approach: 2 },
        circle: null, seconds_left: 1085, last_deviation_um: -3.1, last_synchronisation_um: null, fault: "", sentence: "",
        certificate: "", ...changed,
    };
}

export function status_of(changed = {}) {
    return {
        protocol: "axiscal/1", station: "demo", version: "0.1.0", utc: "2026-11-21T10:00:00Z",
        axis: {
            name: "X", kind: "linear", reading: "length", position_mm: 301.4112, deviation_um: -0.8, displacement_mm: 301.4,
            strength_percent: 82, spread_um: 0.06, slope_um_per_s: 0, still: true,
        },
        channels: [laser_of(), channel_of()],
        instruments: [{ name: "laser", state: "available", note: "" }, { name: "air", state: "available", note: "" }],
        trigger: { port: "modbus", cnc_silent: false, note: "" },
        run: run_of(), run_open: true, drift: null, outbox_entries: 0,
        outbox: { waiting: 0, oldest_s: null, alarm: "", publisher: { runs: true, destination: "", state: "idle", reason: "", since_utc: "" } },
        notes: [], ...changed,
    };
}

export function point_of(step, changed = {}) {
    return { step, target: step, direction: "positive", approach: 0, deviation_um: step * 0.5, sequence: step + 1, ...changed };
}

/** What the points of a target give in one direction, as the station computes it. */
export function side_of(mean_um = null, s_um = null) {
    const reach = s_um === null ? null : 2 * s_um;
    const points = mean_um === null ? 0 : s_um === null ? 1 : 2;
    return { points, mean_um, low_um: reach === null ? null : mean_um - reach, high_um: reach === null ? null : mean_um + reach };
}

export function target_of(target, positive = side_of(), negative = side_of()) {
    return { target, nominal_mm: target * 100, positive, negative };
}

export function so_far_of(changed = {}) {
    return {
        standing: "outside", sentence: "So far already outside: A 14.2 of 12.0 um.", basis: "as shown at the machine: without U",
        points_per_target: 3, deviation_range_um: 13.1, reversal_max_um: 2.6, standard: "ISO 230-2:2014",
        figures: [{ parameter: "A", value_um: 14.2 }, { parameter: "B_mean", value_um: -2.6 }],
        limits: [{ parameter: "A", limit_um: 12, value_um: 14.2, standing: "outside", sentence: "A 14.2 of 12.0 um so far" }],
        ...changed,
    };
}

/** Where marks stand on scales that are as even as uPlot's, which rounds the ends of the upright one outwards. */
export function plot_of(drawn, { width, height, factor, next }) {
    const frame = { left: margins.left, right: width - margins.right, top: margins.top, bottom: height - margins.bottom };
    const places = places_of(drawn, next);
    const data = data_of(drawn, places, factor);
    const [low, high] = least_range(...[Math.min, Math.max].map((find, nth) => find(...data[nth + 1].map((one) => one ?? 0))));
    const [from, to] = place_range(places, frame.right - frame.left);
    const x_of = (place) => frame.left + ((place - from) / (to - from)) * (frame.right - frame.left);
    const y_of = (value) => frame.bottom - ((value - low) / (high - low)) * (frame.bottom - frame.top);
    return { ...marks_of(drawn, places, next, { x_of, y_of, width: frame.right - frame.left, factor }), ...frame, low, high, data };
}
