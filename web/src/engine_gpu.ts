// WebGPU: the fluid is moved and drawn on the device; this thread only queues work. At most two frames are under way,
// gated on onSubmittedWorkDone(): animation frames go on at full rate even when a device is lost or far behind.
import {
  diagnoseInterval, newStats, type Engine, type EngineStats, type FaultHandler, type Snapshot, type Tool,
} from './engine.ts';
import type { PickSource } from './pick.ts';
import { Pace } from './pace.ts';
import { ProbeReader, ProbeSeries } from './probes.ts';
import { canResume, type SceneDocument } from './scene_document.ts';
import { FluidStyle, Status, WeirError, type Gpu, type Renderer, type Scene, type Sim, type View, type Weir } from './weir.ts';

const framesInFlight = 2;
const longestFrameMs = 51; // three of a display with 60 per second
const snapshotMs = 1000;
const pickMs = 300; // in 3D, where the pointer looks for the fluid in the snapshot
const passTimesMs = 500;
const diagnoseMs = 100; // the device sums up what the plots show, and gathers what probes of wcsph look at
const settleMs = 1000; // for what is still on its way when the picture stops
const repaintMs = 500; // of a picture that stands still: a browser may lose it
const bytesPerParticle = 16; // of the largest array, array<vec4f>

// Firefox (153) never paints again if a device, or a canvas's configuration, goes while that canvas is on the page: the
// canvas is taken away first, then some frames pass.
function afterFrames(run: () => void): void {
  let waiting = true;
  const once = (): void => {
    if (waiting) run();
    waiting = false;
  };
  const count = (left: number): void => {
    if (left === 0) once();
    else requestAnimationFrame(() => count(left - 1));
  };
  count(4);
  setTimeout(once, 500); // a hidden page has no animation frames
}

// A copy of `values`, in the array `into` if it is as long.
function kept(into: Float32Array<ArrayBuffer>, values: Float32Array): Float32Array<ArrayBuffer> {
  if (into.length !== values.length) return new Float32Array(values);
  into.set(values);
  return into;
}

export class GpuEngine implements Engine {
  readonly kind = 'gpu';
  readonly stats: EngineStats = newStats();
  readonly gpu: Gpu; // public for tests, which destroy its device
  readonly #weir: Weir;
  readonly #device: GPUDevice;
  readonly #renderer: Renderer;
  readonly #canvas: HTMLCanvasElement;
  readonly #onFault: FaultHandler;
  readonly #pace = new Pace(longestFrameMs);
  #sim: Sim | null = null;
  #creating: Promise<Sim> | null = null; // the next one
  #inFlight = 0;
  #owedWall = 0; // of animation frames that were skipped
  #lastDone = 0;
  #intervalMs = 1000 / 60; // the display's
  // Of the frames under way, oldest first.
  readonly #sent = new Float64Array(framesInFlight);
  readonly #sentSteps = new Int32Array(framesInFlight);
  #diagnosed = 0;
  #diagnosing = false;
  #snapshotAt = 0;
  #copying = false; // the next one is under way
  #positions = new Float32Array(0);
  #velocities = new Float32Array(0);
  #snapshot: Snapshot | null = null;
  #pick: PickSource | null = null;
  #probes: ProbeReader | null = null;
  #probing = false; // a copy for them is under way
  #probed = 0;
  #wcsph = false;
  #timed = 0;
  #timeOffset = 0;
  #stepOffset = 0;
  #stopped = false;
  #destroyed = false;
  #leaving = false; // the device is about to go
  #shown = ''; // the view that was drawn last while time stood still
  #changed = 0; // when the picture did
  #lastSent = 0; // when the last frame was

  // `gpu` must be ready.
  constructor(weir: Weir, gpu: Gpu, canvas: HTMLCanvasElement, onFault: FaultHandler) {
    const device = gpu.nativeDevice;
    if (!device) throw new Error('the WebGPU device is gone');
    this.#weir = weir;
    this.gpu = gpu;
    this.#device = device;
    this.#onFault = onFault;
    this.#renderer = weir.createRenderer(gpu, canvas);
    this.#canvas = canvas;
    this.#guardDestroy();
    void device.lost.then((info) => this.#fail(`The WebGPU device was lost: ${info.message || info.reason}`));
  }

  // Whoever destroys the device: the canvas goes first.
  #guardDestroy(): void {
    const device = this.#device;
    const destroy = device.destroy.bind(device);
    device.destroy = () => {
      device.destroy = destroy;
      this.#leaving = true;
      this.#canvas.remove();
      afterFrames(destroy);
      return undefined;
    };
  }

  get device(): string {
    return this.gpu.device;
  }
  get mostParticles(): number {
    const { maxStorageBufferBindingSize, maxBufferSize } = this.#device.limits;
    return Math.min(Math.floor(Math.min(maxStorageBufferBindingSize, maxBufferSize) / bytesPerParticle), 4_000_000);
  }

  async start(scene: SceneDocument, from: Snapshot | null): Promise<void> {
    this.#creating = this.#create(scene);
    const next = await this.#creating;
    if (this.#destroyed) {
      next.destroy();
      throw new Error('the engine was closed');
    }
    this.#timeOffset = this.#stepOffset = 0;
    if (from && canResume(scene) && from.positions.length === next.dimension * next.particleCount) {
      next.setState(from.positions, from.velocities);
      this.#timeOffset = from.time;
      this.#stepOffset = from.steps;
    }
    this.#probes?.destroy();
    this.#sim?.destroy();
    this.#sim = next;
    const probes = (this.#probes = new ProbeReader(next));
    this.stats.probes = probes.infos.map((info) => new ProbeSeries(info));
    this.#probing = false;
    this.#pace.reset();
    this.#stopped = false;
    this.#snapshot = null;
    this.#copying = false;
    this.#changed = performance.now();
    this.#snapshotAt = this.#changed - 0.8 * snapshotMs; // soon, but not in the first frames
    this.#diagnosing = false;
    this.stats.particles = next.particleCount;
    this.stats.diagnostics = null;
    this.stats.clock = null;
    this.stats.passes = [];
  }

  // The run before stays until the new one is there; where memory is too short for both, it has to go first.
  #noteScene(scene: Scene): void {
    const { min, max } = scene.domain;
    this.#wcsph = scene.method === 'wcsph';
    this.#pick = { positions: this.#positions, count: 0, radius: 1.2 * (scene.parameter('particle_spacing')[0] ?? 0.01), min, max };
  }

  async #create(document: SceneDocument): Promise<Sim> {
    const scene = this.#weir.loadScene(document);
    let sim: Sim | null = null;
    try {
      sim = this.#weir.createSim(scene, { gpu: this.gpu, maxSteps: this.#pace.maxSteps });
      if (!this.gpu.isSoftware) this.#renderer.prepare(scene, FluidStyle.water); // as most cards draw it
      await sim.ready();
      this.#noteScene(scene);
      return sim;
    } catch (error) {
      sim?.destroy();
      throw error;
    } finally {
      scene.destroy();
    }
  }

  frame(wallSeconds: number, intervalMs: number, tool: Tool, view: View): void {
    const sim = this.#sim;
    if (!sim || this.#destroyed || this.#leaving) return;
    this.#intervalMs = intervalMs;
    this.#owedWall += wallSeconds;
    if (!this.#poll(sim) || this.#inFlight >= framesInFlight || this.#standsStill(wallSeconds, view)) return;
    try {
      sim.setTool(tool.kind, tool.position, tool.velocity, tool.radius, tool.strength);
      sim.setMaxSteps(this.#pace.maxSteps);
      const steps = this.#stopped ? 0 : sim.advance(this.#owedWall);
      this.#owedWall = 0;
      this.#submit(sim, view, steps);
      this.#measure(sim);
    } catch (error) {
      this.#caught(error as Error);
    }
  }

  // Whether the same picture is to be drawn again as lately.
  #standsStill(wallSeconds: number, view: View): boolean {
    const now = performance.now();
    if (wallSeconds > 0) {
      this.#changed = now;
      return false;
    }
    const shown = `${JSON.stringify(view)} ${this.#canvas.width} ${this.#canvas.height}`;
    if (shown !== this.#shown) this.#changed = now;
    this.#shown = shown;
    return now - this.#changed > settleMs && now - this.#lastSent < repaintMs;
  }

  #submit(sim: Sim, view: View, steps: number): void {
    const status = this.#renderer.draw(sim, view);
    if (status !== Status.ok && status !== Status.pending) this.#fail(this.gpu.error || 'drawing failed');
    this.#sent[this.#inFlight] = this.#lastSent = performance.now();
    this.#sentSteps[this.#inFlight] = steps;
    this.#inFlight++;
    this.stats.frameSteps = steps;
    this.#device.queue.onSubmittedWorkDone().then(this.#done, this.#notDone);
  }

  readonly #done = (): void => {
    const now = performance.now();
    const begin = Math.max(this.#sent[0] as number, this.#lastDone);
    this.stats.drawMs = this.gpu.isSoftware || this.#destroyed ? 0 : this.#renderer.drawTime;
    this.#pace.measured(this.#sentSteps[0] as number, now - begin, this.#intervalMs, this.#deviceMs(), this.stats.drawMs);
    this.#lastDone = now;
    this.#sent.copyWithin(0, 1);
    this.#sentSteps.copyWithin(0, 1);
    this.#inFlight--;
    this.stats.frames++;
    this.stats.stepMs = this.#pace.stepMs;
    if (!this.#sim || this.#destroyed) return;
    this.stats.steps = this.#sim.stepCount + this.#stepOffset;
    this.stats.time = this.#sim.time + this.#timeOffset;
    if (this.#wcsph) this.stats.clock = this.#sim.clock();
  };

  // Of a step, by the device's clock; 0: not known.
  #deviceMs(): number {
    return this.gpu.isSoftware ? 0 : (this.#sim?.stepTime ?? 0);
  }

  readonly #notDone = (error: Error): void => {
    this.#inFlight = Math.max(this.#inFlight - 1, 0);
    this.#fail(`The WebGPU queue failed: ${error.message}`);
  };

  // False once it cannot go on.
  #poll(sim: Sim): boolean {
    const gpu = this.gpu.poll();
    if (gpu !== Status.ok && gpu !== Status.pending) {
      this.#fail(this.gpu.error);
      return false;
    }
    if (this.#stopped) return true;
    const status = sim.poll();
    if (status === Status.unstable || status === Status.lost) {
      this.#stopped = true;
      this.#onFault('unstable', sim.error);
    } else if (status !== Status.ok && status !== Status.pending) {
      this.#fail(sim.error);
      return false;
    }
    return true;
  }

  #measure(sim: Sim): void {
    const now = performance.now();
    if (this.#stopped || this.#destroyed) return;
    this.#diagnose(sim, now);
    // One copy of the state at a time; the probes of wcsph need none.
    if (this.#wcsph || !this.#copying) this.#probe(sim, now);
    if (this.#wcsph || !this.#probing) this.#takeSnapshot(sim, now);
    if (now - this.#timed > passTimesMs) {
      this.stats.passes = sim.passTimes();
      this.stats.memory = this.gpu.memory;
      this.stats.warning = sim.warning;
      this.#timed = now;
    }
  }

  #diagnose(sim: Sim, now: number): void {
    if (!this.#diagnosing && now - this.#diagnosed < diagnoseMs) return;
    const diagnostics = sim.diagnose();
    this.#diagnosing = diagnostics === null;
    if (diagnostics) {
      this.stats.diagnostics = diagnostics;
      this.#diagnosed = now;
    }
  }

  #probe(sim: Sim, now: number): void {
    const interval = this.#wcsph ? diagnoseMs : diagnoseInterval(sim.particleCount);
    if (!this.#probing && now - this.#probed < 0.7 * interval) return;
    const samples = this.#probes ? this.#probes.update() : [];
    this.#probing = samples === null;
    if (!samples) return;
    this.#probed = now;
    for (const one of samples) this.stats.probes[one.probe]?.add(one);
  }

  #takeSnapshot(sim: Sim, now: number): void {
    const interval = Math.max(sim.dimension === 3 ? pickMs : snapshotMs, 5 * diagnoseInterval(sim.particleCount));
    if (!this.#copying && now - this.#snapshotAt < interval) return;
    const motion = sim.readMotion();
    this.#copying = motion === null;
    if (!motion) return;
    this.#positions = kept(this.#positions, motion.positions);
    this.#velocities = kept(this.#velocities, motion.velocities);
    if (this.#pick) Object.assign(this.#pick, { positions: this.#positions, count: sim.fluidSlots });
    const { time, steps } = this.stats;
    this.#snapshot = { positions: this.#positions, velocities: this.#velocities, time, steps };
    this.#snapshotAt = now;
  }

  #caught(error: Error): void {
    if (error instanceof WeirError && (error.status === Status.unstable || error.status === Status.lost)) {
      this.#stopped = true;
      this.#onFault('unstable', error.message);
    } else {
      this.#fail(error.message);
    }
  }

  #fail(message: string): void {
    if (this.#destroyed) return;
    this.#destroyed = true; // no second report, no more work
    this.#onFault('engine', message);
  }

  step(count: number): void {
    this.#changed = performance.now();
    try {
      this.#sim?.step(count);
    } catch (error) {
      this.#caught(error as Error);
    }
  }
  reset(): void {
    this.#changed = performance.now();
    this.#sim?.reset();
    this.#probes?.clear();
    for (const series of this.stats.probes) series.clear();
    this.#timeOffset = this.#stepOffset = 0;
    this.#stopped = false;
  }
  setParameter(name: string, values: number[]): void {
    this.#changed = performance.now();
    this.#sim?.setParameter(name, values);
    this.#pace.reset();
  }
  snapshot(): Snapshot | null {
    return this.#snapshot;
  }
  fluid(): PickSource | null {
    return this.#sim?.dimension === 3 && this.#pick && this.#pick.count > 0 ? this.#pick : null;
  }
  destroy(): void {
    this.#destroyed = true;
    this.#canvas.remove();
    afterFrames(() => void this.#release());
  }

  // A simulation that is being made still needs the device.
  async #release(): Promise<void> {
    await this.#creating?.catch(() => null);
    this.#probes?.destroy();
    this.#probes = null;
    this.#sim?.destroy();
    this.#sim = null;
    this.#renderer.destroy();
    this.gpu.destroy();
  }
}
