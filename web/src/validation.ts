// validation.html: choose a case, watch it, see what is measured grow over the reference, and how the gates judge.
// ?case=NAME, ?resolution=coarse|normal|fine, ?solver=gpu|cpu, ?run=1 starts at once.
import { drawChart, type Curve } from './chart.ts';
import { CpuPicture } from './engine_cpu.ts';
import { formatNumber, niceCeil } from './format.ts';
import { KnownCards, pageStore } from './real_time.ts';
import { GateKind, resolutions, validationCases, type CaseInfo, type CurveData, type Gate, type Resolution } from './validation_api.ts';
import type { FromValidator, Solver, ToValidator } from './validation_worker.ts';
import { Camera, watchSize } from './view.ts';
import { Weir } from './weir.ts';

const element = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;
const query = new URLSearchParams(location.search);
const colors = ['#62c4ff', '#4fe0c8', '#ffb454', '#c79bff', '#ff8f8f', '#9be06a'];
const firstCase = 'dam_break'; // that visitors see
const referenceColor = '#e8f1ff';

export type ValidationState = {
  running: boolean; device: string; caseName: string; curves: CurveData[]; gates: Gate[]; passed: boolean | null; time: number; frames: number;
};
declare global {
  interface Window {
    validation?: ValidationState; // for tests
  }
}

class ValidationPage {
  readonly state: ValidationState = { running: false, device: '', caseName: '', curves: [], gates: [], passed: null, time: 0, frames: 0 };
  readonly #weir: Weir;
  readonly #cases: CaseInfo[];
  readonly #worker: Worker;
  readonly #camera = new Camera();
  readonly #verdicts = new Map<string, boolean>();
  #picture: CpuPicture | null = null;
  #canvas: HTMLCanvasElement | null = null;
  #chosen: CaseInfo;
  #job = 0;
  #plots: HTMLCanvasElement[] = [];
  #label = '';
  #changed = false; // since it was last drawn
  #fastest = 0; // square of the fluid's largest speed in this run

  constructor(weir: Weir, module: WebAssembly.Module) {
    this.#weir = weir;
    this.#cases = validationCases(weir);
    this.#chosen = this.#cases.find(({ name }) => name === query.get('case')) ?? this.#cases.find(({ name }) => name === firstCase) ?? (this.#cases[0] as CaseInfo);
    this.#worker = new Worker(new URL('./validation_worker.ts', import.meta.url), { type: 'module', name: 'validation' });
    this.#worker.onmessage = (event: MessageEvent<FromValidator>) => this.#receive(event.data);
    this.#worker.onerror = (event) => this.#say(event.message || 'the worker could not be loaded');
    this.#send({ type: 'load', module, known: new KnownCards(pageStore()).device() });
    this.#listCases();
    this.#listResolutions();
    watchSize(element('stage'), (width, height, ratio) => {
      Object.assign(this.#camera, { width, height, pixelRatio: ratio });
      this.#camera.fit({ left: 14, right: 14, top: 14, bottom: 14 });
      this.#changed = true;
    });
    element('run').addEventListener('click', () => this.run());
    element('stop').addEventListener('click', () => this.stop('stopped'));
    requestAnimationFrame(this.#draw);
    this.#choose(this.#chosen);
  }

  // The worker knows by now what there is to compute on: WebGPU first where a real graphics card does it.
  #ready({ gpu, isSoftware }: Extract<FromValidator, { type: 'ready' }>): void {
    const select = element<HTMLSelectElement>('solver');
    select.replaceChildren(new Option('C on the CPU', 'cpu'));
    if (gpu) select.prepend(new Option(isSoftware ? 'WebGPU (in software)' : 'WebGPU', 'gpu'));
    select.title = gpu || 'This browser gives no WebGPU to workers.';
    const wanted = query.get('solver');
    select.value = wanted === 'cpu' || !gpu ? 'cpu' : wanted === 'gpu' || !isSoftware ? 'gpu' : 'cpu';
    select.disabled = false;
    element<HTMLButtonElement>('run').disabled = false;
    if (query.get('run')) this.run();
  }

  #send(message: ToValidator): void {
    this.#worker.postMessage(message);
  }

  #listCases(): void {
    element('cases').replaceChildren(...this.#cases.map((info) => {
      const button = document.createElement('button');
      const dot = document.createElement('i');
      button.append(dot, info.title);
      button.dataset['case'] = info.name;
      button.addEventListener('click', () => {
        this.stop('');
        this.#choose(info);
      });
      return button;
    }));
  }

  #listResolutions(): void {
    const select = element<HTMLSelectElement>('resolution');
    select.replaceChildren(...resolutions.map((name) => new Option(name, name)));
    const wanted = query.get('resolution') as Resolution | null;
    select.value = wanted && resolutions.includes(wanted) ? wanted : 'coarse';
  }

  #choose(info: CaseInfo): void {
    this.#chosen = info;
    element('case-title').textContent = info.title;
    element('case-summary').textContent = info.summary;
    element('case-source').textContent = info.source;
    element('stage').replaceChildren();
    element('plots').replaceChildren();
    element('verdict').replaceChildren();
    this.#picture?.renderer.destroy();
    this.#picture = null;
    this.#plots = [];
    Object.assign(this.state, { caseName: info.name, curves: [], gates: [], passed: null, time: 0, frames: 0 });
    this.#say('');
    this.#mark();
  }

  // The dots of the list.
  #mark(): void {
    for (const button of element('cases').querySelectorAll<HTMLButtonElement>('button')) {
      const name = button.dataset['case'] ?? '';
      const verdict = this.#verdicts.get(name);
      const here = name === this.#chosen.name;
      if (here && button.getAttribute('aria-current') !== 'true') reveal(button);
      button.setAttribute('aria-current', String(here));
      const dot = button.querySelector('i') as HTMLElement;
      dot.className = here && this.state.running ? 'running' : verdict === undefined ? '' : verdict ? 'passed' : 'failed';
    }
    element('run').hidden = this.state.running;
    element('stop').hidden = !this.state.running;
  }

  #say(text: string): void {
    element('progress-text').textContent = text;
  }

  run(): void {
    this.#choose(this.#chosen);
    this.state.running = true;
    const resolution = element<HTMLSelectElement>('resolution').value as Resolution;
    const solver = element<HTMLSelectElement>('solver').value as Solver;
    this.#send({ type: 'start', job: ++this.#job, caseIndex: this.#chosen.index, resolution, solver });
    this.#say('starting');
    this.#go();
    this.#mark();
  }

  stop(words: string): void {
    if (!this.state.running) return;
    this.state.running = false;
    this.#job++;
    this.#send({ type: 'stop' });
    this.#say(words);
    this.#mark();
  }

  #go(): void {
    this.#send({ type: 'go', job: this.#job, colorBy: this.#camera.view.colorBy });
  }

  #receive(message: FromValidator): void {
    if (message.type === 'ready') return this.#ready(message);
    if (message.job !== this.#job) return;
    if (message.type === 'run') {
      this.#showRun(message);
    } else if (message.type === 'frame') {
      this.#picture?.setValues(message.values);
      this.#stretchColors(message.values);
      this.#changed = true;
      element<HTMLProgressElement>('progress').value = message.progress;
      this.state.time = message.time;
      this.state.frames++;
      this.#say(`${this.#label}${formatNumber(message.time, 3)} s simulated`);
      if (message.curves) this.#showCurves(message.curves);
      this.#go();
    } else if (message.type === 'idle') {
      this.#go();
    } else if (message.type === 'judged') {
      this.#judged(message);
    } else {
      this.stop(message.message);
    }
  }

  #showRun({ run, runs, scene, particles, fluidSlots, device }: Extract<FromValidator, { type: 'run' }>): void {
    this.state.device = device;
    this.#label = `run ${run + 1} of ${runs.length}, ${runs[run]?.label ?? ''}: `;
    if (!this.#picture) {
      this.#canvas = document.createElement('canvas');
      element('stage').replaceChildren(this.#canvas);
      this.#picture = new CpuPicture(this.#weir, this.#canvas);
    }
    this.#picture.setScene(scene, particles, fluidSlots, []);
    const loaded = this.#weir.loadScene(scene);
    const { view } = this.#camera;
    this.#camera.setDomain(loaded.domain, loaded.dimension);
    view.particleRadius = (loaded.dimension === 3 ? 0.6 : 0.5) * (loaded.parameter('particle_spacing')[0] ?? 0.01);
    this.#fastest = 0;
    loaded.destroy();
  }

  // The fastest fluid so far has the map's last colour.
  #stretchColors(values: Float32Array): void {
    const { dimension, view } = this.#camera;
    const count = values.length / (2 * dimension + 2);
    for (let i = 0; i < count; i++) {
      if (values[(2 * dimension + 1) * count + i] !== 0) continue;
      let square = 0;
      for (let k = 0; k < dimension; k++) square += (values[dimension * (count + i) + k] ?? 0) ** 2;
      if (square > this.#fastest) this.#fastest = square;
    }
    view.colorMax = niceCeil(Math.max(Math.sqrt(this.#fastest), 1e-9));
  }

  readonly #draw = (): void => {
    requestAnimationFrame(this.#draw);
    const canvas = this.#canvas;
    if (!canvas || !this.#picture || !this.#changed) return;
    this.#changed = false;
    if (canvas.width !== this.#camera.width) canvas.width = this.#camera.width;
    if (canvas.height !== this.#camera.height) canvas.height = this.#camera.height;
    this.#picture.draw(this.#camera.view);
  };

  #showCurves(curves: CurveData[]): void {
    this.state.curves = curves;
    const plots = [...new Set(curves.map((curve) => curve.plot))];
    while (this.#plots.length < plots.length) {
      const canvas = document.createElement('canvas');
      element('plots').append(canvas);
      this.#plots.push(canvas);
    }
    plots.forEach((plot, k) => {
      const canvas = this.#plots[k] as HTMLCanvasElement;
      canvas.setAttribute('aria-label', plot);
      drawPlot(canvas, plot, curves.filter((curve) => curve.plot === plot));
    });
  }

  #judged({ passed, gates, curves, error }: Extract<FromValidator, { type: 'judged' }>): void {
    Object.assign(this.state, { running: false, gates, passed });
    this.#verdicts.set(this.#chosen.name, passed);
    this.#showCurves(curves);
    element<HTMLProgressElement>('progress').value = 1;
    const judged = gates.filter((gate) => gate.kind !== GateKind.reported);
    const good = judged.filter((gate) => gate.passed).length;
    this.#say(error || `${good} of ${judged.length} gates passed`);
    element('verdict').replaceChildren(gateTable(gates));
    this.#mark();
  }
}

// Scrolls the list so that the button is seen; scrollIntoView() would move the page too.
function reveal(button: HTMLElement): void {
  const list = element('cases');
  const [outer, inner] = [list.getBoundingClientRect(), button.getBoundingClientRect()];
  if (inner.top < outer.top || inner.bottom > outer.bottom) list.scrollTop += inner.top - outer.top - outer.height / 2;
  if (inner.left < outer.left || inner.right > outer.right) list.scrollLeft += inner.left - outer.left - 16;
}

// Measured curves in colours, each reference in white: points where it has few, else dashed.
function drawPlot(canvas: HTMLCanvasElement, title: string, curves: CurveData[]): void {
  const first = curves[0];
  if (!first) return;
  const firstReference = curves.find((curve) => curve.isReference);
  let color = 0;
  const drawn = curves.map((curve): Curve => ({
    x: curve.x, y: curve.y,
    ...(curve.isReference && curve !== firstReference ? {} : { label: curve.isReference ? 'reference' : curve.name }),
    color: curve.isReference ? referenceColor : (colors[color++ % colors.length] ?? referenceColor),
    ...(curve.isReference ? (curve.x.length < 40 ? { dots: true } : { dashed: true }) : {}),
  }));
  drawn.sort((a, b) => Number(a.color === referenceColor) - Number(b.color === referenceColor));
  const unit = (name: string): string => (name === '1' || name === '' ? '' : ` (${name})`);
  drawChart(canvas, { title, xLabel: `${first.xName}${unit(first.xUnit)}`, yLabel: `${first.yName}${unit(first.yUnit)}`, curves: drawn });
}

function demand({ kind, limit, reference, unit }: Gate): string {
  const suffix = unit === '1' || unit === '' ? '' : ` ${unit}`;
  if (kind === GateKind.atMost) return `at most ${formatNumber(limit)}${suffix}`;
  if (kind === GateKind.atLeast) return `at least ${formatNumber(limit)}${suffix}`;
  if (kind === GateKind.relative) return `${formatNumber(reference, 4)}${suffix} ± ${formatNumber(100 * limit)} %`;
  return '';
}

function gateTable(gates: Gate[]): HTMLTableElement {
  const table = document.createElement('table');
  const head = table.createTHead().insertRow();
  for (const text of ['', 'measured', 'value', 'gate']) head.append(Object.assign(document.createElement('th'), { textContent: text }));
  const body = table.createTBody();
  for (const gate of gates) {
    const row = body.insertRow();
    const reported = gate.kind === GateKind.reported;
    row.className = reported ? '' : gate.passed ? 'passed' : 'failed';
    const verdict = document.createElement('b');
    verdict.textContent = reported ? '' : gate.passed ? 'pass' : 'fail';
    row.insertCell().append(verdict);
    row.insertCell().textContent = gate.name;
    const value = row.insertCell();
    value.className = 'number';
    value.textContent = `${formatNumber(gate.value)}${gate.unit === '1' ? '' : ` ${gate.unit}`}`;
    row.insertCell().textContent = demand(gate);
  }
  return table;
}

async function main(): Promise<void> {
  const response = await fetch(new URL('weir.wasm', document.baseURI));
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  const module = await WebAssembly.compile(await response.arrayBuffer());
  const weir = await Weir.load(module, { gpu: null });
  window.validation = new ValidationPage(weir, module).state;
}

main().catch((error: unknown) => {
  element('progress-text').textContent = `Weir could not start: ${error instanceof Error ? error.message : String(error)}`;
});
