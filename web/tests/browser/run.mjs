// Runs the browser tests on the built page (dist/), building it first if it is missing.
// WEIR_CHROMIUM, WEIR_FIREFOX: other programs than the distribution's. WEIR_BROWSERS=chromium: only that one.
import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const here = fileURLToPath(new URL('.', import.meta.url));
const web = fileURLToPath(new URL('../..', import.meta.url));

function run(command, ...args) {
  const { status } = spawnSync(command, args, { cwd: web, stdio: 'inherit' });
  if (status !== 0) process.exit(status ?? 1);
}

if (!existsSync(`${web}dist/index.html`)) run(process.execPath, 'node_modules/vite/bin/vite.js', 'build');
run(process.execPath, '--test', '--test-concurrency=1', `${here}page.test.mjs`, `${here}embed.test.mjs`);
