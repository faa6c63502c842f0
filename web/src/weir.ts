// The typed API over weir.wasm: the contract between the page and the engine. Every check and every message comes from
// the C core; this file moves values.

import { wasiImports } from './wasi.ts';
import { WebGpuImports, type Canvas } from './webgpu_imports.ts';
import { OUT_OF_MEMORY, Status, WeirError, WeirMemory, type WeirExports } from './weir_memory.ts';

export { Status, WeirError };

export type ParameterInfo = {
  name: string;
  unit: string;
  help: string;
  kind: 'number' | 'vector' | 'choice';
  choices: string[];
  default: number[];
  minimum: number;
  maximum: number;
  method: string; // the only one that reads it; '' if every one does
  live: boolean;
};

export const enum Field { position = 0, velocity = 1, acceleration = 2, density = 3, pressure = 4, group = 5 }
// What diagnose() is asked for beside the rest, by bit: on a GPU a copy of all particles.
export const enum Diagnose { neighbors = 1, hash = 2 }
export const enum ToolKind { none = 0, push = 1, pull = 2, stir = 3 }
export const enum ColorBy { speed = 0, density = 1, densityError = 2, pressure = 3 }

export type Diagnostics = {
  step: number;
  time: number;
  densityErrorMean: number;
  densityErrorMax: number;
  kineticEnergy: number;
  potentialEnergy: number;
  momentum: Triple;
  maxSpeed: number;
  meanNeighbors: number; // negative if not asked for
  lostParticles: number;
  stateHash: string; // 16 hexadecimal digits; '' if not asked for
};

export type PassTime = { name: string; milliseconds: number };

// What the simulation knows of itself without reading particles; `mueller` knows step and time only. As WeirClock in
// weir/weir.h.
export type Clock = {
  step: number;
  time: number;
  timeStep: number; // s, of the next step
  soundSpeed: number;
  maxSpeed: number;
  machNumber: number;
  maxDensityError: number;
  fluidParticles: number;
  drainedParticles: number;
  lostParticles: number;
};

export type Triple = [number, number, number];

// The camera of a simulation in 3D; angles in radians.
export type CameraPose = {
  target: Triple; // m, what it looks at
  yaw: number; // 0: along -z
  pitch: number;
  distance: number; // m, from the target
  fieldOfView: number; // of the picture's height
  shift: [number, number]; // where the target appears: 0, 0 in the middle, 1, 1 at the top right
};

// How the fluid is drawn: coloured discs (2D) or spheres (3D); or as water, one body with a smooth surface, in 2D coloured too,
// in 3D clear.
export const enum FluidStyle { particles = 0, water = 1 }

// What one frame shows; as WeirView in weir/weir_render.h.
export type View = {
  colorBy: ColorBy;
  colorMin: number;
  colorMax: number;
  particleRadius: number; // m
  toolPosition: Triple; // m
  toolRadius: number; // m; 0: no ring
  toolPressed: number; // 0 to 1
  center: [number, number]; // 2D: m
  pixelsPerMeter: number; // 2D: device pixels
  camera: CameraPose; // 3D
  fluidStyle?: FluidStyle; // particles if not given
};

// How a wall or body is drawn.
export const enum Look { hidden = 0, wall = 1, body = 2 }

export type Ray = { origin: Triple; direction: Triple };

// What the objects below share.
export type Context = { readonly memory: WeirMemory; readonly c: WeirExports; readonly webgpu: WebGpuImports; weir: Weir };

const DIAGNOSTIC_COUNT = 14;
const CLOCK_COUNT = 10;
const VIEW_FLOATS = 22; // weir_web_renderer_draw()
const MAX_PASSES = 32;
const LONGEST_PATH = 255; // as in the native loader: no path of a scene is as long

export class Weir {
  readonly version: string;
  readonly parameters: ParameterInfo[];
  readonly context: Context; // for what is built on it: validation_api.ts
  readonly #context: Context;

  private constructor(context: Context) {
    this.#context = this.context = context;
    context.weir = this;
    this.version = context.memory.text(context.c.weir_web_version());
    this.parameters = readParameters(context);
  }

  // A URL or string is fetched; bytes or a compiled module are instantiated. `gpu` null: no WebGPU (tests); left out:
  // navigator.gpu if there is one.
  static async load(
    source: URL | string | BufferSource | WebAssembly.Module, options: { gpu?: GPU | null } = {},
  ): Promise<Weir> {
    const module = await compile(source);
    const browser = typeof navigator === 'undefined' ? undefined : (navigator.gpu as GPU | undefined);
    const webgpu = new WebGpuImports(options.gpu === undefined ? (browser ?? null) : options.gpu);
    const instance = await WebAssembly.instantiate(module, wasiImports(module, { webgpu: webgpu.functions }));
    const c = instance.exports as unknown as WeirExports;
    webgpu.attach(c);
    c._initialize();
    return new Weir({ memory: new WeirMemory(c), c, webgpu, weir: null as unknown as Weir });
  }

  // Bytes of the program's memory, which grows with the scenes and never shrinks.
  get memoryBytes(): number {
    return this.#context.c.memory.buffer.byteLength;
  }

  // Sets every value of a parsed scene document by its path. Throws WeirError with the core's message.
  loadScene(document: unknown): Scene {
    const scene = new Scene(this.#context);
    try {
      // The dimension says how long vectors are, and the method which dimensions there are: both come first.
      if (typeof document === 'object' && document !== null && !Array.isArray(document)) {
        const given = document as Record<string, unknown>;
        for (const key of ['method', 'dimension']) if (Object.hasOwn(given, key)) scene.setAll(key, given[key]);
      }
      scene.setAll('', document);
    } catch (error) {
      scene.destroy();
      throw error;
    }
    return scene;
  }

  // Starts to look for a device; see Gpu.ready().
  createGpu(options: GpuOptions = {}): Gpu {
    return new Gpu(this.#context, options);
  }

  // On the GPU if one is given, else with the C solver. The scene is copied. Throws WeirError.
  createSim(scene: Scene, options: { gpu?: Gpu; maxSteps?: number; maxLag?: number } = {}): Sim {
    return new Sim(this.#context, scene, options);
  }

  // Draws into the canvas, which belongs to the renderer from then on. Throws WeirError.
  createRenderer(gpu: Gpu, canvas: Canvas): Renderer {
    return new Renderer(this.#context, gpu, canvas);
  }

  // 256 colours, 3 bytes each, sRGB: the shader's own map.
  colorMap(colorBy: ColorBy): Uint8Array {
    const { memory, c } = this.#context;
    return memory.scratch(256 * 3, (at) => {
      c.weir_web_color_map(colorBy, at);
      return memory.bytes.slice(at, at + 256 * 3);
    });
  }

  // The camera of a view in 3D as a matrix, column by column, for a picture of that size.
  viewMatrix(view: View, width: number, height: number): Float32Array {
    const { memory, c } = this.#context;
    return memory.scratch(4 * (VIEW_FLOATS + 16), (at) => {
      writeView(memory.floats(at, VIEW_FLOATS), view);
      const matrix = at + 4 * VIEW_FLOATS;
      c.weir_web_view_matrix(at, width, height, matrix);
      return memory.floats(matrix, 16).slice();
    });
  }

  // The ray from its camera through a pixel, y down.
  viewRay(view: View, width: number, height: number, x: number, y: number): Ray {
    const { memory, c } = this.#context;
    return memory.scratch(4 * (VIEW_FLOATS + 6), (at) => {
      writeView(memory.floats(at, VIEW_FLOATS), view);
      const ray = at + 4 * VIEW_FLOATS;
      c.weir_web_view_ray(at, width, height, x, y, ray);
      const found = memory.floats(ray, 6);
      return { origin: triple(found, 0), direction: triple(found, 3) };
    });
  }

  // Handles of WebGPU objects in use: for tests.
  get liveGpuObjects(): number {
    return this.#context.webgpu.liveObjects;
  }
}

async function compile(source: URL | string | BufferSource | WebAssembly.Module): Promise<WebAssembly.Module> {
  if (source instanceof WebAssembly.Module) return source;
  if (typeof source !== 'string' && !(source instanceof URL)) return WebAssembly.compile(source);
  const response = await fetch(source);
  if (!response.ok) throw new WeirError(Status.input, `${source}: ${response.status} ${response.statusText}`);
  // Streaming needs the right content type, which not every server sends.
  const streams = response.headers.get('content-type') === 'application/wasm';
  return streams ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

function readParameters({ memory, c }: Context): ParameterInfo[] {
  type Raw = Omit<ParameterInfo, 'choices' | 'live'> & { choices: string; live: number };
  const list: ParameterInfo[] = [];
  for (let at = c.weir_web_parameter(0); at !== 0; at = c.weir_web_parameter(list.length)) {
    const raw = JSON.parse(memory.text(at)) as Raw;
    const choices = raw.choices === '' ? [] : raw.choices.split('|');
    const maximum = raw.kind === 'choice' ? choices.length - 1 : raw.maximum;
    list.push({ ...raw, choices, maximum, live: raw.live !== 0 });
  }
  return list;
}

// Asks again until the answer is not `pending`. A timer lets the GPU's callbacks run in between, in workers too.
async function unlessPending(ask: () => Status, isAlive: () => boolean, gone: string): Promise<Status> {
  let status = ask();
  while (status === Status.pending) {
    await new Promise((resolve) => setTimeout(resolve, 1));
    if (!isAlive()) throw new WeirError(Status.device, gone);
    status = ask();
  }
  return status;
}

// What of a device is measured when it is made (WeirGpuOptions): 0.1 to 0.2 s that are saved where it is known from before.
export type KnownDevice = { device: string; parallelism: number };

export type GpuOptions = { lowPower?: boolean; timestamps?: boolean; known?: KnownDevice };

export class Gpu {
  readonly pointer: number; // WeirGpu in wasm memory
  readonly #context: Context;
  #alive = true;

  constructor(context: Context, options: GpuOptions) {
    const { lowPower = false, timestamps = true, known = { device: '', parallelism: 0 } } = options;
    this.#context = context;
    this.pointer = context.memory.withText(known.device, (device) =>
      context.c.weir_web_gpu_create(lowPower ? 1 : 0, timestamps ? 1 : 0, known.parallelism, device));
    if (this.pointer === 0) throw new WeirError(Status.memory, OUT_OF_MEMORY);
  }

  // Resolves when the device is there; throws WeirError if there is none.
  async ready(): Promise<void> {
    const status = await unlessPending(() => this.poll(), () => this.#alive, 'the GPU was destroyed while it started');
    if (status !== Status.ok) throw new WeirError(status, this.error);
  }

  // Lets callbacks run. Once per frame.
  poll(): Status {
    return this.#context.c.weir_gpu_poll(this.pointer);
  }

  get device(): string {
    return this.#context.memory.text(this.#context.c.weir_gpu_device(this.pointer));
  }

  // Threads that keep it busy; 0 until it is ready.
  get parallelism(): number {
    return this.#context.c.weir_gpu_parallelism(this.pointer);
  }

  get isSoftware(): boolean {
    return this.#context.c.weir_gpu_is_software(this.pointer) !== 0;
  }

  get memory(): number {
    return this.#context.c.weir_web_gpu_memory(this.pointer);
  }

  get error(): string {
    return this.#context.memory.text(this.#context.c.weir_gpu_error(this.pointer));
  }

  // The browser's own device, null until it is there: for tests.
  get nativeDevice(): GPUDevice | null {
    const handle = this.#context.c.weir_gpu_wgpu_device(this.pointer);
    return (this.#context.webgpu.object(handle) as GPUDevice | undefined) ?? null;
  }

  destroy(): void {
    if (this.#alive) this.#context.c.weir_gpu_destroy(this.pointer);
    this.#alive = false;
  }
}

export class Scene {
  readonly pointer: number; // WeirScene in wasm memory
  readonly #context: Context;
  #alive = true;

  constructor(context: Context, pointer?: number) {
    this.#context = context;
    this.pointer = pointer ?? context.c.weir_scene_create();
    if (this.pointer === 0) throw new WeirError(Status.memory, OUT_OF_MEMORY);
  }

  get title(): string {
    return this.#context.memory.text(this.#context.c.weir_scene_title(this.pointer));
  }

  get method(): string {
    return this.#context.memory.text(this.#context.c.weir_scene_method(this.pointer));
  }

  get dimension(): number {
    return this.#context.c.weir_scene_dimension(this.pointer);
  }

  get particleCount(): number {
    return this.#context.c.weir_scene_particle_count(this.pointer) >>> 0;
  }

  // Without walls and bodies.
  get fluidCount(): number {
    return this.#context.c.weir_web_scene_fluid_count(this.pointer) >>> 0;
  }

  get stableTimeStep(): number {
    return this.#context.c.weir_scene_stable_time_step(this.pointer);
  }

  // Of wall or body 0, 1, ...
  look(solid: number): Look {
    return this.#context.c.weir_scene_look(this.pointer, solid);
  }

  // Advice of the last check().
  get warning(): string {
    return this.#context.memory.text(this.#context.c.weir_scene_warning(this.pointer));
  }

  get domain(): { min: Triple; max: Triple } {
    const { memory, c } = this.#context;
    return memory.scratch(48, (at) => {
      c.weir_web_scene_domain(this.pointer, at);
      const bounds = memory.doubles(at, 6);
      return { min: triple(bounds, 0), max: triple(bounds, 3) };
    });
  }

  // One number, three of a vector, the index of a choice.
  parameter(name: string): number[] {
    return readParameter(this.#context, this.pointer, name);
  }

  // A string names a choice.
  setParameter(name: string, values: number | readonly number[] | string): void {
    this.setAll(`parameters.${name}`, values);
  }

  // The walk of a parsed document, the same as the native loader's (src/json/json_scene.c): objects extend the path by
  // ".key", lists of objects by "[index]"; anything that no scene holds is refused by the core, by name.
  setAll(path: string, value: unknown): void {
    if (path.length > LONGEST_PATH) return this.#refuse(path, 'nested too deep');
    if (typeof value === 'number') return this.#setNumber(path, value);
    if (typeof value === 'string') return this.#setString(path, value);
    if (typeof value === 'boolean') return this.#setBoolean(path, value);
    if (Array.isArray(value)) return this.#setList(path, value);
    if (typeof value !== 'object' || value === null) return this.#refuse(path, String(value));
    const entries = Object.entries(value);
    if (entries.length === 0 && path !== '') return this.#refuse(path, 'an empty object');
    for (const [key, item] of entries) {
      // A key that would be read as a path of its own is quoted, so that the core finds it unknown.
      const name = key === '' || /[.[\]"]/.test(key) ? `"${key}"` : key;
      this.setAll(path === '' ? name : `${path}.${name}`, item);
    }
  }

  #setNumber(path: string, value: number): void {
    const { memory, c } = this.#context;
    this.#throwIf(memory.withText(path, (at) => c.weir_scene_set_number(this.pointer, at, value)));
  }

  #setBoolean(path: string, value: boolean): void {
    const { memory, c } = this.#context;
    this.#throwIf(memory.withText(path, (at) => c.weir_scene_set_boolean(this.pointer, at, value ? 1 : 0)));
  }

  #setString(path: string, value: string): void {
    const { memory, c } = this.#context;
    if (value.includes('\0')) return this.#refuse(path, 'a text with a null character');
    const set = (at: number) =>
      memory.withText(value, (text) => c.weir_scene_set_string(this.pointer, at, text));
    this.#throwIf(memory.withText(path, set));
  }

  #setList(path: string, list: readonly unknown[]): void {
    const { memory, c } = this.#context;
    const isNumber = (item: unknown) => typeof item === 'number';
    if (list.every(isNumber)) {
      const set = (at: number) =>
        memory.withDoubles(list as number[], (values) =>
          c.weir_scene_set_numbers(this.pointer, at, values, list.length));
      return this.#throwIf(memory.withText(path, set));
    }
    if (isNumber(list[0])) return this.#refuse(path, 'a list of mixed types');
    list.forEach((item, index) => this.setAll(`${path}[${index}]`, item));
  }

  #refuse(path: string, typeName: string): void {
    const { memory, c } = this.#context;
    const refuse = (at: number) =>
      memory.withText(typeName, (text) => c.weir_scene_refuse(this.pointer, at, text));
    this.#throwIf(memory.withText(path, refuse));
  }

  // The scene as a whole: some fluid, inside the domain, no overlap, a count that fits. Sets `warning`.
  check(): void {
    this.#throwIf(this.#context.c.weir_scene_check(this.pointer));
  }

  copy(): Scene {
    return new Scene(this.#context, this.#context.c.weir_scene_copy(this.pointer));
  }

  destroy(): void {
    if (this.#alive) this.#context.c.weir_scene_destroy(this.pointer);
    this.#alive = false;
  }

  #throwIf(status: Status): void {
    if (status === Status.ok) return;
    throw new WeirError(status, this.#context.memory.text(this.#context.c.weir_scene_error(this.pointer)));
  }
}

// A field's copy in wasm memory.
type FieldBlock = { at: number; view: Float32Array };

export class Sim {
  readonly context: Context; // for what goes with a simulation: probes.ts
  readonly pointer: number; // WeirSim in wasm memory
  readonly particleCount: number;
  readonly fluidSlots: number; // ids below are fluid or empty slots, the others walls and bodies
  readonly dimension: number;
  readonly backend: string; // "cpu" or "gpu"
  readonly #context: Context;
  readonly #fields: (FieldBlock | undefined)[] = [];
  #alive = true;

  constructor(context: Context, scene: Scene, options: { gpu?: Gpu; maxSteps?: number; maxLag?: number }) {
    const { memory, c } = context;
    this.#context = this.context = context;
    let backend = 0;
    if (options.gpu) {
      const status = options.gpu.poll();
      if (status === Status.pending) throw new WeirError(status, 'the GPU is still starting; await ready() first');
      backend = c.weir_gpu_backend(options.gpu.pointer);
      if (backend === 0) throw new WeirError(status, options.gpu.error);
    }
    this.pointer = c.weir_web_sim_create(scene.pointer, backend, options.maxSteps ?? 0, options.maxLag ?? 0);
    if (this.pointer === 0) throw new WeirError(Status.memory, OUT_OF_MEMORY);
    this.particleCount = c.weir_sim_particle_count(this.pointer) >>> 0;
    this.fluidSlots = c.weir_sim_fluid_slots(this.pointer) >>> 0;
    this.dimension = scene.dimension;
    this.backend = memory.text(c.weir_sim_backend(this.pointer));
    const status = this.status;
    if (status === Status.ok) return;
    const error = new WeirError(status, this.error);
    this.destroy();
    throw error;
  }

  // Resolves when it may step, on the GPU when its shaders are compiled; until then what would step or change it throws.
  // Throws WeirError if it cannot run.
  async ready(): Promise<void> {
    this.#throwIf(await unlessPending(() => this.poll(), () => this.#alive, 'the simulation was destroyed while it started'));
  }

  // Resolves when all steps asked for are done, and stepCount and time tell of them. Throws WeirError.
  async finished(): Promise<void> {
    const wait = (): Status => this.#context.c.weir_sim_wait(this.pointer);
    this.#throwIf(await unlessPending(wait, () => this.#alive, 'the simulation was destroyed while it stepped'));
  }

  // Resolves when all changes hold. Throws WeirError.
  async settled(): Promise<void> {
    const settle = (): Status => {
      const status = this.poll();
      return status === Status.ok && this.isChanging ? Status.pending : status;
    };
    this.#throwIf(await unlessPending(settle, () => this.#alive, 'the simulation was destroyed while it changed'));
  }

  // Whether a change waits for its shaders.
  get isChanging(): boolean {
    return this.#context.c.weir_sim_is_changing(this.pointer) !== 0;
  }

  get stepCount(): number {
    return this.#context.c.weir_web_sim_step_count(this.pointer);
  }

  get time(): number {
    return this.#context.c.weir_sim_time(this.pointer);
  }

  get device(): string {
    return this.#context.memory.text(this.#context.c.weir_sim_device(this.pointer));
  }

  get error(): string {
    return this.#context.memory.text(this.#context.c.weir_sim_error(this.pointer));
  }

  get warning(): string {
    return this.#context.memory.text(this.#context.c.weir_sim_warning(this.pointer));
  }

  get status(): Status {
    return this.#context.c.weir_sim_status(this.pointer);
  }

  step(steps: number): void {
    this.#throwUnlessDone(this.#context.c.weir_sim_step(this.pointer, steps));
  }

  // Takes that many steps, fewer if they come to `time`. On the GPU poll() tells when they are done.
  stepUntil(steps: number, time: number): void {
    this.#throwUnlessDone(this.#context.c.weir_sim_step_until(this.pointer, steps, time));
  }

  // Takes the steps due after that much more wall time; returns their number.
  advance(wallSeconds: number): number {
    const steps = this.#context.c.weir_web_sim_advance(this.pointer, wallSeconds);
    if (steps < 0) this.#throwUnlessDone(-steps);
    return steps;
  }

  setMaxSteps(steps: number): void {
    this.#context.c.weir_sim_set_max_steps(this.pointer, steps);
  }

  // Lets GPU callbacks run and looks for faults; the text is in .error.
  poll(): Status {
    return this.#context.c.weir_sim_poll(this.pointer);
  }

  reset(): void {
    this.#throwUnlessDone(this.#context.c.weir_sim_reset(this.pointer));
  }

  // As it runs now.
  parameter(name: string): number[] {
    return readParameter(this.#context, this.#context.c.weir_sim_scene(this.pointer), name);
  }

  // Of live parameters only; a choice by its index. On the GPU a change that needs other shaders holds when they are
  // compiled; until then steps go on as before, see settled().
  setParameter(name: string, values: number | readonly number[]): void {
    const { memory, c } = this.#context;
    const list = typeof values === 'number' ? [values] : values;
    const set = (at: number) =>
      memory.withDoubles(list, (numbers) => c.weir_sim_set_parameter(this.pointer, at, numbers, list.length));
    this.#throwUnlessDone(memory.withText(name, set));
  }

  // x, y (and z in 3D) per particle, by id.
  setState(positions: Float32Array, velocities: Float32Array): void {
    const { memory, c } = this.#context;
    const wanted = this.dimension * this.particleCount;
    if (positions.length !== wanted || velocities.length !== wanted)
      throw new WeirError(Status.input,
        `state: has ${positions.length} and ${velocities.length} numbers; must have ${wanted} each`);
    const bytes = 4 * wanted;
    const status = memory.scratch(2 * bytes, (at) => {
      memory.floats(at, wanted).set(positions);
      memory.floats(at + bytes, wanted).set(velocities);
      return c.weir_sim_set_state(this.pointer, at, at + bytes);
    });
    this.#throwUnlessDone(status);
  }

  setTool(kind: ToolKind, position: Readonly<Triple>, velocity: Readonly<Triple>, radius: number, strength: number): void {
    const [x, y, z] = position;
    const [vx, vy, vz] = velocity;
    this.#throwUnlessDone(this.#context.c.weir_web_sim_set_tool(this.pointer, kind, x, y, z, vx, vy, vz, radius, strength));
  }

  clock(): Clock {
    const { memory, c } = this.#context;
    return memory.scratch(8 * CLOCK_COUNT, (at) => {
      c.weir_web_sim_clock(this.pointer, at);
      const [step, time, timeStep, soundSpeed, maxSpeed, machNumber, maxDensityError, fluidParticles,
        drainedParticles, lostParticles] = memory.doubles(at, CLOCK_COUNT);
      return {
        step, time, timeStep, soundSpeed, maxSpeed, machNumber, maxDensityError, fluidParticles, drainedParticles,
        lostParticles,
      } as Clock;
    });
  }

  // By id; a view into wasm memory, valid until the next read() of the field or until that memory grows: use it at once
  // or copy it. null while the GPU copies.
  read(field: Field): Float32Array | null {
    const count = this.#components(field);
    const status = this.#context.c.weir_sim_read(this.pointer, field, this.#block(field).at, count);
    if (status === Status.pending) return null;
    this.#throwIf(status);
    return this.#view(field);
  }

  // Both of one moment, which two calls of read() do not give while the simulation runs. Views as of read().
  readMotion(): { positions: Float32Array; velocities: Float32Array } | null {
    const [positions, velocities] = [this.#block(Field.position), this.#block(Field.velocity)];
    const count = this.#components(Field.position);
    const status = this.#context.c.weir_sim_read_motion(this.pointer, positions.at, velocities.at, count);
    if (status === Status.pending) return null;
    this.#throwIf(status);
    return { positions: this.#view(Field.position), velocities: this.#view(Field.velocity) };
  }

  #components(field: Field): number {
    return this.particleCount * (field >= Field.density ? 1 : this.dimension);
  }

  // Where a field goes in wasm memory.
  #block(field: Field): { at: number; view: Float32Array } {
    return (this.#fields[field] ??= {
      at: this.#context.memory.allocate(4 * this.#components(field)), view: new Float32Array(0),
    });
  }

  #view(field: Field): Float32Array {
    const { memory, c } = this.#context;
    const block = this.#block(field);
    if (block.view.buffer !== c.memory.buffer) block.view = memory.floats(block.at, this.#components(field));
    return block.view;
  }

  // `flags` of Diagnose. null while the GPU copies.
  diagnose(flags = 0): Diagnostics | null {
    const { memory, c } = this.#context;
    return memory.scratch(8 * DIAGNOSTIC_COUNT, (at) => {
      const status = c.weir_web_sim_diagnose(this.pointer, flags, at);
      if (status === Status.pending) return null;
      this.#throwIf(status);
      const [step, time, densityErrorMean, densityErrorMax, kineticEnergy, potentialEnergy] = memory.doubles(at, 6);
      const [maxSpeed, meanNeighbors, lostParticles, high, low] = memory.doubles(at + 72, 5);
      return {
        step, time, densityErrorMean, densityErrorMax, kineticEnergy, potentialEnergy, maxSpeed, meanNeighbors,
        lostParticles, momentum: triple(memory.doubles(at + 48, 3), 0),
        stateHash: flags & Diagnose.hash ? hex(high) + hex(low) : '',
      } as Diagnostics;
    });
  }

  // Of the last measured step; empty where the device gives no times.
  passTimes(): PassTime[] {
    const { memory, c } = this.#context;
    return memory.scratch(16 * MAX_PASSES, (at) => {
      const count = c.weir_web_sim_pass_times(this.pointer, at, MAX_PASSES);
      const pairs = memory.doubles(at, 2 * count);
      return Array.from({ length: count }, (_, k) => ({
        name: memory.text(pairs[2 * k] as number), milliseconds: pairs[2 * k + 1] as number,
      }));
    });
  }

  // Milliseconds that the device takes for a step, averaged over batches; 0: not known.
  get stepTime(): number {
    return this.#context.c.weir_sim_step_time(this.pointer);
  }

  destroy(): void {
    if (!this.#alive) return;
    this.#alive = false;
    for (const block of this.#fields) if (block) this.#context.memory.free(block.at);
    this.#context.c.weir_sim_destroy(this.pointer);
  }

  #throwUnlessDone(status: Status): void {
    if (status === Status.pending) throw new WeirError(status, 'the simulation is still starting; await ready() first');
    this.#throwIf(status);
  }

  #throwIf(status: Status): void {
    if (status !== Status.ok && status !== Status.pending) throw new WeirError(status, this.error);
  }
}

function readParameter(context: Context, scene: number, name: string): number[] {
  const { memory, c, weir } = context;
  const kind = weir.parameters.find((parameter) => parameter.name === name)?.kind;
  return memory.scratch(24, (at) => {
    const status = memory.withText(name, (text) => c.weir_scene_get_parameter(scene, text, at));
    if (status !== Status.ok) throw new WeirError(status, `${name}: unknown parameter`);
    return Array.from(memory.doubles(at, kind === 'vector' ? 3 : 1));
  });
}

// The order of weir_web_renderer_draw() in apps/web/web_gpu.c.
function writeView(to: Float32Array, view: View): void {
  const { camera } = view;
  to[0] = view.colorBy;
  to[1] = view.colorMin;
  to[2] = view.colorMax;
  to[3] = view.particleRadius;
  to.set(view.toolPosition, 4);
  to[7] = view.toolRadius;
  to[8] = view.toolPressed;
  to.set(view.center, 9);
  to[11] = view.pixelsPerMeter;
  to.set(camera.target, 12);
  to[15] = camera.yaw;
  to[16] = camera.pitch;
  to[17] = camera.distance;
  to[18] = camera.fieldOfView;
  to.set(camera.shift, 19);
  to[21] = view.fluidStyle ?? FluidStyle.particles;
}

function triple(values: Float64Array | Float32Array, from: number): Triple {
  return [values[from] as number, values[from + 1] as number, values[from + 2] as number];
}

function hex(half: number | undefined): string {
  return (half ?? 0).toString(16).padStart(8, '0');
}

export class Renderer {
  readonly #context: Context;
  readonly #canvas: Canvas;
  readonly #view: number; // floats of the view in wasm memory
  #pointer: number;

  constructor(context: Context, gpu: Gpu, canvas: Canvas) {
    this.#context = context;
    this.#canvas = canvas;
    const status = gpu.poll();
    if (status !== Status.ok) throw new WeirError(status, gpu.error || 'the GPU is still starting; await ready() first');
    const id = context.webgpu.registerCanvas(canvas);
    this.#pointer = context.c.weir_web_renderer_create(gpu.pointer, id);
    if (this.#pointer === 0)
      throw new WeirError(Status.device, 'the canvas gives no WebGPU context, or memory ran out');
    this.#view = context.memory.allocate(4 * VIEW_FLOATS);
  }

  // Makes what pictures of such scenes need, which their first one does otherwise: a browser compiles it beside a simulation's passes.
  prepare(scene: Scene, style: FluidStyle): Status {
    return this.#context.c.weir_web_renderer_prepare(this.#pointer, scene.pointer, style);
  }

  // Queues one frame at canvas.width x canvas.height, in device pixels.
  draw(sim: Sim, view: View): Status {
    const { memory, c } = this.#context;
    writeView(memory.floats(this.#view, VIEW_FLOATS), view);
    return c.weir_web_renderer_draw(this.#pointer, sim.pointer, this.#canvas.width, this.#canvas.height, this.#view);
  }

  // Milliseconds that the device takes for a picture, averaged; 0: not known.
  get drawTime(): number {
    return this.#context.c.weir_web_renderer_draw_time(this.#pointer);
  }

  destroy(): void {
    if (this.#pointer === 0) return;
    this.#context.c.weir_web_renderer_destroy(this.#pointer);
    this.#context.memory.free(this.#view);
    this.#pointer = 0;
  }
}
