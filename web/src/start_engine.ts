// Chooses the engine: WebGPU on a real adapter, else the C solver in a worker, else on this thread; and says why.
import type { Engine, FaultHandler } from './engine.ts';
import { GpuEngine } from './engine_gpu.ts';
import { MainEngine } from './engine_main.ts';
import { WorkerEngine } from './engine_worker.ts';
import { KnownCards, pageStore } from './real_time.ts';
import type { Weir } from './weir.ts';

export type Backend = 'auto' | 'gpu' | 'cpu';
export type Chosen = { engine: Engine; reason: string }; // reason: '' or why it is not what was asked for

export type EngineSetup = {
  weir: Weir;
  module: WebAssembly.Module;
  newCanvas: () => HTMLCanvasElement; // a canvas keeps its first kind of context for ever
  onFault: FaultHandler;
};

const answerMs = 10_000;

const words = (error: unknown): string => (error instanceof Error ? error.message : String(error));

// A driver that hangs must not leave the page empty.
const noAnswer = (): Promise<never> =>
  new Promise((_, reject) => setTimeout(() => reject(new Error('WebGPU gives no device.')), answerMs));

export async function startGpu(setup: EngineSetup, allowSoftware: boolean): Promise<GpuEngine> {
  if (!navigator.gpu) throw new Error('This browser has no WebGPU.');
  const cards = new KnownCards(pageStore());
  const gpu = setup.weir.createGpu({ known: cards.device() });
  try {
    await Promise.race([gpu.ready(), noAnswer()]);
    cards.noteDevice(gpu);
    if (gpu.isSoftware && !allowSoftware) {
      throw new Error(`WebGPU has only a software adapter here, ${gpu.device}.`);
    }
    return new GpuEngine(setup.weir, gpu, setup.newCanvas(), setup.onFault);
  } catch (error) {
    gpu.destroy();
    throw error;
  }
}

export function startCpu(setup: EngineSetup): Engine {
  try {
    return new WorkerEngine(setup.weir, setup.module, setup.newCanvas(), setup.onFault);
  } catch {
    return startMain(setup);
  }
}

export const startMain = (setup: EngineSetup): Engine => new MainEngine(setup.weir, setup.newCanvas(), setup.onFault);

export async function startEngine(setup: EngineSetup, backend: Backend): Promise<Chosen> {
  if (backend === 'cpu') return { engine: startCpu(setup), reason: '' };
  try {
    return { engine: await startGpu(setup, backend === 'gpu'), reason: '' };
  } catch (error) {
    return { engine: startCpu(setup), reason: words(error) };
  }
}
