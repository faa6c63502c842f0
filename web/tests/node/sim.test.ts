// Simulations on the CPU through the bindings: stepping, reading, tools, faults, memory.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { Diagnose, Field, Status, ToolKind, Weir, WeirError, type Sim } from '../../src/weir.ts';
import { root, wasmFile } from './support.ts';

const bytes = wasmFile('weir.wasm');
const weir = await Weir.load(bytes, { gpu: null });
const drop = {
  parameters: { particle_spacing: 0.02, support_radius: 0.05, time_step: 0.0003 },
  fluid: [{ ball: { center: [0, -0.2], radius: 0.3 } }],
};

function start(document: unknown = drop): Sim {
  const scene = weir.loadScene(document);
  const sim = weir.createSim(scene);
  scene.destroy();
  return sim;
}

const read = (sim: Sim, field: Field): Float32Array => (sim.read(field) as Float32Array).slice();
const mean = (values: Float32Array, offset: number): number => {
  let sum = 0;
  for (let k = offset; k < values.length; k += 2) sum += values[k] as number;
  return (2 * sum) / values.length;
};

test('the program is small and asks for little', () => {
  const module = new WebAssembly.Module(bytes);
  assert.ok(bytes.length <= 712 * 1024, `${bytes.length} bytes`);
  const modules = new Set(WebAssembly.Module.imports(module).map((entry) => entry.module));
  modules.delete('wasi_snapshot_preview1');
  assert.deepEqual([...modules], ['webgpu']);
  assert.match(readFileSync(join(root, 'include/weir/weir.h'), 'utf8'), new RegExp(`WEIR_VERSION "${weir.version}"`));
});

test('a drop falls as gravity has it', () => {
  const sim = start();
  assert.match(sim.device, /CPU/);
  const from = read(sim, Field.position);
  sim.step(100);
  assert.equal(sim.stepCount, 100);
  assert.ok(Math.abs(sim.time - 0.03) < 1e-6);
  assert.ok(Math.abs(mean(read(sim, Field.velocity), 1) + 9.81 * 0.03) < 1e-3);
  const fallen = mean(from, 1) - mean(read(sim, Field.position), 1);
  assert.ok(Math.abs(fallen - 0.5 * 9.81 * 0.03 ** 2) < 2e-4, `${fallen}`);
  sim.destroy();
});

test('diagnostics agree with the fields', () => {
  const sim = start();
  sim.step(40);
  const found = sim.diagnose(Diagnose.neighbors | Diagnose.hash);
  assert.ok(found);
  const velocity = read(sim, Field.velocity);
  const position = read(sim, Field.position);
  const density = read(sim, Field.density);
  const mass = found.momentum[1] / (mean(velocity, 1) * sim.particleCount);
  let kinetic = 0;
  let potential = 0;
  let fastest = 0;
  for (let k = 0; k < sim.particleCount; k++) {
    const [vx = 0, vy = 0, y = 0] = [velocity[2 * k], velocity[2 * k + 1], position[2 * k + 1]];
    kinetic += 0.5 * mass * (vx * vx + vy * vy);
    potential += mass * 9.81 * (y + 1);
    fastest = Math.max(fastest, Math.hypot(vx, vy));
  }
  const near = (a: number, b: number) => assert.ok(Math.abs(a - b) <= 1e-5 * Math.abs(b), `${a} ${b}`);
  near(found.kineticEnergy, kinetic);
  near(found.potentialEnergy, potential);
  near(found.maxSpeed, fastest);
  near(found.densityErrorMax, Math.max(...density) / 1000 - 1);
  assert.equal(found.step, 40);
  assert.equal(found.lostParticles, 0);
  assert.ok(found.meanNeighbors > 10 && found.meanNeighbors < 25);
  assert.match(found.stateHash, /^[0-9a-f]{16}$/);
  assert.ok((sim.diagnose()?.meanNeighbors ?? 0) < 0);
  assert.equal(sim.diagnose()?.stateHash, '');
  assert.equal(read(sim, Field.pressure).length, sim.particleCount);
  assert.equal(read(sim, Field.acceleration).length, 2 * sim.particleCount);
  sim.destroy();
});

test('wall time becomes steps, up to the cap', () => {
  const sim = start();
  assert.equal(sim.advance(0.00125), 4); // 0.0003 each
  assert.equal(sim.advance(0.0003), 1); // 0.0005 owed
  sim.setMaxSteps(7);
  assert.equal(sim.advance(0.09), 7); // the rest is dropped
  assert.equal(sim.stepCount, 12);
  assert.throws(() => sim.advance(NaN), WeirError);
  sim.destroy();
});

test('reset goes back to the start, bit by bit', () => {
  const sim = start();
  const from = sim.diagnose(Diagnose.hash)?.stateHash;
  sim.step(20);
  assert.notEqual(sim.diagnose(Diagnose.hash)?.stateHash, from);
  sim.reset();
  assert.equal(sim.diagnose(Diagnose.hash)?.stateHash, from);
  assert.equal(sim.stepCount, 0);
  sim.destroy();
});

test('a state that is set is the state that is read', () => {
  const sim = start();
  const position = read(sim, Field.position).map((x) => x * 0.9);
  const velocity = read(sim, Field.velocity).map((_, k) => k % 2);
  sim.setState(position, velocity);
  assert.deepEqual(read(sim, Field.position), position);
  assert.deepEqual(read(sim, Field.velocity), velocity);
  assert.throws(() => sim.setState(position.slice(2), velocity), /must have/);
  position[0] = NaN;
  assert.throws(() => sim.setState(position, velocity), WeirError);
  sim.destroy();
});

test('parameters change while it runs, or say why not', () => {
  const sim = start();
  sim.setParameter('gravity', [3, 0]);
  assert.deepEqual(sim.parameter('gravity'), [3, 0, 0]);
  sim.step(10);
  assert.ok(mean(read(sim, Field.velocity), 0) > 0.005);
  assert.throws(() => sim.setParameter('viscosity', -1), /viscosity/);
  assert.throws(() => sim.setParameter('support_radius', 0.1), /support_radius/);
  assert.throws(() => sim.setParameter('stickiness', 1), /stickiness/);
  assert.throws(() => sim.setParameter('gravity', [1]), WeirError);
  assert.equal(sim.status, Status.ok); // a refused value stops nothing
  sim.destroy();
});

test('the tool pushes, pulls and stirs', () => {
  const outward = (kind: ToolKind, vx: number): number => {
    const sim = start({ ...drop, parameters: { ...drop.parameters, gravity: [0, 0] } });
    sim.setTool(kind, [-0.2, -0.2, 0], [vx, 0, 0], 0.3, 20);
    sim.step(20);
    const speed = mean(read(sim, Field.velocity), 0);
    sim.destroy();
    return speed;
  };
  assert.ok(outward(ToolKind.push, 0) > 1e-3);
  assert.ok(outward(ToolKind.pull, 0) < -1e-3);
  assert.ok(outward(ToolKind.stir, 2) > 1e-3);
  assert.equal(Math.abs(outward(ToolKind.none, 2)) < 1e-6, true);
  const sim = start();
  assert.throws(() => sim.setTool(ToolKind.push, [NaN, 0, 0], [0, 0, 0], 0.3, 20), WeirError);
  sim.destroy();
});

test('a blow-up is told with its step and a time step that holds', () => {
  const sim = start({ ...drop, parameters: { ...drop.parameters, time_step: 0.05 } });
  assert.match(sim.warning, /time_step/);
  const run = () => {
    for (let k = 0; k < 200; k++) {
      sim.step(10);
      assert.ok(sim.poll() === Status.ok || sim.status !== Status.ok);
      if (sim.status !== Status.ok) throw new WeirError(sim.status, sim.error);
    }
  };
  assert.throws(run, (error: WeirError) => error.status === Status.unstable && /step/.test(error.message));
  sim.destroy();
});

test('simulations live side by side', () => {
  const alone = start();
  alone.step(30);
  const wanted = alone.diagnose(Diagnose.hash)?.stateHash;
  const first = start();
  const second = start({ ...drop, parameters: { ...drop.parameters, viscosity: 5 } });
  for (let k = 0; k < 30; k++) {
    first.step(1);
    second.step(2);
  }
  assert.equal(first.diagnose(Diagnose.hash)?.stateHash, wanted);
  assert.notEqual(second.diagnose(Diagnose.hash)?.stateHash, wanted);
  for (const sim of [alone, first, second]) sim.destroy();
});

test('views stay right when memory grows', () => {
  const sim = start();
  sim.step(5);
  const velocity = read(sim, Field.velocity);
  const before = weir.memoryBytes;
  const fluid = [{ box: { min: [-0.9, -0.9], max: [0.9, 0.9] } }];
  const large = start({ parameters: { particle_spacing: 0.004, support_radius: 0.01 }, fluid });
  assert.ok(large.particleCount > 190_000);
  assert.ok(weir.memoryBytes > before, 'nothing grew: the test needs a larger scene');
  assert.equal((large.read(Field.position) as Float32Array).length, 2 * large.particleCount);
  assert.deepEqual(read(sim, Field.velocity), velocity);
  sim.step(5);
  assert.equal(sim.diagnose()?.step, 10);
  large.destroy();
  sim.destroy();
});

test('what is destroyed gives its memory back', () => {
  const cycle = () => {
    const sim = start();
    for (const field of [Field.position, Field.velocity, Field.density]) sim.read(field);
    sim.step(1);
    sim.diagnose(Diagnose.neighbors);
    sim.destroy();
    sim.destroy(); // twice is allowed
  };
  for (let k = 0; k < 20; k++) cycle();
  const before = weir.memoryBytes;
  for (let k = 0; k < 400; k++) cycle();
  assert.equal(weir.memoryBytes, before);
});

test('more particles than memory holds is an error, not a crash', () => {
  const parameters = { particle_spacing: 0.0002, support_radius: 0.0005, time_step: 1e-6 };
  const fluid = [{ box: { min: [-1, -1], max: [1, 1] } }];
  assert.throws(
    () => start({ parameters, fluid }),
    (error: WeirError) => error instanceof WeirError && error.message.length > 20,
  );
  const sim = start(); // and the rest goes on
  sim.step(1);
  sim.destroy();
});
