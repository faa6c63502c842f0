// The contract between the page and whatever moves and draws the fluid: WebGPU here, C in a worker, C on this thread.
import type { SceneDocument } from './scene_document.ts';
import type { PickSource } from './pick.ts';
import type { ProbeSeries } from './probes.ts';
import { ToolKind, type Clock, type Diagnostics, type PassTime, type Triple, type View } from './weir.ts';

// The pointer's tool, as weir_sim_set_tool() takes it.
export type Tool = {
  kind: ToolKind;
  position: Triple; // m
  velocity: Triple; // m/s
  radius: number; // m
  strength: number;
};

// Positions and velocities to go on from: x0, y0, (z0,) x1, ...
export type Snapshot = { positions: Float32Array; velocities: Float32Array; time: number; steps: number };

// What an engine tells while it runs; one object, changed in place.
export type EngineStats = {
  particles: number;
  steps: number; // since the start
  time: number; // simulated seconds since the start
  frames: number; // drawn, each with a newer state than the last one
  frameSteps: number; // of the last frame
  stepMs: number; // milliseconds per step, averaged
  drawMs: number; // milliseconds that the device draws a picture, averaged; 0: not known
  passes: PassTime[]; // empty where the device gives no times
  diagnostics: Diagnostics | null;
  clock: Clock | null; // wcsph only
  probes: ProbeSeries[]; // of the scene; another list for another run
  memory: number; // bytes; 0: not known
  warning: string; // the simulation's own advice; '' if none
};

// As weir_sim_warning() has them: too fast, or too compressed, for nearly incompressible flow.
export const isFast = (clock: Clock): boolean => clock.machNumber > 0.1;
export const isCompressed = (clock: Clock): boolean => clock.maxDensityError > 0.03;

export type FaultKind =
  | 'input' // the scene is refused
  | 'unstable' // the fluid blew up; the engine is fine
  | 'engine'; // it cannot go on: device lost, worker gone, out of memory

export type FaultHandler = (kind: FaultKind, message: string) => void;

export interface Engine {
  readonly kind: 'gpu' | 'worker' | 'main';
  readonly device: string;
  readonly stats: EngineStats;
  readonly mostParticles: number; // that it can hold, for the panel
  // Starts a scene; the run before goes on if this throws.
  start(scene: SceneDocument, from: Snapshot | null): Promise<void>;
  // Once per animation frame: takes the steps due after `wallSeconds` and draws.
  frame(wallSeconds: number, intervalMs: number, tool: Tool, view: View): void;
  step(count: number): void;
  reset(): void;
  // `scene`: the whole document with that change, for engines that may have to start it again.
  setParameter(name: string, values: number[], scene: SceneDocument): void;
  snapshot(): Snapshot | null; // the last one known
  fluid(): PickSource | null; // where it is, as far as known: 3D only
  destroy(): void;
}

export function newStats(): EngineStats {
  return {
    particles: 0, steps: 0, time: 0, frames: 0, frameSteps: 0, stepMs: 0, drawMs: 0, passes: [], diagnostics: null, clock: null,
    probes: [], memory: 0, warning: '',
  };
}

// Where diagnostics or probes visit all particles on the host, or copy them there: rarer for more of them.
export const diagnoseInterval = (particles: number): number => Math.max(100, particles / 1000);
