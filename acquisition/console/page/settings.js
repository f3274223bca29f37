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

/** @param {() => void} changed  called when other colours hold: chosen here, or the computer's own */
export function on_colours(changed) {
    new MutationObserver(changed).observe(document.documentElement, { attributes: true, attributeFilter: ["data-theme"] });
    for (const query of ["(prefers-color-scheme: dark)", "(forced-colors: active)"]) matchMedia(query).addEventListener("change", changed);
}
