// A small live plot: kinetic, potential and total energy, and the density error, over the last 20 seconds.
import { prepareCanvas } from './chart.ts';
import { formatNumber, niceCeil } from './format.ts';
import type { Diagnostics } from './weir.ts';

const seconds = 20;
const capacity = 512;
const series = [
  { label: 'total', color: '#e8f1ff' },
  { label: 'potential', color: '#5aa2ff' },
  { label: 'kinetic', color: '#4fe0c8' },
] as const;
const errorColor = '#ffb454';

export class Plot {
  readonly #canvas: HTMLCanvasElement;
  readonly #context: CanvasRenderingContext2D | null;
  // Ring buffers: wall time, then total, potential, kinetic energy, density error in percent.
  readonly #times = new Float64Array(capacity);
  readonly #values = [0, 1, 2, 3].map(() => new Float64Array(capacity));
  #count = 0;
  #energyTop = 1;
  #energyLow = 0;
  #errorTop = 1;
  visible = true;
  unit = 'J/m'; // of the energies; J in 3D

  constructor(canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
    this.#context = canvas.getContext('2d');
  }

  show(visible: boolean): void {
    this.visible = visible;
    this.#canvas.classList.toggle('hidden', !visible);
  }

  clear(): void {
    this.#count = 0;
  }

  add(now: number, diagnostics: Diagnostics): void {
    const slot = this.#count++ % capacity;
    const { kineticEnergy, potentialEnergy } = diagnostics;
    this.#times[slot] = now / 1000;
    const samples = [kineticEnergy + potentialEnergy, potentialEnergy, kineticEnergy, 100 * diagnostics.densityErrorMean];
    samples.forEach((value, k) => {
      const ring = this.#values[k];
      if (ring) ring[slot] = Number.isFinite(value) ? value : 0;
    });
    if (this.visible) this.#draw(now / 1000);
  }

  #range(): void {
    let [top, low, error] = [0, 0, 0];
    const begin = Math.max(0, this.#count - capacity);
    const newest = this.#times[(this.#count - 1) % capacity] ?? 0;
    for (let n = begin; n < this.#count; n++) {
      const slot = n % capacity;
      if (newest - (this.#times[slot] ?? 0) > seconds) continue;
      for (let k = 0; k < 3; k++) {
        top = Math.max(top, this.#values[k]?.[slot] ?? 0);
        low = Math.min(low, this.#values[k]?.[slot] ?? 0);
      }
      error = Math.max(error, this.#values[3]?.[slot] ?? 0);
    }
    this.#energyTop = niceCeil(top * 1.02);
    this.#energyLow = low < 0 ? -niceCeil(-low) : 0;
    this.#errorTop = niceCeil(Math.max(error, 0.1));
  }

  #draw(now: number): void {
    const context = this.#context;
    if (!context || this.#count < 2) return;
    const prepared = prepareCanvas(this.#canvas);
    if (!prepared) return;
    const { width, height } = prepared;
    this.#range();
    const energy = { left: 0, top: 18, width, height: height - 84 };
    const error = { left: 0, top: height - 46, width, height: 44 };
    this.#caption(context, 'Energy', `${formatNumber(this.#energyTop)} ${this.unit}`, 11, width);
    series.forEach((item, k) => this.#curve(context, k, item.color, now, energy, this.#energyLow, this.#energyTop));
    let x = 52;
    for (const item of series) {
      context.fillStyle = item.color;
      context.fillText(item.label, x, 11);
      x += context.measureText(item.label).width + 10;
    }
    this.#caption(context, 'Density error, mean', `${formatNumber(this.#errorTop)} %`, height - 52, width);
    this.#curve(context, 3, errorColor, now, error, 0, this.#errorTop);
  }

  #caption(context: CanvasRenderingContext2D, left: string, right: string, y: number, width: number): void {
    context.fillStyle = '#8296b4';
    context.textAlign = 'left';
    context.fillText(left, 0, y);
    context.textAlign = 'right';
    context.fillText(right, width, y);
    context.textAlign = 'left';
  }

  #curve(
    context: CanvasRenderingContext2D, k: number, color: string, now: number,
    box: { left: number; top: number; width: number; height: number }, low: number, top: number,
  ): void {
    const ring = this.#values[k];
    if (!ring) return;
    const zero = box.top + box.height * (1 - (0 - low) / (top - low));
    context.strokeStyle = 'rgba(120,160,215,0.22)';
    context.lineWidth = 1;
    context.strokeRect(box.left, zero, box.width, 0);
    context.strokeStyle = color;
    context.lineWidth = 1.5;
    context.lineJoin = 'round';
    context.beginPath();
    for (let n = Math.max(0, this.#count - capacity); n < this.#count; n++) {
      const age = now - (this.#times[n % capacity] ?? 0);
      if (age > seconds) continue;
      const share = ((ring[n % capacity] ?? 0) - low) / (top - low);
      context.lineTo(box.left + box.width * (1 - age / seconds), box.top + box.height * (1 - share));
    }
    context.stroke();
  }
}
