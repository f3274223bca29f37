// Small hands on the document: what does not change is not touched.

/** @param {string} id @returns {HTMLElement} */
export function by_id(id) {
    const found = document.getElementById(id);
    if (found === null) throw new Error(`the page has no element ${id}`);
    return found;
}

/** @param {Element} element @param {string} text */
export function set_text(element, text) {
    if (element.textContent !== text) element.textContent = text;
}

/** @param {Element} element @param {string} name @param {string | null} value  null: without it */
export function set_attribute(element, name, value) {
    if (element.getAttribute(name) === value) return;
    if (value === null) element.removeAttribute(name);
    else element.setAttribute(name, value);
}

/**
 * @template {keyof HTMLElementTagNameMap} Name
 * @param {Name} name @param {string} [class_name] @param {(Node | string)[]} [inside]
 * @returns {HTMLElementTagNameMap[Name]}
 */
export function make(name, class_name = "", inside = []) {
    const element = document.createElement(name);
    if (class_name !== "") element.className = class_name;
    element.append(...inside);
    return element;
}

/**
 * Called before what lies in a place is made anew.
 * @param {Element} place @param {(one: Element) => string | null} key_of  what a link or button is about
 * @returns {() => void} gives the focus to the one that is about the same as the one that had it: keys go on from where they were
 */
export function kept_focus(place, key_of) {
    const focused = document.activeElement;
    const key = focused !== null && place.contains(focused) ? key_of(focused) : null;
    return () => {
        if (key === null) return;
        const again = [...place.querySelectorAll("a, button")].find((one) => key_of(one) === key);
        if (again instanceof HTMLElement) again.focus({ preventScroll: true });
    };
}

/** As many children as wanted; those that stay are kept. @param {Element} parent @param {number} count @param {() => Element} make_one */
export function keep_children(parent, count, make_one) {
    while (parent.childElementCount > count) parent.lastElementChild?.remove();
    while (parent.childElementCount < count) parent.append(make_one());
    return [...parent.children];
}
