// The first script of the page, written so that a browser of 2012 reads it: says in words that a browser is too old, and starts
// the page only in one that has what it needs. Whoever uses something new of a browser in a module names it here.
(function () {
    "use strict";

    var needed = ["fetch", "Promise", "AbortController", "ReadableStream", "TextDecoder", "ResizeObserver", "MutationObserver", "PointerEvent",
        "Path2D", "Intl.DateTimeFormat", "Object.hasOwn", "Object.fromEntries", "Array.prototype.at", "String.prototype.replaceAll",
        "Element.prototype.replaceChildren"];

    /** @param {string} path  "Object.hasOwn" */
    function has(path) {
        var names = path.split(".");
        /** @type {any} */
        var within = window;
        for (var nth = 0; nth < names.length && within; nth += 1) within = within[names[nth]];
        return Boolean(within);
    }

    function missing() {
        var found = "noModule" in document.createElement("script") ? [] : ["modules"];
        for (var nth = 0; nth < needed.length; nth += 1) if (!has(needed[nth])) found.push(needed[nth]);
        return found;
    }

    /** @param {string} id @returns {any} */
    function place(id) {
        return document.getElementById(id);
    }

    /** @param {string} shown  id */
    function show(shown) {
        place("begin_wait").setAttribute("hidden", "");
        place(shown).removeAttribute("hidden");
    }

    /** @param {string[]} lacks */
    function tell_too_old(lacks) {
        place("begin_lacks").textContent = lacks.join(", ");
        show("begin_old");
    }

    /** One behind the other, as they are asked for. A library that is not there stops nothing. @param {string} source @param {string} type */
    function load(source, type) {
        var script = document.createElement("script");
        script.type = type;
        script.async = false;
        script.src = source;
        document.body.appendChild(script);
    }

    /** A newer grammar shows only when the modules are read. */
    function start() {
        window.addEventListener("error", function (event) {
            if (event.error instanceof SyntaxError && !place("begin").hidden) tell_too_old([String(event.error)]);
        });
        load("/page/libraries/uplot.js", "text/javascript");
        load("/page/main.js", "module");
    }

    var lacks = missing();
    if (lacks.length > 0) {
        tell_too_old(lacks);
    } else {
        show("begin_wait");
        start();
    }
})();
