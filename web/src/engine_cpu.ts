// What the two engines with the C solver share: the canvas, its renderer, and the frame to draw.
import { newStats, type EngineStats, type Snapshot } from './engine.ts';
import { createPointsRenderer, floatsPerParticle, type PointsFrame, type PointsRenderer } from './points.ts';
import type { PickSource } from './pick.ts';
import { ProbeSeries, type ProbeInfo, type ProbeSamples } from './probes.ts';
import type { SceneDocument } from './scene_document.ts';
import { ColorBy, type View, type Weir } from './weir.ts';

export class CpuPicture {
  readonly stats: EngineStats = newStats();
  readonly renderer: PointsRenderer;
  readonly #weir: Weir;
  #fluidSlots = 0;
  readonly #frame: PointsFrame = {
    values: new Float32Array(0), count: 0, changed: false, dimension: 2, domainMin: [0, 0],
    domainMax: [0, 0], border: 0, particleSpacing: 0.01, restDensity: 1000,
  };

  constructor(weir: Weir, canvas: HTMLCanvasElement) {
    this.#weir = weir;
    const maps = new Uint8Array(4 * 768);
    for (const by of [ColorBy.speed, ColorBy.density, ColorBy.densityError, ColorBy.pressure]) {
      maps.set(weir.colorMap(by), 768 * by);
    }
    this.renderer = createPointsRenderer(canvas, maps);
  }

  // Takes over what drawing needs to know of the scene.
  setScene(document: SceneDocument, particles: number, fluidSlots: number, probes: ProbeInfo[]): void {
    const scene = this.#weir.loadScene(document);
    const { min, max } = scene.domain;
    this.#frame.domainMin = min;
    this.#frame.domainMax = max;
    this.#frame.particleSpacing = scene.parameter('particle_spacing')[0] ?? 0.01;
    this.#frame.restDensity = scene.parameter('rest_density')[0] ?? 1000;
    this.#frame.dimension = scene.dimension;
    // mueller's walls hold the particles' centres; wcsph's are where the lattice's half spacing ends.
    this.#frame.border = scene.method === 'wcsph' ? 0.5 * this.#frame.particleSpacing : 0;
    this.#fluidSlots = fluidSlots;
    scene.destroy();
    this.#frame.count = 0;
    this.stats.particles = particles;
    this.stats.diagnostics = null;
    this.stats.clock = null;
    this.stats.probes = probes.map((info) => new ProbeSeries(info));
    this.stats.frameSteps = 0;
  }

  addSamples(samples: ProbeSamples[]): void {
    for (const one of samples) this.stats.probes[one.probe]?.add(one);
  }

  // A new state, laid out as PointsFrame says.
  setValues(values: Float32Array): void {
    this.#frame.values = values;
    this.#frame.count = values.length / floatsPerParticle(this.#frame.dimension);
    this.#frame.changed = true;
    this.stats.frames++;
  }

  draw(view: View): void {
    if (this.#frame.count === 0) return;
    this.renderer.draw(this.#frame, view);
    this.#frame.changed = false;
  }

  snapshot(): Snapshot | null {
    const { values, count, dimension } = this.#frame;
    if (count === 0) return null;
    const { time, steps } = this.stats;
    const vectors = dimension * count;
    return { positions: values.slice(0, vectors), velocities: values.slice(vectors, 2 * vectors), time, steps };
  }

  fluid(): PickSource | null {
    const { values, count, dimension, domainMin: min, domainMax: max, particleSpacing } = this.#frame;
    if (count === 0 || dimension !== 3) return null;
    return { positions: values, count: this.#fluidSlots, radius: 1.2 * particleSpacing, min, max };
  }
}
