// Bars of steps per second on a logarithmic axis, longer is faster, as HTML.
import { framesPerSecond, type Result } from './compare_rows.ts';
import { formatCount, formatNumber } from './format.ts';

function bar(result: Result, low: number, high: number): HTMLElement {
  const row = document.createElement('div');
  row.className = 'bar';
  const rate = framesPerSecond(result);
  const name = Object.assign(document.createElement('span'), { textContent: result.solver.label });
  const track = document.createElement('div');
  const fill = document.createElement('i');
  const share = Number.isFinite(rate) ? Math.log(rate / low) / Math.log(high / low) : 0;
  fill.style.width = `${100 * Math.max(share, 0.003)}%`;
  fill.style.background = result.solver.color;
  const value = Object.assign(document.createElement('b'), { textContent: Number.isFinite(rate) ? formatNumber(rate) : '–' });
  track.append(fill, value);
  row.append(name, track);
  return row;
}

export function drawChart(container: HTMLElement, results: Result[]): void {
  const rates = results.map(framesPerSecond).filter(Number.isFinite);
  if (rates.length === 0) return container.replaceChildren();
  const low = 10 ** Math.floor(Math.log10(Math.min(...rates)) - 0.01);
  const high = 10 ** Math.ceil(Math.log10(Math.max(...rates)) + 0.01);
  const groups = [...new Set(results.map((result) => result.count))].map((count) => {
    const group = document.createElement('section');
    group.append(Object.assign(document.createElement('h3'), { textContent: `${formatCount(count)} particles` }));
    for (const result of results) if (result.count === count) group.append(bar(result, low, high));
    return group;
  });
  const caption = Object.assign(document.createElement('p'), {
    textContent: `Steps per second, logarithmic from ${formatNumber(low)} to ${formatCount(high)}. Longer is faster.`,
  });
  container.replaceChildren(caption, ...groups);
}
