// The scene as it is now: the document that the page edits and the engine's own checked copy of it. A change either
// passes all of the engine's checks or changes nothing.
import { withParameters, type ParameterValue, type SceneDocument } from './scene_document.ts';
import type { ParameterInfo, Scene, Weir } from './weir.ts';

// particles: of fluid, without walls and bodies.
export type Derived = { particles: number; stableTimeStep: number; warning: string };

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
  // neighbours per particle and stability stay what they are. Particles fill the fluid's volume exactly as before: the
  // lattice is stretched to whole numbers along each side, which would squeeze them by some percent.
  withParticles(count: number): SceneDocument {
    if (!Number.isFinite(count) || count < 1) throw new Error(`particles: ${count}; must be 1 or more`);
    return this.#filling(this.#about(count));
  }

  // With the spacing that the volume of the present document's fluid gives for the number of particles in `next`.
  #filling(next: SceneDocument): SceneDocument {
    const { dimension } = this.scene;
    const spacing = this.scene.parameter('particle_spacing')[0] ?? 0;
    let document = next;
    for (let round = 0; round < 4; round++) {
      const scene = this.#weir.loadScene(document);
      const factor = (spacing * (this.derived.particles / scene.fluidCount) ** (1 / dimension)) / (scene.parameter('particle_spacing')[0] ?? 0);
      scene.destroy();
      if (!Number.isFinite(factor) || Math.abs(factor - 1) < 1e-5) break;
      document = this.#scaled(document, factor);
    }
    return document;
  }

  #about(count: number): SceneDocument {
    let document = this.document;
    let particles = this.derived.particles;
    // The lattice does not fill a piece of fluid exactly: the second round mends most of it.
    for (let round = 0; round < 3 && particles > 0 && Math.abs(particles / count - 1) > 0.005; round++) {
      const next = this.#scaled(document, (particles / count) ** (1 / this.scene.dimension));
      const scene = this.#weir.loadScene(next);
      const made = scene.fluidCount;
      if (made === 0) {
        // Let the engine say why, through check().
        scene.destroy();
        return next;
      }
      scene.destroy();
      if (round > 0 && Math.abs(made / count - 1) >= Math.abs(particles / count - 1)) break;
      document = next;
      particles = made;
    }
    return document;
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
