// What all calls of webgpu_imports.ts stand on: the table of objects, texts in wasm memory, and events. What has
// finished waits in its instance's queue until wgpuInstanceProcessEvents() delivers it to C.

// What the C half exports: one function per kind of callback, with (record, status, value, length of the message).
type Callback = (record: number, status: number, value: number, messageLength: number) => void;
export type WebGpuExports = {
  memory: WebAssembly.Memory;
  weir_webgpu_adapter_done: Callback;
  weir_webgpu_device_done: Callback;
  weir_webgpu_status_done: Callback;
  weir_webgpu_scope_done: Callback;
  weir_webgpu_pipeline_done: Callback;
  weir_webgpu_shader_done: Callback;
  weir_webgpu_lost_done: Callback;
  weir_webgpu_error_done: Callback;
  weir_webgpu_forget(record: number): void;
};

export type Kind = 'adapter' | 'device' | 'status' | 'scope' | 'pipeline' | 'shader' | 'lost' | 'error';

// The values of webgpu.h's status enums that all callbacks share, and those of their own.
export const SUCCESS = 1;
export const CANCELLED = 2;
export const UNAVAILABLE = 3; // request adapter
export const ADAPTER_ERROR = 4;
export const FAILED = 3; // the others
export const PIPELINE_INVALID = 3;
export const PIPELINE_FAILED = 4;
export const MAP_ABORTED = 4;
export const LOST_UNKNOWN = 1;
export const LOST_DESTROYED = 2;
export const LOST_CANCELLED = 3;
export const LOST_FAILED_CREATION = 4;
export const ERROR_NONE = 1;
export const ERROR_VALIDATION = 2;
export const ERROR_TYPES: Record<string, number> = {
  GPUValidationError: ERROR_VALIDATION,
  GPUOutOfMemoryError: 3,
  GPUInternalError: 4,
};

export type WebEvent = {
  kind: Kind;
  record: number;
  status: number;
  value: number; // a handle, an error type or a count
  message: string;
  device: DeviceHome | null; // of lost and error
  messages: readonly GPUCompilationMessage[];
};

export type InstanceHome = { open: boolean; pending: Set<WebEvent>; queue: WebEvent[] };
export type DeviceHome = { device: GPUDevice; handle: number; instance: InstanceHome; errorRecord: number };
export type Home = InstanceHome | DeviceHome;

export function reasonText(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

export class WebGpuHost {
  exports!: WebGpuExports;

  // The table of objects; slot 0 is the null handle.
  readonly objects: unknown[] = [undefined];
  readonly references: number[] = [0];
  readonly homes: (Home | null)[] = [null];
  readonly free: number[] = [];

  readonly encoder = new TextEncoder();
  readonly decoder = new TextDecoder();
  heldText = new Uint8Array(0); // what take_text() will copy
  messages: readonly GPUCompilationMessage[] = []; // while a compilation callback runs

  // Labels of each frame's encoders and passes, by address; checked against the bytes at every use.
  readonly labels = new Map<number, { bytes: Uint8Array; text: string }>();
  bytes = new Uint8Array(0);
  words = new Uint32Array(0);

  get liveObjects(): number {
    return this.objects.length - 1 - this.free.length;
  }

  add(object: unknown, home: Home | null): number {
    const handle = this.free.pop() ?? this.objects.length;
    this.objects[handle] = object;
    this.references[handle] = 1;
    this.homes[handle] = home;
    return handle;
  }

  get<T>(handle: number): T {
    return this.objects[handle] as T;
  }

  homeOf(handle: number): DeviceHome {
    return this.homes[handle] as DeviceHome;
  }

  instanceOf(handle: number): InstanceHome {
    const home = this.homes[handle] as Home;
    return 'instance' in home ? home.instance : home;
  }

  release(handle: number): number {
    if (handle === 0) return 0;
    const left = (this.references[handle] as number) - 1;
    this.references[handle] = left;
    if (left > 0) return left;
    const object = this.objects[handle];
    const home = this.homes[handle] ?? null;
    if (home !== null && home === object) this.closeInstance(home as InstanceHome);
    if (home !== null && 'device' in home && home.handle === handle) this.closeDevice(home);
    this.objects[handle] = undefined;
    this.homes[handle] = null;
    this.free.push(handle);
    return 0;
  }

  // The last reference of an instance: what is still under way ends now, so that no callback ever runs with memory
  // that its owner has freed.
  closeInstance(instance: InstanceHome): void {
    instance.open = false;
    for (const event of instance.pending) {
      if (event.kind === 'adapter' || event.kind === 'device') this.release(event.value);
      event.status = event.kind === 'lost' ? LOST_CANCELLED : CANCELLED;
      event.value = 0;
      event.message = 'the instance was released';
      event.messages = [];
      this.deliver(instance, event);
    }
    instance.queue.length = 0;
  }

  closeDevice(home: DeviceHome): void {
    if (home.errorRecord) this.exports.weir_webgpu_forget(home.errorRecord);
    home.errorRecord = 0;
    home.handle = 0;
    home.device.destroy();
  }

  // An import must never throw into C: what the browser refuses becomes an error of the device that the first
  // argument belongs to. Fixed parameters, because rest parameters would make an array per call.
  guard(name: string, call: Function): Function {
    type Numbers = (...values: number[]) => number | void;
    const run = call as Numbers;
    return (a: number, b: number, c: number, d: number, e: number, f: number, g: number, h: number, i: number,
      j: number, k: number, l: number, m: number, n: number): number => {
      try {
        return run(a, b, c, d, e, f, g, h, i, j, k, l, m, n) ?? 0;
      } catch (error) {
        if (error instanceof WebAssembly.RuntimeError) throw error; // C itself failed inside a callback
        this.report(a, `${name}: ${reasonText(error)}`);
        return 0;
      }
    };
  }

  report(handle: number, message: string): void {
    const home = this.homes[handle];
    if (home && 'device' in home) this.queueError(home, ERROR_VALIDATION, message);
  }

  queueError(device: DeviceHome, status: number, message: string): void {
    if (!device.instance.open || device.errorRecord === 0) return;
    device.instance.queue.push({
      kind: 'error', record: device.errorRecord, status, value: 0, message, device, messages: [],
    });
  }

  view(): Uint8Array {
    const buffer = this.exports.memory.buffer;
    if (this.bytes.buffer !== buffer) {
      this.bytes = new Uint8Array(buffer);
      this.words = new Uint32Array(buffer);
    }
    return this.bytes;
  }

  text(at: number, length: number): string {
    return length === 0 ? '' : this.decoder.decode(this.view().subarray(at, at + length));
  }

  entryPoint(at: number, length: number): string | undefined {
    return length === 0 ? undefined : this.text(at, length);
  }

  // The same for labels that come again every frame: decoded once per address, as long as the bytes stay the same.
  label(at: number, length: number): string {
    if (length === 0) return '';
    const view = this.view();
    const known = this.labels.get(at);
    if (known && known.bytes.length === length) {
      let k = 0;
      while (k < length && known.bytes[k] === view[at + k]) k++;
      if (k === length) return known.text;
    }
    if (this.labels.size > 256) this.labels.clear();
    const bytes = view.slice(at, at + length);
    const text = this.decoder.decode(bytes);
    this.labels.set(at, { bytes, text });
    return text;
  }

  hold(text: string): number {
    this.heldText = this.encoder.encode(text);
    return this.heldText.length;
  }

  // -------------------------------------------------------------------------------------------------------
  // Events

  start(instance: InstanceHome, kind: Kind, record: number, device: DeviceHome | null = null): WebEvent {
    const event: WebEvent = { kind, record, status: 0, value: 0, message: '', device, messages: [] };
    if (instance.open) instance.pending.add(event);
    return event;
  }

  // False if nobody waits any more.
  finish(instance: InstanceHome, event: WebEvent, status: number, value = 0, message = ''): boolean {
    if (!instance.pending.has(event)) return false;
    event.status = status;
    event.value = value;
    event.message = message;
    instance.queue.push(event);
    return true;
  }

  deliver(instance: InstanceHome, event: WebEvent): void {
    const length = this.hold(event.message);
    const exports = this.exports;
    instance.pending.delete(event);
    switch (event.kind) {
      case 'adapter': return exports.weir_webgpu_adapter_done(event.record, event.status, event.value, length);
      case 'device': return exports.weir_webgpu_device_done(event.record, event.status, event.value, length);
      case 'status': return exports.weir_webgpu_status_done(event.record, event.status, 0, length);
      case 'scope': return exports.weir_webgpu_scope_done(event.record, event.status, event.value, length);
      case 'pipeline': return exports.weir_webgpu_pipeline_done(event.record, event.status, event.value, length);
      case 'shader':
        this.messages = event.messages;
        exports.weir_webgpu_shader_done(event.record, event.status, event.messages.length, 0);
        this.messages = [];
        return;
      case 'lost':
        return exports.weir_webgpu_lost_done(event.record, event.status, event.device?.handle ?? 0, length);
      case 'error':
        if (event.device?.errorRecord !== event.record) return; // the device was released meanwhile
        return exports.weir_webgpu_error_done(event.record, event.status, event.device.handle, length);
    }
  }

  processEvents(instance: InstanceHome): void {
    // Only what is there now: a callback that fails a call must not keep this loop going for ever.
    for (let left = instance.queue.length; left > 0 && instance.open; left--)
      this.deliver(instance, instance.queue.shift() as WebEvent);
  }
}
