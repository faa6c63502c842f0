// The panel, made from the engine's own parameter list. It shows what the scene holds; a change goes to the app, and
// if that refuses, the control goes back.
import type { BindingApi } from '@tweakpane/core';
import { Pane, type FolderApi } from 'tweakpane';
import { colorNames } from './legend.ts';
import type { ToolName, ToolSettings } from './pointer.ts';
import type { ParameterValue, SceneEntry } from './scene_document.ts';
import { addSlider, sliderRange, type SliderRange } from './slider.ts';
import type { Backend } from './start_engine.ts';
import { FluidStyle, type ColorBy, type ParameterInfo } from './weir.ts';

export interface PanelHost {
  readonly parameters: ParameterInfo[];
  readonly scenes: SceneEntry[];
  sceneName: string;
  backend: Backend;
  tool: ToolSettings;
  colorBy: ColorBy;
  fluidStyle: FluidStyle;
  method(): string;
  parameter(name: string): number[];
  particles(): number;
  mostParticles(): number;
  setParameter(name: string, value: ParameterValue): boolean; // false: refused
  setParticles(count: number): boolean;
  setBackend(backend: Backend): void;
  setColorBy(colorBy: ColorBy): void;
  drawsWater(): boolean; // whether the fluid can be shown as water
  setFluidStyle(style: FluidStyle): void;
  setRadius(radius: number): void;
  loadScene(name: string): void;
  togglePause(): void;
  restart(): void;
  useStableStep(): void;
}

type Point = { x: number; y: number };

// Puts the list's options under headings, one for each run of equal groups; options beyond the groups stay as they are.
function groupOptions(list: BindingApi, groups: string[]): void {
  const options = [...list.element.querySelectorAll('option')];
  let heading: HTMLOptGroupElement | null = null;
  groups.forEach((group, n) => {
    const option = options[n];
    if (!option) return;
    if (heading?.label !== group) {
      heading = document.createElement('optgroup');
      heading.label = group;
      option.before(heading);
    }
    heading.append(option);
  });
}

// Shown apart from the method's own parameters.
const speedName = 'time_scale';
const words = (name: string): string => name.replaceAll('_', ' ');

export class Panel {
  readonly #host: PanelHost;
  readonly #pane: Pane;
  readonly #refreshers: (() => void)[] = [];
  #quiet = false; // while the panel itself writes
  #pauseButton: { title: string } | null = null;

  constructor(container: HTMLElement, host: PanelHost, expanded: boolean) {
    this.#host = host;
    this.#pane = new Pane({ container, title: 'Controls', expanded });
    this.#addScene(this.#pane.addFolder({ title: 'Scene' }));
    this.#addTool(this.#pane.addFolder({ title: 'Tool' }));
    this.#addView(this.#pane.addFolder({ title: 'View' }));
    this.#addMethod(this.#pane.addFolder({ title: 'Method', expanded: innerHeight > 860 }));
    this.refresh();
  }

  // Shows the values that hold now.
  refresh(): void {
    this.#quiet = true;
    for (const refresher of this.#refreshers) refresher();
    this.#quiet = false;
  }

  showPaused(paused: boolean): void {
    if (this.#pauseButton) this.#pauseButton.title = paused ? 'Go on' : 'Pause';
  }

  #addScene(folder: FolderApi): void {
    const host = this.#host;
    const entries = Object.fromEntries(host.scenes.map((scene, n) => [n < 9 ? `${n + 1}  ${scene.title}` : scene.title, scene.name]));
    const list = this.#addList(folder, 'scene', { ...entries, '…': '' }, () => (host.scenes.some((s) => s.name === host.sceneName) ? host.sceneName : ''),
      (name) => (name ? host.loadScene(name) : this.refresh()), 'What the fluid is and where it starts. Drop a scene file onto the page to see your own.');
    groupOptions(list, host.scenes.map((scene) => scene.group));
    const range = { low: 500, high: 50_000, log: true, fromZero: false };
    this.#addNumber(folder, 'particles', range, () => host.particles(), (count) => host.setParticles(count),
      'About so many: particle spacing, support radius and time step change together. Restarts the scene.', () => host.mostParticles());
    const speed = host.parameters.find((info) => info.name === speedName);
    if (speed) this.#addParameter(folder, speed, 'speed');
    this.#addList(folder, 'solver', { 'automatic': 'auto', 'WebGPU': 'gpu', 'C on the CPU': 'cpu' }, () => host.backend,
      (backend) => host.setBackend(backend as Backend), 'Automatic: WebGPU on a real graphics card, else the C solver.');
    const pause = folder.addButton({ title: 'Pause' });
    pause.on('click', () => host.togglePause());
    this.#pauseButton = pause;
    folder.addButton({ title: 'Restart' }).on('click', () => host.restart());
  }

  #addTool(folder: FolderApi): void {
    const { tool } = this.#host;
    this.#addList(folder, 'tool', { push: 'push', pull: 'pull', stir: 'stir' }, () => tool.tool, (name) => (tool.tool = name as ToolName),
      'What the left button or a finger does. 2D: right button pull, Shift stir, Ctrl push. 3D: on the fluid; Alt stir, Ctrl push.');
    this.#addNumber(folder, 'radius', { low: 0.02, high: 0.6, log: true, fromZero: false }, () => tool.radius,
      (radius) => (this.#host.setRadius(radius), true), 'Of the tool, in metres. Also by the wheel (3D: with Ctrl).');
    this.#addNumber(folder, 'strength', { low: 0.1, high: 10, log: true, fromZero: false }, () => tool.strength,
      (strength) => strength > 0 && strength <= 100 && ((tool.strength = strength), true), 'Of the tool; 1 is the usual one.');
  }

  #addView(folder: FolderApi): void {
    const host = this.#host;
    const style = this.#addList(folder, 'fluid', { water: FluidStyle.water, particles: FluidStyle.particles }, () => host.fluidStyle,
      (next) => host.setFluidStyle(Number(next)), 'How the fluid is drawn. Also by W.');
    this.#refreshers.push(() => (style.hidden = !host.drawsWater()));
    this.#addList(folder, 'colour by', colorNames, () => host.colorBy, (by) => host.setColorBy(Number(by)),
      'The quantity that colours the fluid. In 3D a choice shows particles in place of water, which has no colours.');
  }

  #addMethod(folder: FolderApi): void {
    for (const info of this.#host.parameters) {
      if (info.name !== speedName) this.#addParameter(folder, info, words(info.name));
    }
    const stable = folder.addButton({ title: 'Use the stable time step' });
    stable.on('click', () => this.#host.useStableStep());
    this.#refreshers.push(() => (stable.hidden = this.#host.method() !== 'mueller'));
  }

  // A parameter that only one method reads is shown with that method only.
  #addParameter(folder: FolderApi, info: ParameterInfo, label: string): void {
    const binding = this.#bindParameter(folder, info, label);
    if (info.method) this.#refreshers.push(() => (binding.hidden = info.method !== this.#host.method()));
  }

  #bindParameter(folder: FolderApi, info: ParameterInfo, label: string): BindingApi {
    const host = this.#host;
    const restart = info.live ? '' : ' A change restarts the scene.';
    const unit = info.unit === '1' ? '' : ` in ${info.unit}`;
    const help = `${info.help}${unit} [${info.minimum} to ${info.maximum}]${restart}`;
    if (info.kind === 'choice') {
      const names = Object.fromEntries(info.choices.map((name) => [words(name), name]));
      return this.#addList(folder, label, names, () => info.choices[host.parameter(info.name)[0] ?? 0] ?? '',
        (name) => host.setParameter(info.name, String(name)) || this.refresh(), `${info.help}${restart}`);
    }
    if (info.kind === 'vector') return this.#addVector(folder, info, label, help);
    const usual = host.parameter(info.name)[0] ?? info.default[0] ?? 1;
    const range = sliderRange(usual > 0 ? usual : (info.default[0] ?? 1), info.minimum, info.maximum);
    return this.#addNumber(folder, label, range, () => host.parameter(info.name)[0] ?? 0,
      (value) => host.setParameter(info.name, value), help, undefined, /\b0( \([^)]*\))?: (?!none|clamps)/.test(info.help) ? 'auto' : '');
  }

  #addList<T extends string | number>(
    folder: FolderApi, label: string, options: Record<string, T>, get: () => T, set: (value: T) => void, help: string,
  ): BindingApi {
    const state = { value: get() };
    const binding = folder.addBinding(state, 'value', { label, options });
    binding.element.title = help;
    binding.element.querySelector('select')?.setAttribute('aria-label', label);
    binding.on('change', (event) => {
      if (!this.#quiet) set(event.value);
    });
    this.#refreshers.push(() => {
      state.value = get();
      binding.refresh();
    });
    return binding;
  }

  #addNumber(
    folder: FolderApi, label: string, range: SliderRange, get: () => number, set: (value: number) => boolean, help: string,
    most?: () => number, zero = '', // what 0 is called
  ): BindingApi {
    const state = { value: get() };
    const format = (value: number): string => {
      if (value === 0 && zero) return zero;
      const text = String(Number.isInteger(value) ? value : Number(value.toPrecision(4)));
      return text.length > 8 ? value.toExponential(2) : text;
    };
    const binding = folder.addBinding(state, 'value', { label, format, pointerScale: Math.max(state.value, range.low) / 100 });
    binding.element.title = help;
    binding.element.querySelector('input[type="text"]')?.setAttribute('aria-label', label);
    const limits = { ...range };
    const moveKnob = addSlider(binding.element, label, limits, (value) => {
      const next = label === 'particles' ? Math.round(value) : value;
      if (!set(next)) this.refresh();
    });
    binding.on('change', (event) => {
      if (!this.#quiet && !set(event.value)) this.refresh();
    });
    this.#refreshers.push(() => {
      state.value = get();
      if (most) limits.high = most();
      binding.refresh();
      moveKnob(state.value);
    });
    return binding;
  }

  #addVector(folder: FolderApi, info: ParameterInfo, label: string, help: string): BindingApi {
    const get = (): Point => {
      const [x = 0, y = 0] = this.#host.parameter(info.name);
      return { x, y };
    };
    const state = { value: get() };
    const axis = { format: (value: number): string => String(Number(value.toPrecision(4))) };
    const binding = folder.addBinding(state, 'value', { label, x: axis, y: { ...axis, inverted: true } });
    binding.element.title = help;
    binding.on('change', (event) => {
      const { x, y } = event.value;
      if (!this.#quiet && !this.#host.setParameter(info.name, [x, y])) this.refresh();
    });
    this.#refreshers.push(() => {
      state.value = get();
      binding.refresh();
    });
    return binding;
  }
}
