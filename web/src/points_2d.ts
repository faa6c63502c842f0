// The last resort: particles on a 2D canvas, as sprites drawn once per colour and size. In 3D the farthest come first.
import type { PointsFrame, PointsRenderer } from './points.ts';
import { cameraAxes, dot, along } from './view.ts';
import type { Triple, View } from './weir.ts';

const bins = 64; // of a colour map
const looks = ['#57667f', '#eda85c', '#e07861', '#99b875', '#c78cb2']; // wall, bodies in turn
const sizes = 24; // of sprites in 3D, each larger than the one before by sizeStep
const sizeStep = 1.22;
const depthBins = 2048; // of the order from far to near

type Sheet = { image: HTMLCanvasElement; size: number };

export class CanvasPoints implements PointsRenderer {
  readonly name = 'Canvas';
  readonly #canvas: HTMLCanvasElement;
  readonly #context: CanvasRenderingContext2D;
  readonly #colorMaps: Uint8Array;
  readonly #sheets = new Map<string, Sheet>(); // all colours side by side
  #order = new Uint32Array(0);
  readonly #starts = new Uint32Array(depthBins + 1);

  constructor(canvas: HTMLCanvasElement, colorMaps: Uint8Array) {
    const context = canvas.getContext('2d', { alpha: false });
    if (!context) throw new Error('This browser gives no canvas to draw on: neither WebGPU, WebGL2 nor 2D.');
    this.#canvas = canvas;
    this.#context = context;
    this.#colorMaps = colorMaps;
  }

  #sheet(colorBy: number, radius: number, shaded: boolean): Sheet {
    const key = `${colorBy} ${radius.toFixed(2)} ${shaded}`;
    const known = this.#sheets.get(key);
    if (known) return known;
    if (this.#sheets.size > 4 * sizes) this.#sheets.clear();
    const size = 2 * Math.ceil(radius + 1);
    const image = document.createElement('canvas');
    image.width = size * (bins + looks.length);
    image.height = size;
    const context = image.getContext('2d');
    for (let bin = 0; context && bin < bins + looks.length; bin++) {
      const at = 3 * (256 * colorBy + Math.round((bin * 255) / (bins - 1)));
      const mapped = `rgb(${this.#colorMaps[at]},${this.#colorMaps[at + 1]},${this.#colorMaps[at + 2]})`;
      context.fillStyle = bin < bins ? mapped : (looks[bin - bins] ?? mapped);
      const x = size * (bin + 0.5);
      context.beginPath();
      context.arc(x, size / 2, radius, 0, 2 * Math.PI);
      context.fill();
      if (!shaded) continue;
      const light = context.createRadialGradient(x - 0.35 * radius, 0.5 * size - 0.45 * radius, 0, x, size / 2, radius);
      light.addColorStop(0, 'rgba(255,255,255,0.35)');
      light.addColorStop(0.5, 'rgba(0,0,0,0.05)');
      light.addColorStop(1, 'rgba(0,0,12,0.5)');
      context.fillStyle = light;
      context.fill();
    }
    const sheet = { image, size };
    this.#sheets.set(key, sheet);
    return sheet;
  }

  // Which sprite of a sheet a particle gets; -1: it is not drawn.
  #binOf(frame: PointsFrame, view: View, i: number): number {
    const { values, count, restDensity, dimension } = frame;
    const look = values[(2 * dimension + 1) * count + i] as number;
    if (look < 0) return -1;
    if (look > 0) return bins + (look === 1 ? 0 : 1 + ((look - 2) % (looks.length - 1)));
    let value = values[2 * dimension * count + i] as number;
    if (view.colorBy === 0) {
      const at = dimension * (count + i);
      value = Math.hypot(values[at] as number, values[at + 1] as number, dimension === 3 ? (values[at + 2] as number) : 0);
    }
    if (view.colorBy === 2) value = (value - restDensity) / restDensity;
    const share = (value - view.colorMin) / (view.colorMax - view.colorMin || 1);
    return Math.round(Math.min(Math.max(share, 0), 1) * (bins - 1));
  }

  draw(frame: PointsFrame, view: View): void {
    const { width, height } = this.#canvas;
    this.#context.fillStyle = '#070b14';
    this.#context.fillRect(0, 0, width, height);
    if (frame.dimension === 3) this.#drawSpace(frame, view);
    else this.#drawFlat(frame, view);
  }

  #drawFlat(frame: PointsFrame, view: View): void {
    const { width, height } = this.#canvas;
    this.#drawDomain(frame, view);
    const scale = view.pixelsPerMeter;
    const { image, size } = this.#sheet(view.colorBy, Math.max(view.particleRadius * scale, 0.7), false);
    const { values, count } = frame;
    for (let i = 0; i < count; i++) {
      const bin = this.#binOf(frame, view, i);
      if (bin < 0) continue;
      const x = ((values[2 * i] as number) - view.center[0]) * scale + width / 2 - size / 2;
      const y = height / 2 - ((values[2 * i + 1] as number) - view.center[1]) * scale - size / 2;
      this.#context.drawImage(image, bin * size, 0, size, size, x, y, size, size);
    }
    const x = (view.toolPosition[0] - view.center[0]) * scale + width / 2;
    const y = height / 2 - (view.toolPosition[1] - view.center[1]) * scale;
    this.#drawRing(view, x, y, view.toolRadius * scale);
  }

  #drawDomain(frame: PointsFrame, view: View): void {
    const context = this.#context;
    const scale = view.pixelsPerMeter;
    const radius = Math.max(view.particleRadius - frame.border, 0) * scale;
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

  // Counting sort by distance ahead, farthest first. Particles that are not seen are left out.
  #sort(count: number, near: number, depthOf: (i: number) => number): number {
    if (this.#order.length !== count) this.#order = new Uint32Array(count);
    let [least, most] = [Infinity, near];
    for (let i = 0; i < count; i++) {
      const depth = depthOf(i);
      if (depth > near && depth < least) least = depth;
      if (depth > most) most = depth;
    }
    const starts = this.#starts.fill(0);
    const scale = (depthBins - 1) / Math.max(most - least, 1e-9);
    for (let i = 0; i < count; i++) if (depthOf(i) > near) starts[Math.floor((most - depthOf(i)) * scale) + 1]!++;
    for (let k = 0; k < depthBins; k++) starts[k + 1]! += starts[k]!;
    const shown = starts[depthBins]!;
    for (let i = 0; i < count; i++) {
      if (depthOf(i) > near) this.#order[starts[Math.floor((most - depthOf(i)) * scale)]!++] = i;
    }
    return shown;
  }

  #drawSpace(frame: PointsFrame, view: View): void {
    const context = this.#context;
    const { width, height } = this.#canvas;
    const { camera } = view;
    const { eye, right, up, ahead, focal, near } = cameraAxes(camera, width, height);
    const { values } = frame;
    const offset = dot(eye, ahead);
    const depthOf = (i: number): number =>
      (values[3 * i] as number) * ahead[0] + (values[3 * i + 1] as number) * ahead[1] + (values[3 * i + 2] as number) * ahead[2] - offset;
    const toPixel = (point: Triple): [number, number, number] => {
      const place = along(point, eye, -1);
      const z = dot(place, ahead);
      const x = (focal[0] * dot(place, right)) / z + camera.shift[0];
      const y = (focal[1] * dot(place, up)) / z + camera.shift[1];
      return [((x + 1) * width) / 2, ((1 - y) * height) / 2, z];
    };
    this.#drawEdges(frame, near, toPixel);
    const shown = this.#sort(frame.count, near, depthOf);
    const radiusScale = (view.particleRadius * focal[1] * height) / 2;
    for (let k = 0; k < shown; k++) {
      const i = this.#order[k] as number;
      const bin = this.#binOf(frame, view, i);
      if (bin < 0) continue;
      const [x, y, z] = toPixel([values[3 * i] as number, values[3 * i + 1] as number, values[3 * i + 2] as number]);
      const step = Math.round(Math.log(Math.max(radiusScale / z, 0.7) / 0.7) / Math.log(sizeStep));
      const { image, size } = this.#sheet(view.colorBy, 0.7 * sizeStep ** Math.min(step, sizes), true);
      context.drawImage(image, bin * size, 0, size, size, x - size / 2, y - size / 2, size, size);
    }
    const [x, y, z] = toPixel(view.toolPosition);
    if (z > near) this.#drawRing(view, x, y, (view.toolRadius * focal[1] * height) / (2 * z));
  }

  #drawEdges(frame: PointsFrame, near: number, toPixel: (point: Triple) => [number, number, number]): void {
    const context = this.#context;
    const place = (corner: number): Triple =>
      [0, 1, 2].map((k) => ((corner >> k) & 1 ? (frame.domainMax[k] ?? 0) : (frame.domainMin[k] ?? 0))) as Triple;
    context.strokeStyle = 'rgba(97,168,242,0.6)';
    context.lineWidth = 1.25;
    context.beginPath();
    for (let corner = 0; corner < 8; corner++) {
      for (let axis = 0; axis < 3; axis++) {
        if ((corner >> axis) & 1) continue;
        const [x0, y0, z0] = toPixel(place(corner));
        const [x1, y1, z1] = toPixel(place(corner | (1 << axis)));
        if (z0 < near || z1 < near) continue;
        context.moveTo(x0, y0);
        context.lineTo(x1, y1);
      }
    }
    context.stroke();
  }

  #drawRing(view: View, x: number, y: number, radius: number): void {
    if (radius <= 0) return;
    const context = this.#context;
    context.strokeStyle = `rgba(158,230,255,${0.55 + 0.4 * view.toolPressed})`;
    context.lineWidth = 1.5;
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.stroke();
  }

  destroy(): void {
    this.#sheets.clear();
  }
}
