// One small chart per probe of the scene, growing with the simulated time.
import { drawChart } from './chart.ts';
import { formatNumber } from './format.ts';
import type { ProbeSeries } from './probes.ts';

const colors = ['#62c4ff', '#4fe0c8', '#ffb454'];
const axes = ['x', 'y', 'z'];
const mostPlots = 3;
const window = 12; // simulated seconds that are shown
const drawMs = 120;

export class ProbePlots {
  readonly #container: HTMLElement;
  #series: readonly ProbeSeries[] = [];
  #canvases: HTMLCanvasElement[] = [];
  #drawn: number[] = [];
  #last = 0;
  visible = true;

  constructor(container: HTMLElement) {
    this.#container = container;
  }

  show(visible: boolean): void {
    this.visible = visible;
    this.#container.classList.toggle('hidden', !visible);
    this.#drawn = [];
  }

  // Once per frame; draws what has changed.
  update(series: readonly ProbeSeries[], now: number): void {
    if (series !== this.#series) this.#rebuild(series);
    if (!this.visible || now - this.#last < drawMs) return;
    this.#last = now;
    this.#canvases.forEach((canvas, k) => {
      const shown = series[k];
      if (!shown || shown.version === this.#drawn[k]) return;
      this.#drawn[k] = shown.version;
      drawProbe(canvas, shown);
    });
  }

  #rebuild(series: readonly ProbeSeries[]): void {
    this.#series = series;
    this.#drawn = [];
    this.#canvases = series.slice(0, mostPlots).map(({ info }) => {
      const canvas = document.createElement('canvas');
      canvas.setAttribute('aria-label', `${info.name}: ${info.kind} over time`);
      return canvas;
    });
    this.#container.replaceChildren(...this.#canvases);
  }
}

function drawProbe(canvas: HTMLCanvasElement, { info, times, values }: ProbeSeries): void {
  const last = times.at(-1) ?? 0;
  const from = Math.max(0, last - window);
  const first = Math.max(times.findIndex((time) => time >= from), 0);
  const x = times.slice(first);
  const several = info.components > 1;
  const newest = values.map((list) => list.at(-1) ?? NaN);
  const size = several ? Math.hypot(...newest) : (newest[0] ?? NaN);
  drawChart(canvas, {
    title: info.name,
    value: Number.isFinite(size) ? `${formatNumber(size)} ${info.unit}` : '–', // nothing is there to measure
    xLabel: 's',
    xRange: [from, Math.max(last, from + 1e-3)],
    curves: values.map((list, k) => ({
      x, y: list.slice(first), color: colors[k] ?? '#fff', ...(several ? { label: axes[k] ?? '' } : {}),
    })),
  });
}
