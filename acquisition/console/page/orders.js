// Orders to the station. What it says is shown as it says it. No DOM.

const patience_ms = 30000; // far longer than the station needs

/**
 * @typedef {object} Answer
 * @property {boolean} done
 * @property {number} status  of HTTP; 0: no answer came, and nobody knows whether the order was carried out
 * @property {string} sentence  the station's own; empty when done
 * @property {any} body
 */

/**
 * @param {string} path  "/v1/run/abort"
 * @param {object | null} body
 * @param {typeof fetch} fetcher
 * @returns {Promise<Answer>}
 */
export async function send_order(path, body, fetcher) {
    const headers = { "Content-Type": "application/json" };
    return answered(path, { method: "POST", headers, body: body === null ? "" : JSON.stringify(body) }, fetcher);
}

/**
 * A question that is given up after its patience: a connection that is dead gives no answer and no error.
 * @param {string} path @param {typeof fetch} fetcher @param {RequestInit} [options] @param {number} [ms]
 * @returns {Promise<{response: Response, body: any}>}
 */
export async function asked(path, fetcher, options = {}, ms = patience_ms) {
    const limit = new AbortController();
    const patience = setTimeout(() => limit.abort(), ms);
    try {
        const response = await fetcher(path, { credentials: "same-origin", cache: "no-store", ...options, signal: limit.signal });
        return { response, body: await response.json() };
    } finally {
        clearTimeout(patience);
    }
}

/** @param {string} path @param {RequestInit} order @param {typeof fetch} fetcher @returns {Promise<Answer>} */
async function answered(path, order, fetcher) {
    try {
        const { response, body } = await asked(path, fetcher, order);
        return { done: response.ok, status: response.status, sentence: response.ok ? "" : (body.error?.sentence ?? ""), body };
    } catch {
        return { done: false, status: 0, sentence: "", body: null };
    }
}

/** Ends what this browser holds at the station. @param {string} path @param {typeof fetch} fetcher @returns {Promise<Answer>} */
export async function delete_order(path, fetcher) {
    return answered(path, { method: "DELETE" }, fetcher);
}

/** @param {Answer} answer @returns {boolean} this browser may look only; the sentence says how it may order */
export function lacks_rights(answer) {
    return answer.status === 401 || answer.status === 403;
}

/** Unsatisfied checks of an arming that was refused. @param {Answer} answer @returns {{name: string, verdict: string}[]} */
export function failed_checks(answer) {
    return (answer.body?.checks ?? []).filter(({ passed, override }) => !passed && override === "");
}
