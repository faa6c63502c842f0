// The last resort: particles on a 2D canvas, as sprites drawn once per colour and size.
import type { PointsFrame, PointsRenderer } from './points.ts';
import type { View } from './weir.ts';

const bins = 64;

export class CanvasPoints implements PointsRenderer {
  readonly name = 'Canvas';
  readonly #canvas: HTMLCanvasElement;
  readonly #context: CanvasRenderingContext2D;
  readonly #colorMaps: Uint8Array;
  #sprites: HTMLCanvasElement | null = null; // all colours side by side
  #spriteKey = '';
  #spriteSize = 1;

  constructor(canvas: HTMLCanvasElement, colorMaps: Uint8Array) {
    const context = canvas.getContext('2d', { alpha: false });
    if (!context) throw new Error('This browser gives no canvas to draw on: neither WebGPU, WebGL2 nor 2D.');
    this.#canvas = canvas;
    this.#context = context;
    this.#colorMaps = colorMaps;
  }

  #makeSprites(view: View): HTMLCanvasElement {
    const radius = Math.max(view.particleRadius * view.pixelsPerMeter, 0.7);
    const key = `${view.colorBy} ${radius}`;
    if (this.#sprites && key === this.#spriteKey) return this.#sprites;
    const size = 2 * Math.ceil(radius + 1);
    const sheet = document.createElement('canvas');
    sheet.width = size * bins;
    sheet.height = size;
    const context = sheet.getContext('2d');
    if (!context) return sheet;
    for (let bin = 0; bin < bins; bin++) {
      const at = 3 * (256 * view.colorBy + Math.round((bin * 255) / (bins - 1)));
      context.fillStyle = `rgb(${this.#colorMaps[at]},${this.#colorMaps[at + 1]},${this.#colorMaps[at + 2]})`;
      context.beginPath();
      context.arc(size * (bin + 0.5), size / 2, radius, 0, 2 * Math.PI);
      context.fill();
    }
    this.#sprites = sheet;
    this.#spriteKey = key;
    this.#spriteSize = size;
    return sheet;
  }

  draw(frame: PointsFrame, view: View): void {
    const context = this.#context;
    const { width, height } = this.#canvas;
    context.fillStyle = '#070b14';
    context.fillRect(0, 0, width, height);
    this.#drawDomain(frame, view);
    const sprites = this.#makeSprites(view);
    const size = this.#spriteSize;
    const { values, count, restDensity } = frame;
    const scale = view.pixelsPerMeter;
    const colorScale = (bins - 1) / (view.colorMax - view.colorMin || 1);
    for (let i = 0; i < count; i++) {
      let value = values[4 * count + i] as number;
      if (view.colorBy === 0) value = Math.hypot(values[2 * (count + i)] as number, values[2 * (count + i) + 1] as number);
      if (view.colorBy === 2) value = (value - restDensity) / restDensity;
      const bin = Math.round(Math.min(Math.max((value - view.colorMin) * colorScale, 0), bins - 1));
      const x = ((values[2 * i] as number) - view.center[0]) * scale + width / 2 - size / 2;
      const y = height / 2 - ((values[2 * i + 1] as number) - view.center[1]) * scale - size / 2;
      context.drawImage(sprites, bin * size, 0, size, size, x, y, size, size);
    }
    this.#drawRing(view);
  }

  #drawDomain(frame: PointsFrame, view: View): void {
    const context = this.#context;
    const scale = view.pixelsPerMeter;
    const radius = view.particleRadius * scale;
    const [x0 = 0, y0 = 0] = frame.domainMin;
    const [x1 = 0, y1 = 0] = frame.domainMax;
    const left = (x0 - view.center[0]) * scale + this.#canvas.width / 2 - radius;
    const top = this.#canvas.height / 2 - (y1 - view.center[1]) * scale - radius;
    context.fillStyle = '#0a1324';
    context.fillRect(left, top, (x1 - x0) * scale + 2 * radius, (y1 - y0) * scale + 2 * radius);
    context.strokeStyle = 'rgba(97,168,242,0.75)';
    context.lineWidth = 1.25;
    context.strokeRect(left, top, (x1 - x0) * scale + 2 * radius, (y1 - y0) * scale + 2 * radius);
  }

  #drawRing(view: View): void {
    if (view.toolRadius <= 0) return;
    const context = this.#context;
    const scale = view.pixelsPerMeter;
    context.strokeStyle = `rgba(158,230,255,${0.55 + 0.4 * view.toolPressed})`;
    context.lineWidth = 1.5;
    context.beginPath();
    const x = (view.toolPosition[0] - view.center[0]) * scale + this.#canvas.width / 2;
    const y = this.#canvas.height / 2 - (view.toolPosition[1] - view.center[1]) * scale;
    context.arc(x, y, view.toolRadius * scale, 0, 2 * Math.PI);
    context.stroke();
  }

  destroy(): void {
    this.#sprites = null;
  }
}
