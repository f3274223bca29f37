import assert from "node:assert/strict";
import { test } from "node:test";
import { LinkState } from "../../acquisition/console/page/link_state.js";

test("contact is lost after two seconds without a word, whatever the connection says", () => {
    const link = new LinkState(0);
    link.heard(100);
    assert.equal(link.view(2100).contact, true);
    assert.equal(link.view(2101).contact, false);
});

test("the break is quiet for three seconds before the strip", () => {
    const link = new LinkState(0);
    link.heard(0);
    assert.equal(link.view(3000).strip, "none");
    assert.equal(link.view(3001).strip, "lost");
});

test("a station that never spoke is looked for, not lost", () => {
    const link = new LinkState(0);
    assert.equal(link.view(2999).strip, "none");
    assert.equal(link.view(3001).strip, "starting");
    assert.equal(link.view(10).contact, false);
});

test("after the return the strip stays two seconds, and only where it was up", () => {
    const link = new LinkState(0);
    link.heard(0);
    link.heard(2500); // quiet
    assert.equal(link.view(2500).strip, "none");
    link.heard(9000);
    assert.equal(link.view(9000).contact, true);
    assert.equal(link.view(10900).strip, "back");
    link.heard(10900);
    link.heard(11000);
    assert.equal(link.view(11000).strip, "none");
});

test("tries never end, and are at most four seconds apart", () => {
    const link = new LinkState(0);
    assert.deepEqual([1, 2, 3, 4, 5, 6, 7].map(() => link.next_pause()), [250, 500, 1000, 2000, 4000, 4000, 4000]);
    link.heard(1);
    assert.equal(link.next_pause(), 250);
});

test("the station's refusal is told until it speaks", () => {
    const link = new LinkState(0);
    link.refused("all 32 places are taken");
    assert.equal(link.view(4000).refusal, "all 32 places are taken");
    link.heard(4001);
    assert.equal(link.view(4001).refusal, "");
});

test("a page that rested by itself comes back quietly, and shows nothing old as new", () => {
    const link = new LinkState(0);
    link.heard(1000);
    link.rest(2000);
    link.resume(600000);
    assert.equal(link.view(600000).contact, false);
    assert.equal(link.view(603000).strip, "none");
    assert.equal(link.view(603001).strip, "lost"); // the station is not there any more
});

test("after a rest that the station outlived there is no word of a break", () => {
    const link = new LinkState(0);
    link.heard(1000);
    link.rest(2000);
    link.resume(600000);
    link.heard(600050);
    assert.deepEqual([link.view(600050).contact, link.view(600050).strip], [true, "none"]);
});

test("a link that was lost before the page rested is lost when it is back", () => {
    const link = new LinkState(0);
    link.heard(1000);
    link.rest(9000);
    link.resume(600000);
    assert.equal(link.view(600000).strip, "lost");
});

test("a tab that was opened in the background meets a station that is there without a word", () => {
    const link = new LinkState(0);
    link.rest(0);
    link.resume(600000);
    assert.equal(link.view(600000).strip, "none");
    link.heard(600050);
    assert.equal(link.view(600050).strip, "none");
});

test("a silence that nobody was told of is none after a rest", () => {
    const link = new LinkState(0);
    link.heard(1000);
    link.rest(3500);
    link.resume(600000);
    link.heard(600050);
    assert.equal(link.view(600050).strip, "none");
});
