// Mouse, touch and pen. In 2D they become the tool that acts on the fluid: left button or touch the tool chosen in the
// panel, right button pull, Shift stir, Ctrl push; the wheel sets the tool's radius. In 3D the left button or a finger
// on the fluid is the tool (Ctrl push, Alt stir); beside the fluid, or with the right button, it turns the camera, with
// Shift or two fingers it shifts it; wheel and pinch zoom, and with Ctrl or Alt the wheel sets the tool's radius.
import type { Tool } from './engine.ts';
import { pickFluid, type PickSource } from './pick.ts';
import { ToolKind, type Triple } from './weir.ts';
import { along, cameraAxes, dot, type Camera } from './view.ts';

export type ToolName = 'push' | 'pull' | 'stir';
const kinds: Record<ToolName, ToolKind> = { push: ToolKind.push, pull: ToolKind.pull, stir: ToolKind.stir };

export type ToolSettings = { tool: ToolName; radius: number; strength: number }; // radius in m, strength 1: usual

// At strength 1: acceleration of push and pull in m/s^2, rate of stir in 1/s.
const pushAcceleration = 120;
const stirRate = 25;
const hoverMs = 40; // between two looks for the fluid under the pointer

type Place = { x: number; y: number }; // CSS pixels
type Gesture = 'none' | 'tool' | 'orbit' | 'pan' | 'pinch';

export class Pointer {
  readonly tool: Tool = { kind: ToolKind.none, position: [0, 0, 0], velocity: [0, 0, 0], radius: 0.1, strength: 0 };
  readonly settings: ToolSettings = { tool: 'push', radius: 0.15, strength: 1 };
  onRadius: () => void = () => {};
  source: () => PickSource | null = () => null; // the fluid, for 3D
  readonly #camera: Camera;
  readonly #element: HTMLElement;
  readonly #down = new Map<number, Place>(); // all pointers that are pressed
  #gesture: Gesture = 'none';
  #leader = 0; // the pointer that acts
  #kind = ToolKind.none;
  #inside = false;
  #mouse: Place = { x: 0, y: 0 };
  #position: Triple = [0, 0, 0]; // m
  #last: Triple = [0, 0, 0];
  #depth = 0; // 3D: of the tool's plane across the line of sight, m ahead of the eye
  #onFluid = false;
  #hovered = 0;

  // `wheel`: it is the tool's or the camera's; otherwise it scrolls the page around.
  constructor(element: HTMLElement, camera: Camera, wheel = true) {
    this.#camera = camera;
    this.#element = element;
    element.addEventListener('pointerdown', (event) => this.#press(event));
    element.addEventListener('pointermove', (event) => this.#move(event));
    element.addEventListener('pointerup', (event) => this.#release(event));
    element.addEventListener('pointercancel', (event) => this.#release(event));
    element.addEventListener('pointerleave', (event) => {
      if (!this.#down.has(event.pointerId)) this.#inside = false;
    });
    element.addEventListener('contextmenu', (event) => event.preventDefault());
    if (wheel) element.addEventListener('wheel', (event) => this.#wheel(event), { passive: false });
  }

  get #isSpace(): boolean {
    return this.#camera.dimension === 3;
  }

  // Where the tool is for a pointer at that place. In 3D on the plane where the fluid was met.
  #place({ x, y }: Place): void {
    this.#inside = true;
    if (!this.#isSpace) {
      this.#position = [this.#camera.toX(x), this.#camera.toY(y), 0];
      return;
    }
    const { origin, direction } = this.#camera.ray(x, y);
    const { ahead } = this.#axes();
    this.#position = along(origin, direction, this.#depth / Math.max(dot(direction, ahead), 1e-6));
  }

  #axes() {
    return cameraAxes(this.#camera.view.camera, this.#camera.width, this.#camera.height);
  }

  // 3D: does the ray meet the fluid? Sets the tool's plane there.
  #meet({ x, y }: Place): boolean {
    const source = this.source();
    const { origin, direction } = this.#camera.ray(x, y);
    const distance = source ? pickFluid(source, origin, direction) : null;
    this.#onFluid = distance !== null;
    if (distance !== null) this.#depth = distance * dot(direction, this.#axes().ahead);
    return this.#onFluid;
  }

  #press(event: PointerEvent): void {
    const place = { x: event.clientX, y: event.clientY };
    (document.activeElement as HTMLElement | null)?.blur?.(); // keys go to the fluid again
    event.preventDefault();
    this.#down.set(event.pointerId, place);
    try {
      this.#element.setPointerCapture(event.pointerId);
    } catch {
      // a synthetic event has no pointer to capture
    }
    if (this.#down.size > 1) {
      if (this.#isSpace && this.#down.size === 2) this.#begin('pinch', event.pointerId);
      return; // in 2D the first finger leads
    }
    this.#mouse = place;
    this.#begin(this.#gestureOf(event, place), event.pointerId);
    if (this.#gesture !== 'tool') return;
    this.#kind = kinds[this.settings.tool];
    if (event.button === 2) this.#kind = ToolKind.pull;
    if (this.#isSpace ? event.altKey : event.shiftKey) this.#kind = ToolKind.stir;
    if (event.ctrlKey || event.metaKey) this.#kind = ToolKind.push;
    this.#place(place);
    this.#last = this.#position;
    this.tool.velocity = [0, 0, 0];
  }

  #gestureOf(event: PointerEvent, place: Place): Gesture {
    if (!this.#isSpace) return 'tool';
    if (event.shiftKey || event.button === 1) return 'pan';
    return event.button === 0 && this.#meet(place) ? 'tool' : 'orbit';
  }

  #begin(gesture: Gesture, pointer: number): void {
    this.#gesture = gesture;
    this.#leader = pointer;
    this.#kind = ToolKind.none;
    this.#element.dataset['gesture'] = gesture;
  }

  #move(event: PointerEvent): void {
    const place = { x: event.clientX, y: event.clientY };
    const before = this.#down.get(event.pointerId);
    if (before) {
      if (this.#gesture === 'pinch') this.#pinch(event.pointerId, before, place);
      else if (event.pointerId === this.#leader) this.#drag(before, place);
      this.#down.set(event.pointerId, place);
    } else if (this.#down.size === 0) {
      this.#mouse = place;
      this.#inside = true;
      if (!this.#isSpace) this.#place(place);
    }
  }

  #drag(before: Place, place: Place): void {
    this.#mouse = place;
    if (this.#gesture === 'tool') this.#place(place);
    if (this.#gesture === 'orbit') this.#camera.orbit(place.x - before.x, place.y - before.y);
    if (this.#gesture === 'pan') this.#camera.pan(place.x - before.x, place.y - before.y);
  }

  // One of two fingers moved: their middle shifts, their distance zooms.
  #pinch(pointer: number, before: Place, place: Place): void {
    const other = [...this.#down].find(([id]) => id !== pointer)?.[1];
    if (!other) return;
    this.#camera.pan((place.x - before.x) / 2, (place.y - before.y) / 2);
    const was = Math.hypot(before.x - other.x, before.y - other.y);
    const is = Math.hypot(place.x - other.x, place.y - other.y);
    if (was > 8 && is > 8) this.#camera.zoom(is / was);
  }

  #release(event: PointerEvent): void {
    this.#down.delete(event.pointerId);
    if (event.pointerType !== 'mouse') this.#inside = false;
    if (this.#gesture === 'pinch' && this.#down.size === 1) {
      this.#begin('orbit', [...this.#down.keys()][0] ?? 0); // the finger that stays turns
    } else if (event.pointerId === this.#leader || this.#down.size === 0) {
      this.#begin('none', 0);
    }
  }

  #wheel(event: WheelEvent): void {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    const factor = Math.exp(-0.0012 * lines * event.deltaY);
    if (this.#isSpace && !event.ctrlKey && !event.altKey) this.#camera.zoom(factor);
    else this.setRadius(this.settings.radius * factor);
  }

  // Largest useful radius: half of the domain's shortest side.
  get limits(): [number, number] {
    const { min, max } = this.#camera.domain;
    const side = Math.min(...[0, 1, 2].slice(0, this.#camera.dimension).map((k) => (max[k] ?? 1) - (min[k] ?? 0)));
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
    if (this.#isSpace && this.#gesture === 'none') this.#hover();
    if (seconds > 0) {
      const weight = 1 - Math.exp(-seconds / 0.04); // pointer events are jerky: average over 40 ms
      for (let k = 0; k < 3; k++) {
        const now = ((this.#position[k] ?? 0) - (this.#last[k] ?? 0)) / seconds;
        tool.velocity[k] = (tool.velocity[k] ?? 0) + weight * (now - (tool.velocity[k] ?? 0));
      }
      this.#last = [...this.#position];
    }
    const acts = this.#kind !== ToolKind.none;
    tool.kind = this.#kind;
    tool.position = [...this.#position];
    tool.radius = settings.radius;
    tool.strength = settings.strength * (this.#kind === ToolKind.stir ? stirRate : pushAcceleration);
    const shown = acts || (this.#gesture === 'none' && this.#inside && (!this.#isSpace || this.#onFluid));
    view.toolPosition = [...this.#position];
    view.toolRadius = shown ? settings.radius : 0;
    view.toolPressed = acts ? 1 : 0;
  }

  #hover(): void {
    const now = performance.now();
    if (!this.#inside || now - this.#hovered < hoverMs) return;
    this.#hovered = now;
    if (this.#meet(this.#mouse)) this.#place(this.#mouse);
    this.#element.dataset['over'] = this.#onFluid ? 'fluid' : 'space';
  }
}
