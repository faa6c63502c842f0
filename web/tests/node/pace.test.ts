// How many steps a frame gets, on devices that are made up: a frame's work is drawing and its steps, one frame after the
// other; a browser tells of a frame's end some time later, and draws no more often than every 16.7 ms.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Pace } from '../../src/pace.ts';

const interval = 1000 / 60;
const budget = 0.85 * interval;

type Made = { stepMs: number; drawMs: number; wanted: number; clock: boolean };

// Means over the last frames: steps per frame, and milliseconds from frame to frame.
function run(pace: Pace, { stepMs, drawMs, wanted, clock }: Made, frames = 1200): { steps: number; frameMs: number } {
  let free = 0; // when the device is
  let told = 0;
  let at = 0;
  let steps = 0;
  let first = 0;
  const half = frames / 2;
  for (let n = 0; n < frames; n++) {
    if (n === half) first = at;
    const taken = Math.min(wanted, pace.maxSteps);
    const jitter = 1 + 0.2 * Math.sin(37 * n);
    free = Math.max(free, at) + drawMs * jitter + taken * stepMs;
    const end = free + 3 * jitter;
    pace.measured(taken, end - Math.max(at, told), budget, clock ? stepMs : 0);
    told = end;
    if (n >= half) steps += taken;
    at = Math.max(at + interval, free - interval); // two frames under way
  }
  return { steps: steps / half, frameMs: (at - first) / half };
}

test('a device that tells its steps gets all that are wanted where there is time for them', () => {
  for (const stepMs of [0.02, 0.04, 0.5]) {
    const wanted = Math.floor((0.75 * interval) / stepMs);
    const { steps, frameMs } = run(new Pace(), { stepMs, drawMs: 1, wanted, clock: true });
    assert.ok(steps > 0.99 * wanted, `${stepMs} ms: ${steps} of ${wanted} steps`);
    assert.ok(frameMs < 1.05 * interval, `${frameMs} ms per frame`);
  }
});

test('and no more than its frames have time for', () => {
  for (const drawMs of [1, 6, 30]) {
    for (const stepMs of [0.05, 1, 9]) {
      const pace = new Pace();
      const { steps, frameMs } = run(pace, { stepMs, drawMs, wanted: 1e6, clock: true });
      const fair = Math.max(drawMs + Math.max(0.65 * budget, stepMs), interval);
      assert.ok(frameMs < 1.3 * fair, `${drawMs} + ${stepMs} ms per step: ${frameMs} ms per frame, ${steps} steps`);
      assert.ok(steps * stepMs > 0.4 * budget, `${drawMs} + ${stepMs} ms per step: only ${steps} steps`);
      assert.equal(pace.stepMs, stepMs);
    }
  }
});

test('without its clock the times of frames tell', () => {
  const pace = new Pace();
  const { steps, frameMs } = run(pace, { stepMs: 0.5, drawMs: 2, wanted: 1e6, clock: false });
  assert.ok(steps > 10 && frameMs < 1.5 * interval, `${steps} steps, ${frameMs} ms`);
  assert.ok(pace.stepMs > 0.2 && pace.stepMs < 1);
});

test('it starts with few steps, and anew after a reset', () => {
  const pace = new Pace();
  assert.equal(pace.maxSteps, 2);
  run(pace, { stepMs: 0.01, drawMs: 1, wanted: 1e6, clock: true }, 40);
  assert.ok(pace.maxSteps > 100);
  pace.reset();
  assert.equal(pace.maxSteps, 2);
  pace.measured(2, NaN, budget, 0.01);
  assert.equal(pace.maxSteps, 2);
});
