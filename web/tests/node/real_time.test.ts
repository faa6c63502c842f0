// How the page finds the number of particles that a graphics card moves in real time.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { isSlowMotion, KnownCards, particlesInRealTime, RunRate, stepsFit } from '../../src/real_time.ts';

const memory = () => {
  const kept = new Map<string, string>();
  return { getItem: (name: string) => kept.get(name) ?? null, setItem: (name: string, value: string) => void kept.set(name, value) };
};

// A run of `particles` on a card that takes `stepsPerSecond` steps of a million particles: the step is as long as a spacing.
const factorOf = (particles: number, stepsPerSecond: number, dimension: number): number =>
  ((1e6 / particles) * stepsPerSecond * 1e-4) * (1e6 / particles) ** (1 / dimension);

test('the number that it gives runs in real time', () => {
  for (const dimension of [2, 3]) {
    for (const rate of [10, 100, 1000]) {
      for (const particles of [2e4, 3e5, 4e6]) {
        const next = particlesInRealTime(particles, factorOf(particles, rate, dimension), dimension);
        const factor = factorOf(next, rate, dimension);
        assert.ok(factor > 0.94 && factor < 1.15, `${dimension}D: ${particles} -> ${next}, ${factor} of real time`);
      }
    }
  }
  assert.equal(particlesInRealTime(100_000, 0.2, 3), 31_000); // two digits
  assert.equal(new KnownCards(null).note('card', 'dam', 70_000, 0, 3), 1); // not one step in all the time
});

test('a run is measured once, after it has settled', () => {
  const rate = new RunRate();
  const time = (now: number): number => (now < 6000 ? 0 : 0.0005 * (now - 6000)); // half of real time after a slow start
  rate.restart(5000);
  const found: number[] = [];
  for (let now = 5000; now < 12_000; now += 16) {
    const factor = rate.update(now, time(now));
    if (factor !== null) found.push(factor);
  }
  assert.equal(found.length, 1);
  assert.ok(Math.abs((found[0] ?? 0) - 0.5) < 0.01, `${found}`);
  rate.restart(20_000);
  assert.equal(rate.update(20_100, 0), null);
  assert.equal(rate.update(21_300, 3), null);
  assert.equal(rate.update(22_000, 0.1), null); // started again: 2 s from here on
  assert.equal(rate.update(23_500, 0.2), null);
  assert.ok(Math.abs((rate.update(24_000, 1.1) ?? 0) - 0.5) < 1e-9);
});

test('slow motion is remembered by card and scene, and a card with time to spare is given more', () => {
  const known = new KnownCards(memory());
  assert.equal(known.recall('card', 'dam'), 0);
  assert.equal(known.note('card', 'dam', 70_000, 1, 3), 0);
  assert.equal(known.recall('card', 'dam'), 0, 'nothing to remember');
  assert.ok(isSlowMotion(0.3) && !isSlowMotion(0.8));
  const fewer = known.note('card', 'dam', 70_000, 0.3, 3);
  assert.equal(fewer, particlesInRealTime(70_000, 0.3, 3));
  assert.equal(known.recall('card', 'dam'), fewer);
  assert.equal(known.recall('other card', 'dam'), 0);
  assert.equal(known.recall('card', 'drop'), 0);
  assert.equal(known.note('card', 'dam', fewer, 0.8, 3), 0);
  assert.equal(known.recall('card', 'dam'), fewer);
  assert.equal(known.note('card', 'dam', fewer, 1, 3), 0);
  assert.ok(known.recall('card', 'dam') > fewer);
});

test('what was measured of the last card is remembered with its name', () => {
  const store = memory();
  const known = new KnownCards(store);
  assert.deepEqual(known.device(), { device: '', parallelism: 0 });
  known.noteDevice({ device: 'vendor architecture-7', parallelism: 4096 });
  assert.deepEqual(new KnownCards(store).device(), { device: 'vendor architecture-7', parallelism: 4096 });
  store.setItem('weir.device', '-5 vendor');
  assert.deepEqual(known.device(), { device: '', parallelism: 0 });
});

test('where the steps of a frame fit, drawing is what is slow', () => {
  assert.ok(stepsFit(0.4, 0.19, 16.7)); // 8 ms of 16.7
  assert.ok(!stepsFit(0.4, 0.3, 16.7));
  assert.ok(!stepsFit(0, 0.3, 16.7) && !stepsFit(0.4, 0, 16.7), 'not known');
  const known = new KnownCards(memory());
  assert.ok(known.drawsWater('card'));
  known.noteTooSlowForWater('card');
  assert.ok(!known.drawsWater('card') && known.drawsWater('other card'));
});

test('a store that is missing, full or broken is no fault', () => {
  const broken = { getItem: () => { throw new Error('no'); }, setItem: () => { throw new Error('full'); } };
  for (const store of [null, broken, { getItem: () => 'nonsense', setItem: () => undefined }]) {
    const known = new KnownCards(store);
    assert.equal(known.recall('card', 'dam'), 0);
    assert.ok(known.note('card', 'dam', 70_000, 0.3, 3) > 0);
    known.noteTooSlowForWater('card');
    known.noteDevice({ device: 'card', parallelism: 256 });
    assert.equal(known.device().parallelism, 0);
  }
});
