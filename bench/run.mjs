// The tutorial's table: plain JavaScript, C in wasm, C natively and the GPU, one after the other, then the case of
// about 20 neighbours that speed is tracked by. Called by bench/run.sh; prints tables and writes build/bench/*.csv.
import { spawnSync } from 'node:child_process';
import { mkdirSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const root = resolve(dirname(fileURLToPath(import.meta.url)), '..');
const seconds = Number(process.argv[2] ?? 1);
const counts = [1000, 5000, 10000, 32768];

// The page's own modules, bundled for Node by the bundler that the page's build uses.
async function loadPageModules() {
  const require = createRequire(join(root, 'web/package.json'));
  const { build } = require('esbuild');
  const out = join(root, 'build/bench/page.mjs');
  mkdirSync(dirname(out), { recursive: true });
  await build({
    entryPoints: [join(root, 'bench/page.ts')],
    outfile: out,
    bundle: true,
    platform: 'node',
    format: 'esm',
    target: 'node18',
    logLevel: 'error',
  });
  return import(pathToFileURL(out).href);
}

function weirBench(...args) {
  const done = spawnSync(join(root, 'build/weir'), ['bench', '--json', '--seconds', String(seconds), ...args], {
    encoding: 'utf8',
    stdio: ['ignore', 'pipe', 'inherit'],
    maxBuffer: 1 << 26,
  });
  if (done.status !== 0) throw new Error(`weir bench ended with ${done.status ?? done.signal}`);
  return JSON.parse(done.stdout);
}

const columns = [
  'scene', 'particles', 'backend', 'device', 'search', 'threads', 'mean_neighbors', 'ms_per_step',
  'particle_steps_per_second', 'real_time_factor', 'frames_per_second', 'speed_up',
];

function cell(value) {
  if (typeof value === 'number') return Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(6)));
  return value === undefined || value === null ? '' : `"${String(value).replaceAll('"', '""')}"`;
}

function writeCsv(name, rows) {
  const path = join(root, 'build/bench', name);
  const lines = rows.map((row) => columns.map((column) => cell(row[column])).join(','));
  writeFileSync(path, [columns.join(','), ...lines, ''].join('\n'));
  console.log(`written: build/bench/${name}\n`);
}

// Widths, and what each column of the printed table shows.
const table = [
  ['particles', 10, (row) => row.particles],
  ['backend', 11, (row) => row.backend],
  ['search', 10, (row) => row.search],
  ['threads', 8, (row) => row.threads || ''],
  ['neighbours', 11, (row) => row.mean_neighbors?.toFixed(1) ?? ''],
  ['ms/step', 12, (row) => row.ms_per_step.toPrecision(4)],
  ['M p-steps/s', 13, (row) => (row.particle_steps_per_second / 1e6).toPrecision(4)],
  ['real-time', 10, (row) => row.real_time_factor.toPrecision(3)],
  ['frames/s', 10, (row) => row.frames_per_second.toFixed(1)],
  ['speed-up', 10, (row) => row.speed_up?.toPrecision(4) ?? ''],
];

function printTable(title, rows) {
  console.log(`\n${title}`);
  console.log(table.map(([name, width]) => name.padStart(width)).join('') + '  device');
  for (const row of rows) {
    console.log(table.map(([, width, show]) => String(show(row)).padStart(width)).join('') + `  ${row.device}`);
  }
}

const page = await loadPageModules();
const wasm = join(root, 'build/wasm/apps/web/weir.wasm');
const rows = [];
console.error(`measuring C natively: ${counts.join(', ')} particles ...`);
const native = weirBench('--counts', counts.join(','));
for (const count of counts) {
  console.error(`measuring JavaScript and wasm: ${count} particles ...`);
  const javascript = page.measureJavaScript(count, seconds);
  const found = [
    javascript,
    ...(await page.measureWasm(wasm, count, seconds)),
    ...native.filter((row) => row.particles === count),
  ];
  for (const row of found) row.speed_up = javascript.ms_per_step / row.ms_per_step;
  rows.push(...found);
}
printTable("The tutorial's parameters; speed-up over plain JavaScript", rows);
writeCsv('article.csv', rows);

console.error('measuring the case of about 20 neighbours ...');
const tracked = [...(await page.measureWasm(wasm, 100000, seconds, 'n20')), ...weirBench('--case', 'n20')];
printTable('About 20 neighbours', tracked);
writeCsv('n20.csv', tracked);
