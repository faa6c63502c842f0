// weir.wasm on WebGPU (Dawn in Node, a software adapter): parity with the C solver, drawing, and how it fails.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { ColorBy, Diagnose, Field, Status, ToolKind, Weir, WeirError, type Gpu, type Sim, type View } from '../../src/weir.ts';
import { fakeCanvas, gpu as browser, nextTurn, root, until, wasmFile } from './support.ts';

const bytes = wasmFile('weir.wasm');
const weir = await Weir.load(bytes, { gpu: browser });
const gpu = weir.createGpu();
await gpu.ready();
after(() => {
  gpu.destroy();
  assert.equal(weir.liveGpuObjects, 0, 'handles are left');
});

// 800 particles or so: SwiftShader is slow.
const dam = JSON.parse(readFileSync(join(root, 'scenes/dam_break.json'), 'utf8'));
const spacing = 0.04;
Object.assign(dam.parameters, { particle_spacing: spacing, support_radius: 2.5 * spacing });
dam.fluid[0].velocity = [-1, -2]; // thrown into the corner: pressure and walls act from the first steps on

function create(device?: Gpu): Sim {
  const scene = weir.loadScene(dam);
  try {
    return weir.createSim(scene, device ? { gpu: device } : {});
  } finally {
    scene.destroy();
  }
}

async function start(device?: Gpu): Promise<Sim> {
  const sim = create(device);
  await sim.ready();
  return sim;
}

const read = async (sim: Sim, field: Field): Promise<Float32Array> =>
  (await until(() => (sim.poll(), sim.read(field)), 'read')).slice();
const diagnose = (sim: Sim, flags = 0) => until(() => (sim.poll(), sim.diagnose(flags)), 'diagnose');
const hashOf = async (sim: Sim): Promise<string> => (await diagnose(sim, Diagnose.hash)).stateHash;
const farthest = (a: Float32Array, b: Float32Array): number =>
  a.reduce((most, value, k) => Math.max(most, Math.abs(value - (b[k] as number))), 0);

test('the device says what it is', () => {
  assert.equal(gpu.poll(), Status.ok);
  assert.ok(gpu.device.length > 3);
  assert.equal(gpu.error, '');
  assert.equal(gpu.nativeDevice?.constructor.name, 'GPUDevice');
  if (/swiftshader/i.test(gpu.device)) assert.equal(gpu.isSoftware, true);
});

test('while its shaders compile it refuses to step and to change, and can be destroyed', async () => {
  const sim = create(gpu);
  const before = sim.parameter('viscosity');
  assert.throws(() => sim.step(1), /still starting/);
  assert.throws(() => sim.advance(1), /still starting/);
  assert.throws(() => sim.reset(), /still starting/);
  assert.throws(() => sim.setParameter('viscosity', 7), /still starting/);
  assert.throws(() => sim.setTool(1, [0, 0, 0], [0, 0, 0], 0.1, 1), /still starting/);
  assert.equal(sim.read(Field.position), null);
  const gone = create(gpu);
  gone.destroy();
  await sim.ready();
  assert.deepEqual(sim.parameter('viscosity'), before);
  sim.setParameter('viscosity', 7);
  sim.step(2);
  assert.equal((await diagnose(sim)).step, 2);
  sim.destroy();
  const going = create(gpu);
  const ready = going.ready();
  going.destroy();
  await assert.rejects(ready, /destroyed while it started/);
});

test('100 steps follow the C solver', async () => {
  const reference = await start();
  const sim = await start(gpu);
  assert.equal(sim.backend, 'gpu');
  assert.equal(sim.particleCount, reference.particleCount);
  assert.deepEqual(await read(sim, Field.position), (reference.read(Field.position) as Float32Array).slice());
  sim.step(100);
  reference.step(100);
  const position = await read(sim, Field.position);
  const off = farthest(position, reference.read(Field.position) as Float32Array);
  // Some five times what SwiftShader's other rounding makes; a viscosity that is 10 % off shows.
  assert.ok(off < 1e-6, `positions differ by ${off} m`);
  const density = farthest(await read(sim, Field.density), reference.read(Field.density) as Float32Array);
  assert.ok(density < 0.006, `densities differ by ${density} kg/m^3`);
  const [found, wanted] = [await diagnose(sim), reference.diagnose()];
  assert.equal(found.step, 100);
  assert.equal(found.lostParticles, 0);
  assert.ok(wanted && wanted.densityErrorMax > 0.005, 'nothing was pressed together: the test shows too little');
  assert.ok(Math.abs(found.kineticEnergy / wanted.kineticEnergy - 1) < 1e-6);
  sim.destroy();
  reference.destroy();
});

test('two runs give the same bits', async () => {
  const hashes: string[] = [];
  for (let run = 0; run < 2; run++) {
    const sim = await start(gpu);
    sim.step(60);
    hashes.push(await hashOf(sim));
    sim.destroy();
  }
  assert.equal(hashes[0], hashes[1]);
});

test('steps, tool, parameters and reset as on the CPU', async () => {
  const sim = await start(gpu);
  const from = await read(sim, Field.position);
  assert.equal(sim.advance(0.002), Math.floor(0.002 / (sim.parameter('time_step')[0] as number) + 1e-6));
  sim.setParameter('gravity', [0, 0]);
  sim.setState(from, from.map(() => 0)); // at rest
  const [left = 0, bottom = 0] = dam.domain.min as number[];
  sim.setTool(ToolKind.push, [left, bottom, 0], [0, 0, 0], 0.5, 50);
  sim.step(20);
  const velocity = await read(sim, Field.velocity);
  assert.ok(Math.max(...velocity) > 0.02);
  assert.throws(() => sim.setParameter('support_radius', 1), WeirError);
  sim.reset();
  assert.deepEqual(await read(sim, Field.position), from);
  const moved = from.map((x) => 0.9 * x);
  sim.setState(moved, from.map(() => 0));
  assert.deepEqual(await read(sim, Field.position), moved);
  sim.destroy();
});

test('a change that needs other shaders comes when they are there; until then all goes on as before', async () => {
  const shifting = (sim: Sim, value: number) => sim.setParameter('shifting', value);
  const document = { ...dam, method: 'wcsph', parameters: { particle_spacing: spacing } };
  const make = async (value: number): Promise<Sim> => {
    const scene = weir.loadScene({ ...document, parameters: { ...document.parameters, shifting: value } });
    const sim = weir.createSim(scene, { gpu });
    scene.destroy();
    await sim.ready();
    return sim;
  };
  const hashAfter = async (sim: Sim, steps: number): Promise<string> => {
    sim.step(steps);
    return hashOf(sim);
  };
  const [shifted, sim] = [await make(2), await make(2)];
  shifting(sim, 0);
  assert.ok(sim.isChanging);
  assert.equal(sim.parameter('shifting')[0], 0);
  sim.step(30); // before any callback comes
  assert.equal(await hashOf(sim), await hashAfter(shifted, 30));
  await sim.settled();
  assert.ok(!sim.isChanging);
  const plain = await make(0);
  sim.reset();
  const without = await hashAfter(plain, 30);
  assert.notEqual(without, await hashOf(shifted), 'shifting changes nothing: the test shows too little');
  assert.equal(await hashAfter(sim, 30), without);
  // Back to what runs before its shaders are there; a change of the change; one whose shaders are there already.
  sim.setParameter('viscosity', 0);
  shifting(sim, 2);
  sim.setParameter('viscosity', plain.parameter('viscosity')[0] as number);
  shifting(sim, 0);
  await sim.settled();
  sim.reset();
  assert.equal(await hashAfter(sim, 30), without);
  shifting(sim, 2);
  assert.ok(!sim.isChanging);
  sim.reset();
  assert.equal(await hashAfter(sim, 30), await hashOf(shifted));
  // Destroyed with shaders under way.
  sim.setParameter('viscosity', 0);
  assert.ok(sim.isChanging);
  for (const one of [plain, shifted, sim]) one.destroy();
});

test('a scene that starts again, with other particles too, compiles nothing', async () => {
  const device = gpu.nativeDevice as GPUDevice;
  const compile = device.createComputePipelineAsync;
  let compiled = 0;
  device.createComputePipelineAsync = (descriptor) => (compiled++, compile.call(device, descriptor));
  const counts: number[] = [];
  for (const [size, kernel] of [[0.05, 'quintic'], [0.05, 'quintic'], [0.045, 'quintic'], [0.05, 'cubic']] as const) {
    const scene = weir.loadScene({ ...dam, method: 'wcsph', parameters: { particle_spacing: size, kernel } });
    const sim = weir.createSim(scene, { gpu });
    scene.destroy();
    await sim.ready();
    counts.push(compiled);
    sim.destroy();
  }
  device.createComputePipelineAsync = compile;
  const [first, again, others, changed] = counts as [number, number, number, number];
  assert.ok(first >= 10);
  assert.equal(again, first);
  assert.equal(others, first);
  assert.ok(changed > first);
});

test('passes are timed by name', async (context) => {
  if (!gpu.nativeDevice?.features.has('timestamp-query')) return context.skip('no timestamps here');
  const sim = await start(gpu);
  const times = await until(() => {
    sim.step(1);
    sim.poll();
    const found = sim.passTimes();
    return found.length > 0 && found.some((pass) => pass.milliseconds > 0) ? found : null;
  }, 'pass times');
  assert.deepEqual(
    ['count', 'scatter', 'density', 'forces', 'integrate'].filter((name) => !times.some((pass) => pass.name === name)),
    [],
  );
  sim.destroy();
});

test('device memory comes back', async () => {
  const before = gpu.memory;
  const handles = weir.liveGpuObjects;
  for (let k = 0; k < 3; k++) {
    const sim = await start(gpu);
    assert.ok(gpu.memory > before + 60 * sim.particleCount);
    assert.ok(gpu.memory < before + 160 * sim.particleCount + 300_000);
    sim.step(3);
    await diagnose(sim);
    const running = weir.liveGpuObjects;
    const memory = gpu.memory;
    for (let frame = 0; frame < 20; frame++) {
      sim.step(3);
      sim.poll();
      await nextTurn();
    }
    await diagnose(sim);
    assert.equal(gpu.memory, memory);
    assert.ok(weir.liveGpuObjects <= running, 'handles pile up');
    sim.destroy();
  }
  assert.equal(gpu.memory, before);
  assert.equal(weir.liveGpuObjects, handles);
});

// Draws into a canvas whose texture can be read back.
test('the renderer draws particles where they are', async () => {
  const device = gpu.nativeDevice as GPUDevice;
  const canvas = fakeCanvas();
  canvas.width = 256;
  canvas.height = 256;
  const handles = weir.liveGpuObjects;
  const renderer = weir.createRenderer(gpu, canvas);
  const sim = await start(gpu);
  const from = await read(sim, Field.position); // the first particle is the lowest on the left
  const view: View = {
    colorBy: ColorBy.speed, colorMin: 0, colorMax: 1, center: [from[0] as number, from[1] as number],
    pixelsPerMeter: 128, particleRadius: 0.03, toolPosition: [0, 0, 0], toolRadius: 0, toolPressed: 0,
    camera: { target: [0, 0, 0], yaw: 0, pitch: 0, distance: 1, fieldOfView: 0.6, shift: [0, 0] },
  };
  assert.equal(renderer.draw(sim, view), Status.ok);
  assert.equal(renderer.draw(sim, view), Status.ok);
  canvas.width = 512; // what a page does when its window grows
  assert.equal(renderer.draw(sim, view), Status.ok);
  assert.equal(gpu.poll(), Status.ok, gpu.error);
  const shown = (canvas as unknown as { shown: GPUTexture }).shown;
  assert.equal(shown.width, 512);
  const pixels = await copyOf(device, shown);
  const bright = (x: number, y: number): number => {
    const at = 4 * (y * 512 + x);
    return (pixels[at] as number) + (pixels[at + 1] as number) + (pixels[at + 2] as number);
  };
  const inside = bright(256 + 30, 128 - 30);
  const outside = bright(256 - 60, 128 + 60); // beyond the walls
  assert.ok(inside > outside + 60, `fluid ${inside}, empty ${outside}`);
  const onCpu = await start();
  assert.equal(renderer.draw(onCpu, view), Status.input); // it has no buffers to draw from
  onCpu.destroy();
  sim.destroy();
  renderer.destroy();
  assert.equal(weir.liveGpuObjects, handles);
});

async function copyOf(device: GPUDevice, texture: GPUTexture): Promise<Uint8Array> {
  const bytesPerRow = 4 * texture.width;
  const usage = GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST;
  const buffer = device.createBuffer({ size: bytesPerRow * texture.height, usage });
  const encoder = device.createCommandEncoder();
  encoder.copyTextureToBuffer({ texture }, { buffer, bytesPerRow }, [texture.width, texture.height]);
  device.queue.submit([encoder.finish()]);
  await buffer.mapAsync(GPUMapMode.READ);
  return new Uint8Array(buffer.getMappedRange().slice(0));
}

test('colour maps', () => {
  for (const by of [ColorBy.speed, ColorBy.density, ColorBy.densityError, ColorBy.pressure]) {
    const map = weir.colorMap(by);
    assert.equal(map.length, 768);
    assert.ok(farthest(new Float32Array(map.slice(0, 3)), new Float32Array(map.slice(-3))) > 40);
  }
});

test('a canvas without WebGPU is refused', () => {
  const canvas = { width: 1, height: 1, getContext: () => null } as unknown as OffscreenCanvas;
  assert.throws(() => weir.createRenderer(gpu, canvas), /WebGPU/);
});

// ---- Failures ----

test('a lost device is told, and the next one works', async () => {
  const lost = weir.createGpu();
  await lost.ready();
  const sim = await start(lost);
  sim.step(1);
  lost.nativeDevice?.destroy();
  await until(() => lost.poll() !== Status.ok, 'the loss');
  assert.equal(lost.poll(), Status.device);
  assert.match(lost.error, /destroyed|lost/);
  assert.equal(sim.poll(), Status.device);
  assert.match(sim.error, /destroyed|lost/);
  assert.throws(() => sim.step(1), WeirError);
  assert.throws(() => create(lost), WeirError);
  sim.destroy();
  lost.destroy();
  const next = weir.createGpu();
  await next.ready();
  const again = await start(next);
  again.step(2);
  assert.equal((await diagnose(again)).step, 2);
  again.destroy();
  next.destroy();
});

test('no WebGPU, no adapter, no device: a message each', async () => {
  const none = await Weir.load(bytes, { gpu: null });
  const missing = none.createGpu();
  await assert.rejects(missing.ready(), (error: WeirError) => error.status === Status.device && /WebGPU/.test(error.message));
  missing.destroy();
  const empty = { ...browser, requestAdapter: async () => null } as unknown as GPU;
  const bare = await Weir.load(bytes, { gpu: empty });
  const without = bare.createGpu();
  await assert.rejects(without.ready(), /no WebGPU adapter/);
  without.destroy();
  assert.equal(bare.liveGpuObjects, 0);
  const adapter = await browser.requestAdapter();
  const broken = Object.create(adapter as object, {
    limits: { get: () => adapter?.limits }, features: { get: () => adapter?.features },
    info: { get: () => adapter?.info }, requestDevice: { value: () => Promise.reject(new Error('out of devices')) },
  });
  const refusing = await Weir.load(bytes, { gpu: { requestAdapter: async () => broken } as unknown as GPU });
  const refused = refusing.createGpu();
  await assert.rejects(refused.ready(), /out of devices/);
  refused.destroy();
  assert.equal(refusing.liveGpuObjects, 0);
});

// A card to whom looks at its name: devices that a processor plays are not measured.
async function cardAdapter(): Promise<GPUAdapter> {
  const adapter = await browser.requestAdapter();
  return Object.create(adapter as object, {
    limits: { get: () => adapter?.limits }, features: { get: () => adapter?.features },
    info: { get: () => ({ vendor: 'vendor', architecture: 'architecture-7', device: '', description: '' }) },
    requestDevice: { value: (descriptor: GPUDeviceDescriptor) => adapter?.requestDevice(descriptor) },
  }) as GPUAdapter;
}

test('how many threads keep a card busy is measured once', async () => {
  assert.equal(gpu.parallelism, 65536, 'of a software adapter');
  const one = await Weir.load(bytes, { gpu: { requestAdapter: cardAdapter } as unknown as GPU });
  const first = one.createGpu();
  assert.equal(first.parallelism, 0);
  await first.ready();
  assert.ok(!first.isSoftware);
  assert.ok(first.parallelism >= 256 && first.parallelism < 65536, `${first.parallelism} threads`);
  first.destroy();
  const told = one.createGpu({ known: { device: 'vendor architecture-7', parallelism: 1024 } });
  await told.ready();
  assert.equal(told.parallelism, 1024);
  told.destroy();
  const early = one.createGpu();
  while (early.nativeDevice === null) {
    early.poll();
    await nextTurn();
  }
  early.poll(); // measures now
  early.destroy();
  for (let turn = 0; turn < 50; turn++) await nextTurn();
  assert.equal(one.liveGpuObjects, 0);
});

test('a GPU that is destroyed while it starts leaves nothing behind', async () => {
  const other = await Weir.load(bytes, { gpu: browser });
  for (let turns = 0; turns < 12; turns++) {
    const early = other.createGpu();
    for (let turn = 0; turn < turns; turn++) {
      early.poll();
      await nextTurn();
    }
    early.destroy();
  }
  await nextTurn();
  for (let turn = 0; turn < 50; turn++) await nextTurn();
  assert.equal(other.liveGpuObjects, 0);
});
