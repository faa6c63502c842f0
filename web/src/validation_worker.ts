// Runs one case, on the CPU or on WebGPU, away from the page: slices of work, a frame of particles and the curves after
// each.
import { fillPoints, looksOf } from './cpu_runner.ts';
import { floatsPerParticle } from './points.ts';
import type { SceneDocument } from './scene_document.ts';
import { Validation, type CurveData, type Gate, type Resolution, type RunInfo } from './validation_api.ts';
import { ColorBy, Field, Weir, type Gpu, type KnownDevice, type Scene, type Sim } from './weir.ts';

export type Solver = 'gpu' | 'cpu';

export type ToValidator =
  | { type: 'load'; module: WebAssembly.Module; known: KnownDevice }
  | { type: 'start'; job: number; caseIndex: number; resolution: Resolution; solver: Solver }
  | { type: 'go'; job: number; colorBy: ColorBy } // one slice
  | { type: 'stop' };

export type FromValidator =
  | { type: 'ready'; job: 0; gpu: string; isSoftware: boolean } // gpu: its name, '' if there is none
  | { type: 'run'; job: number; run: number; runs: RunInfo[]; scene: SceneDocument; particles: number; fluidSlots: number; device: string }
  | { type: 'frame'; job: number; values: Float32Array; time: number; progress: number; curves: CurveData[] | null }
  | { type: 'judged'; job: number; passed: boolean; gates: Gate[]; curves: CurveData[]; error: string }
  | { type: 'idle'; job: number } // a slice without a picture
  | { type: 'fault'; job: number; message: string };

const sliceMs = 60;
const answerMs = 10_000; // a driver that hangs must not leave the page waiting
const mostQueued = 512; // steps on the GPU between two looks at it

const send = (message: FromValidator, transfer: Transferable[] = []): void => postMessage(message, { transfer });
const textOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));

// A timer, so that callbacks of the GPU get their turn: a worker that posts messages to itself starves them (Chromium).
const nextTurn = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 0));

// One case, run by run.
class Job {
  readonly #weir: Weir;
  readonly #gpu: Gpu | null;
  readonly #job: number;
  readonly #validation: Validation;
  #run = -1;
  #sim: Sim | null = null;
  #looks: number[] = [];
  #queued = 1; // steps asked for at once
  #samples = 0; // measurements that the run has

  constructor(weir: Weir, gpu: Gpu | null, job: number, caseIndex: number, resolution: Resolution) {
    this.#weir = weir;
    this.#gpu = gpu;
    this.#job = job;
    this.#validation = new Validation(weir, caseIndex, resolution);
  }

  // False once all is done.
  async slice(colorBy: ColorBy): Promise<boolean> {
    const validation = this.#validation;
    if (!this.#sim || validation.runIsDone) {
      this.#sim?.destroy();
      this.#sim = null;
      if (++this.#run >= validation.runs.length) {
        this.#judge();
        return false;
      }
      await this.#begin();
    }
    if (!this.#sim || !(await this.#work(this.#sim, colorBy))) send({ type: 'idle', job: this.#job });
    return true;
  }

  // Asks again until it is done; in between the GPU's callbacks run.
  async #until(isDone: () => boolean): Promise<void> {
    while (!isDone()) {
      await nextTurn();
      this.#gpu?.poll();
    }
  }

  async #begin(): Promise<void> {
    const validation = this.#validation;
    const run = validation.runs[this.#run] as RunInfo;
    const document = JSON.parse(run.sceneText) as SceneDocument;
    let scene: Scene | null = null;
    try {
      scene = this.#weir.loadScene(document);
      validation.prepare(this.#run, scene);
      const sim = (this.#sim = this.#weir.createSim(scene, this.#gpu ? { gpu: this.#gpu } : {}));
      await sim.ready();
      this.#looks = looksOf(scene, document);
      // What the page draws: the document with this run's spacing.
      const parameters = { ...document.parameters, particle_spacing: run.spacing };
      send({
        type: 'run', job: this.#job, run: this.#run, runs: validation.runs, scene: { ...document, parameters },
        particles: sim.particleCount, fluidSlots: sim.fluidSlots, device: sim.device,
      });
      await this.#until(() => validation.begin(this.#run, sim));
      this.#samples = 1;
    } catch (error) {
      validation.abandon(textOf(error));
    } finally {
      scene?.destroy();
    }
  }

  // A look costs some milliseconds: it should not come more often than needed, nor seldom where steps are slow.
  #pace(ms: number): void {
    if (ms < sliceMs / 3) this.#queued = Math.min(2 * this.#queued, mostQueued);
    if (ms > sliceMs) this.#queued = Math.max(this.#queued >> 1, 1);
  }

  // Steps towards the next measurement and takes it when its time has come. False if the run has failed.
  async #work(sim: Sim, colorBy: ColorBy): Promise<boolean> {
    const validation = this.#validation;
    const { interval, endTime } = validation.runs[this.#run] as RunInfo;
    const begin = performance.now();
    let measured = false;
    try {
      while (!validation.runIsDone && performance.now() - begin < sliceMs) {
        const { time } = sim;
        const asked = performance.now();
        sim.stepUntil(this.#queued, Math.min(this.#samples * interval, endTime));
        if (this.#gpu) {
          await sim.finished();
          this.#pace(performance.now() - asked);
        }
        if (sim.time !== time) continue;
        await this.#until(() => validation.advance(sim));
        this.#samples++;
        measured = true;
      }
      const values = await this.#points(sim, colorBy);
      const curves = measured ? validation.curves() : null;
      send({ type: 'frame', job: this.#job, values, time: sim.time, progress: validation.progress, curves }, [values.buffer]);
      return true;
    } catch {
      if (!validation.runIsDone) validation.abandon(sim.error);
      return false; // its gates will say so
    }
  }

  async #points(sim: Sim, colorBy: ColorBy): Promise<Float32Array<ArrayBuffer>> {
    const values = new Float32Array(floatsPerParticle(sim.dimension) * sim.particleCount);
    const copies = new Map<Field, Float32Array>();
    for (const field of [Field.position, Field.velocity, Field.group]) {
      await this.#until(() => {
        const view = sim.read(field);
        if (view) copies.set(field, view.slice());
        return view !== null;
      });
    }
    fillPoints(sim, colorBy, this.#looks, values, (field) => copies.get(field) ?? null);
    return values;
  }

  #judge(): void {
    const validation = this.#validation;
    const passed = validation.judge();
    send({
      type: 'judged', job: this.#job, passed, gates: validation.gates(), curves: validation.curves(), error: validation.error,
    });
  }

  destroy(): void {
    this.#sim?.destroy();
    this.#validation.destroy();
  }
}

type Engine = { weir: Weir; gpu: Gpu | null };

async function load(module: WebAssembly.Module, known: KnownDevice): Promise<Engine> {
  const weir = await Weir.load(module);
  if (!navigator.gpu) {
    send({ type: 'ready', job: 0, gpu: '', isSoftware: false });
    return { weir, gpu: null };
  }
  // Times are wanted for the device alone, if the page does not know it yet.
  const gpu = weir.createGpu({ known, timestamps: known.parallelism === 0 });
  const late = new Promise<never>((_, reject) => setTimeout(() => reject(new Error('no answer')), answerMs));
  try {
    await Promise.race([gpu.ready(), late]);
    send({ type: 'ready', job: 0, gpu: gpu.device, isSoftware: gpu.isSoftware });
    return { weir, gpu };
  } catch {
    gpu.destroy();
    send({ type: 'ready', job: 0, gpu: '', isSoftware: false });
    return { weir, gpu: null };
  }
}

let engine: Promise<Engine> | null = null;
let current: { number: number; job: Job } | null = null;

async function act(message: ToValidator): Promise<void> {
  if (message.type === 'load') {
    engine = load(message.module, message.known);
    await engine;
  } else if (message.type === 'start' || message.type === 'stop') {
    current?.job.destroy();
    current = null;
    if (message.type === 'stop' || !engine) return;
    const { weir, gpu } = await engine;
    if (message.solver === 'gpu' && !gpu) throw new Error('There is no WebGPU here.');
    current = {
      number: message.job, job: new Job(weir, message.solver === 'gpu' ? gpu : null, message.job, message.caseIndex, message.resolution),
    };
  } else if (message.type === 'go' && current?.number === message.job) {
    if (await current.job.slice(message.colorBy)) return;
    current.job.destroy();
    current = null;
  }
}

let queue = Promise.resolve();
addEventListener('message', (event: MessageEvent<ToValidator>) => {
  const message = event.data;
  queue = queue.then(() => act(message)).catch((error: unknown) => {
    send({ type: 'fault', job: 'job' in message ? message.job : 0, message: textOf(error) });
  });
});
