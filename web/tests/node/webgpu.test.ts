// Every call of src/webgpu_web against Dawn: the program apps/web/tests/webgpu_calls.c makes it from C and checks what
// comes back. Each test must also give back all handles that it took.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { wasiImports } from '../../src/wasi.ts';
import * as names from '../../src/webgpu_enums.ts';
import type { WebGpuExports } from '../../src/webgpu_host.ts';
import { WebGpuImports } from '../../src/webgpu_imports.ts';
import { fakeCanvas, gpu, nextTurn, root, wasmFile } from './support.ts';

type Exports = WebGpuExports & {
  _initialize(): void;
  weir_test_calls(index: number): number;
  weir_test_run(index: number, step: number): number;
  weir_test_failure(): number;
};

const webgpu = new WebGpuImports(gpu);
webgpu.registerCanvas(fakeCanvas());
webgpu.registerCanvas({ getContext: () => null } as unknown as OffscreenCanvas);
const module = await WebAssembly.compile(wasmFile('webgpu_calls.wasm'));

// The calls on their way to the browser. "Undefined" of C must come as -1, never as its unsigned value.
const unsignedValues = new Set<string>();
const watched: Record<string, (...values: number[]) => number> = {};
for (const [name, call] of Object.entries(webgpu.functions))
  watched[name] = (...values) => {
    if (values.some((value) => value === 0xffffffff || value > Number.MAX_SAFE_INTEGER)) unsignedValues.add(name);
    return (call as (...values: number[]) => number)(...values);
  };
const instance = await WebAssembly.instantiate(module, wasiImports(module, { webgpu: watched }));
const c = instance.exports as unknown as Exports;
webgpu.attach(c);
c._initialize();

function text(at: number): string {
  const bytes = new Uint8Array(c.memory.buffer);
  return new TextDecoder().decode(bytes.subarray(at, bytes.indexOf(0, at)));
}

// What a test keeps for the ones after it, less what the last ones give back.
const KEPT: Record<string, number> = {
  'wgpuCreateInstance wgpuInstanceRelease': 1,
  'wgpuInstanceRequestAdapter wgpuInstanceProcessEvents': 1,
  'wgpuAdapterRequestDevice wgpuDeviceGetLimits wgpuDeviceHasFeature': 2, // with its queue
  'wgpuDeviceRelease wgpuAdapterRelease wgpuInstanceRelease': -4,
};

const covered = new Set<string>();
for (let index = 0; c.weir_test_calls(index) !== 0; index++) {
  const calls = text(c.weir_test_calls(index));
  for (const call of calls.split(' ')) covered.add(call);
  test(calls, async () => {
    const before = webgpu.liveObjects;
    let state = 0;
    for (let step = 0; state === 0 && step < 10_000; step++) {
      state = c.weir_test_run(index, step);
      await nextTurn();
    }
    assert.equal(state, 1, state === 0 ? 'never ends' : text(c.weir_test_failure()));
    assert.equal(webgpu.liveObjects - before, KEPT[calls] ?? 0, 'handles kept');
  });
}

test('what C leaves undefined is undefined for the browser', () => assert.deepEqual([...unsignedValues], []));

const layer = join(root, 'src/webgpu_web');
const sources = readdirSync(layer).filter((name) => name.endsWith('.c'));
const source = sources.map((name) => readFileSync(join(layer, name), 'utf8')).join('\n');
const served = [...source.matchAll(/^[A-Za-z_].*?\*?((?:wgpu|weir_webgpu_canvas_)\w+)\([^;]*\n?[^;]*?\n\{/gm)].map(
  (match) => match[1] as string,
);

test('each call of the layer has its test', () => {
  assert.ok(served.length > 70, `found ${served.length} calls`);
  assert.deepEqual(served.filter((name) => !covered.has(name)), []);
});

test('each import of the layer is served, and nothing else', () => {
  const declared = readFileSync(join(layer, 'imports.h'), 'utf8').matchAll(/^WEIR_JS\(\w+, (\w+)/gm);
  const wanted = [...declared].map((match) => match[1] as string).sort();
  assert.deepEqual(Object.keys(webgpu.functions).sort(), wanted);
});

test('a call that the layer does not have fails when the program is linked', () => {
  const folder = mkdtempSync(join(tmpdir(), 'weir-link-'));
  after(() => rmSync(folder, { recursive: true }));
  const link = (call: string) => {
    const file = join(folder, 'call.c');
    const head = '#include <webgpu/webgpu.h>\n__attribute__((export_name("run"))) void run(WGPUInstance instance)\n';
    writeFileSync(file, `${head}{ ${call}; }\n`);
    const library = join(process.env.WEIR_WASM_DIR as string, 'src/webgpu_web/libwebgpu_web.a');
    const include = process.env.WEIR_WGPU_DIR ?? join(root, 'deps/wgpu');
    const parts = ['--target=wasm32-wasi', '-fuse-ld=lld', '-mexec-model=reactor', `-I${include}/include`, file, library];
    return spawnSync('clang-19', [...parts, '-o', join(folder, 'call.wasm')], { encoding: 'utf8' });
  };
  const served = link('wgpuInstanceProcessEvents(instance)');
  assert.equal(served.status, 0, served.stderr);
  const missing = link('wgpuInstanceWaitAny(instance, 0, 0, 0)');
  assert.notEqual(missing.status, 0);
  assert.match(missing.stderr, /undefined symbol: wgpuInstanceWaitAny/);
});

test('enum tables follow webgpu.h', () => {
  const include = process.env.WEIR_WGPU_DIR ?? join(root, 'deps/wgpu');
  const header = readFileSync(join(include, 'include/webgpu/webgpu.h'), 'utf8');
  let values = 0;
  for (const [table, list] of Object.entries(names)) {
    const type = table[0]?.toUpperCase() + table.slice(1);
    const found = [...header.matchAll(new RegExp(`WGPU${type}_(\\w+) = 0x([0-9A-Fa-f]+)`, 'g'))];
    assert.ok(found.length > 2, type);
    for (const [, name = '', number = ''] of found) {
      if (['Force32', 'Undefined', 'BindingNotUsed', 'Auto', 'Unpremultiplied', 'Inherit'].includes(name)) continue;
      assert.equal(list[parseInt(number, 16)]?.replaceAll('-', ''), name.toLowerCase(), `${type} ${name}`);
      values++;
    }
  }
  assert.ok(values > 150, `${values} values`);
});
