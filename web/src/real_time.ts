// What of a scene a graphics card shows in real time: water or plain particles, and how many of them. Measured in the first
// seconds of a run, kept for the next visit. So a page shows slow motion for a moment once, and not at all when it comes back.
// Beside it, how many threads keep the card busy.

import type { KnownDevice } from './weir.ts';

const settleMs = 1200; // of a run, in which the pace finds its steps
const windowMs = 2000;
const slowMotion = 0.7; // of real time; below, fewer particles are better
const aim = 0.95;
const growth = 1.15; // what held real time is given so much more at the next visit

// The number of particles that runs in real time if `particles` run at `factor` of it: the time of a step goes with their
// number, its length with their distance. Two digits.
export function particlesInRealTime(particles: number, factor: number, dimension: number): number {
  const wanted = particles * (factor / aim) ** (dimension / (dimension + 1));
  const unit = 10 ** Math.max(Math.floor(Math.log10(Math.max(wanted, 1))) - 1, 0);
  return Math.floor(wanted / unit) * unit;
}

// Whether the steps of a frame would leave time for drawing: if a run is slow all the same, drawing is what takes too long.
// Lengths and times of steps in ms.
export const stepsFit = (timeStep: number, stepMs: number, intervalMs: number): boolean =>
  timeStep > 0 && stepMs > 0 && (intervalMs / timeStep) * stepMs < 0.6 * intervalMs;

export const isSlowMotion = (factor: number): boolean => factor < slowMotion;

// Measures the real-time factor of a run once, when the run has settled.
export class RunRate {
  #began = 0;
  #from: { now: number; time: number } | null = null;
  #done = false;

  // A run starts, or what was measured of it so far does not count.
  restart(now: number): void {
    this.#began = now;
    this.#from = null;
    this.#done = false;
  }

  // Once per frame, with the simulated time; null but for the one time when the factor is known.
  update(now: number, time: number): number | null {
    if (this.#done || now - this.#began < settleMs) return null;
    if (!this.#from || time < this.#from.time) this.#from = { now, time };
    const wall = now - this.#from.now;
    if (wall < windowMs) return null;
    this.#done = true;
    return (1000 * (time - this.#from.time)) / wall;
  }
}

type Store = Pick<Storage, 'getItem' | 'setItem'>;

// What is known of cards: numbers of particles by scene, which ones are too slow for water, and what was measured of the last one.
export class KnownCards {
  readonly #store: Store | null;

  constructor(store: Store | null) {
    this.#store = store;
  }

  // 0: nothing is known.
  recall(card: string, scene: string): number {
    const known = Number(this.#read(particlesKey(card, scene)));
    return Number.isFinite(known) && known >= 1 ? known : 0;
  }

  // The card of the last visit, as it was measured then.
  device(): KnownDevice {
    const [parallelism = '', device = ''] = this.#read(deviceKey).split(/ (.*)/s);
    const threads = Number(parallelism);
    return Number.isInteger(threads) && threads > 0 ? { device, parallelism: threads } : { device: '', parallelism: 0 };
  }
  noteDevice({ device, parallelism }: KnownDevice): void {
    this.#keep(deviceKey, `${parallelism} ${device}`);
  }

  drawsWater(card: string): boolean {
    return this.#read(plainKey(card)) === '';
  }
  noteTooSlowForWater(card: string): void {
    this.#keep(plainKey(card), 'too slow');
  }

  // That many ran at `factor` of real time. Gives the number to run instead, 0 for none.
  note(card: string, scene: string, particles: number, factor: number, dimension: number): number {
    const fewer = isSlowMotion(factor) ? Math.max(particlesInRealTime(particles, factor, dimension), 1) : 0;
    const known = this.recall(card, scene);
    const more = known > 0 && factor > aim ? Math.round(growth * Math.max(known, particles)) : 0;
    if (fewer > 0 || more > 0) this.#keep(particlesKey(card, scene), String(fewer || more));
    return fewer;
  }

  #read(name: string): string {
    try {
      return this.#store?.getItem(name) ?? '';
    } catch {
      return '';
    }
  }

  #keep(name: string, value: string): void {
    try {
      this.#store?.setItem(name, value);
    } catch {
      // A full or forbidden store: measured anew at the next visit.
    }
  }
}

const particlesKey = (card: string, scene: string): string => `weir.particles ${scene} ${card}`;
const deviceKey = 'weir.device';
const plainKey = (card: string): string => `weir.water ${card}`;

// null where a page may keep nothing.
export function pageStore(): Store | null {
  try {
    return window.localStorage;
  } catch {
    return null;
  }
}
