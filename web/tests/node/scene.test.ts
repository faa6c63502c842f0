// Scenes through the bindings: the same values, the same messages and the same bits as the native program.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { chooseRange } from '../../src/legend.ts';
import type { SceneDocument } from '../../src/scene_document.ts';
import { SceneStore } from '../../src/scene_store.ts';
import { Camera } from '../../src/view.ts';
import { Diagnose, Status, Weir, WeirError } from '../../src/weir.ts';
import { root, wasmFile } from './support.ts';

const weir = await Weir.load(wasmFile('weir.wasm'), { gpu: null });
const native = process.env.WEIR_NATIVE ?? join(root, 'build/weir');
const folder = mkdtempSync(join(tmpdir(), 'weir-scenes-'));
after(() => rmSync(folder, { recursive: true }));
before(() => assert.ok(existsSync(native), `${native} is missing: run tools/build.sh native, or set WEIR_NATIVE`));

type Parameter = { name: string; kind: string; unit: string; live: boolean; default: unknown };

test('the parameter list is the native one', () => {
  const listed = spawnSync(native, ['params', '--json'], { encoding: 'utf8' });
  assert.equal(listed.status, 0, listed.stderr);
  const wanted = JSON.parse(listed.stdout) as (Parameter & { enum?: string[] })[];
  const key = (kind: string, unit: string, live: boolean) => `${kind} ${unit} ${live}`;
  assert.deepEqual(
    weir.parameters.map((p) => [p.name, key(p.kind, p.unit, p.live)]),
    wanted.map((p) => [p.name, key(p.kind, p.unit, p.live)]),
  );
  for (const [index, info] of weir.parameters.entries()) {
    const given = wanted[index];
    const numbers = info.kind === 'vector' ? info.default.slice(0, 2) : info.default[0];
    assert.deepEqual(info.kind === 'choice' ? info.choices[info.default[0] as number] : numbers, given?.default);
    assert.ok(info.help.length > 10 && info.maximum > info.minimum, info.name);
    if (info.kind === 'choice') assert.deepEqual(info.choices, given?.enum);
  }
});

test('the defaults of a scene are those of the list', () => {
  const scene = weir.loadScene({});
  for (const info of weir.parameters) {
    const wanted = info.kind === 'choice' ? info.default : info.default.map(Math.fround);
    assert.deepEqual(scene.parameter(info.name), wanted, info.name);
  }
  scene.destroy();
});

// ---- Golden hashes ----

type Golden = Record<string, { steps: number; hash: string }>;
const golden = JSON.parse(readFileSync(join(root, 'tests/golden.json'), 'utf8')) as Golden;
const files = readdirSync(join(root, 'scenes')).filter((name) => name.endsWith('.json'));
const document = (name: string): Record<string, unknown> =>
  JSON.parse(readFileSync(join(root, 'scenes', `${name}.json`), 'utf8'));

test('there are scenes, each with its golden hash', () => {
  assert.ok(files.length >= 6);
  assert.deepEqual(files.map((name) => name.replace('.json', '')).sort(), Object.keys(golden).sort());
});

for (const [name, { steps, hash }] of Object.entries(golden)) {
  test(`${name}: the same bits as native after ${steps} steps`, () => {
    const scene = weir.loadScene(document(name));
    scene.check();
    const sim = weir.createSim(scene);
    assert.equal(sim.particleCount, scene.particleCount);
    assert.equal(sim.backend, 'cpu');
    sim.step(steps);
    assert.equal(sim.poll(), Status.ok, sim.error);
    assert.equal(sim.stepCount, steps);
    assert.equal(`0x${sim.diagnose(Diagnose.hash)?.stateHash}`, hash);
    sim.destroy();
    scene.destroy();
  });
}

// ---- wcsph: everything that a scene can hold becomes the same particles natively and here ----

const tank2 = { min: [0, 0], max: [2, 1] };
const cubeMesh = {
  vertices: [0, 1].flatMap((z) => [0, 1].flatMap((y) => [0, 1].map((x) => [x, y, z]))),
  triangles: [
    [0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
    [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5],
  ],
};
const worlds: Record<string, Record<string, unknown>> = {
  'walls, bodies, emitter, drain': {
    // The dimension's place in the file does not matter.
    fluid: [{ box: { min: [0, 0], max: [2, 0.4] } }, { polygon: [[0.2, 0.6], [0.4, 0.9], [0.6, 0.6]], velocity: [1, 0] }],
    domain: { ...tank2, open: '+y', free_slip: true },
    parameters: { particle_spacing: 0.04, equation_of_state: 'tait' },
    walls: [
      { name: 'wedge', polygon: [[1.2, 0], [1.5, 0.3], [1.7, 0]], no_slip: false },
      { ball: { center: [0.5, 0.2], radius: 0.11 }, motion: { angle: 0.5, period: 0.9, amplitude: [0.01, 0.02] } },
      { box: { min: [0, 0], max: [0.1, 0.8] }, motion: { rows: [[0, 0, 0, 0], [0.5, 0.05, 0, 0], [1, 0, 0, 0]], repeats: true } },
    ],
    bodies: [{ name: 'cork', ball: { center: [1, 0.5], radius: 0.1 }, density: 300, fixed: 'x', angular_velocity: 2 }],
    emitters: [{ center: [1.7, 0.8], direction: [-1, -1], size: 0.1, speed: 1, capacity: 50 }],
    drains: [{ min: [0.2, 0], max: [0.4, 0.1] }],
    probes: [{ name: 'push', kind: 'force', target: 'wedge' }],
    method: 'wcsph',
    dimension: 2,
  },
  'a tank around the fluid': {
    method: 'wcsph',
    domain: { min: [-1, -1], max: [1, 1] },
    parameters: { particle_spacing: 0.05 },
    fluid: [{ box: { min: [-1, -1], max: [1, 0] } }],
    walls: [{ ball: { center: [0, 0], radius: 0.8 }, inside: true }],
  },
  'flows': {
    method: 'wcsph',
    domain: { min: [0, 0], max: [1, 1], periodic: 'xy' },
    parameters: { particle_spacing: 0.05, gravity: [0, 0], viscosity: 10 },
    fluid: [{ box: { min: [0, 0], max: [1, 1] }, flow: 'taylor_green', flow_rate: 1 }],
  },
  'a stretched drop': {
    method: 'wcsph',
    domain: { min: [-2, -2], max: [2, 2], open: '-x +x -y +y' },
    parameters: { particle_spacing: 0.1, gravity: [0, 0] },
    fluid: [{ ball: { center: [0, 0], radius: 1 }, flow: 'stretch', flow_rate: 3 }],
  },
  'a square that turns': {
    method: 'wcsph',
    domain: { min: [-2, -2], max: [2, 2], open: '-x +x -y +y' },
    parameters: { particle_spacing: 0.1, gravity: [0, 0] },
    fluid: [{ box: { min: [-1, -1], max: [1, 1] }, flow: 'rotating_square', flow_rate: 3 }],
  },
  'a standing wave': {
    method: 'wcsph',
    domain: { min: [0, 0], max: [2, 1.5], open: '+y' },
    parameters: { particle_spacing: 0.05 },
    fluid: [{ box: { min: [0, 0], max: [2, 1] }, flow: 'standing_wave', flow_rate: 0.05 }],
  },
  'three dimensions': {
    domain: { min: [-1, -1, -1], max: [1, 1, 1] },
    parameters: { particle_spacing: 0.1 },
    fluid: [{ box: { min: [-1, -1, -1], max: [1, -0.4, 1] } }],
    walls: [
      { mesh: { ...cubeMesh, scale: 0.53, translate: [-0.3, -0.8, -0.3] } },
      { cylinder: { from: [-0.7, -0.5, -0.6], to: [-0.6, 0.2, 0.7], radius: 0.2 }, motion: { angular_velocity: [0, 1, 0.5] } },
    ],
    bodies: [{ ball: { center: [0.7, 0.2, 0.5], radius: 0.25 }, density: 700, angular_velocity: [1, 0, 2] }],
    emitters: [{ center: [0.7, 0.8, -0.6], direction: [0.1, -1, 0.2], size: 0.3, speed: 1, capacity: 60 }],
    dimension: 3,
    method: 'wcsph',
  },
};

for (const [name, scene] of Object.entries(worlds)) {
  test(`wcsph, the same bits as native: ${name}`, () => {
    for (const steps of [0, 3]) {
      const file = join(folder, 'world.json');
      writeFileSync(file, JSON.stringify(scene));
      const run = spawnSync(native, ['run', file, '--steps', String(steps), '--backend', 'cpu', '--quiet', '--json'], { encoding: 'utf8' });
      assert.equal(run.status, 0, run.stderr);
      const loaded = weir.loadScene(scene);
      loaded.check();
      const sim = weir.createSim(loaded);
      sim.step(steps);
      assert.equal(sim.poll(), Status.ok, sim.error);
      const said = JSON.parse(run.stdout) as { state_hash: string; particles: number };
      assert.equal(said.state_hash.replace(/^0x/, ''), sim.diagnose(Diagnose.hash)?.stateHash);
      sim.destroy();
      loaded.destroy();
    }
  });
}

// ---- Messages ----

const box = { box: { min: [-0.5, -0.5], max: [0, 0] } };
const bad: Record<string, unknown> = {
  'unknown key': { title: 'x', colour: 'red' },
  'unknown parameter': { parameters: { stickiness: 1 } },
  'text for a number': { parameters: { viscosity: 'thick' } },
  'null': { parameters: { viscosity: null } },
  'true': { parameters: { viscosity: true } },
  'list for a number': { parameters: { viscosity: [1, 2] } },
  'number for a list': { parameters: { gravity: -9.81 } },
  'too long a list': { parameters: { gravity: [1, 2, 3, 4] } },
  'a very long list': { parameters: { gravity: Array.from({ length: 20 }, (_, k) => k) } },
  'a mixed list': { parameters: { gravity: [1, 'x'] } },
  'an empty list': { parameters: { gravity: [] } },
  'an empty object': { parameters: { viscosity: {} } },
  'an object for a number': { parameters: { viscosity: { value: 1 } } },
  'too small': { parameters: { time_step: 0 } },
  'too large': { parameters: { restitution: 1.5 } },
  'huge': { parameters: { viscosity: 1e300 } },
  'unknown choice': { parameters: { search: 'tree' } },
  'number for a choice': { parameters: { search: 1 } },
  'wrong version': { version: 2 },
  'wrong dimension': { dimension: 3 },
  'wrong method': { method: 'sph' },
  'long title': { title: 'x'.repeat(500) },
  'title of another script': { title: 'ü'.repeat(100) },
  'key with a dot': { 'parameters.viscosity': 1 },
  'key with brackets': { 'fluid[0]': box },
  'empty key': { '': 1 },
  'very long key': { ['k'.repeat(5000)]: 1 },
  'fluid as an object': { fluid: box },
  'fluid of numbers': { fluid: [1, 2] },
  'fluid of lists': { fluid: [[1, 2]] },
  'empty piece': { fluid: [{}] },
  'box and ball': { fluid: [{ ...box, ball: { center: [0, 0], radius: 1 } }] },
  'unknown key of a piece': { fluid: [{ ...box, color: 'red' }] },
  'negative radius': { fluid: [{ ball: { center: [0, 0], radius: -1 } }] },
  'a list at the top': [1, 2],
  'no fluid': { parameters: { viscosity: 1 } },
  'box without max': { fluid: [{ box: { min: [0, 0] } }] },
  'inside out': { fluid: [{ box: { min: [0.5, 0.5], max: [0, 0] } }] },
  'outside the domain': { fluid: [{ box: { min: [0, 0], max: [3, 1] } }] },
  'overlap': { fluid: [box, box] },
  'flat domain': { domain: { min: [0, 0], max: [0, 1] }, fluid: [box] },
  'walls with mueller': { fluid: [box], walls: [{ box: box.box }] },
  'booleans for text': { fluid: [{ ...box, flow: true }] },
  'text for a boolean': { method: 'wcsph', fluid: [{ ...box, hydrostatic: 'yes' }] },
  'number for a boolean': { method: 'wcsph', domain: { free_slip: 1 } },
  'unknown flow': { method: 'wcsph', fluid: [{ ...box, flow: 'whirl' }] },
  'dimension without method': { dimension: 3, fluid: [box] },
  'vectors of the other dimension': { fluid: [box], method: 'wcsph', dimension: 3 },
  'a polygon of one number': { method: 'wcsph', fluid: [{ polygon: [[1, 2], [3]] }] },
  'a polygon of numbers': { method: 'wcsph', fluid: [{ polygon: [1, 2, 3] }] },
  'an empty polygon': { method: 'wcsph', fluid: [{ polygon: [] }] },
  'a table out of order': {
    method: 'wcsph', parameters: { particle_spacing: 0.05 }, fluid: [box],
    walls: [{ box: { min: [0.5, 0.5], max: [1, 1] }, motion: { rows: [[0, 0, 0, 0], [2, 1, 0, 0], [1, 0, 0, 0]] } }],
  },
  'a mesh with a hole': {
    method: 'wcsph', dimension: 3, parameters: { particle_spacing: 0.1 },
    fluid: [{ box: { min: [-1, -1, -1], max: [1, 0, 1] } }],
    walls: [{ mesh: { vertices: cubeMesh.vertices, triangles: cubeMesh.triangles.slice(1) } }],
  },
  'an unknown wall': { method: 'wcsph', parameters: { particle_spacing: 0.05 }, fluid: [box], probes: [{ kind: 'force', target: 'lid' }] },
  'far too many particles': { parameters: { particle_spacing: 1e-5, support_radius: 3e-5 }, fluid: [box] },
};

// Message of the native program for the same document.
function nativeMessage(scene: unknown): string {
  const file = join(folder, 'scene.json');
  writeFileSync(file, JSON.stringify(scene));
  const run = spawnSync(native, ['run', file, '--steps', '1', '--backend', 'cpu', '--quiet'], { encoding: 'utf8' });
  assert.equal(run.status, 2, `native took it: ${run.stdout}${run.stderr}`);
  const lines = run.stderr.trim().split('\n');
  return (lines.find((line) => line.startsWith('weir run: ')) ?? run.stderr).replace(/^weir run: /, '').replace(`${file}: `, '');
}

function wasmMessage(scene: unknown): string {
  const error = (() => {
    try {
      const loaded = weir.loadScene(scene);
      loaded.check();
      loaded.destroy();
    } catch (caught) {
      return caught;
    }
    return null;
  })();
  assert.ok(error instanceof WeirError, `accepted, or another error: ${error}`);
  assert.equal(error.status, Status.input);
  return error.message;
}

for (const [name, scene] of Object.entries(bad))
  test(`refused as natively: ${name}`, () => assert.equal(wasmMessage(scene), nativeMessage(scene)));

test('files are for the command line', () => {
  const motion = { file: 'piston.csv' }, mesh = { file: 'hull.stl' };
  assert.match(wasmMessage({ method: 'wcsph', walls: [{ motion }] }), /walls\[0\]\.motion\.file.*piston\.csv.*command line only.*rows/);
  assert.match(wasmMessage({ method: 'wcsph', dimension: 3, walls: [{ mesh }] }), /hull\.stl.*command line only.*vertices and triangles/);
});

test('what only JavaScript can hold is refused too', () => {
  for (const value of [NaN, Infinity, -Infinity])
    assert.match(wasmMessage({ parameters: { viscosity: value } }), /viscosity.*(nan|inf|finite|must be)/i);
  assert.match(wasmMessage({ title: 'a\0b' }), /title/);
  assert.match(wasmMessage({ parameters: { viscosity: undefined } }), /viscosity.*undefined/);
  assert.match(wasmMessage('a text'), /scene.*object/);
  assert.match(wasmMessage(null), /scene.*object/);
  let deep: unknown = 1;
  for (let k = 0; k < 100_000; k++) deep = [deep];
  assert.match(wasmMessage({ fluid: deep }), /fluid/);
});

test('a refused value leaves the scene as it was', () => {
  const scene = weir.loadScene(document('dam_break'));
  const before = scene.parameter('viscosity');
  assert.throws(() => scene.setParameter('viscosity', -1), WeirError);
  assert.throws(() => scene.setParameter('viscosity', 'thick'), WeirError);
  assert.throws(() => scene.setParameter('stickiness', 1), /stickiness/);
  assert.deepEqual(scene.parameter('viscosity'), before);
  scene.setParameter('viscosity', 0.25);
  scene.setParameter('gravity', [1, 2]);
  scene.setParameter('search', 'all_pairs');
  const copy = scene.copy();
  scene.setParameter('viscosity', 0.5);
  assert.deepEqual(copy.parameter('viscosity'), [0.25]);
  assert.deepEqual(copy.parameter('gravity'), [1, 2, 0]);
  assert.deepEqual(copy.parameter('search'), [1]);
  assert.throws(() => scene.parameter('stickiness'), WeirError);
  copy.destroy();
  scene.destroy();
});

test('a scene describes itself', () => {
  const scene = weir.loadScene(document('water'));
  assert.equal(scene.title, document('water').title);
  assert.equal(scene.method, 'mueller');
  assert.equal(scene.dimension, 2);
  assert.equal(scene.particleCount, 32_768);
  assert.deepEqual(scene.domain, { min: [-1, -1, 0], max: [1, 1, 0] });
  assert.ok(scene.stableTimeStep >= 0.0006 && scene.stableTimeStep < 0.0008, `${scene.stableTimeStep}`);
  scene.check();
  assert.equal(scene.warning, '');
  scene.setParameter('time_step', 0.01);
  scene.check();
  assert.match(scene.warning, /time_step/);
  scene.destroy();
});

test('another number of particles fills the same volume', () => {
  for (const [name, count] of [['kleefsman', 5000], ['kleefsman', 300], ['dam_3d', 4000], ['dam_2d', 5000], ['floating_3d', 4000], ['floating_2d', 5000], ['lid_cavity', 8000]] as const) {
    const document = JSON.parse(readFileSync(join(root, `scenes/${name}.json`), 'utf8')) as SceneDocument;
    const store = new SceneStore(weir, document);
    const volume = (): number => store.derived.particles * (store.scene.parameter('particle_spacing')[0] ?? 0) ** store.scene.dimension;
    const before = volume();
    store.replace(store.withParticles(count));
    assert.ok(Math.abs(store.derived.particles / count - 1) < 0.15, `${name}: ${store.derived.particles} particles instead of ${count}`);
    assert.ok(Math.abs(volume() / before - 1) < 0.012, `${name}: ${store.derived.particles} particles fill ${volume()} instead of ${before}`);
  }
});

test('the colours of the speed reach as far as the front of a dam break', () => {
  for (const [name, height, most] of [['dam_2d', 2, 8], ['dam_3d', 1.2, 6], ['kleefsman', 0.54, 4]] as const) {
    const document = JSON.parse(readFileSync(join(root, `scenes/${name}.json`), 'utf8')) as SceneDocument;
    const scene = weir.loadScene(document);
    const { view } = new Camera();
    chooseRange(view, scene, document);
    scene.destroy();
    assert.deepEqual([view.colorMin, view.colorMax], [0, most], name);
    assert.ok(view.colorMax > 1.6 * Math.sqrt(9.81 * height), name);
  }
});

test('the colours of the speed show what a sliding lid drags along', () => {
  const document = JSON.parse(readFileSync(join(root, 'scenes/lid_cavity.json'), 'utf8')) as SceneDocument;
  const scene = weir.loadScene(document);
  const { view } = new Camera();
  chooseRange(view, scene, document);
  scene.destroy();
  assert.deepEqual([view.colorMin, view.colorMax], [0, 0.5]);
});
