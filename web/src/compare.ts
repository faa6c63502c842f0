// compare.html: the tutorial's table, measured in this browser. ?counts=200,400 other particle counts,
// ?seconds=0.2 time per measurement, ?run=1 starts at once.
import { Bench } from './compare_bench.ts';
import { cells, headings, solvers, toCsv, toMarkdown, type Result, type Solver } from './compare_rows.ts';
import { drawChart } from './compare_chart.ts';
import { formatCount } from './format.ts';
import { Weir } from './weir.ts';

const query = new URLSearchParams(location.search);
const counts = (query.get('counts') ?? '1000,5000,10000,32768').split(',').map(Number).filter((n) => n >= 1 && n <= 1e6);
const seconds = Number(query.get('seconds')) || 1;
// Before the race: all solvers must compute the same. Small, because plain JavaScript takes part.
const checkedCount = 512;
const checkedSteps = 40;
const checkedViscosity = 50; // Pa s: enough to be seen in the positions
const tolerance = 5e-6; // m; single precision on one side, double on the other

const element = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;
const results: Result[] = [];
let machine = '';

declare global {
  interface Window {
    compare?: { results: Result[]; done: boolean; agreement: number };
  }
}
const state: NonNullable<Window['compare']> = { results, done: false, agreement: NaN };
window.compare = state;

function say(text: string): void {
  element('progress-text').textContent = text;
}

function chosen(): Solver[] {
  return solvers.filter((solver) => element<HTMLInputElement>(`use-${solver.id}`).checked);
}

function addChoices(): void {
  for (const solver of solvers) {
    const label = document.createElement('label');
    const box = document.createElement('input');
    box.type = 'checkbox';
    box.id = `use-${solver.id}`;
    box.checked = true;
    const dot = document.createElement('i');
    dot.style.background = solver.color;
    label.append(box, dot, solver.label);
    element('solvers').append(label);
  }
}

function showTable(): void {
  const head = document.createElement('tr');
  for (const text of headings()) head.append(Object.assign(document.createElement('th'), { textContent: text }));
  const rows = results.map((result) => {
    const row = document.createElement('tr');
    row.dataset['solver'] = result.solver.id;
    row.dataset['count'] = String(result.count);
    for (const text of cells(result)) row.append(Object.assign(document.createElement('td'), { textContent: text }));
    if (result.solver.id === solvers[0]?.id) row.className = 'first';
    return row;
  });
  element('table').replaceChildren(head, ...rows);
  drawChart(element('chart'), results);
}

// Largest distance, over all solvers, of a particle from where the first solver has it.
async function checkAgreement(bench: Bench, list: Solver[]): Promise<void> {
  let reference: Float32Array | null = null;
  let worst = 0;
  for (const solver of list) {
    say(`Checking that all compute the same: ${solver.label}`);
    const positions = await bench.positions(solver, checkedCount, checkedSteps, checkedViscosity);
    reference ??= positions;
    positions.forEach((value, k) => (worst = Math.max(worst, Math.abs(value - (reference?.[k] ?? NaN)))));
  }
  state.agreement = worst;
  const verdict = worst <= tolerance ? 'All solvers compute the same' : 'THE SOLVERS DISAGREE';
  element('agreement').textContent = `${verdict}: after ${checkedSteps} steps of ${checkedCount} particles the positions differ by at most ${worst.toExponential(1)} m.`;
}

async function measureAll(bench: Bench, list: Solver[], gpuTrouble: string): Promise<void> {
  const total = counts.length * list.length;
  for (const count of counts) {
    let baseline = NaN;
    for (const solver of list) {
      if (bench.stopped) return;
      say(`${formatCount(count)} particles: ${solver.label}`);
      element<HTMLProgressElement>('progress').value = results.length / total;
      const result: Result = { count, solver, msPerStep: NaN, note: '', baseline };
      try {
        if (solver.gpu && gpuTrouble) throw new Error(gpuTrouble);
        result.msPerStep = (await bench.measure(solver, count, seconds)).msPerStep;
        if (solver.id === 'javascript') result.baseline = baseline = result.msPerStep;
      } catch (error) {
        result.note = (error as Error).message;
      }
      results.push(result);
      showTable();
    }
  }
}

async function run(bench: Bench): Promise<void> {
  const [start, stop] = [element<HTMLButtonElement>('run'), element<HTMLButtonElement>('stop')];
  start.disabled = true;
  stop.disabled = false;
  bench.stopped = false;
  results.length = 0;
  state.done = false;
  showTable();
  let gpuTrouble = '';
  let gpuName = '';
  try {
    gpuName = await bench.startGpu();
  } catch (error) {
    gpuTrouble = (error as Error).message;
  }
  const day = new Date().toISOString().slice(0, 10);
  machine = `${day}, ${browserName()}, ${navigator.hardwareConcurrency} threads, WebGPU: ${gpuName || gpuTrouble}`;
  element('machine').textContent = machine;
  try {
    await checkAgreement(bench, chosen().filter((solver) => !solver.gpu || !gpuTrouble));
    await measureAll(bench, chosen(), gpuTrouble);
    element<HTMLProgressElement>('progress').value = 1;
    say(bench.stopped ? 'Stopped.' : 'Done.');
  } catch (error) {
    say((error as Error).message);
  }
  state.done = true;
  start.disabled = false;
  stop.disabled = true;
}

function browserName(): string {
  const found = /(Firefox|Edg|Chrome|Version)\/[\d.]+/.exec(navigator.userAgent);
  return found?.[0].replace('Version', 'Safari').replace('Edg/', 'Edge/').replace('/', ' ') ?? 'browser';
}

async function copy(text: string, button: HTMLElement): Promise<void> {
  const label = button.textContent;
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = 'Copied';
    setTimeout(() => (button.textContent = label), 1500);
  } catch {
    // No permission: show it, selected, to copy by hand.
    const area = element<HTMLTextAreaElement>('copied');
    area.value = text;
    area.hidden = false;
    area.select();
  }
}

async function main(): Promise<void> {
  addChoices();
  const url = new URL('weir.wasm', document.baseURI);
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  const module = await WebAssembly.compile(await response.arrayBuffer());
  const bench = new Bench(await Weir.load(module), module);
  element('run').addEventListener('click', () => void run(bench));
  element('stop').addEventListener('click', () => bench.stop());
  element('copy-csv').addEventListener('click', (event) => void copy(toCsv(results), event.currentTarget as HTMLElement));
  element('copy-markdown').addEventListener('click', (event) => void copy(toMarkdown(results, machine), event.currentTarget as HTMLElement));
  element<HTMLButtonElement>('run').disabled = false;
  showTable();
  if (query.get('run')) void run(bench);
}

main().catch((error: Error) => say(`Weir could not start: ${error.message}`));
