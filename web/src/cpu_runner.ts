// Runs a scene with the C solver, inside a worker or on the page's own thread, frame by frame.
import { diagnoseInterval, type Snapshot, type Tool } from './engine.ts';
import { Pace } from './pace.ts';
import { floatsPerParticle } from './points.ts';
import { ProbeReader, type ProbeInfo, type ProbeSamples } from './probes.ts';
import { canResume, type SceneDocument } from './scene_document.ts';
import { ColorBy, Field, Look, type Clock, type Diagnostics, type Scene, type Sim, type Weir } from './weir.ts';

export type CpuFrame = {
  steps: number; // taken
  behind: boolean; // more were due
  stepCount: number;
  time: number;
  stepMs: number;
  diagnostics: Diagnostics | null; // a new one now and then
  clock: Clock | null; // wcsph only
  samples: ProbeSamples[]; // new ones of the probes
  warning: string;
};

// The looks of walls and bodies by number, as PointsFrame has them.
export function looksOf(scene: Scene, document: SceneDocument): number[] {
  const most = 1 + (document.walls?.length ?? 0) + (document.bodies?.length ?? 0);
  let bodies = 0;
  return Array.from({ length: most }, (_, solid) => {
    const look = scene.look(solid);
    if (look === Look.hidden) return -1;
    return look === Look.wall ? 1 : 2 + bodies++;
  });
}

// Fills `values` as PointsFrame says, if they have the right length, from what `read` gives.
export function fillPoints(
  sim: Sim, colorBy: ColorBy, looksOfSolids: number[], values: Float32Array,
  read = (field: Field): Float32Array | null => sim.read(field),
): void {
  const { particleCount: count, dimension } = sim;
  if (values.length !== floatsPerParticle(dimension) * count) return;
  const position = read(Field.position);
  if (position) values.set(position, 0);
  const velocity = read(Field.velocity);
  if (velocity) values.set(velocity, dimension * count);
  const field = colorBy === ColorBy.pressure ? Field.pressure : Field.density;
  const scalar = colorBy === ColorBy.speed ? null : read(field); // which costs an evaluation with wcsph
  if (scalar) values.set(scalar, 2 * dimension * count);
  const looks = values.subarray((2 * dimension + 1) * count);
  const group = read(Field.group);
  for (let i = 0; group && i < count; i++) {
    const number = group[i] as number;
    looks[i] = number <= 0 ? number : (looksOfSolids[number - 1] ?? 1);
  }
}

export class CpuRunner {
  readonly #weir: Weir;
  readonly #pace = new Pace();
  #sim: Sim | null = null;
  #timeOffset = 0; // a run that goes on from a snapshot keeps its clock
  #stepOffset = 0;
  #diagnosed = 0;
  readonly #frame: CpuFrame = { steps: 0, behind: false, stepCount: 0, time: 0, stepMs: 0, diagnostics: null, clock: null, samples: [], warning: '' };
  #probes: ProbeReader | null = null;
  #looks: number[] = [];
  #wcsph = false;

  constructor(weir: Weir) {
    this.#weir = weir;
  }

  get device(): string {
    return this.#sim?.device ?? '';
  }
  get particles(): number {
    return this.#sim?.particleCount ?? 0;
  }

  get dimension(): number {
    return this.#sim?.dimension ?? 2;
  }
  get fluidSlots(): number {
    return this.#sim?.fluidSlots ?? 0;
  }

  get probes(): ProbeInfo[] {
    return this.#probes?.infos ?? [];
  }

  start(document: SceneDocument, from: Snapshot | null): void {
    const scene = this.#weir.loadScene(document);
    let sim: Sim | null = null;
    try {
      sim = this.#weir.createSim(scene, { maxSteps: this.#pace.maxSteps });
      if (from && canResume(document) && from.positions.length === sim.dimension * sim.particleCount) {
        sim.setState(from.positions, from.velocities);
        this.#timeOffset = from.time;
        this.#stepOffset = from.steps;
      } else {
        this.#timeOffset = this.#stepOffset = 0;
      }
      this.#looks = looksOf(scene, document);
      this.#wcsph = scene.method === 'wcsph';
    } catch (error) {
      sim?.destroy();
      throw error;
    } finally {
      scene.destroy();
    }
    this.#probes?.destroy();
    this.#sim?.destroy();
    this.#sim = sim;
    this.#probes = new ProbeReader(sim);
    this.#pace.reset();
    this.#diagnosed = 0;
  }

  // Advances and fills `values` as PointsFrame says. Throws WeirError if the fluid blows up.
  frame(wallSeconds: number, budgetMs: number, tool: Tool, colorBy: ColorBy, values: Float32Array): CpuFrame {
    const frame = this.#frame;
    const sim = this.#sim;
    frame.diagnostics = null;
    if (!sim) return frame;
    sim.setTool(tool.kind, tool.position, tool.velocity, tool.radius, tool.strength);
    sim.setMaxSteps(this.#pace.maxSteps);
    const begin = performance.now();
    frame.steps = sim.advance(wallSeconds);
    const end = performance.now();
    frame.behind = frame.steps > 0 && frame.steps >= this.#pace.maxSteps;
    this.#pace.measured(frame.steps, end - begin, budgetMs);
    fillPoints(sim, colorBy, this.#looks, values);
    frame.samples = this.#probes?.update() ?? [];
    frame.stepCount = sim.stepCount + this.#stepOffset;
    frame.time = sim.time + this.#timeOffset;
    frame.stepMs = this.#pace.stepMs;
    frame.clock = this.#wcsph ? sim.clock() : null;
    frame.warning = sim.warning;
    if (end - this.#diagnosed > diagnoseInterval(sim.particleCount)) {
      frame.diagnostics = sim.diagnose();
      this.#diagnosed = end;
    }
    return frame;
  }

  step(count: number): void {
    this.#sim?.step(count);
  }
  reset(): void {
    this.#sim?.reset();
    this.#probes?.clear();
    this.#timeOffset = this.#stepOffset = 0;
  }
  setParameter(name: string, values: number[]): void {
    this.#sim?.setParameter(name, values);
    this.#pace.reset(); // `search` changes what a step costs by orders of magnitude
  }
  destroy(): void {
    this.#probes?.destroy();
    this.#probes = null;
    this.#sim?.destroy();
    this.#sim = null;
  }
}
