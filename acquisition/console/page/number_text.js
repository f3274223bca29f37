// Numbers as people read them at a machine. No DOM.

import { is_number } from "./freshness.js";

/** In the place of a number that is not there; never 0. */
export const no_number = "– – –";
const minus = "\u2212";
const room_for_sign = "\u2007"; // as wide as a digit: digits do not jump when the sign comes

/**
 * @typedef {object} NumberStyle
 * @property {string} [decimal_mark]  "." or ","
 * @property {boolean} [plus]  write the sign of a positive number
 */

/**
 * Fixed decimals, true minus, no exponent, and never "−0.0".
 * @param {unknown} value
 * @param {number} decimals
 * @param {NumberStyle} [style]
 */
export function number_text(value, decimals, style = {}) {
    if (!is_number(value) || Math.abs(value) >= 1e15) return no_number;
    const digits = Math.abs(value).toFixed(decimals);
    const is_zero = !/[1-9]/.test(digits);
    const positive = style.plus ? "+" : room_for_sign;
    const sign = is_zero ? room_for_sign : value < 0 ? minus : positive;
    return sign + digits.replace(".", style.decimal_mark ?? ".");
}

/**
 * A stored unit as the shop floor reads it: the same units and decimals as `axiscal status`.
 * @param {string} unit  of the interface: "m", "Pa", "degC", "%", ...
 * @returns {{factor: number, decimals: number, unit: string}} `unit` is a key of the catalogue where it has one
 */
export function shop_unit(unit) {
    if (unit === "m") return { factor: 1e3, decimals: 4, unit: "mm" };
    if (unit === "Pa") return { factor: 1e-2, decimals: 1, unit: "hPa" };
    if (unit === "degC") return { factor: 1, decimals: 2, unit: "°C" };
    if (unit === "arcsec") return { factor: 1, decimals: 2, unit: "″" };
    return { factor: 1, decimals: unit === "%" ? 1 : 2, unit };
}

/**
 * Of a rotary axis the interface's millimetres are degrees, shown with seconds of arc.
 * @param {{kind?: string, reading?: string}} axis
 */
export function axis_units(axis) {
    const length = { factor: 1, unit: "µm" };
    const angle = { factor: 3.6, unit: "″" }; // of thousandths of a degree
    const rotary = axis.kind === "rotary";
    return {
        coordinate: rotary ? "°" : "mm",
        deviation: rotary ? angle : length,
        reading: axis.reading === "angle" ? angle : length,
    };
}

/**
 * @param {unknown} seconds
 * @returns {{key: "age_s" | "age_min" | "age_h", number: string} | null}
 */
export function age_of(seconds) {
    if (!is_number(seconds)) return null;
    const whole = Math.floor(Math.max(0, seconds));
    if (whole < 120) return { key: "age_s", number: String(whole) };
    if (whole < 7200) return { key: "age_min", number: String(Math.floor(whole / 60)) };
    return { key: "age_h", number: String(Math.floor(whole / 3600)) };
}

/** @param {unknown} seconds @returns {string} "18:05" */
export function minutes_text(seconds) {
    if (!is_number(seconds)) return no_number;
    const whole = Math.max(0, Math.round(seconds));
    return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}

/**
 * What a person typed, with comma or point, and either minus.
 * @param {string} typed
 * @returns {number | null} null: no number
 */
export function typed_number(typed) {
    const plain = typed.trim().replace(/[\u2212\u2013]/, "-").replace(",", ".");
    return /^[+-]?(\d+\.?\d*|\.\d+)$/.test(plain) ? Number(plain) : null;
}
