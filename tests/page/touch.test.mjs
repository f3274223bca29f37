import assert from "node:assert/strict";
import { test } from "node:test";
import { Hold } from "../../acquisition/console/page/hold.js";
import { Wakefulness } from "../../acquisition/console/page/wakefulness.js";

function ticked(wake, from, to) {
    for (let at = from; at <= to; at += 80) wake.tick(at);
}

test("the first touch after two idle minutes only wakes", () => {
    const wake = new Wakefulness(0);
    ticked(wake, 0, 121000);
    assert.equal(wake.asleep, true);
    assert.equal(wake.touch(121040), false);
    assert.equal(wake.touch(121100), true);
});

test("a page that was long in loading is not asleep when it is shown, unless it was hidden", () => {
    const wake = new Wakefulness(0);
    wake.begin(9000);
    assert.equal(wake.touch(9040), true);
    wake.hide();
    wake.begin(9100);
    assert.equal(wake.touch(9140), false);
});

test("a touch while somebody works acts", () => {
    const wake = new Wakefulness(0);
    ticked(wake, 0, 5000);
    assert.equal(wake.touch(5040), true);
});

test("a computer that slept is woken by the first touch, even before a tick", () => {
    const wake = new Wakefulness(0);
    ticked(wake, 0, 1000);
    assert.equal(wake.touch(61000), false);
    assert.equal(wake.touch(61050), true);
});

test("a page that was hidden is woken first", () => {
    const wake = new Wakefulness(0);
    wake.hide();
    assert.equal(wake.touch(10), false);
});

test("a hold is done after 0.8 s, once", () => {
    const hold = new Hold();
    hold.press(0);
    for (let at = 80; at < 800; at += 80) assert.ok(hold.progress(at) < 1);
    assert.equal(hold.progress(800), 1);
    assert.equal(hold.progress(880), 0);
});

test("a tap, and a finger that leaves, abort nothing", () => {
    const hold = new Hold();
    hold.press(0);
    hold.progress(240);
    hold.release();
    assert.equal(hold.progress(900), 0);
});

test("a page that was frozen while the finger was down has not seen it held", () => {
    const hold = new Hold();
    hold.press(0);
    assert.equal(hold.progress(5000), 0);
    assert.equal(hold.progress(5080), 0);
});
