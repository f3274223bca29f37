import assert from "node:assert/strict";
import { test } from "node:test";
import { Tone, pitch_hz } from "../../acquisition/console/page/tone.js";

/** A parameter of Web Audio that remembers what it was told. */
class Parameter {
    value = 1;
    planned = [];
    cancelScheduledValues(at) {
        this.planned = this.planned.filter((one) => one.at < at);
    }
    setTargetAtTime(value, at) {
        this.planned.push({ value, at });
    }
    at(time) {
        return this.planned.filter((one) => one.at <= time).at(-1)?.value ?? this.value;
    }
}

function audio() {
    const made = [];
    const make_audio = () => {
        const context = {
            currentTime: 0, closed: false, gain: new Parameter(), frequency: new Parameter(), stopped: false, destination: {},
            createOscillator: () => ({
                frequency: context.frequency, connect: (to) => to, start: () => {}, stop: () => (context.stopped = true),
            }),
            createGain: () => ({ gain: context.gain, connect: (to) => to }),
            resume: async () => {},
            close: async () => void (context.closed = true),
        };
        made.push(context);
        return context;
    };
    return { made, tone: new Tone(make_audio) };
}

test("the pitch rises with the strength, by whole octaves, and nothing has no pitch", () => {
    assert.equal(pitch_hz(0), 220);
    assert.equal(Math.round(pitch_hz(100)), 1760);
    assert.ok(pitch_hz(61) < pitch_hz(62));
    assert.equal(pitch_hz(140), pitch_hz(100));
    assert.equal(pitch_hz(-0.1), 220);
    for (const none of [null, Number.NaN, Infinity]) assert.equal(pitch_hz(none), null);
});

test("nothing is made and nothing sounds before a touch", () => {
    const { made, tone } = audio();
    assert.equal(tone.follow(82), null);
    assert.equal(made.length, 0);
    tone.start();
    assert.equal(made[0].gain.at(0), 0);
    assert.equal(tone.follow(50), pitch_hz(50));
    assert.ok(made[0].gain.at(0) > 0);
});

test("a second touch makes no second tone", () => {
    const { made, tone } = audio();
    tone.start();
    tone.start();
    assert.equal(made.length, 1);
});

test("without a fresh strength it is silent at once, and sounds again with the next one", () => {
    const { made, tone } = audio();
    tone.start();
    tone.follow(82);
    made[0].currentTime = 0.08;
    assert.equal(tone.follow(null), null);
    for (const later of [0.08, 1, 100]) assert.equal(made[0].gain.at(later), 0);
    made[0].currentTime = 0.16;
    tone.follow(82);
    assert.ok(made[0].gain.at(0.2) > 0);
});

test("where nobody drives it, it falls silent by itself", () => {
    const { made, tone } = audio();
    tone.start();
    tone.follow(82);
    assert.ok(made[0].gain.at(0.3) > 0);
    assert.equal(made[0].gain.at(0.5), 0);
});

test("it is ended whole, and is off until the next touch", () => {
    const { made, tone } = audio();
    tone.start();
    tone.follow(82);
    tone.stop();
    tone.stop();
    assert.deepEqual([made[0].closed, made[0].stopped, tone.is_on(), tone.follow(82)], [true, true, false, null]);
    tone.start();
    assert.equal(made.length, 2);
});

test("a browser without sound says so, and a later touch tries again", () => {
    let works = false;
    const { tone: good } = audio();
    const tone = new Tone(() => {
        if (!works) throw new TypeError("no audio");
        return good.make_audio();
    });
    tone.start();
    assert.deepEqual([tone.failed, tone.is_on()], [true, false]);
    works = true;
    tone.start();
    assert.deepEqual([tone.failed, tone.is_on()], [false, true]);
});
