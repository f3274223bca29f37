// Words by language. No DOM.

/** Those with a file in languages/; the pseudo language is made from English. */
export const languages = Object.freeze(["en", "de", "ru", "zh"]);
export const pseudo_language = "pseudo";

const accents = Object.freeze({
    a: "á", c: "ç", e: "é", i: "í", n: "ñ", o: "ö", s: "š", u: "ü", y: "ý", z: "ž",
    A: "Å", C: "Ç", E: "É", I: "Í", N: "Ñ", O: "Ö", S: "Š", U: "Ü", Y: "Ý", Z: "Ž",
});

/**
 * Longer by two fifths and accented, so that a text that is cut off, or not in the catalogue, is seen.
 * @param {string} text  fields in braces stay as they are
 */
export function pseudo_text(text) {
    const parts = text.split(/(\{\w+\})/);
    const letters = parts.filter((part) => !part.startsWith("{")).join("").length;
    const accented = parts.map((part) => (part.startsWith("{") ? part : part.replace(/[a-zA-Z]/g, (one) => accents[one] ?? one)));
    return `[${accented.join("")}${"~".repeat(Math.max(0, Math.ceil(letters * 0.4) - 2))}]`;
}

/** @param {Record<string, string>} english @returns {Record<string, string>} */
export function pseudo_table(english) {
    return Object.fromEntries(
        Object.entries(english).map(([key, text]) => [key, key.startsWith("_") ? text : pseudo_text(text)]),
    );
}

export class Catalogue {
    /** @param {Record<string, string>} table  keys with "_" in front are about the language itself */
    constructor(table) {
        this.table = table;
        this.tag = table._tag ?? "en";
        // English dates of two countries differ by day and month, and have twelve hours: they are written by ISO 8601, as Swedish ones.
        this.date_tag = this.tag.startsWith("en") ? "sv" : this.tag;
        this.decimal_mark = table._decimal_mark ?? ".";
    }

    /**
     * @param {string} key
     * @param {Record<string, string | number>} [fields]
     * @returns {string} a key that is not there stands in brackets: tests look for them
     */
    text(key, fields = {}) {
        if (!Object.hasOwn(this.table, key)) return `⟦${key}⟧`;
        return this.table[key].replace(/\{(\w+)\}/g, (whole, name) =>
            Object.hasOwn(fields, name) ? String(fields[name]) : whole,
        );
    }

    /** A unit in this language, or as it is: "µm" is "мкм" in Russian. @param {string} unit */
    unit(unit) {
        const key = `unit_${unit}`;
        return Object.hasOwn(this.table, key) ? this.table[key] : unit;
    }

    /** @param {{key: string, number: string} | null} age */
    age(age) {
        return age === null ? this.text("age_never") : this.text(age.key, { number: age.number });
    }
}

/**
 * @param {string | null} stored  what a person chose
 * @param {readonly string[]} wished  as navigator.languages: "de-AT"
 */
export function choose_language(stored, wished) {
    if (stored !== null && (languages.includes(stored) || stored === pseudo_language)) return stored;
    for (const tag of wished) {
        const short = tag.toLowerCase().split("-")[0];
        if (languages.includes(short)) return short;
    }
    return "en";
}
