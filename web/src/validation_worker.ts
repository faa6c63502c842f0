// Runs one case with the C solver, away from the page: slices of work, a frame of particles and the curves after each.
import { fillPoints, looksOf } from './cpu_runner.ts';
import { floatsPerParticle } from './points.ts';
import type { SceneDocument } from './scene_document.ts';
import { Validation, type CurveData, type Gate, type Resolution, type RunInfo } from './validation_api.ts';
import { ColorBy, Weir, type Scene, type Sim } from './weir.ts';

export type ToValidator =
  | { type: 'load'; module: WebAssembly.Module }
  | { type: 'start'; job: number; caseIndex: number; resolution: Resolution }
  | { type: 'go'; job: number; colorBy: ColorBy } // one slice
  | { type: 'stop' };

export type FromValidator =
  | { type: 'run'; job: number; run: number; runs: RunInfo[]; scene: SceneDocument; particles: number; fluidSlots: number }
  | { type: 'frame'; job: number; values: Float32Array; time: number; progress: number; curves: CurveData[] | null }
  | { type: 'judged'; job: number; passed: boolean; gates: Gate[]; curves: CurveData[]; error: string }
  | { type: 'idle'; job: number } // a slice without a picture
  | { type: 'fault'; job: number; message: string };

const sliceMs = 60;

const send = (message: FromValidator, transfer: Transferable[] = []): void => postMessage(message, { transfer });
const textOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));

// One case, run by run.
class Job {
  readonly #weir: Weir;
  readonly #job: number;
  readonly #validation: Validation;
  #run = -1;
  #sim: Sim | null = null;
  #looks: number[] = [];
  #samples = 0; // measurements that the run has

  constructor(weir: Weir, job: number, caseIndex: number, resolution: Resolution) {
    this.#weir = weir;
    this.#job = job;
    this.#validation = new Validation(weir, caseIndex, resolution);
  }

  // False once all is done.
  slice(colorBy: ColorBy): boolean {
    const validation = this.#validation;
    if (!this.#sim || validation.runIsDone) {
      this.#sim?.destroy();
      this.#sim = null;
      if (++this.#run >= validation.runs.length) {
        this.#judge();
        return false;
      }
      this.#begin();
    }
    if (!this.#sim || !this.#work(this.#sim, colorBy)) send({ type: 'idle', job: this.#job });
    return true;
  }

  #begin(): void {
    const validation = this.#validation;
    const run = validation.runs[this.#run] as RunInfo;
    const document = JSON.parse(run.sceneText) as SceneDocument;
    let scene: Scene | null = null;
    try {
      scene = this.#weir.loadScene(document);
      validation.prepare(this.#run, scene);
      const sim = (this.#sim = this.#weir.createSim(scene));
      this.#looks = looksOf(scene, document);
      // What the page draws: the document with this run's spacing.
      const parameters = { ...document.parameters, particle_spacing: run.spacing };
      send({
        type: 'run', job: this.#job, run: this.#run, runs: validation.runs, scene: { ...document, parameters },
        particles: sim.particleCount, fluidSlots: sim.fluidSlots,
      });
      validation.begin(this.#run, sim);
      this.#samples = 1;
    } catch (error) {
      validation.abandon(textOf(error));
    } finally {
      scene?.destroy();
    }
  }

  // Steps towards the next measurement; the last steps, which end there exactly, are the engine's. False if the run
  // has failed.
  #work(sim: Sim, colorBy: ColorBy): boolean {
    const validation = this.#validation;
    const { interval, endTime } = validation.runs[this.#run] as RunInfo;
    const begin = performance.now();
    let measured = false;
    try {
      while (!validation.runIsDone && performance.now() - begin < sliceMs) {
        const next = Math.min(this.#samples * interval, endTime);
        const { time, timeStep } = sim.clock();
        if (timeStep > 0 && time + 3 * timeStep < next) {
          sim.step(1);
          continue;
        }
        validation.advance(sim);
        this.#samples++;
        measured = true;
      }
    } catch {
      return false; // its gates will say so
    }
    const values = new Float32Array(floatsPerParticle(sim.dimension) * sim.particleCount);
    fillPoints(sim, colorBy, this.#looks, values);
    const curves = measured ? validation.curves() : null;
    send({ type: 'frame', job: this.#job, values, time: sim.time, progress: validation.progress, curves }, [values.buffer]);
    return true;
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

let weir: Promise<Weir> | null = null;
let current: { number: number; job: Job } | null = null;

async function act(message: ToValidator): Promise<void> {
  if (message.type === 'load') {
    weir = Weir.load(message.module, { gpu: null });
  } else if (message.type === 'start' || message.type === 'stop') {
    current?.job.destroy();
    current = null;
    if (message.type === 'stop' || !weir) return;
    current = { number: message.job, job: new Job(await weir, message.job, message.caseIndex, message.resolution) };
  } else if (message.type === 'go' && current?.number === message.job) {
    if (current.job.slice(message.colorBy)) return;
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
