// Runs one measurement of the table: in a worker for the CPU, here for WebGPU.
import { benchScene, type Measured } from './all_pairs.ts';
import type { Solver } from './compare_rows.ts';
import type { Done, Job } from './compare_worker.ts';
import { KnownCards, pageStore } from './real_time.ts';
import { Field, Status, WeirError, type Gpu, type Sim, type Weir } from './weir.ts';

type Task = { task: 'measure'; seconds: number } | { task: 'positions'; steps: number; viscosity: number };

export class Bench {
  readonly #weir: Weir;
  readonly #module: WebAssembly.Module;
  #gpu: Gpu | null = null;
  #worker: Worker | null = null;
  #stop: (() => void) | null = null; // of the task in the worker
  stopped = false;

  constructor(weir: Weir, module: WebAssembly.Module) {
    this.#weir = weir;
    this.#module = module;
  }

  // The WebGPU adapter's name; throws if there is none.
  async startGpu(): Promise<string> {
    if (!navigator.gpu) throw new Error('no WebGPU in this browser');
    this.#gpu ??= this.#weir.createGpu({ known: new KnownCards(pageStore()).device() });
    await this.#gpu.ready();
    return this.#gpu.device;
  }

  async measure(solver: Solver, count: number, seconds: number): Promise<Measured> {
    if (solver.gpu) return this.#withGpuSim(solver, count, (sim) => this.#measureGpu(sim, seconds));
    const done = await this.#inWorker(solver, count, { task: 'measure', seconds });
    if ('measured' in done) return done.measured;
    throw new Error('error' in done ? done.error : 'no answer');
  }

  async positions(solver: Solver, count: number, steps: number, viscosity: number): Promise<Float32Array> {
    if (solver.gpu) return this.#withGpuSim(solver, count, (sim) => this.#readGpu(sim, steps), viscosity);
    const done = await this.#inWorker(solver, count, { task: 'positions', steps, viscosity });
    if ('positions' in done) return done.positions;
    throw new Error('error' in done ? done.error : 'no answer');
  }

  // Ends the task under way; a long step in the worker is cut off.
  stop(): void {
    this.stopped = true;
    this.#stop?.();
  }

  #inWorker(solver: Solver, count: number, task: Task): Promise<Done> {
    this.#worker ??= new Worker(new URL('./compare_worker.ts', import.meta.url), { type: 'module' });
    const worker = this.#worker;
    return new Promise((resolve, reject) => {
      const fail = (message: string): void => {
        worker.terminate();
        this.#worker = null;
        reject(new Error(message));
      };
      this.#stop = () => fail('stopped');
      worker.onmessage = (event: MessageEvent<Done>) => resolve(event.data);
      worker.onerror = (event) => fail(event.message || 'the worker could not be loaded');
      worker.postMessage({ module: this.#module, solver: solver.id, count, ...task } satisfies Job);
    });
  }

  async #withGpuSim<T>(
    solver: Solver, count: number, use: (sim: Sim) => Promise<T>, viscosity?: number,
  ): Promise<T> {
    if (!this.#gpu) throw new Error('no WebGPU');
    const search = solver.id === 'gpu_grid' ? 'grid' : 'all_pairs';
    const scene = this.#weir.loadScene(benchScene(count, search, viscosity));
    const sim = this.#weir.createSim(scene, { gpu: this.#gpu });
    try {
      await sim.ready();
      return await use(sim);
    } finally {
      sim.destroy();
      scene.destroy();
    }
  }

  async #finish(sim: Sim): Promise<void> {
    await this.#gpu?.nativeDevice?.queue.onSubmittedWorkDone();
    const status = sim.poll();
    if (status !== Status.ok && status !== Status.pending) throw new WeirError(status, sim.error);
  }

  // Ever larger batches until one takes long enough that starting and waiting for it no longer matter.
  async #measureGpu(sim: Sim, seconds: number): Promise<Measured> {
    sim.step(1);
    await this.#finish(sim);
    for (let steps = 1; ; ) {
      const begin = performance.now();
      // A single submission may not hold the device for long: drivers reset it after a few seconds.
      for (let left = steps; left > 0; left -= 64) sim.step(Math.min(left, 64));
      await this.#finish(sim);
      const ms = performance.now() - begin;
      if (ms >= 500 * seconds || this.stopped || steps >= 1 << 20) return { steps, msPerStep: ms / steps };
      steps = Math.max(2 * steps, Math.min(32 * steps, Math.floor((700 * seconds * steps) / Math.max(ms, 1))));
    }
  }

  async #readGpu(sim: Sim, steps: number): Promise<Float32Array> {
    sim.step(steps);
    await this.#finish(sim);
    for (;;) {
      const positions = sim.read(Field.position);
      if (positions) return new Float32Array(positions);
      await new Promise((resolve) => setTimeout(resolve, 2));
      await this.#finish(sim);
    }
  }
}
