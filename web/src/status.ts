// The status line: what runs, where, how fast and how true. Averages over about a second, written four times a second.
import { isCompressed, isFast, type Engine, type EngineStats } from './engine.ts';
import { formatCount, formatNumber } from './format.ts';

const windowMs = 1000;
const writeMs = 250;

const solverNames = { gpu: 'WebGPU', worker: 'C on the CPU', main: 'C on the CPU' } as const;
export const solverName = (engine: Engine): string => solverNames[engine.kind];

type Cell = { value: string; label: string; className: string; title: string };

export class StatusLine {
  readonly #numbers: HTMLElement;
  readonly #details: HTMLElement;
  #since = 0;
  #sinceTime = 0;
  #sinceSteps = 0;
  #sinceFrames = 0;
  #written = 0;
  fps = 0;
  realTimeFactor = 0;
  stepsPerFrame = 0;
  reason = ''; // why the engine is not the one that was asked for

  constructor(root: HTMLElement) {
    this.#numbers = root.querySelector('#numbers') as HTMLElement;
    this.#details = root.querySelector('#details') as HTMLElement;
  }

  // Another run: averages start anew.
  restart(now: number, engine: Engine): void {
    this.#since = now;
    this.#sinceTime = engine.stats.time;
    this.#sinceSteps = engine.stats.steps;
    this.#sinceFrames = engine.stats.frames;
  }

  update(now: number, engine: Engine, paused: boolean): void {
    const { stats } = engine;
    const wall = now - this.#since;
    // A picture that stands still is hardly drawn: the rates are those from before.
    const held = paused && this.fps > 0;
    if (held || stats.time < this.#sinceTime || stats.frames < this.#sinceFrames) this.restart(now, engine);
    else if (wall >= windowMs || (this.fps === 0 && wall >= windowMs / 4)) {
      const frames = stats.frames - this.#sinceFrames;
      this.fps = (1000 * frames) / wall;
      this.realTimeFactor = (1000 * (stats.time - this.#sinceTime)) / wall;
      this.stepsPerFrame = frames > 0 ? (stats.steps - this.#sinceSteps) / frames : 0;
      this.restart(now, engine);
    }
    if (now - this.#written < writeMs) return;
    this.#written = now;
    this.#write(engine, paused);
  }

  // In place, so that what the pointer rests on stays.
  #show(cells: Cell[]): void {
    const list = this.#numbers;
    while (list.children.length > cells.length) list.lastElementChild?.remove();
    cells.forEach(({ value, label, className, title }, k) => {
      const span = list.children[k] ?? list.appendChild(document.createElement('span'));
      const bold = span.firstElementChild ?? document.createElement('b');
      bold.textContent = value;
      span.className = className;
      if (title) span.setAttribute('title', title);
      else span.removeAttribute('title');
      span.replaceChildren(bold, label ? ` ${label}` : '');
    });
  }

  // What tells whether the numbers are to be trusted.
  #methodCells({ clock, diagnostics, warning }: EngineStats): Cell[] {
    if (!clock) {
      return [
        cell(formatNumber(this.stepsPerFrame, 2), 'steps/frame'),
        cell(diagnostics ? `${formatNumber(100 * diagnostics.densityErrorMean, 2)} %` : '–', 'density error', '', 'The mean of all particles'),
      ];
    }
    const { timeStep, machNumber, maxDensityError } = clock;
    return [
      cell(`${formatNumber(1000 * timeStep, 3)} ms`, 'time step'),
      cell(formatNumber(machNumber, 2), 'Mach', isFast(clock) ? 'slow' : '', advised('Of the fastest particle: its speed over the speed of sound', warning)),
      cell(`${formatNumber(100 * maxDensityError, 2)} %`, 'density error', isCompressed(clock) ? 'slow' : '', advised('The largest of all particles', warning)),
    ];
  }

  #write(engine: Engine, paused: boolean): void {
    const { stats } = engine;
    const cells = [
      cell(formatCount(stats.clock?.fluidParticles || stats.particles), 'particles'),
      cell(this.fps < 10 ? formatNumber(this.fps, 2) : String(Math.round(this.fps)), 'FPS'),
      paused
        ? cell('paused', `at ${stats.time.toFixed(3)} s`)
        : cell(`${this.realTimeFactor.toFixed(2)}×`, 'real time', this.realTimeFactor < 0.5 ? 'slow' : ''),
      ...this.#methodCells(stats),
      cell(solverName(engine), '', '', engine.kind === 'gpu' ? '' : this.reason),
    ];
    this.#show(cells);
    const passes = stats.passes.map((pass) => `${pass.name} ${formatNumber(pass.milliseconds, 2)}`);
    const timing = passes.length > 0 ? `ms per pass: ${passes.join(' · ')}` : `${formatNumber(stats.stepMs, 2)} ms per step`;
    const drawing = stats.drawMs > 0 ? `   ·   ${formatNumber(stats.drawMs, 2)} ms to draw` : '';
    this.#details.textContent = `${engine.device}   ·   ${timing}${drawing}   ·   ${formatNumber(this.stepsPerFrame, 2)} steps per frame   ·   ${stats.time.toFixed(2)} s simulated`;
  }
}

const advised = (title: string, warning: string): string => (warning ? `${title}\n\n${warning}` : title);

const cell = (value: string, label: string, className = '', title = ''): Cell => ({ value, label, className, title });
