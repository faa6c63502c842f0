// The scene as it is now: the document that the page edits and the engine's own checked copy of it. A change either
// passes all of the engine's checks or changes nothing.
import { withParameters, type ParameterValue, type SceneDocument } from './scene_document.ts';
import type { ParameterInfo, Scene, Weir } from './weir.ts';

// particles: of fluid, without walls and bodies.
export type Derived = { particles: number; stableTimeStep: number; warning: string };

type Made = { document: SceneDocument; particles: number; spacing: number };

const manyParticles = 30_000; // so fine that stretching a lattice changes little

export class SceneStore {
  document: SceneDocument;
  scene: Scene;
  derived: Derived;
  readonly #weir: Weir;

  constructor(weir: Weir, document: SceneDocument) {
    this.#weir = weir;
    this.scene = this.#checked(document);
    this.document = document;
    this.derived = derive(this.scene);
  }

  #checked(document: SceneDocument): Scene {
    const scene = this.#weir.loadScene(document);
    try {
      scene.check();
      return scene;
    } catch (error) {
      scene.destroy();
      throw error;
    }
  }

  // Throws WeirError and keeps the last good one if the engine refuses.
  replace(document: SceneDocument): void {
    const scene = this.#checked(document);
    this.scene.destroy();
    this.scene = scene;
    this.document = document;
    this.derived = derive(scene);
  }

  set(name: string, value: ParameterValue): void {
    this.replace(withParameters(this.document, { [name]: value }));
  }

  // The document with about `count` particles: lengths of the discretisation and the time step scale together, so
  // neighbours per particle and stability stay what they are. The engine stretches the lattice of each box to whole
  // numbers along each side, which may squeeze or thin the fluid by several percent: a spacing near by may fit better.
  withParticles(count: number): SceneDocument {
    if (!Number.isFinite(count) || count < 1) throw new Error(`particles: ${count}; must be 1 or more`);
    const about = this.#about(count);
    if (about.particles === 0 || count > manyParticles) return about.document;
    let best = about;
    for (const factor of [0.99, 1.01, 0.98, 1.02, 0.97, 1.03, 0.96, 1.04]) {
      const other = this.#made(this.#scaled(about.document, factor));
      if (this.#misfit(other, count) < this.#misfit(best, count)) best = other;
    }
    const exact = this.#made(this.#scaled(best.document, this.#volume(best) ** (-1 / this.scene.dimension)));
    return this.#misfit(exact, count) < this.#misfit(best, count) ? exact.document : best.document;
  }

  #made(document: SceneDocument): Made {
    const scene = this.#weir.loadScene(document);
    const made = { document, particles: scene.fluidCount, spacing: scene.parameter('particle_spacing')[0] ?? 0 };
    scene.destroy();
    return made;
  }

  // Of its particles, relative to those of the present document.
  #volume({ particles, spacing }: Made): number {
    const now = this.scene.parameter('particle_spacing')[0] ?? 0;
    return (particles / this.derived.particles) * (spacing / now) ** this.scene.dimension;
  }

  #misfit(made: Made, count: number): number {
    return Math.abs(this.#volume(made) - 1) + 0.1 * Math.abs(made.particles / count - 1);
  }

  #about(count: number): Made {
    let best: Made = { document: this.document, particles: this.derived.particles, spacing: this.scene.parameter('particle_spacing')[0] ?? 0 };
    // The lattice does not fill a piece of fluid exactly: the second round mends most of it.
    for (let round = 0; round < 3 && best.particles > 0 && Math.abs(best.particles / count - 1) > 0.005; round++) {
      const next = this.#made(this.#scaled(best.document, (best.particles / count) ** (1 / this.scene.dimension)));
      if (next.particles === 0) return next; // let the engine say why, through check()
      if (round > 0 && Math.abs(next.particles / count - 1) >= Math.abs(best.particles / count - 1)) break;
      best = next;
    }
    return best;
  }

  #scaled(document: SceneDocument, factor: number): SceneDocument {
    const scene = this.#weir.loadScene(document);
    const scaled = (name: string): number => Number(((scene.parameter(name)[0] ?? 0) * factor).toPrecision(6));
    const wasStable = (scene.parameter('time_step')[0] ?? 0) <= scene.stableTimeStep;
    const timeStep = scaled('time_step');
    const changes = {
      particle_spacing: scaled('particle_spacing'),
      support_radius: scaled('support_radius'),
      time_step: timeStep,
    };
    scene.destroy();
    const next = withParameters(document, changes);
    if (!wasStable) return next;
    // The engine rounds its estimate down: a stable step must not become an unstable one by that.
    const check = this.#weir.loadScene(next);
    const stable = check.stableTimeStep;
    check.destroy();
    return withParameters(next, { time_step: Math.min(timeStep, stable) });
  }

  // A parameter's value as the document writes it, in numbers as the engine takes it while running.
  numbers(info: ParameterInfo): number[] {
    const values = this.scene.parameter(info.name);
    return info.kind === 'vector' ? values : values.slice(0, 1);
  }
}

function derive(scene: Scene): Derived {
  return { particles: scene.fluidCount, stableTimeStep: scene.stableTimeStep, warning: scene.warning };
}
