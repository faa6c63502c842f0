// Measures the solvers that run on the CPU, away from the page so that it stays alive meanwhile.
import { AllPairsFluid, benchAllPairs, benchScene, measureSteps, type Measured } from './all_pairs.ts';
import type { SolverId } from './compare_rows.ts';
import { Field, Weir, type Sim } from './weir.ts';

export type Job = { module: WebAssembly.Module; solver: SolverId; count: number } & (
  | { task: 'measure'; seconds: number }
  | { task: 'positions'; steps: number; viscosity: number }
);
export type Done = { measured: Measured } | { positions: Float32Array } | { error: string };

let engine: Promise<Weir> | null = null;

async function withSim<T>(job: Job, use: (sim: Sim) => T): Promise<T> {
  const weir = await (engine ??= Weir.load(job.module, { gpu: null }));
  const search = job.solver === 'c_grid' ? 'grid' : 'all_pairs';
  const scene = weir.loadScene(benchScene(job.count, search, job.task === 'positions' ? job.viscosity : undefined));
  const sim = weir.createSim(scene);
  try {
    return use(sim);
  } finally {
    sim.destroy();
    scene.destroy();
  }
}

async function run(job: Job): Promise<Done> {
  if (job.task === 'measure') {
    if (job.solver === 'javascript') return { measured: benchAllPairs(job.count, job.seconds) };
    return { measured: await withSim(job, (sim) => measureSteps((steps) => sim.step(steps), job.seconds)) };
  }
  if (job.solver === 'javascript') {
    const fluid = new AllPairsFluid(job.count, job.viscosity);
    for (let n = 0; n < job.steps; n++) fluid.step();
    return { positions: fluid.positions() };
  }
  return withSim(job, (sim) => {
    sim.step(job.steps);
    return { positions: new Float32Array(sim.read(Field.position) ?? []) };
  });
}

addEventListener('message', (event: MessageEvent<Job>) => {
  run(event.data).then(
    (done) => postMessage(done),
    (error: unknown) => postMessage({ error: error instanceof Error ? error.message : String(error) }),
  );
});
