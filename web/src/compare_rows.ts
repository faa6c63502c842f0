// What compare.html measures, and how the results are written.
import { article } from './all_pairs.ts';
import { formatNumber } from './format.ts';

export type SolverId = 'javascript' | 'c_all_pairs' | 'c_grid' | 'gpu_all_pairs' | 'gpu_grid';
export type Solver = { id: SolverId; label: string; color: string; gpu: boolean };

export const solvers: Solver[] = [
  { id: 'javascript', label: 'JavaScript, all pairs', color: '#8296b4', gpu: false },
  { id: 'c_all_pairs', label: 'C in wasm, all pairs', color: '#4f8dff', gpu: false },
  { id: 'c_grid', label: 'C in wasm, grid', color: '#46c3ff', gpu: false },
  { id: 'gpu_all_pairs', label: 'WebGPU, all pairs', color: '#8f7bff', gpu: true },
  { id: 'gpu_grid', label: 'WebGPU, grid', color: '#4fe0c8', gpu: true },
];

export type Result = {
  count: number;
  solver: Solver;
  msPerStep: number; // NaN: not measured
  note: string; // why not
  baseline: number; // milliseconds of plain JavaScript; NaN if it was not measured
};

export const framesPerSecond = (result: Result): number => 1000 / result.msPerStep;
export const speedUp = (result: Result): number => result.baseline / result.msPerStep;
export const realTimeFactor = (result: Result): number => (1000 * article.time_step) / result.msPerStep;

const heads = ['particles', 'solver', 'ms per step', 'FPS at one step per frame', 'speed-up', 'real-time factor'];

const number = (value: number, digits = 3): string => (Number.isFinite(value) ? formatNumber(value, digits) : '–');

export function cells(result: Result): string[] {
  return [
    String(result.count),
    result.solver.label,
    result.note || number(result.msPerStep),
    number(framesPerSecond(result)),
    Number.isFinite(speedUp(result)) ? `${number(speedUp(result))}×` : '–',
    Number.isFinite(realTimeFactor(result)) ? `${number(realTimeFactor(result))}×` : '–',
  ];
}

export const headings = (): string[] => heads;

export function toMarkdown(results: Result[], device: string): string {
  const line = (texts: string[]): string => `| ${texts.join(' | ')} |`;
  const rule = `|${heads.map((_, n) => (n === 1 ? ' --- ' : ' ---: ')).join('|')}|`;
  return [device, '', line(heads), rule, ...results.map((result) => line(cells(result)))].join('\n');
}

export function toCsv(results: Result[]): string {
  const value = (x: number): string => (Number.isFinite(x) ? String(Number(x.toPrecision(6))) : '');
  const rows = results.map((result) =>
    [
      result.count, `"${result.solver.label}"`, value(result.msPerStep), value(framesPerSecond(result)),
      value(speedUp(result)), value(realTimeFactor(result)),
    ].join(','),
  );
  return ['particles,solver,ms_per_step,frames_per_second,speed_up,real_time_factor', ...rows].join('\n');
}
