// The typed API over weir.wasm: the contract between the page and the engine.
// (Signatures; the bodies follow in the next commits.)

export type ParameterInfo = {
  name: string;
  unit: string;
  help: string;
  kind: 'number' | 'vector' | 'choice';
  choices: string[];
  default: number[];
  minimum: number;
  maximum: number;
  live: boolean;
};

export const enum Status { ok = 0, pending = 1, input = 2, memory = 3, device = 4, unstable = 5, lost = 6 }
export const enum Field { position = 0, velocity = 1, acceleration = 2, density = 3, pressure = 4 }
export const enum ToolKind { none = 0, push = 1, pull = 2, stir = 3 }
export const enum ColorBy { speed = 0, density = 1, densityError = 2, pressure = 3 }

export type Diagnostics = {
  step: number;
  time: number;
  densityErrorMean: number;
  densityErrorMax: number;
  kineticEnergy: number;
  potentialEnergy: number;
  momentum: [number, number, number];
  maxSpeed: number;
  meanNeighbors: number; // negative if not asked for
  lostParticles: number;
  stateHash: string; // 16 hexadecimal digits
};

export type PassTime = { name: string; milliseconds: number };

// What one frame shows; as WeirView in weir/weir_render.h.
export type View = {
  colorBy: ColorBy;
  colorMin: number;
  colorMax: number;
  center: [number, number]; // m
  pixelsPerMeter: number; // device pixels
  particleRadius: number; // m
  toolPosition: [number, number]; // m
  toolRadius: number; // m; 0: no ring
  toolPressed: number; // 0 to 1
};

export declare class WeirError extends Error {
  readonly status: Status;
  constructor(status: Status, message: string);
}

export declare class Weir {
  // A URL or string is fetched; bytes or a compiled module are instantiated. `gpu` null: no WebGPU (Node, tests);
  // left out: navigator.gpu if there is one.
  static load(source: URL | string | BufferSource | WebAssembly.Module, options?: { gpu?: GPU | null }): Promise<Weir>;
  readonly version: string;
  readonly parameters: ParameterInfo[];
  readonly memoryBytes: number; // of the wasm memory
  loadScene(document: unknown): Scene; // throws WeirError
  createGpu(options?: { lowPower?: boolean; timestamps?: boolean }): Gpu; // throws WeirError if memory runs out
  createSim(scene: Scene, options?: { gpu?: Gpu; maxSteps?: number; maxLag?: number }): Sim; // throws WeirError
  createRenderer(gpu: Gpu, canvas: HTMLCanvasElement | OffscreenCanvas): Renderer; // throws WeirError
  colorMap(colorBy: ColorBy): Uint8Array; // 256 * 3 bytes, sRGB
}

export declare class Gpu {
  ready(): Promise<void>; // throws WeirError
  poll(): Status;
  readonly device: string;
  readonly isSoftware: boolean;
  readonly memory: number; // bytes that simulations hold on the device
  readonly error: string;
  readonly nativeDevice: GPUDevice | null; // for tests
  destroy(): void;
}

export declare class Scene {
  readonly title: string;
  readonly method: string;
  readonly dimension: number;
  readonly particleCount: number;
  readonly stableTimeStep: number;
  readonly warning: string; // of the last check()
  readonly domain: { min: [number, number, number]; max: [number, number, number] };
  parameter(name: string): number[]; // one number, three of a vector, the index of a choice
  setParameter(name: string, values: number | readonly number[] | string): void; // throws; a string names a choice
  check(): void; // throws
  copy(): Scene;
  destroy(): void;
}

export declare class Sim {
  readonly particleCount: number;
  readonly stepCount: number;
  readonly time: number;
  readonly backend: string; // "cpu" or "gpu"
  readonly device: string;
  readonly error: string;
  readonly warning: string;
  readonly status: Status;
  step(steps: number): void; // throws
  advance(wallSeconds: number): number; // steps taken; throws
  setMaxSteps(steps: number): void;
  poll(): Status; // lets GPU callbacks run; the error's text is in .error
  reset(): void;
  parameter(name: string): number[]; // as it runs now
  setParameter(name: string, values: number | readonly number[]): void; // throws; a choice by its index
  setState(positions: Float32Array, velocities: Float32Array): void; // throws
  setTool(kind: ToolKind, x: number, y: number, vx: number, vy: number, radius: number, strength: number): void;
  // By id; a view into wasm memory, valid until the next read() of the same field or until wasm memory grows: use
  // it at once or copy it. null while the GPU copies.
  read(field: Field): Float32Array | null;
  diagnose(countNeighbors: boolean): Diagnostics | null; // null while the GPU copies
  passTimes(): PassTime[];
  destroy(): void;
}

export declare class Renderer {
  // Draws into the canvas at its own canvas.width x canvas.height.
  draw(sim: Sim, view: View): Status;
  destroy(): void;
}
