// Probes of a scene: numbers sampled while a simulation runs. ProbeReader asks the engine for them; ProbeSeries is what
// the page keeps and draws, wherever the simulation runs.
import { Status, WeirError, type Context, type Sim } from './weir.ts';

export type ProbeInfo = { name: string; kind: string; unit: string; components: number };
// New samples of one probe: `components` values each.
export type ProbeSamples = { probe: number; times: number[]; values: number[] };

const mostSamples = 2400; // kept of a probe; beyond, every second one goes

export class ProbeReader {
  readonly infos: ProbeInfo[];
  readonly #context: Context;
  readonly #sim: Sim;
  readonly #pointer: number;
  readonly #taken: number[];

  constructor(sim: Sim) {
    const { memory, c } = (this.#context = sim.context);
    this.#sim = sim;
    this.#pointer = c.weir_probes_create(sim.pointer);
    const count = this.#pointer ? c.weir_probes_count(this.#pointer) : 0;
    this.infos = Array.from({ length: count }, (_, probe) => memory.scratch(40, (at) => {
      c.weir_web_probe_info(this.#pointer, probe, at);
      const [name = 0, kind = 0, unit = 0, components = 1] = memory.doubles(at, 4);
      return { name: memory.text(name), kind: memory.text(kind), unit: memory.text(unit), components };
    }));
    this.#taken = this.infos.map(() => 0);
  }

  // Samples what is due; null while the device copies.
  update(): ProbeSamples[] | null {
    if (this.infos.length === 0) return [];
    const status = this.#context.c.weir_probes_update(this.#pointer, this.#sim.pointer);
    if (status === Status.pending) return null;
    if (status !== Status.ok) throw new WeirError(status, this.#sim.error);
    return this.infos.map((_, probe) => this.#new(probe)).filter((samples) => samples.times.length > 0);
  }

  #new(probe: number): ProbeSamples {
    const { memory, c } = this.#context;
    return memory.scratch(24, (at) => {
      c.weir_web_probe_series(this.#pointer, probe, at);
      const [count = 0, times = 0, values = 0] = memory.doubles(at, 3);
      const first = this.#taken[probe] ?? 0;
      const components = this.infos[probe]?.components ?? 1;
      this.#taken[probe] = count;
      return {
        probe, times: [...memory.doubles(times + 8 * first, count - first)],
        values: [...memory.doubles(values + 8 * components * first, components * (count - first))],
      };
    });
  }

  clear(): void {
    if (this.#pointer) this.#context.c.weir_probes_clear(this.#pointer);
    this.#taken.fill(0);
  }

  destroy(): void {
    if (this.#pointer) this.#context.c.weir_probes_destroy(this.#pointer);
  }
}

export class ProbeSeries {
  readonly info: ProbeInfo;
  times: number[] = [];
  values: number[][]; // one list per component
  version = 0; // rises with each change

  constructor(info: ProbeInfo) {
    this.info = info;
    this.values = Array.from({ length: info.components }, () => []);
  }

  add(samples: ProbeSamples): void {
    const { components } = this.info;
    samples.times.forEach((time, n) => {
      this.times.push(time);
      for (let k = 0; k < components; k++) this.values[k]?.push(samples.values[components * n + k] ?? NaN);
    });
    if (this.times.length > mostSamples) {
      const half = <T>(list: T[]): T[] => list.filter((_, n) => n % 2 === 0);
      this.times = half(this.times);
      this.values = this.values.map(half);
    }
    this.version++;
  }

  clear(): void {
    this.times = [];
    this.values = this.values.map(() => []);
    this.version++;
  }
}
