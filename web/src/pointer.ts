// Mouse, touch and pen become the tool that acts on the fluid. Left button or touch: the tool chosen in the panel;
// right button: pull; Shift: stir; Ctrl: push. The wheel sets the radius.
import type { Tool } from './engine.ts';
import { ToolKind } from './weir.ts';
import type { Camera } from './view.ts';

export type ToolName = 'push' | 'pull' | 'stir';
const kinds: Record<ToolName, ToolKind> = { push: ToolKind.push, pull: ToolKind.pull, stir: ToolKind.stir };

export type ToolSettings = { tool: ToolName; radius: number; strength: number }; // radius in m, strength 1: usual

// At strength 1: acceleration of push and pull in m/s^2, rate of stir in 1/s.
const pushAcceleration = 120;
const stirRate = 25;

export class Pointer {
  readonly tool: Tool = { kind: ToolKind.none, x: 0, y: 0, vx: 0, vy: 0, radius: 0.1, strength: 0 };
  readonly settings: ToolSettings = { tool: 'push', radius: 0.15, strength: 1 };
  onRadius: () => void = () => {};
  readonly #camera: Camera;
  readonly #element: HTMLElement;
  #id: number | null = null; // of the pointer that acts
  #kind = ToolKind.none;
  #inside = false;
  #x = 0; // m
  #y = 0;
  #lastX = 0;
  #lastY = 0;

  constructor(element: HTMLElement, camera: Camera) {
    this.#camera = camera;
    this.#element = element;
    element.addEventListener('pointerdown', (event) => this.#down(event));
    element.addEventListener('pointermove', (event) => this.#move(event));
    element.addEventListener('pointerup', (event) => this.#up(event));
    element.addEventListener('pointercancel', (event) => this.#up(event));
    element.addEventListener('pointerleave', (event) => {
      if (event.pointerId !== this.#id) this.#inside = false;
    });
    element.addEventListener('contextmenu', (event) => event.preventDefault());
    element.addEventListener('wheel', (event) => this.#wheel(event), { passive: false });
  }

  #place(event: PointerEvent): void {
    this.#x = this.#camera.toX(event.clientX);
    this.#y = this.#camera.toY(event.clientY);
    this.#inside = true;
  }

  #down(event: PointerEvent): void {
    if (this.#id !== null) return; // the first finger leads
    this.#id = event.pointerId;
    try {
      this.#element.setPointerCapture(event.pointerId);
    } catch {
      // a synthetic event has no pointer to capture
    }
    this.#kind = kinds[this.settings.tool];
    if (event.button === 2) this.#kind = ToolKind.pull;
    if (event.shiftKey) this.#kind = ToolKind.stir;
    if (event.ctrlKey || event.metaKey) this.#kind = ToolKind.push;
    this.#place(event);
    this.#lastX = this.#x;
    this.#lastY = this.#y;
    this.tool.vx = this.tool.vy = 0;
    (document.activeElement as HTMLElement | null)?.blur?.(); // keys go to the fluid again
    event.preventDefault();
  }

  #move(event: PointerEvent): void {
    if (this.#id === null || event.pointerId === this.#id) this.#place(event);
  }

  #up(event: PointerEvent): void {
    if (event.pointerId !== this.#id) return;
    this.#id = null;
    this.#kind = ToolKind.none;
    if (event.pointerType !== 'mouse') this.#inside = false;
  }

  #wheel(event: WheelEvent): void {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    this.setRadius(this.settings.radius * Math.exp(-0.0012 * lines * event.deltaY));
  }

  // Largest useful radius: half of the domain's shorter side.
  get limits(): [number, number] {
    const { min, max } = this.#camera.domain;
    const side = Math.min((max[0] ?? 1) - (min[0] ?? 0), (max[1] ?? 1) - (min[1] ?? 0));
    return [0.01 * side, 0.5 * side];
  }

  setRadius(radius: number): void {
    const [low, high] = this.limits;
    this.settings.radius = Math.min(Math.max(radius, low), high);
    this.onRadius();
  }

  // Once per frame: the tool as it acts now, and the ring to draw.
  update(seconds: number): void {
    const { tool, settings } = this;
    const { view } = this.#camera;
    if (seconds > 0) {
      const weight = 1 - Math.exp(-seconds / 0.04); // pointer events are jerky: average over 40 ms
      tool.vx += weight * ((this.#x - this.#lastX) / seconds - tool.vx);
      tool.vy += weight * ((this.#y - this.#lastY) / seconds - tool.vy);
      this.#lastX = this.#x;
      this.#lastY = this.#y;
    }
    const acts = this.#kind !== ToolKind.none;
    tool.kind = this.#kind;
    tool.x = this.#x;
    tool.y = this.#y;
    tool.radius = settings.radius;
    tool.strength = settings.strength * (this.#kind === ToolKind.stir ? stirRate : pushAcceleration);
    view.toolPosition[0] = this.#x;
    view.toolPosition[1] = this.#y;
    view.toolRadius = this.#inside || acts ? settings.radius : 0;
    view.toolPressed = acts ? 1 : 0;
  }
}
