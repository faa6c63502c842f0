// The C solver in a worker. Two buffers go to and fro: one is drawn (and is the snapshot to go on from), the other is
// with the worker. A worker that dies is replaced once; the second death is a fault.
import { newStats, type Engine, type EngineStats, type FaultHandler, type Snapshot, type Tool } from './engine.ts';
import { CpuPicture } from './engine_cpu.ts';
import type { PickSource } from './pick.ts';
import { floatsPerParticle } from './points.ts';
import type { SceneDocument } from './scene_document.ts';
import type { FromWorker, ToWorker } from './worker_protocol.ts';
import { Status, WeirError, type View, type Weir } from './weir.ts';

// A worker that answers nothing for so long is taken for dead: usually, and after anything that may make its steps
// far slower (all pairs of 50,000 particles take many seconds).
const patienceMs = 3000;
const longPatienceMs = 60_000;

type Waiting = { resolve: () => void; reject: (error: Error) => void; scene: SceneDocument };

export class WorkerEngine implements Engine {
  readonly kind = 'worker';
  readonly mostParticles = 200_000;
  readonly stats: EngineStats = newStats();
  device = '';
  worker: Worker; // public for tests, which kill it
  readonly #module: WebAssembly.Module;
  readonly #picture: CpuPicture;
  readonly #onFault: FaultHandler;
  readonly #frameMessage: Extract<ToWorker, { type: 'frame' }>;
  #run = 0;
  #waiting: Waiting | null = null;
  #scene: SceneDocument = {};
  #back: ArrayBuffer | null = null; // ours to send
  #front: ArrayBuffer | null = null; // being drawn
  #asked = 0; // when the frame under way was asked for; 0: none
  #patience = longPatienceMs;
  #wallSince = 0; // when the wall time began that the next frame is to simulate; 0: paused
  #deaths = 0;
  #stopped = false;
  #destroyed = false;

  constructor(weir: Weir, module: WebAssembly.Module, canvas: HTMLCanvasElement, onFault: FaultHandler) {
    this.#module = module;
    this.#picture = new CpuPicture(weir, canvas);
    this.stats = this.#picture.stats;
    this.#onFault = onFault;
    const tool: Tool = { kind: 0, position: [0, 0, 0], velocity: [0, 0, 0], radius: 0, strength: 0 };
    this.#frameMessage = { type: 'frame', run: 0, wallSeconds: 0, budgetMs: 12, tool, colorBy: 0, buffer: new ArrayBuffer(0) };
    this.worker = this.#spawn();
  }

  #spawn(): Worker {
    const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'weir' });
    worker.onmessage = (event: MessageEvent<FromWorker>) => {
      if (worker === this.worker) this.#receive(event.data);
    };
    worker.onerror = (event) => {
      if (worker === this.worker) this.#died(event.message || 'the worker could not be loaded');
    };
    worker.postMessage({ type: 'load', module: this.#module } satisfies ToWorker);
    return worker;
  }

  #send(message: ToWorker): void {
    this.worker.postMessage(message);
  }

  start(scene: SceneDocument, from: Snapshot | null): Promise<void> {
    this.#waiting?.reject(new Error('another scene was started'));
    return new Promise((resolve, reject) => {
      this.#waiting = { resolve, reject, scene };
      this.#patience = longPatienceMs;
      this.#send({ type: 'start', run: ++this.#run, scene, from });
    });
  }

  #receive(message: FromWorker): void {
    if (message.type === 'frame') {
      if (message.run === this.#frameMessage.run) this.#received(message);
      return;
    }
    if (message.run !== this.#run && message.type !== 'fault') return; // of an earlier scene
    if (message.type === 'started') this.#started(message);
    if (message.type === 'refused') {
      this.#run = this.#frameMessage.run; // the scene before goes on
      this.#waiting?.reject(new WeirError(message.status, message.message));
      this.#waiting = null;
    }
    if (message.type === 'fault') {
      this.#asked = 0;
      this.#stopped = true;
      this.#onFault(message.status === Status.unstable ? 'unstable' : 'engine', message.message);
    }
  }

  #started({ particles, device, fluidSlots, dimension, probes }: Extract<FromWorker, { type: 'started' }>): void {
    const waiting = this.#waiting;
    if (!waiting) return;
    this.#scene = waiting.scene;
    this.device = `${device}, in a worker, drawn by ${this.#picture.renderer.name}`;
    this.#picture.setScene(waiting.scene, particles, fluidSlots, probes);
    this.#front = null;
    this.#back = new ArrayBuffer(4 * floatsPerParticle(dimension) * particles);
    this.#asked = 0;
    this.#stopped = false;
    this.#frameMessage.run = this.#run;
    this.#waiting = null;
    waiting.resolve();
  }

  #received(message: Extract<FromWorker, { type: 'frame' }>): void {
    this.#asked = 0;
    this.#patience = patienceMs + 20 * message.busyMs;
    this.#back = this.#front ?? new ArrayBuffer(message.buffer.byteLength);
    this.#front = message.buffer;
    const stats = this.stats;
    stats.frameSteps = message.steps;
    stats.steps = message.stepCount;
    stats.time = message.time;
    stats.stepMs = message.stepMs;
    stats.clock = message.clock;
    stats.warning = message.warning;
    this.#picture.addSamples(message.samples);
    if (message.diagnostics) stats.diagnostics = message.diagnostics;
    this.#picture.setValues(new Float32Array(message.buffer));
    if (message.behind && this.#wallSince > 0) this.#ask(); // the worker must not idle until the display's next frame
  }

  #ask(): void {
    if (this.#asked !== 0 || !this.#back || this.#stopped || this.#waiting) return;
    const message = this.#frameMessage;
    const now = performance.now();
    message.wallSeconds = this.#wallSince > 0 ? (now - this.#wallSince) / 1000 : 0;
    message.buffer = this.#back;
    if (this.#wallSince > 0) this.#wallSince = now;
    this.#back = null;
    this.#asked = now;
    this.worker.postMessage(message, [message.buffer]);
  }

  frame(wallSeconds: number, intervalMs: number, tool: Tool, view: View): void {
    const now = performance.now();
    if (wallSeconds === 0) this.#wallSince = 0;
    else if (this.#wallSince === 0) this.#wallSince = now - 1000 * wallSeconds;
    Object.assign(this.#frameMessage.tool, tool);
    this.#frameMessage.colorBy = view.colorBy;
    this.#frameMessage.budgetMs = Math.max(0.75 * intervalMs, 4);
    if (this.#asked !== 0 && now - this.#asked > this.#patience) this.#died('the worker does not answer');
    this.#ask();
    this.#picture.draw(view);
  }

  #died(reason: string): void {
    if (this.#destroyed) return;
    this.worker.terminate();
    this.#asked = 0;
    if (this.#waiting) {
      this.#waiting.reject(new Error(reason));
      this.#waiting = null;
      this.#stopped = true;
      if (this.#deaths++ > 0) this.#onFault('engine', reason);
      else this.worker = this.#spawn();
      return;
    }
    if (this.#deaths++ > 0) {
      this.#stopped = true;
      this.#onFault('engine', reason);
      return;
    }
    this.worker = this.#spawn();
    this.start(this.#scene, this.snapshot()).catch((error: Error) => this.#onFault('engine', error.message));
  }

  step(count: number): void {
    this.#patience = longPatienceMs;
    this.#send({ type: 'step', count });
    this.#ask();
  }
  reset(): void {
    for (const series of this.stats.probes) series.clear();
    this.#stopped = false;
    this.#send({ type: 'reset' });
  }
  setParameter(name: string, values: number[], scene: SceneDocument): void {
    this.#patience = longPatienceMs;
    this.#scene = scene;
    this.#send({ type: 'set', name, values });
  }
  snapshot(): Snapshot | null {
    return this.#picture.snapshot();
  }
  fluid(): PickSource | null {
    return this.#picture.fluid();
  }
  destroy(): void {
    this.#destroyed = true;
    this.worker.terminate();
    this.#waiting?.reject(new Error('the engine was closed'));
    this.#waiting = null;
    this.#picture.renderer.destroy();
  }
}
