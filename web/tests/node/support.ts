// What the Node tests share: the build's files and Dawn's navigator.gpu.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { create, globals } from 'webgpu';

export const root = process.env.WEIR_ROOT as string;
export const wasmFile = (name: string): Uint8Array<ArrayBuffer> =>
  new Uint8Array(readFileSync(join(process.env.WEIR_WASM_DIR as string, 'apps/web', name)));

Object.assign(globalThis, globals);

// One GPU object for the process: Dawn wants it kept alive as long as anything that came from it.
export const gpu: GPU = Object.assign(create([]), { getPreferredCanvasFormat: () => 'bgra8unorm' as const });

export const nextTurn = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 1));

// Repeats `probe` over turns of the event loop until it gives something.
export async function until<T>(probe: () => T | null | undefined | false, what: string): Promise<T> {
  const end = Date.now() + 60_000;
  while (Date.now() < end) {
    const found = probe();
    if (found) return found;
    await nextTurn();
  }
  throw new Error(`${what}: nothing happened for 60 s`);
}

// A canvas as the layer needs one: its textures come from Dawn, and `shown` is the last of them.
export function fakeCanvas(): OffscreenCanvas {
  let configured: GPUCanvasConfiguration | null = null;
  const canvas = { width: 300, height: 150, getContext, shown: null as GPUTexture | null };
  const context = {
    configure(configuration: GPUCanvasConfiguration) {
      configured = configuration;
    },
    unconfigure() {
      configured = null;
    },
    getCurrentTexture(): GPUTexture {
      if (!configured) throw new Error('the canvas is not configured');
      const { device, format, usage = GPUTextureUsage.RENDER_ATTACHMENT } = configured;
      const size = [canvas.width, canvas.height];
      canvas.shown = device.createTexture({ format, usage: usage | GPUTextureUsage.COPY_SRC, size });
      return canvas.shown;
    },
  };
  function getContext(kind: string) {
    return kind === 'webgpu' ? context : null;
  }
  return canvas as unknown as OffscreenCanvas;
}
