// A tone whose pitch follows the strength of the beam, for who has both hands at the laser. No DOM but its audio.

import { is_number } from "./freshness.js";

const lowest_hz = 220;
const octaves = 3; // from 0 to 100 %: a step of one per cent is a third of a semitone, which is heard
const loudness = 0.2;
const glide_s = 0.03; // a step of the pitch does not click
/** Nobody drives it for so long: it falls silent by itself, also where this page's scripts hang. */
const alone_s = 0.4;

/** @param {number | null} percent @returns {number | null} null: silent */
export function pitch_hz(percent) {
    if (!is_number(percent)) return null;
    return lowest_hz * 2 ** ((octaves * Math.min(100, Math.max(0, percent))) / 100);
}

export class Tone {
    /** @param {() => AudioContext} make_audio  called by a touch alone: no browser plays before one */
    constructor(make_audio) {
        this.make_audio = make_audio;
        /** @type {{context: AudioContext, oscillator: OscillatorNode, gain: GainNode} | null} */
        this.parts = null;
        this.failed = false;
    }

    is_on() {
        return this.parts !== null;
    }

    /** By a touch. It stays silent until it is told a strength. */
    start() {
        if (this.parts !== null) return;
        try {
            const context = this.make_audio();
            const oscillator = context.createOscillator();
            const gain = context.createGain();
            gain.gain.value = 0;
            oscillator.connect(gain).connect(context.destination);
            oscillator.start();
            this.parts = { context, oscillator, gain };
            this.failed = false;
            context.resume().catch(() => {});
        } catch {
            this.failed = true; // a browser without sound
        }
    }

    /** Gives the sound back to the computer; only a touch starts it again. */
    stop() {
        const { parts } = this;
        this.parts = null;
        if (parts === null) return;
        parts.oscillator.stop();
        parts.context.close().catch(() => {});
    }

    /**
     * With each tick.
     * @param {number | null} percent  null: nothing fresh, so nothing is heard
     * @returns {number | null} the pitch that sounds now
     */
    follow(percent) {
        if (this.parts === null) return null;
        const { context, oscillator, gain } = this.parts;
        const at = context.currentTime;
        const pitch = pitch_hz(percent);
        gain.gain.cancelScheduledValues(at);
        gain.gain.setTargetAtTime(pitch === null ? 0 : loudness, at, glide_s);
        if (pitch === null) return null;
        gain.gain.setTargetAtTime(0, at + alone_s, glide_s);
        oscillator.frequency.cancelScheduledValues(at);
        oscillator.frequency.setTargetAtTime(pitch, at, glide_s);
        return pitch;
    }
}
