// The picture's sharpness on cards that are made up: drawing takes something fixed and something per pixel, and steps take their
// part.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Sharpness } from '../../src/sharpness.ts';

const interval = 1000 / 60;

type Card = { fixedMs: number; pixelsMs: number; stepsMs?: number }; // of all the display's pixels

// Seconds of frames; returns the shares that it went through.
function run(sharpness: Sharpness, card: (second: number) => Card, seconds: number, ratio = 2, intervalMs = interval): number[] {
  const seen = [sharpness.share];
  let mean = 0;
  sharpness.restart(0, true);
  for (let now = 0; now < 1000 * seconds; now += interval) {
    const { fixedMs, pixelsMs, stepsMs = 6 } = card(now / 1000);
    const drawMs = fixedMs + pixelsMs * sharpness.share ** 2;
    mean = mean > 0 ? mean + 0.05 * (drawMs - mean) : drawMs;
    if (sharpness.update(now, { drawMs: mean, stepsMs }, intervalMs, ratio)) seen.push(sharpness.share);
  }
  return seen;
}

test('a card with time to spare draws every pixel', () => {
  assert.deepEqual(run(new Sharpness(), () => ({ fixedMs: 1, pixelsMs: 7 }), 20), [1]);
  assert.deepEqual(run(new Sharpness(), () => ({ fixedMs: 1, pixelsMs: 12, stepsMs: 2 }), 20), [1]);
});

test('a small card on a dense display draws as many pixels as it has time for', () => {
  for (const pixelsMs of [12, 20, 40, 80]) {
    for (const stepsMs of [1, 6, 14, 40]) {
      const sharpness = new Sharpness();
      const seen = run(sharpness, () => ({ fixedMs: 1, pixelsMs, stepsMs }), 30);
      assert.ok(seen.length <= 3, `${pixelsMs} ms: ${seen}`);
      const drawMs = 1 + pixelsMs * sharpness.share ** 2;
      const room = Math.max(0.95 * interval - stepsMs, 0.45 * interval);
      assert.ok(drawMs < 1.02 * room || sharpness.share === 0.4, `${pixelsMs} and ${stepsMs} ms: ${sharpness.share}`);
    }
  }
});

test('a picture stays fine enough to look at', () => {
  const sharpness = new Sharpness();
  run(sharpness, () => ({ fixedMs: 1, pixelsMs: 500 }), 30, 1);
  assert.equal(sharpness.share, 0.8);
});

test('on a display less dense than the last one too', () => {
  const sharpness = new Sharpness();
  const small = (): Card => ({ fixedMs: 1, pixelsMs: 80 });
  run(sharpness, small, 10, 2);
  assert.equal(sharpness.share, 0.4);
  run(sharpness, small, 3, 1);
  assert.equal(sharpness.share, 0.8);
});

test('what fewer pixels do not mend they do not blur', () => {
  const sharpness = new Sharpness();
  const seen = run(sharpness, () => ({ fixedMs: 35, pixelsMs: 2 }), 60);
  assert.equal(sharpness.share, 1);
  assert.equal(seen.length, 3, `${seen}`); // tried once
});

test('it comes back when there is time again', () => {
  const sharpness = new Sharpness();
  run(sharpness, (second) => ({ fixedMs: 1, pixelsMs: second < 10 ? 40 : 5 }), 40);
  assert.equal(sharpness.share, 1);
});

test('another picture begins as sharp as the last one; without a card every pixel is drawn', () => {
  const sharpness = new Sharpness();
  run(sharpness, () => ({ fixedMs: 1, pixelsMs: 40 }), 10);
  const { share } = sharpness;
  assert.ok(share < 1);
  sharpness.restart(20_000, true);
  assert.equal(sharpness.share, share);
  sharpness.restart(20_000, false);
  assert.equal(sharpness.share, 1);
});

test('displays with more frames do not make it blur', () => {
  assert.deepEqual(run(new Sharpness(), () => ({ fixedMs: 2, pixelsMs: 5 }), 20, 2, 1000 / 144), [1]);
});

test('nothing changes while nothing is known', () => {
  const sharpness = new Sharpness();
  sharpness.restart(0, true);
  for (let now = 0; now < 10000; now += interval) assert.equal(sharpness.update(now, { drawMs: 0, stepsMs: 9 }, interval, 2), false);
  assert.equal(sharpness.update(10500, { drawMs: 100, stepsMs: 9 }, interval, 2), false);
});
