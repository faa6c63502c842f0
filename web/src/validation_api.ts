// Published cases that the engine measures itself by: the typed API over weir_validation.h.
import { OUT_OF_MEMORY, Status, WeirError } from './weir_memory.ts';
import type { Context, Scene, Sim, Weir } from './weir.ts';

export type CaseInfo = { index: number; name: string; title: string; summary: string; source: string };
export const resolutions = ['coarse', 'normal', 'fine'] as const;
export type Resolution = (typeof resolutions)[number];

export type RunInfo = { label: string; sceneText: string; spacing: number; endTime: number; interval: number };

export const enum GateKind { atMost = 0, atLeast = 1, relative = 2, reported = 3 }
export type Gate = {
  name: string; unit: string; kind: GateKind; value: number; reference: number; limit: number; passed: boolean;
};

export type CurveData = {
  plot: string; name: string; xName: string; xUnit: string; yName: string; yUnit: string; isReference: boolean;
  x: number[]; y: number[];
};

const CURVE_TEXT = 320; // bytes; web_validation.c

export function validationCases({ context: { memory, c } }: Weir): CaseInfo[] {
  const text = (index: number, which: number): string => memory.text(c.weir_web_case_text(index, which));
  return Array.from({ length: c.weir_case_count() }, (_, index) => ({
    index, name: text(index, 0), title: text(index, 1), summary: text(index, 2), source: text(index, 3),
  }));
}

export class Validation {
  readonly runs: RunInfo[];
  readonly #context: Context;
  readonly #pointer: number;

  constructor(weir: Weir, caseIndex: number, resolution: Resolution) {
    const { memory, c } = (this.#context = weir.context);
    this.#pointer = c.weir_validation_create(caseIndex, resolutions.indexOf(resolution));
    if (this.#pointer === 0) throw new WeirError(Status.memory, OUT_OF_MEMORY);
    this.runs = Array.from({ length: c.weir_validation_run_count(this.#pointer) }, (_, run) => memory.scratch(24, (at) => {
      c.weir_web_run_numbers(this.#pointer, run, at);
      const [spacing = 0, endTime = 0, interval = 0] = memory.doubles(at, 3);
      const text = (which: number): string => memory.text(c.weir_web_run_text(this.#pointer, run, which));
      return { label: text(0), sceneText: text(1), spacing, endTime, interval };
    }));
  }

  prepare(run: number, scene: Scene): void {
    this.#throwIf(this.#context.c.weir_validation_prepare(this.#pointer, run, scene.pointer));
  }

  // False while the GPU is not done: then it is to be called again.
  begin(run: number, sim: Sim): boolean {
    return this.#isDone(this.#context.c.weir_validation_begin(this.#pointer, run, sim.pointer));
  }

  // Simulates until the next measurement and takes it. False as above.
  advance(sim: Sim): boolean {
    return this.#isDone(this.#context.c.weir_validation_advance(this.#pointer, sim.pointer));
  }

  get runIsDone(): boolean {
    return this.#context.c.weir_validation_run_is_done(this.#pointer) !== 0;
  }

  abandon(message: string): void {
    const { memory, c } = this.#context;
    memory.withText(message, (text) => c.weir_validation_abandon(this.#pointer, text));
  }

  get progress(): number {
    return this.#context.c.weir_validation_progress(this.#pointer);
  }

  get error(): string {
    return this.#context.memory.text(this.#context.c.weir_validation_error(this.#pointer));
  }

  // True if all gates pass.
  judge(): boolean {
    return this.#context.c.weir_validation_judge(this.#pointer) !== 0;
  }

  gates(): Gate[] {
    const { memory, c } = this.#context;
    return Array.from({ length: c.weir_validation_gate_count(this.#pointer) }, (_, index) => memory.scratch(56, (at) => {
      c.weir_web_gate(this.#pointer, index, at);
      const [name = 0, unit = 0, kind = 0, value = NaN, reference = NaN, limit = NaN, passed = 0] = memory.doubles(at, 7);
      return { name: memory.text(name), unit: memory.text(unit), kind, value, reference, limit, passed: passed !== 0 };
    }));
  }

  curves(): CurveData[] {
    const { memory, c } = this.#context;
    return Array.from({ length: c.weir_validation_curve_count(this.#pointer) }, (_, index) => memory.scratch(32 + CURVE_TEXT, (at) => {
      c.weir_web_curve(this.#pointer, index, at + 32, at);
      const [isReference = 0, count = 0, x = 0, y = 0] = memory.doubles(at, 4);
      const [plot = '', name = '', xName = '', xUnit = '', yName = '', yUnit = ''] = memory.text(at + 32).split('\n');
      return {
        plot, name, xName, xUnit, yName, yUnit, isReference: isReference !== 0,
        x: [...memory.doubles(x, count)], y: [...memory.doubles(y, count)],
      };
    }));
  }

  destroy(): void {
    this.#context.c.weir_validation_destroy(this.#pointer);
  }

  #isDone(status: Status): boolean {
    this.#throwIf(status);
    return status === Status.ok;
  }

  #throwIf(status: Status): void {
    if (status !== Status.ok && status !== Status.pending) throw new WeirError(status, this.error);
  }
}
