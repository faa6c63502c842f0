// Bundles the TypeScript tests and runs them: npm run test:node; one file: node tests/node/run.mjs gpu.test.ts. Needs
// the wasm build (cmake --preset wasm), or another one whose folder WEIR_WASM_DIR names. WebGPU is Dawn in Node on a
// software adapter.
import { build } from 'esbuild';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync, rmSync } from 'node:fs';
import { cpus } from 'node:os';
import { basename, dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, '../../..');
const wasm = resolve(process.env.WEIR_WASM_DIR ?? join(root, 'build/wasm'));
const out = join(here, '../../node_modules/.weir-tests'); // where imports of packages still resolve

if (!existsSync(join(wasm, 'apps/web/weir.wasm'))) {
  console.error(`${wasm} holds no build: run tools/build.sh wasm first`);
  process.exit(2);
}
const tests = readdirSync(here).filter((name) => name.endsWith('.test.ts'));
const chosen = process.argv.slice(2).map((name) => basename(name));
const unknown = chosen.find((name) => !tests.includes(name)); // without files node --test would look for some itself
if (unknown !== undefined) {
  console.error(`'${unknown}' is no file of tests; there are: ${tests.join(' ')}`);
  process.exit(2);
}
const entries = chosen.length > 0 ? chosen : tests;
rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
await build({
  entryPoints: entries.map((name) => join(here, name)),
  outdir: out,
  bundle: true,
  platform: 'node',
  format: 'esm',
  target: 'node18',
  external: ['webgpu'],
  sourcemap: 'inline',
  outExtension: { '.js': '.mjs' },
});

// Chromium's SwiftShader, if it is there and nobody has chosen a driver: Dawn refuses Debian's lavapipe.
const swiftshader = '/usr/lib/chromium/vk_swiftshader_icd.json';
const env = { ...process.env, WEIR_ROOT: root, WEIR_WASM_DIR: wasm };
if (!env.VK_ICD_FILENAMES && !env.VK_DRIVER_FILES && existsSync(swiftshader)) env.VK_ICD_FILENAMES = swiftshader;
env.XDG_RUNTIME_DIR ??= '/tmp'; // Dawn's driver complains without
const files = entries.map((name) => join(out, name.replace(/\.ts$/, '.mjs')));
// As many files at a time as there are cores; one fewer, as is usual, leaves half of two cores idle.
const options = ['--enable-source-maps', '--test', `--test-concurrency=${cpus().length}`];
const result = spawnSync(process.execPath, [...options, ...files], { stdio: 'inherit', env });
process.exit(result.status ?? 1);
