// A browser as far as uPlot and the page's plot ask it, whose canvas notes what is drawn. uPlot itself is the one that ships: of the
// build that AXISCAL_PAGE names, else of preset check.
import { existsSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import vm from "node:vm";

const source_folder = join(dirname(fileURLToPath(import.meta.url)), "../..");
const library_file = join(process.env.AXISCAL_PAGE ?? join(source_folder, "build/check/share/axiscal/page"), "libraries/uplot.js");
/** Under ctest it is there, or its tests fail. */
export const may_be_missing = process.env.AXISCAL_PAGE === undefined && !existsSync(library_file);

class Canvas {
    constructor() {
        this.done = []; // since it was cleared
        this.state = {};
        this.kept = [];
        for (const name of ["beginPath", "moveTo", "lineTo", "translate", "scale", "rect", "clip"]) this[name] = () => {};
    }
    save() {
        this.kept.push({ ...this.state });
    }
    restore() {
        this.state = this.kept.pop();
    }
    clearRect() {
        this.done = [];
    }
    setLineDash(dash) {
        this.state.dash = dash;
    }
    note(what, colour, also) {
        this.done.push({ what, colour, width: this.state.lineWidth, ...also });
    }
    fill(shape) {
        this.note("fill", this.state.fillStyle, { path: shape?.path, alpha: this.state.globalAlpha });
    }
    stroke(shape) {
        this.note("stroke", this.state.strokeStyle, { path: shape?.path });
    }
    measureText(text) {
        return { width: 11.5 * text.length };
    }
    fillText(text, x, y) {
        this.note("text", this.state.fillStyle, { text, x, y });
    }
}
for (const name of ["fillStyle", "strokeStyle", "lineWidth", "lineJoin", "lineCap", "font", "textAlign", "textBaseline", "globalAlpha"])
    Object.defineProperty(Canvas.prototype, name, {
        get() {
            return this.state[name];
        },
        set(value) {
            this.state[name] = value;
        },
    });

class Path {
    constructor(path) {
        this.path = path;
    }
}

class Element extends EventTarget {
    constructor(name) {
        super();
        Object.assign(this, { localName: name, children: [], attributes: new Map(), style: {}, dataset: {}, className: "", textContent: "" });
        this.classList = { add() {}, remove() {}, contains: () => false };
        this.canvas = name === "canvas" ? new Canvas() : null;
    }
    getContext() {
        return this.canvas;
    }
    append(...inside) {
        this.children.push(...inside);
    }
    appendChild(one) {
        this.children.push(one);
    }
    insertBefore(one) {
        this.children.push(one);
    }
    getAttribute(name) {
        return this.attributes.get(name) ?? null;
    }
    setAttribute(name, value) {
        this.attributes.set(name, String(value));
    }
    removeAttribute(name) {
        this.attributes.delete(name);
    }
    getBoundingClientRect() {
        return { left: 0, top: 0, width: 0, height: 0 };
    }
    find(name) {
        if (this.localName === name) return this;
        for (const one of this.children) {
            const found = one.find?.(name);
            if (found) return found;
        }
        return null;
    }
}

/** @param colours  by property; may be changed, and `browser.recolour()` tells it */
export function browser_with(colours, { ratio = 1, library = true } = {}) {
    const observers = { size: [], colours: [] };
    const window = new EventTarget();
    const root = new Element("html");
    const has = {
        window, devicePixelRatio: ratio, navigator: { language: "en" }, CustomEvent: Event, HTMLElement: Element, Path2D: Path,
        document: { documentElement: root, createElement: (name) => new Element(name), addEventListener() {}, hidden: false },
        matchMedia: () => new EventTarget(),
        getComputedStyle: () => ({ fontFamily: "sans-serif", getPropertyValue: (name) => ` ${colours[name.slice(2)]}` }),
        ResizeObserver: class {
            constructor(call) {
                observers.size.push(call);
            }
            observe() {}
        },
        MutationObserver: class {
            constructor(call) {
                observers.colours.push(call);
            }
            observe() {}
        },
    };
    for (const [name, value] of Object.entries(has)) Object.defineProperty(globalThis, name, { value, configurable: true, writable: true });
    const read = () => vm.runInThisContext(`(() => {${readFileSync(library_file, "utf8")}; return uPlot; })()`, { filename: "uplot.js" });
    globalThis.uPlot = library ? read() : undefined;
    return {
        place: new Element("figure"),
        resize: (width, height) => observers.size.forEach((call) => call([{ contentRect: { width, height } }])),
        recolour: () => observers.colours.forEach((call) => call()),
        drawn: () => new Promise((done) => setTimeout(done, 0)), // uPlot draws when this turn of the loop has ended
    };
}
