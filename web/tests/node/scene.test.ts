// Scenes through the bindings: the same values, the same messages and the same bits as the native program.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { Status, Weir, WeirError } from '../../src/weir.ts';
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
    assert.equal(`0x${sim.diagnose(false)?.stateHash}`, hash);
    sim.destroy();
    scene.destroy();
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
