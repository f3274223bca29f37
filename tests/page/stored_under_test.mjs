// A stored run and its certificate as the station sends them.

export function stored_of(changed = {}) {
    return {
        id: "demo-20260102T081500Z-X", status: "complete", sentence: "", kind: "positioning", axis: "X", machine: "M-10442",
        machine_serial: "4711", machine_state: "as found", started_utc: "2026-01-02T08:15:00Z", points: 4, planned: 4, left_out: 0,
        verdict: "fail", limits: "shop", rule: "simple", standard: "ISO 230-2:2014", unit: "mm",
        figures: [
            { parameter: "R", value: 0.0046, U: 0.0012001, limit: 0.004, verdict: "fail", reason: "" },
            { parameter: "A", value: 0.0164, U: null, limit: 0.02, verdict: "pass", reason: "" },
            { parameter: "B_mean", value: -0.0024, U: null, limit: null, verdict: "", reason: "" },
        ],
        paper: "published", paper_sentence: "", number: "C-7", ...changed,
    };
}

export function certificate_of(changed = {}) {
    return {
        format: "axiscal.result/1", unit: "mm",
        positions: [
            { target: 0, mean_forward: 0.001, mean_backward: -0.002, s_forward: 0.0005, s_backward: 0.0001 },
            { target: 100, mean_forward: 0.003, mean_backward: 0.001 },
        ],
        completeness: { status: "complete", left_out: [] },
        run: {
            id: "demo-20260102T081500Z-X", plan: { targets: [0, 100] }, set_aside: [], remarks: ["The dead path is as stated."],
            deviations: { forward: [[0.0005, 0.0015], [0.003]], backward: [[-0.002], [0.001]] },
        },
        ...changed,
    };
}

export function result_with(changed = {}, certificate = certificate_of()) {
    return { ...stored_of(changed), papers: [{ name: "certificate.pdf", bytes: 123456 }, { name: "demo.axiscal", bytes: 2_300_000 }], certificate };
}

/** Answers each path by the first rule that its text begins; remembers what was asked. */
export function station_that(answers) {
    const asked = [];
    const fetcher = async (path) => {
        asked.push(path);
        const found = Object.entries(answers).find(([begin]) => path.startsWith(begin));
        if (!found) throw new TypeError("no network");
        const [status, body] = typeof found[1] === "function" ? found[1](path) : found[1];
        return { ok: status === 200, status, json: async () => body };
    };
    return { asked, fetcher };
}
