// Messages between the page and the worker that runs the C solver. `run` numbers the scenes started, so that frames
// of an earlier one are told apart.
import type { Snapshot, Tool } from './engine.ts';
import type { ProbeInfo, ProbeSamples } from './probes.ts';
import type { SceneDocument } from './scene_document.ts';
import type { Clock, ColorBy, Diagnostics, Status } from './weir.ts';

export type ToWorker =
  | { type: 'load'; module: WebAssembly.Module }
  | { type: 'start'; run: number; scene: SceneDocument; from: Snapshot | null }
  // `buffer` is transferred; it comes back, filled, with the frame.
  | { type: 'frame'; run: number; wallSeconds: number; budgetMs: number; tool: Tool; colorBy: ColorBy; buffer: ArrayBuffer }
  | { type: 'step'; count: number }
  | { type: 'set'; name: string; values: number[] }
  | { type: 'reset' };

export type FromWorker =
  | {
      type: 'started';
      run: number;
      particles: number;
      device: string;
      fluidSlots: number;
      dimension: number;
      probes: ProbeInfo[];
    }
  | { type: 'refused'; run: number; status: Status; message: string }
  | {
      type: 'frame';
      run: number;
      steps: number;
      behind: boolean;
      stepCount: number;
      time: number;
      stepMs: number;
      busyMs: number;
      diagnostics: Diagnostics | null;
      clock: Clock | null;
      samples: ProbeSamples[];
      warning: string;
      buffer: ArrayBuffer;
    }
  | { type: 'fault'; run: number; status: Status; message: string };
