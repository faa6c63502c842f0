// The runner itself: a name that is no file of tests ends it with a word about that, and runs nothing.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { join } from 'node:path';
import { test } from 'node:test';

const runner = join(process.env.WEIR_ROOT!, 'web/tests/node/run.mjs');

for (const names of [['nothing.test.ts'], ['camera.test.ts', 'nothing.test.ts']]) {
  test(`run.mjs refuses ${names.join(' ')}`, () => {
    const run = spawnSync(process.execPath, [runner, ...names], { encoding: 'utf8', timeout: 10_000 });
    assert.equal(run.status, 2, run.stderr);
    assert.match(run.stderr, /'nothing\.test\.ts'.*camera\.test\.ts/s);
    assert.equal(run.stdout, '');
  });
}
