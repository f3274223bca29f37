// What one browser remembers: language, colours, who orders. A browser that keeps nothing loses nothing else.

/** @param {string} name @returns {string | null} */
export function remembered(name) {
    try {
        return localStorage.getItem(`axiscal.${name}`);
    } catch {
        return null;
    }
}

/** @param {string} name @param {string} value */
export function remember(name, value) {
    try {
        localStorage.setItem(`axiscal.${name}`, value);
    } catch {
        // Kept until the page is loaded anew.
    }
}

export const themes = Object.freeze(["auto", "light", "dark", "grey"]);

/** @param {string} theme */
export function use_theme(theme) {
    if (theme === "auto" || !themes.includes(theme)) delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = theme;
}
