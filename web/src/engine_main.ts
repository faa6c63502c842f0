// The C solver on the page's own thread: the last resort, when workers fail.
import { CpuRunner } from './cpu_runner.ts';
import { type Engine, type EngineStats, type FaultHandler, type Snapshot, type Tool } from './engine.ts';
import { CpuPicture } from './engine_cpu.ts';
import type { PickSource } from './pick.ts';
import { floatsPerParticle } from './points.ts';
import type { SceneDocument } from './scene_document.ts';
import { Status, WeirError, type View, type Weir } from './weir.ts';

const budgetMs = 9; // of a frame: the page must stay responsive

export class MainEngine implements Engine {
  readonly kind = 'main';
  readonly mostParticles = 100_000;
  readonly stats: EngineStats;
  readonly #runner: CpuRunner;
  readonly #picture: CpuPicture;
  readonly #onFault: FaultHandler;
  #values = new Float32Array(0);
  #stopped = false;

  constructor(weir: Weir, canvas: HTMLCanvasElement, onFault: FaultHandler) {
    this.#runner = new CpuRunner(weir);
    this.#picture = new CpuPicture(weir, canvas);
    this.#onFault = onFault;
    this.stats = this.#picture.stats;
  }

  get device(): string {
    return this.#runner.device;
  }

  async start(scene: SceneDocument, from: Snapshot | null): Promise<void> {
    this.#runner.start(scene, from);
    const { particles, dimension, fluidSlots, probes } = this.#runner;
    this.#picture.setScene(scene, particles, fluidSlots, probes);
    this.#values = new Float32Array(floatsPerParticle(dimension) * particles);
    this.#stopped = false;
  }

  frame(wallSeconds: number, _intervalMs: number, tool: Tool, view: View): void {
    if (!this.#stopped) this.#advance(wallSeconds, tool, view);
    this.#picture.draw(view);
  }

  #advance(wallSeconds: number, tool: Tool, view: View): void {
    try {
      const frame = this.#runner.frame(wallSeconds, budgetMs, tool, view.colorBy, this.#values);
      this.stats.frameSteps = frame.steps;
      this.stats.steps = frame.stepCount;
      this.stats.time = frame.time;
      this.stats.stepMs = frame.stepMs;
      this.stats.clock = frame.clock;
      this.stats.warning = frame.warning;
      this.#picture.addSamples(frame.samples);
      if (frame.diagnostics) this.stats.diagnostics = frame.diagnostics;
      this.#picture.setValues(this.#values);
    } catch (error) {
      this.#stopped = true;
      const unstable = error instanceof WeirError && error.status === Status.unstable;
      this.#onFault(unstable ? 'unstable' : 'engine', (error as Error).message);
    }
  }

  step(count: number): void {
    this.#runner.step(count);
  }
  reset(): void {
    for (const series of this.stats.probes) series.clear();
    this.#runner.reset();
    this.#stopped = false;
  }
  setParameter(name: string, values: number[]): void {
    this.#runner.setParameter(name, values);
  }
  snapshot(): Snapshot | null {
    return this.#picture.snapshot();
  }
  fluid(): PickSource | null {
    return this.#picture.fluid();
  }
  destroy(): void {
    this.#runner.destroy();
    this.#picture.renderer.destroy();
  }
}
