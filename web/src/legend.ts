// The colour map with its quantity, unit and range; and the range that suits a scene.
import { formatNumber, niceCeil } from './format.ts';
import type { SceneDocument } from './scene_document.ts';
import { ColorBy, type Scene, type View, type Weir } from './weir.ts';

export const colorNames: Record<string, ColorBy> = {
  speed: ColorBy.speed,
  density: ColorBy.density,
  'density error': ColorBy.densityError,
  pressure: ColorBy.pressure,
};

const captions: Record<ColorBy, string> = {
  [ColorBy.speed]: 'Speed, m/s',
  [ColorBy.density]: 'Density, kg/m³',
  [ColorBy.densityError]: 'Density error, %',
  [ColorBy.pressure]: 'Pressure, kPa',
};

const size = (vector: unknown): number => (Array.isArray(vector) ? Math.hypot(...vector.filter(Number.isFinite)) : 0);

// The largest speed that the document itself names: of fluid thrown (which gets faster where its way is narrow), moving
// walls, emitters. A sliding surface drags most of the fluid along at less than half its speed.
function namedSpeed(document: SceneDocument): number {
  const fluid = (document.fluid ?? []).map((piece) => Math.max(1.4 * size(piece.velocity), piece.flow === 'taylor_green' ? (piece.flow_rate ?? 0) : 0));
  const walls = (document.walls ?? []).map((wall) => Math.max(0.5 * size(wall.surface_velocity), size(wall.motion?.velocity)));
  const emitters = (document.emitters ?? []).map((emitter) => emitter.speed ?? 0);
  return Math.max(0, ...fluid, ...walls, ...emitters);
}

// Of the highest fluid over the floor: a dam break's front comes to 2 sqrt(g H) (Ritter).
function fluidHeight(document: SceneDocument, floor: number): number {
  const tops = (document.fluid ?? []).map(({ box }) => (box?.max?.[1] ?? floor) - floor);
  return Math.max(0, ...tops);
}

const speedSteps = [1, 1.5, 2, 3, 4, 5, 6, 8]; // whole numbers in the middle of the legend, or halves

// Sets colorMin and colorMax from what the scene can be expected to do.
export function chooseRange(view: View, scene: Scene, document: SceneDocument): void {
  const { min, max } = scene.domain;
  const wcsph = scene.method === 'wcsph';
  const height = Math.max((max[1] ?? 1) - (min[1] ?? 0), 1e-9);
  const gravity = Math.hypot(...scene.parameter('gravity'));
  const restDensity = scene.parameter('rest_density')[0] ?? 1000;
  const stiffness = wcsph ? 0 : (scene.parameter('gas_constant')[0] ?? 2000);
  const named = namedSpeed(document);
  const fall = Math.sqrt(2 * gravity * height);
  view.colorMin = 0;
  const front = wcsph ? 2 * Math.sqrt(gravity * fluidHeight(document, min[1] ?? 0)) : 0;
  if (view.colorBy === ColorBy.speed) {
    view.colorMax = niceCeil(Math.max((wcsph ? 0.7 : 0.55) * fall, 0.8 * front, named, 0.1), speedSteps);
  }
  if (view.colorBy === ColorBy.density) {
    view.colorMin = (wcsph ? 0.98 : 0.9) * restDensity;
    view.colorMax = (wcsph ? 1.02 : 1.1) * restDensity;
  }
  if (view.colorBy === ColorBy.densityError) {
    view.colorMax = wcsph ? 0.02 : 0.1;
    view.colorMin = -view.colorMax;
  }
  if (view.colorBy === ColorBy.pressure) {
    view.colorMin = wcsph ? (scene.parameter('background_pressure')[0] ?? 0) : 0;
    const range = restDensity * Math.max(gravity * height, 0.5 * named * named, 0.002 * stiffness);
    view.colorMax = view.colorMin + niceCeil(Math.max(range, 1));
  }
}

export class Legend {
  readonly #name: HTMLElement;
  readonly #ticks: HTMLElement[];
  readonly #map: HTMLCanvasElement;

  constructor(root: HTMLElement) {
    this.#name = root.querySelector('#legend-name') as HTMLElement;
    this.#map = root.querySelector('canvas') as HTMLCanvasElement;
    this.#ticks = [...root.querySelectorAll<HTMLElement>('#legend-ticks span')];
  }

  update(weir: Weir, view: View): void {
    this.#name.textContent = captions[view.colorBy];
    const scale = view.colorBy === ColorBy.densityError ? 100 : view.colorBy === ColorBy.pressure ? 1e-3 : 1;
    const values = [view.colorMin, (view.colorMin + view.colorMax) / 2, view.colorMax];
    this.#ticks.forEach((tick, k) => (tick.textContent = formatNumber((values[k] ?? 0) * scale)));
    const colors = weir.colorMap(view.colorBy);
    const context = this.#map.getContext('2d');
    const image = context?.createImageData(256, 1);
    if (!context || !image) return;
    for (let n = 0; n < 256; n++) {
      for (let k = 0; k < 3; k++) image.data[4 * n + k] = colors[3 * n + k] ?? 0;
      image.data[4 * n + 3] = 255;
    }
    context.putImageData(image, 0, 0);
  }
}
