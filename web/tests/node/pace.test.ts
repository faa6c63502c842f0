// How many steps a frame gets, on devices that are made up: a frame's work is drawing and its steps, one frame after the
// other; a browser tells of a frame's end some time later, and draws no more often than every 16.7 ms.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Pace } from '../../src/pace.ts';

const interval = 1000 / 60;
const longest = 51;

// `late`: how much later than a frame's end the browser tells of it. `drawing`: the device tells what that takes.
type Made = { stepMs: number; drawMs: number; wanted: number; clock: boolean; late?: number; drawing?: boolean };
type Ran = { steps: number; frameMs: number; changes: number };

// Means over the second half of the frames: steps per frame, and milliseconds from frame to frame; and how often the number of
// steps changed much.
function run(pace: Pace, { stepMs, drawMs, wanted, clock, late = 3, drawing = clock }: Made, frames = 1200): Ran {
  let free = 0; // when the device is
  let told = 0;
  let at = 0;
  let steps = 0;
  let first = 0;
  let last = 0;
  let changes = 0;
  const half = frames / 2;
  for (let n = 0; n < frames; n++) {
    if (n === half) first = at;
    const taken = Math.min(wanted, pace.maxSteps);
    const jitter = 1 + 0.2 * Math.sin(37 * n);
    free = Math.max(free, at) + drawMs * jitter + taken * stepMs;
    const end = free + late * jitter;
    pace.measured(taken, end - Math.max(at, told), interval, clock ? stepMs : 0, drawing ? drawMs : 0);
    told = end;
    if (n >= half) {
      steps += taken;
      if (Math.abs(taken - last) * stepMs > 0.4 * interval) changes++;
    }
    last = taken;
    at = Math.max(at + interval, Math.ceil((free - interval) / interval) * interval); // two frames under way
  }
  return { steps: steps / half, frameMs: (at - first) / half, changes };
}

test('a device that tells its steps gets all that are wanted where there is time for them', () => {
  for (const stepMs of [0.02, 0.04, 0.5]) {
    const wanted = Math.floor((0.85 * interval) / stepMs);
    const { steps, frameMs } = run(new Pace(longest), { stepMs, drawMs: 1, wanted, clock: true });
    assert.ok(steps > 0.99 * wanted, `${stepMs} ms: ${steps} of ${wanted} steps`);
    assert.ok(frameMs < 1.05 * interval, `${frameMs} ms per frame`);
  }
});

test('frames keep to the display while drawing leaves a third of each for steps', () => {
  for (const late of [0, 3]) {
    for (const drawMs of [1, 3, 6]) {
      const { steps, frameMs } = run(new Pace(longest), { stepMs: 0.05, drawMs, wanted: 1e6, clock: true, late });
      const told = `drawing ${drawMs}, told ${late} ms late: ${frameMs} ms per frame, ${steps} steps`;
      assert.ok(frameMs < 1.25 * interval, told);
      assert.ok(steps * 0.05 > 0.97 * (0.95 * interval - drawMs), told);
    }
  }
});

test('and last two or three of the display where it leaves less', () => {
  for (const [drawMs, most] of [[11, 2], [18, 3], [30, 4]] as const) {
    for (const stepMs of [0.05, 1]) {
      const { steps, frameMs } = run(new Pace(longest), { stepMs, drawMs, wanted: 1e6, clock: true });
      const told = `drawing ${drawMs}: ${frameMs} ms per frame, ${steps} steps of ${stepMs} ms`;
      assert.ok(frameMs < 1.1 * most * interval, told);
      assert.ok(steps * stepMs > 0.28 * frameMs, told);
    }
  }
});

test('it settles, whatever drawing takes and however late the browser tells', () => {
  for (const late of [0, 1, 3]) {
    for (let drawMs = 1; drawMs < 30; drawMs++) {
      for (const drawing of [false, true]) {
        const { changes } = run(new Pace(longest), { stepMs: 0.1, drawMs, wanted: 1e6, clock: true, late, drawing });
        assert.ok(changes < 6, `drawing ${drawMs} ms, ${drawing ? '' : 'not '}known, told ${late} ms late: ${changes} changes`);
      }
    }
  }
});

test('frames that are rare for another reason get steps for half of their time', () => {
  const pace = new Pace(longest);
  for (let n = 0; n < 200; n++) pace.measured(Math.min(pace.maxSteps, 150), 50, interval, 0.16);
  assert.ok(pace.maxSteps >= 150, `${pace.maxSteps} steps`);
});

test('a frame that may not last longer has no more than its interval', () => {
  const pace = new Pace();
  for (let n = 0; n < 200; n++) pace.measured(pace.maxSteps, 0.5 * pace.maxSteps, 9);
  assert.ok(pace.maxSteps >= 15 && pace.maxSteps <= 23, `${pace.maxSteps} steps`);
});

test('without its clock the times of frames tell', () => {
  const pace = new Pace(longest);
  const { steps, frameMs } = run(pace, { stepMs: 0.5, drawMs: 2, wanted: 1e6, clock: false });
  assert.ok(steps > 10 && frameMs < 1.5 * interval, `${steps} steps, ${frameMs} ms`);
  assert.ok(pace.stepMs > 0.2 && pace.stepMs < 1);
});

test('what the first frames took while all was made is forgotten when the device tells', () => {
  const pace = new Pace(longest);
  for (let n = 0; n < 4; n++) pace.measured(2, 400, interval);
  for (let n = 0; n < 20; n++) pace.measured(Math.min(pace.maxSteps, 40), 5 + 0.1 * Math.min(pace.maxSteps, 40), interval, 0.1);
  assert.ok(pace.maxSteps > 90 && pace.maxSteps < 130, `${pace.maxSteps} steps`);
});

test('it starts with few steps, and anew after a reset', () => {
  const pace = new Pace(longest);
  assert.equal(pace.maxSteps, 2);
  run(pace, { stepMs: 0.01, drawMs: 1, wanted: 1e6, clock: true }, 40);
  assert.ok(pace.maxSteps > 100);
  pace.reset();
  assert.equal(pace.maxSteps, 2);
  pace.measured(2, NaN, interval, 0.01);
  assert.equal(pace.maxSteps, 2);
});
