import assert from "node:assert/strict";
import { test } from "node:test";
import { SleeplessClock } from "../../acquisition/console/page/clock.js";
import { KeptValues, judge, mark_of, shapes } from "../../acquisition/console/page/freshness.js";
import { channel_of, hears, laser_of } from "./page_under_test.mjs";

test("a good value stays good while the station is heard", () => {
    assert.equal(judge(channel_of({ age_s: 14 }), hears).mark, "good");
});

test("a reading of the laser is stale after two seconds by the page's own clock", () => {
    const laser = laser_of({ age_s: 0.1 });
    assert.equal(judge(laser, { contact: true, status_age_ms: 1899 }).mark, "good");
    assert.equal(judge(laser, { contact: true, status_age_ms: 1901 }).mark, "stale");
});

test("every channel is stale beyond the limit that the station tells for it", () => {
    for (const channel of [channel_of({ age_s: 59, stale_after_s: 60 }), laser_of({ age_s: 59, stale_after_s: 60 })]) {
        assert.equal(judge(channel, { contact: true, status_age_ms: 999 }).mark, "good");
        assert.equal(judge(channel, { contact: true, status_age_ms: 1001 }).mark, "stale");
    }
});

test("a limit that is none makes nothing stale, of the laser neither; one that is not told is two seconds of laser and ballbar", () => {
    assert.equal(judge(laser_of({ age_s: 500, stale_after_s: null }), hears).mark, "good");
    assert.equal(judge(channel_of({ age_s: 500, stale_after_s: null }), hears).mark, "good");
    assert.equal(judge(laser_of({ age_s: 2.1, role: "ballbar" }), hears).mark, "stale");
    assert.equal(judge(laser_of({ age_s: 2.1, role: "" }), hears).mark, "good");
    assert.equal(judge(channel_of({ age_s: 500 }), hears).mark, "good");
});

test("a limit does not hold a value up without contact", () => {
    assert.equal(judge(channel_of({ stale_after_s: 60 }), { contact: false, status_age_ms: 0 }).mark, "stale");
});

test("without contact every value is stale, and its age grows", () => {
    const judged = judge(channel_of({ age_s: 1 }), { contact: false, status_age_ms: 9000 });
    assert.deepEqual(judged, { mark: "stale", age_s: 10 });
});

test("a status that stands still makes its values stale, although heartbeats come", () => {
    assert.equal(judge(channel_of(), { contact: true, status_age_ms: 2001 }).mark, "stale");
});

test("a lost value stays lost without contact: it is no better than before", () => {
    assert.equal(judge(laser_of({ quality: "beam_lost", value: null }), { contact: false, status_age_ms: 9000 }).mark, "lost");
});

test("a good value without a number is lost, and so is a quality that nobody knows", () => {
    assert.equal(judge(channel_of({ value: null }), hears).mark, "lost");
    assert.equal(mark_of("excellent"), "lost");
    assert.equal(mark_of("constructor"), "lost");
});

test("a channel that never spoke has no age", () => {
    assert.deepEqual(judge(channel_of({ quality: "none", value: null, age_s: null }), hears), { mark: "none", age_s: null });
});

test("every mark has a shape of its own", () => {
    assert.equal(new Set(Object.values(shapes)).size, 5);
});

test("a stale value is kept, a lost one is forgotten and does not come back", () => {
    const kept = new KeptValues();
    assert.equal(kept.take("x", 3, "good"), 3);
    assert.equal(kept.take("x", null, "stale"), 3);
    assert.equal(kept.take("x", null, "lost"), null);
    assert.equal(kept.take("x", null, "stale"), null);
});

test("a datum that is gone takes its position with it, although the laser is good", () => {
    const kept = new KeptValues();
    kept.take("axis/position_mm", 5, "good");
    assert.equal(kept.take("axis/position_mm", null, "good"), null);
});

test("the clock goes on while the computer sleeps, whichever clock stood still", () => {
    let monotonic = 0;
    let wall = 1000;
    const clock = new SleeplessClock(() => monotonic, () => wall);
    monotonic += 80;
    wall += 80;
    assert.equal(clock.now(), 80);
    monotonic += 80;
    wall += 60000; // slept
    assert.equal(clock.now(), 60080);
});

test("a wall clock that is set back makes nothing younger", () => {
    let monotonic = 0;
    let wall = 100000;
    const clock = new SleeplessClock(() => monotonic, () => wall);
    monotonic += 80;
    wall -= 50000;
    assert.equal(clock.now(), 80);
});
