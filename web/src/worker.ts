// The worker: its own instance of the engine, one scene at a time, one answer per frame asked for.
import { CpuRunner } from './cpu_runner.ts';
import type { FromWorker, ToWorker } from './worker_protocol.ts';
import { Status, Weir, WeirError } from './weir.ts';

let runner: Promise<CpuRunner> | null = null;
let run = 0;

const send = (message: FromWorker, transfer: Transferable[] = []): void => postMessage(message, { transfer });
const statusOf = (error: unknown): Status => (error instanceof WeirError ? error.status : Status.device);
const textOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));

function answerFrame(cpu: CpuRunner, message: Extract<ToWorker, { type: 'frame' }>): void {
  const begin = performance.now();
  const values = new Float32Array(message.buffer);
  const { wallSeconds, budgetMs, tool, colorBy, buffer } = message;
  const frame = cpu.frame(wallSeconds, budgetMs, tool, colorBy, values);
  send({ type: 'frame', run, ...frame, busyMs: performance.now() - begin, buffer }, [buffer]);
}

function act(cpu: CpuRunner, message: ToWorker): void {
  if (message.type === 'start') {
    try {
      cpu.start(message.scene, message.from);
      run = message.run;
      const { particles, device, fluidSlots, dimension, probes } = cpu;
      send({ type: 'started', run, particles, device, fluidSlots, dimension, probes });
    } catch (error) {
      send({ type: 'refused', run: message.run, status: statusOf(error), message: textOf(error) });
    }
    return;
  }
  // A frame asked for before a restart: its buffer no longer fits.
  if (message.type === 'frame' && message.run === run) answerFrame(cpu, message);
  if (message.type === 'step') cpu.step(message.count);
  if (message.type === 'set') cpu.setParameter(message.name, message.values);
  if (message.type === 'reset') cpu.reset();
}

addEventListener('message', async (event: MessageEvent<ToWorker>) => {
  const message = event.data;
  if (message.type === 'load') {
    runner = Weir.load(message.module, { gpu: null }).then((weir) => new CpuRunner(weir));
    return;
  }
  try {
    if (runner) act(await runner, message);
  } catch (error) {
    send({ type: 'fault', run, status: statusOf(error), message: textOf(error) });
  }
});
