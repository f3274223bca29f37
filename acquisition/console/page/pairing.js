// Whether this browser may order (docs/pairing.md). The station says so; the cookie itself no script can read. No DOM.

import { asked } from "./orders.js";

/** @typedef {{paired: boolean, name: string, how: string, until_utc: string}} Session */

/** @returns {Session} before the station was asked: nothing is claimed, so the orders are on and the station judges them */
export const not_asked = () => ({ paired: true, name: "", how: "", until_utc: "" });

/**
 * @param {typeof fetch} fetcher
 * @returns {Promise<Session | null>} null: no answer came
 */
export async function ask_session(fetcher) {
    try {
        const { response, body } = await asked("/v1/session", fetcher);
        if (!response.ok) return null;
        const { paired, name = "", how = "", until_utc = "" } = body;
        return { paired: paired === true, name, how, until_utc };
    } catch {
        return null;
    }
}

/** What the station's sentence is when this browser may not order; empty: it may. @param {Session} session */
export function refusal_of(session) {
    return session.paired ? "" : session.how;
}
