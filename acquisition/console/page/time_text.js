// Times as the reader's own clock shows them. No DOM.

/** @typedef {import("./catalogue.js").Catalogue} Catalogue */

const day = Object.freeze(/** @type {const} */ ({ year: "numeric", month: "2-digit", day: "2-digit" }));

/** To the minute. @param {string} utc  ISO time; what is none is shown as it is @param {Catalogue} words */
export function date_text(utc, words) {
    const at = new Date(utc);
    if (utc === "" || Number.isNaN(at.getTime())) return utc;
    return new Intl.DateTimeFormat(words.date_tag, { ...day, hour: "2-digit", minute: "2-digit" }).format(at);
}

/** To the second; with the day where that is not today's. @param {string} utc  as above @param {Catalogue} words */
export function since_text(utc, words) {
    const at = new Date(utc);
    if (Number.isNaN(at.getTime())) return utc;
    const when = at.toDateString() === new Date().toDateString() ? {} : day;
    return new Intl.DateTimeFormat(words.date_tag, { ...when, hour: "2-digit", minute: "2-digit", second: "2-digit" }).format(at);
}
