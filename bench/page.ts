// The page's engines, measured in Node the way `weir bench` measures natively: the same scenes
// (apps/cli/bench_scene.c), a warm-up, the median of batches from the scene's start.
import { readFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { article, benchAllPairs, blockColumns } from '../web/src/all_pairs.ts';
import { Diagnose, Weir, type Sim } from '../web/src/weir.ts';

type Case = 'article' | 'n20';

type Row = {
  scene: string;
  particles: number;
  backend: string;
  device: string;
  search: string;
  threads: number;
  mean_neighbors?: number;
  ms_per_step: number;
  particle_steps_per_second: number;
  real_time_factor: number;
  frames_per_second: number;
};

const MAX_REPETITIONS = 64;
const MAX_BATCH = 256; // steps
const device = `${cpus()[0]?.model.trim() ?? 'CPU'}, Node ${process.version}`;

function rates(particles: number, timeStep: number, seconds: number) {
  return {
    ms_per_step: 1e3 * seconds,
    particle_steps_per_second: particles / seconds,
    real_time_factor: timeStep / seconds,
    frames_per_second: 1 / seconds,
  };
}

function scene(benchCase: Case, count: number, search: string, timeStep: number): object {
  const [spacing, radius] = benchCase === 'article' ? [article.particle_spacing, article.support_radius] : [0.01, 0.025];
  const aspect = Math.sqrt(2 * count) * spacing <= 2 ? 0.5 : 2;
  const columns = blockColumns(count, aspect);
  const size = [columns * spacing, (count / columns) * spacing];
  const min = size.map((length) => -0.5 * Math.max(2, 1.5 * length));
  return {
    title: benchCase,
    parameters: { particle_spacing: spacing, support_radius: radius, time_step: timeStep, search },
    domain: { min, max: min.map((low) => -low) },
    fluid: [{ box: { min, max: min.map((low, axis) => low + size[axis]!) } }],
  };
}

function timeSteps(sim: Sim, steps: number): number {
  sim.reset();
  sim.step(1);
  const start = performance.now();
  sim.step(steps);
  return (performance.now() - start) / 1e3;
}

// As measure_step() of apps/cli/bench.c. Seconds per step.
function measureStep(sim: Sim, budget: number): number {
  let steps = 1;
  for (let batch = timeSteps(sim, steps); batch < 0.1 * budget && steps < MAX_BATCH; batch = timeSteps(sim, steps)) {
    steps = Math.min(2 * steps, MAX_BATCH);
  }
  const times: number[] = [];
  for (let spent = 0; times.length < MAX_REPETITIONS && (times.length === 0 || spent < budget); ) {
    const batch = timeSteps(sim, steps);
    times.push(batch / steps);
    spent += batch;
  }
  times.sort((a, b) => a - b);
  const middle = times.length >> 1;
  return times.length % 2 ? times[middle]! : 0.5 * (times[middle - 1]! + times[middle]!);
}

// The C solver in wasm, one thread: all pairs and grid, or grid alone.
export async function measureWasm(path: string, count: number, seconds: number, benchCase: Case = 'article') {
  const weir = await Weir.load(readFileSync(path), { gpu: null });
  const rows: Row[] = [];
  for (const search of benchCase === 'article' ? ['all_pairs', 'grid'] : ['grid']) {
    const probe = weir.loadScene(scene(benchCase, count, search, 0.0001));
    const timeStep = benchCase === 'article' ? article.time_step : 0.5 * probe.stableTimeStep;
    const loaded = weir.loadScene(scene(benchCase, count, search, timeStep));
    const sim = weir.createSim(loaded);
    const step = measureStep(sim, seconds);
    const neighbors = sim.diagnose(Diagnose.neighbors)?.meanNeighbors;
    rows.push({
      scene: benchCase,
      particles: sim.particleCount,
      backend: 'wasm',
      device,
      search,
      threads: 1,
      ...(neighbors === undefined ? {} : { mean_neighbors: neighbors }),
      ...rates(sim.particleCount, timeStep, step),
    });
    sim.destroy();
    loaded.destroy();
    probe.destroy();
  }
  return rows;
}

// What a reader of the tutorial would write: plain JavaScript, every particle against every other one.
export function measureJavaScript(count: number, seconds: number): Row {
  const found = benchAllPairs(count, seconds);
  return {
    scene: 'article',
    particles: count,
    backend: 'javascript',
    device,
    search: 'all_pairs',
    threads: 1,
    ...rates(count, article.time_step, found.msPerStep / 1e3),
  };
}
