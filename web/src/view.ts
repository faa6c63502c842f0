// What of the domain is seen. 2D: it is fitted into the window, beside the panel where there is room. 3D: a camera that
// turns about a point of the domain.
import { ColorBy, FluidStyle, type CameraPose, type Ray, type Triple, type View } from './weir.ts';

export type Insets = { left: number; right: number; top: number; bottom: number }; // CSS pixels
export type Domain = { min: readonly number[]; max: readonly number[] };

// The camera's place and axes, as weir_view_matrix() has them; a test holds them together.
export type CameraAxes = { eye: Triple; right: Triple; up: Triple; ahead: Triple; focal: [number, number]; near: number };

const homeYaw = 0.56;
const homePitch = 0.35; // the horizon just beyond the upper edge
const fieldOfView = 0.6;
const mostPitch = 1.55;
const leastPitch = -0.2; // a little from below
const turnPerPixel = 0.0065; // rad per CSS pixel

export const dot = (a: Readonly<Triple>, b: Readonly<Triple>): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
// a + factor * b
export const along = (a: Readonly<Triple>, b: Readonly<Triple>, factor: number): Triple =>
  [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];

export function cameraAxes(pose: CameraPose, width: number, height: number): CameraAxes {
  const [sy, cy, sp, cp] = [Math.sin(pose.yaw), Math.cos(pose.yaw), Math.sin(pose.pitch), Math.cos(pose.pitch)];
  const ahead: Triple = [-sy * cp, -sp, -cy * cp];
  const focal = 1 / Math.tan(pose.fieldOfView / 2);
  return {
    eye: along(pose.target, ahead, -pose.distance), right: [cy, 0, -sy], up: [-sy * sp, cp, -cy * sp], ahead,
    focal: [(focal * height) / width, focal], near: 0.02 * pose.distance,
  };
}

export class Camera {
  readonly view: View = {
    colorBy: ColorBy.speed,
    colorMin: 0,
    colorMax: 1,
    particleRadius: 0.005,
    toolPosition: [0, 0, 0],
    toolRadius: 0,
    toolPressed: 0,
    center: [0, 0],
    pixelsPerMeter: 100,
    camera: { target: [0, 0, 0], yaw: homeYaw, pitch: homePitch, distance: 3, fieldOfView, shift: [0, 0] },
    fluidStyle: FluidStyle.water,
  };
  width = 1; // device pixels
  height = 1;
  pixelRatio = 1;
  domain: Domain = { min: [-1, -1], max: [1, 1] };
  dimension = 2;
  #insets: Insets = { left: 0, right: 0, top: 0, bottom: 0 };
  #moved = false; // by the user: a new window size then keeps what is seen
  #reached = false;

  // A scene: what it shows at first is all of it.
  setDomain(domain: Domain, dimension: number): void {
    this.domain = domain;
    this.dimension = dimension;
    this.home();
  }

  fit(insets: Insets): void {
    this.#insets = insets;
    this.#fitFlat();
    this.#fitSpace();
  }

  // The whole domain again.
  home(): void {
    this.#moved = false;
    this.view.camera.yaw = homeYaw;
    this.view.camera.pitch = homePitch;
    this.fit(this.#insets);
  }

  // Whether the domain's outline comes into the window's upper left corner of that size, CSS pixels. A camera that the
  // user has moved keeps its place: then the last answer holds.
  reaches(width: number, height: number): boolean {
    if (this.dimension !== 3) {
      const { center, pixelsPerMeter } = this.view;
      return (((this.domain.min[0] ?? 0) - center[0]) * pixelsPerMeter + this.width / 2) / this.pixelRatio < width;
    }
    if (!this.#moved) this.#reached = this.#edgesReach(width, height);
    return this.#reached;
  }

  #edgesReach(width: number, height: number): boolean {
    const { min, max } = this.domain;
    for (let edge = 0; edge < 12; edge++) {
      const axis = edge >> 2;
      for (let part = 0; part <= 1; part += 1 / 16) {
        const share = [edge & 1, (edge >> 1) & 1];
        share.splice(axis, 0, part);
        const place = [0, 1, 2].map((k) => (min[k] ?? 0) + (share[k] ?? 0) * ((max[k] ?? 0) - (min[k] ?? 0))) as Triple;
        const seen = this.toClient(place);
        if (seen && seen[0] < width && seen[1] < height) return true;
      }
    }
    return false;
  }

  // The free rectangle of the window in device pixels.
  #free(): { left: number; right: number; top: number; bottom: number } {
    const { left, right, top, bottom } = this.#insets;
    const ratio = this.pixelRatio;
    return {
      left: left * ratio, right: this.width - right * ratio, top: top * ratio, bottom: this.height - bottom * ratio,
    };
  }

  // The largest scale that fits; the domain stays in the window's middle unless the right inset is in its way.
  #fitFlat(): void {
    const { min, max } = this.domain;
    const [x0, y0, x1, y1] = [min[0] ?? 0, min[1] ?? 0, max[0] ?? 1, max[1] ?? 1];
    const { left, right, top, bottom } = this.#free();
    const scale = Math.max(Math.min((right - left) / (x1 - x0), (bottom - top) / (y1 - y0)), 1e-3);
    const half = (scale * (x1 - x0)) / 2;
    const middle = Math.max(Math.min(this.width / 2, right - half), left + half);
    this.view.pixelsPerMeter = scale;
    this.view.center[0] = (x0 + x1) / 2 + (this.width / 2 - middle) / scale;
    this.view.center[1] = (y0 + y1) / 2 + ((top + bottom) / 2 - this.height / 2) / scale;
  }

  // The nearest place from which all corners of the domain are seen inside of the free rectangle.
  #fitSpace(): void {
    const pose = this.view.camera;
    const { left, right, top, bottom } = this.#free();
    pose.shift = [(left + right) / this.width - 1, 1 - (top + bottom) / this.height];
    if (this.#moved) return;
    const { min, max } = this.domain;
    pose.target = [0, 1, 2].map((k) => ((min[k] ?? 0) + (max[k] ?? 0)) / 2) as Triple;
    const { right: x, up: y, ahead: z, focal } = cameraAxes(pose, this.width, this.height);
    const room = [Math.max(right - left, 1) / this.width, Math.max(bottom - top, 1) / this.height] as const;
    let distance = 1e-3;
    for (let corner = 0; corner < 8; corner++) {
      const place = [0, 1, 2].map((k) => ((corner >> k) & 1 ? (max[k] ?? 0) : (min[k] ?? 0)) - (pose.target[k] ?? 0)) as Triple;
      const across = (Math.abs(dot(place, x)) * focal[0]) / room[0];
      const above = (Math.abs(dot(place, y)) * focal[1]) / room[1];
      distance = Math.max(distance, Math.max(across, above) - dot(place, z));
    }
    pose.distance = 1.02 * distance;
  }

  // Turns about the target by a drag of so many CSS pixels.
  orbit(dx: number, dy: number): void {
    const pose = this.view.camera;
    this.#moved = true;
    pose.yaw -= turnPerPixel * dx;
    pose.pitch = Math.min(Math.max(pose.pitch + turnPerPixel * dy, leastPitch), mostPitch);
  }

  // Moves what is seen along with a drag of so many CSS pixels.
  pan(dx: number, dy: number): void {
    const pose = this.view.camera;
    this.#moved = true;
    const { right, up, focal } = cameraAxes(pose, this.width, this.height);
    const scale = (2 * this.pixelRatio * pose.distance) / (focal[1] * this.height);
    pose.target = along(along(pose.target, right, -scale * dx), up, scale * dy);
  }

  // Comes nearer by a factor above 1.
  zoom(factor: number): void {
    const { min, max } = this.domain;
    const size = Math.hypot(...[0, 1, 2].map((k) => (max[k] ?? 0) - (min[k] ?? 0)));
    const pose = this.view.camera;
    this.#moved = true;
    pose.distance = Math.min(Math.max(pose.distance / factor, 0.05 * size), 8 * size);
  }

  // The ray through a point of the window in CSS pixels, as weir_view_ray() has it.
  ray(clientX: number, clientY: number): Ray {
    const pose = this.view.camera;
    const { eye, right, up, ahead, focal } = cameraAxes(pose, this.width, this.height);
    const x = ((2 * clientX * this.pixelRatio) / this.width - 1 - pose.shift[0]) / focal[0];
    const y = (1 - (2 * clientY * this.pixelRatio) / this.height - pose.shift[1]) / focal[1];
    const direction = along(along(ahead, right, x), up, y);
    const length = Math.hypot(...direction);
    return { origin: eye, direction: direction.map((part) => part / length) as Triple };
  }

  // Where a point of the domain appears, in CSS pixels; null if it is behind the camera.
  toClient(point: Readonly<Triple>): [number, number] | null {
    const pose = this.view.camera;
    const { eye, right, up, ahead, focal, near } = cameraAxes(pose, this.width, this.height);
    const offset = along(point, eye, -1);
    const z = dot(offset, ahead);
    if (z < near) return null;
    const x = (focal[0] * dot(offset, right)) / z + pose.shift[0];
    const y = (focal[1] * dot(offset, up)) / z + pose.shift[1];
    return [((x + 1) * this.width) / 2 / this.pixelRatio, ((1 - y) * this.height) / 2 / this.pixelRatio];
  }

  // CSS pixels of the window to metres (2D).
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
