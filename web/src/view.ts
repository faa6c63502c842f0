// What of the domain is seen: it is fitted into the window, beside the panel where there is room.
import { ColorBy, type View } from './weir.ts';

export type Insets = { left: number; right: number; top: number; bottom: number }; // CSS pixels
export type Domain = { min: readonly number[]; max: readonly number[] };

export class Camera {
  readonly view: View = {
    colorBy: ColorBy.speed,
    colorMin: 0,
    colorMax: 1,
    center: [0, 0],
    pixelsPerMeter: 100,
    particleRadius: 0.005,
    toolPosition: [0, 0],
    toolRadius: 0,
    toolPressed: 0,
  };
  width = 1; // device pixels
  height = 1;
  pixelRatio = 1;
  domain: Domain = { min: [-1, -1], max: [1, 1] };

  // The largest scale that fits; the domain stays in the window's middle unless the right inset is in its way.
  fit(insets: Insets): void {
    const { min, max } = this.domain;
    const [x0, y0, x1, y1] = [min[0] ?? 0, min[1] ?? 0, max[0] ?? 1, max[1] ?? 1];
    const ratio = this.pixelRatio;
    const left = insets.left * ratio;
    const right = this.width - insets.right * ratio;
    const top = insets.top * ratio;
    const bottom = this.height - insets.bottom * ratio;
    const scale = Math.max(Math.min((right - left) / (x1 - x0), (bottom - top) / (y1 - y0)), 1e-3);
    const half = (scale * (x1 - x0)) / 2;
    const middle = Math.max(Math.min(this.width / 2, right - half), left + half);
    this.view.pixelsPerMeter = scale;
    this.view.center[0] = (x0 + x1) / 2 + (this.width / 2 - middle) / scale;
    this.view.center[1] = (y0 + y1) / 2 + ((top + bottom) / 2 - this.height / 2) / scale;
  }

  // Metres to CSS pixels of the window.
  toClientX(x: number): number {
    return ((x - this.view.center[0]) * this.view.pixelsPerMeter + this.width / 2) / this.pixelRatio;
  }

  // CSS pixels of the window to metres.
  toX(clientX: number): number {
    return this.view.center[0] + (clientX * this.pixelRatio - this.width / 2) / this.view.pixelsPerMeter;
  }
  toY(clientY: number): number {
    return this.view.center[1] - (clientY * this.pixelRatio - this.height / 2) / this.view.pixelsPerMeter;
  }
}

// Calls back with the size in device pixels, exact where the browser knows it.
export function watchSize(element: HTMLElement, changed: (width: number, height: number, ratio: number) => void): void {
  const report = (entry?: ResizeObserverEntry): void => {
    const box = entry?.devicePixelContentBoxSize?.[0];
    const width = pixels(element.clientWidth, box?.inlineSize);
    changed(width, pixels(element.clientHeight, box?.blockSize), width / Math.max(element.clientWidth, 1));
  };
  const observer = new ResizeObserver((entries) => report(entries[0]));
  try {
    observer.observe(element, { box: 'device-pixel-content-box' });
  } catch {
    observer.observe(element); // Safari
  }
  addEventListener('resize', () => report()); // a window moved to a screen of another density
  report();
}

// The exact size repairs the rounding of the computed one; it is no use where it knows nothing of the pixel ratio
// (emulated screens).
function pixels(cssPixels: number, exact: number | undefined): number {
  const computed = Math.max(Math.round(cssPixels * devicePixelRatio), 1);
  return exact !== undefined && Math.abs(exact - computed) <= 2 ? Math.max(exact, 1) : computed;
}
