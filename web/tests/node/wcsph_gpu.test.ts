// The solver of wcsph on WebGPU as browsers check it (Dawn in Node): every shader compiles, and follows the C solver.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { ProbeReader } from '../../src/probes.ts';
import { Field, Weir, type Sim } from '../../src/weir.ts';
import { gpu as browser, until, wasmFile } from './support.ts';

const weir = await Weir.load(wasmFile('weir.wasm'), { gpu: browser });
const gpu = weir.createGpu();
await gpu.ready();
after(() => {
  gpu.destroy();
  assert.equal(weir.liveGpuObjects, 0, 'handles are left');
});

const spacing = 0.05;
const box = (min: number[], max: number[]) => ({ box: { min, max } });
const tank = {
  version: 1,
  method: 'wcsph',
  dimension: 2,
  parameters: { particle_spacing: spacing, viscosity: 2, shifting: 1 },
  domain: { min: [0, 0], max: [0.8, 0.6] },
  fluid: [{ ...box([0, 0], [0.4, 0.4]), velocity: [1, 0] }],
};
// Some of everything that has a shader of its own.
const lively = {
  ...tank,
  walls: [{ name: 'gate', ...box([0.7, 0], [0.8, 0.3]), motion: { amplitude: [-0.02, 0], period: 0.1 } }],
  bodies: [{ name: 'block', ...box([0.5, 0.3], [0.65, 0.45]), density: 500 }],
  emitters: [{ center: [0.2, 0.55], direction: [0, -1], size: 0.15, speed: 2, capacity: 50 }],
  drains: [{ min: [0.3, 0], max: [0.4, 0.1] }],
};
// As many as a scene may have: what they take of buffers must be within WebGPU's limits.
const places = Array.from({ length: 1024 }, (_, n) => [0.5 * (n % 32) + 0.25, 0.5 * Math.floor(n / 32) + 0.25] as const);
const crowd = {
  ...tank,
  parameters: { particle_spacing: spacing, gravity: [0, 0] },
  domain: { min: [0, 0], max: [16, 16], open: '-x +x -y +y' },
  fluid: [box([0, 0], [spacing, spacing])],
  emitters: places.map((center, n) => ({ center, direction: [0, -1], size: spacing, speed: 2, start: 1e-3 * (n % 9), capacity: 4 })),
  drains: places.map(([x, y]) => ({ min: [x - 0.1, y - 0.2], max: [x + 0.1, y - 0.02] })),
};
const deep = {
  ...tank,
  dimension: 3,
  domain: { min: [0, 0, 0], max: [0.5, 0.4, 0.3], periodic: 'z' },
  fluid: [{ ...box([0, 0, 0], [0.25, 0.3, 0.3]), velocity: [1, 0, 0] }],
};

async function start(scene: object, onGpu: boolean): Promise<Sim> {
  const loaded = weir.loadScene(scene);
  const sim = weir.createSim(loaded, onGpu ? { gpu } : {});
  loaded.destroy();
  await sim.ready();
  return sim;
}

async function follow(document: object, steps: number, tolerance: number): Promise<void> {
  const sims = [await start(document, false), await start(document, true)];
  const fields: Float32Array[] = [];
  for (const sim of sims) {
    sim.step(steps);
    fields.push((await until(() => (sim.poll(), sim.read(Field.position)), 'read')).slice());
  }
  const [expected, found] = fields as [Float32Array, Float32Array];
  assert.equal(found.length, expected.length);
  const off = found.reduce((most, value, k) => Math.max(most, Math.abs(value - (expected[k] as number))), 0);
  assert.ok(off < tolerance * spacing, `positions differ by ${off} m`);
  const moved = await start(document, false);
  const before = moved.read(Field.position) as Float32Array;
  assert.ok(expected.some((value, k) => Math.abs(value - (before[k] as number)) > 0.1 * spacing), 'nothing moved');
  for (const sim of [...sims, moved]) sim.destroy();
}

// Of the state at the first call, though steps go on while the device's answers are on their way.
async function measure(document: object, place: number[], direction: number[]): Promise<void> {
  const probes = [
    { kind: 'pressure', position: place }, { kind: 'velocity', position: place }, { kind: 'height', position: place },
    { kind: 'force', target: 'domain' }, { kind: 'front', direction }, { kind: 'mass', min: place.map(() => 0), max: place },
  ].map((probe) => ({ ...probe, rate: 1e4 }));
  const [reference, sim] = [await start({ ...document, probes }, false), await start({ ...document, probes }, true)];
  const [wanted, found] = [new ProbeReader(reference), new ProbeReader(sim)];
  for (let round = 0; round < 2; round++) {
    reference.step(10);
    sim.step(10);
    await sim.finished();
    const time = sim.time;
    const expected = reference.diagnose();
    const samples = wanted.update();
    assert.equal(found.update(), null);
    assert.equal(sim.diagnose(), null);
    sim.step(1);
    const diagnostics = await until(() => (sim.poll(), sim.diagnose()), 'diagnose');
    const there = await until(() => (sim.poll(), found.update()), 'probes');
    reference.step(1);
    assert.equal(there.length, probes.length);
    for (const { probe, times, values } of there) {
      const numbers = samples?.[probe]?.values ?? [];
      const scale = Math.max(...numbers.map(Math.abs));
      assert.deepEqual(times, [time]);
      assert.ok(scale > 0 && values.length === numbers.length, JSON.stringify(probes[probe]));
      // Of two solvers' states that are this near.
      values.forEach((value, k) => assert.ok(Math.abs(value - (numbers[k] as number)) < 0.02 * scale,
        `${probes[probe]?.kind}: ${values} instead of ${numbers}`));
    }
    assert.ok(expected && expected.kineticEnergy > 0);
    assert.equal(diagnostics.step, expected.step);
    assert.ok(Math.abs(diagnostics.kineticEnergy / expected.kineticEnergy - 1) < 1e-3);
    assert.ok(Math.abs(diagnostics.potentialEnergy / expected.potentialEnergy - 1) < 1e-4);
    assert.ok(Math.abs(diagnostics.densityErrorMean - expected.densityErrorMean) < 1e-5);
  }
  for (const reader of [wanted, found]) reader.destroy();
  for (const one of [reference, sim]) one.destroy();
}

test('finished() waits for the steps that are queued', async () => {
  const sim = await start(tank, true);
  sim.step(5);
  await sim.finished();
  assert.equal(sim.stepCount, 5);
  assert.ok(sim.time > 0);
  sim.destroy();
});

test('2D: 40 steps of a tank follow the C solver', () => follow(tank, 40, 1e-3));
test('2D: moving wall, body, emitter and drain', () => follow(lively, 40, 5e-3));
test('2D: 1,024 emitters and drains', () => follow(crowd, 30, 5e-3));
test('3D: 20 steps follow the C solver', () => follow(deep, 20, 1e-3));
test('2D: probes and diagnostics of the state at which they were asked for', () => measure(lively, [0.15, 0.2], [1, 0]));
test('3D: probes and diagnostics', () => measure(deep, [0.1, 0.15, 0.28], [1, 0, 0]));

test('positions and velocities come of one moment while steps go on', async () => {
  const [sim, still] = [await start(lively, true), await start(lively, true)];
  for (const one of [sim, still]) one.step(12);
  const wanted = await until(() => (still.poll(), still.readMotion()), 'readMotion');
  const first = sim.readMotion(); // asked for; a fast device may have it at once
  sim.step(5);
  const motion = first ?? (await until(() => (sim.poll(), sim.readMotion()), 'readMotion'));
  assert.deepEqual(motion.positions, wanted.positions);
  assert.deepEqual(motion.velocities, wanted.velocities);
  // The next copy is of the steps since, and more may be asked of it than was under way.
  sim.readMotion();
  const density = (await until(() => (sim.poll(), sim.read(Field.density)), 'read')).slice();
  assert.ok(density.some((value) => value > 900));
  const later = await until(() => (sim.poll(), sim.readMotion()), 'readMotion');
  assert.notDeepEqual(later.positions, wanted.positions);
  for (const one of [sim, still]) one.destroy();
});

test('after a blow-up the last good positions and velocities come', async () => {
  const sim = await start({ ...tank, parameters: { ...tank.parameters, stepping: 'fixed', time_step: 0.01 } }, true);
  try {
    sim.step(100);
    await sim.finished();
    assert.fail('it did not blow up');
  } catch (error) {
    assert.match((error as Error).message, /blew up/);
  }
  const { positions, velocities } = await until(() => (sim.poll(), sim.readMotion()), 'readMotion');
  assert.ok(positions.every(Number.isFinite) && velocities.every(Number.isFinite));
  assert.ok(velocities.some((value) => value !== 0));
  const diagnostics = await until(() => (sim.poll(), sim.diagnose()), 'diagnose');
  assert.ok(Number.isFinite(diagnostics.kineticEnergy));
  sim.destroy();
});
