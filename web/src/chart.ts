// A small chart on a canvas: some curves over one quantity, calm and exact.
import { formatNumber, niceCeil } from './format.ts';

export type Curve = {
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  color: string;
  label?: string;
  dots?: boolean; // single points rather than a line
  dashed?: boolean;
};

export type Chart = {
  title: string;
  value?: string; // at the right of the title
  xLabel?: string; // under the axis
  yLabel?: string; // under the title: the curves' names then have a line of their own
  curves: Curve[];
  xRange?: [number, number]; // else what the curves have
};

const axisColor = 'rgba(120,160,215,0.22)';
const textColor = '#8ea3c2';
const titleColor = '#c3d3ea';

type Range = { low: number; high: number };

function rangeOf(curves: Curve[], pick: (curve: Curve) => ArrayLike<number>): Range {
  let [low, high] = [Infinity, -Infinity];
  for (const curve of curves) {
    const values = pick(curve);
    for (let n = 0; n < values.length; n++) {
      const value = values[n] as number;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? { low, high } : { low: 0, high: 0 };
}

// Round ends that differ as they are written; zero stays in where it is near.
export function niceRange({ low, high }: Range): Range {
  if (low === 0 && high === 0) return { low: 0, high: 1 };
  if (low >= 0 && low < 0.6 * high) return { low: 0, high: niceCeil(high * 1.02) };
  if (high <= 0 && high > 0.6 * low) return { low: -niceCeil(-low * 1.02), high: 0 };
  const step = niceCeil(Math.max(high - low, 0.02 * Math.max(Math.abs(low), Math.abs(high), 1e-9)) / 5);
  const from = Math.floor(low / step) * step;
  return { low: from, high: Math.max(Math.ceil(high / step) * step, from + step) };
}

const padding = [10, 7] as const; // CSS pixels around the chart

// The canvas's context in CSS pixels, its store as fine as the screen; null while it is not shown.
export function prepareCanvas(canvas: HTMLCanvasElement): { context: CanvasRenderingContext2D; width: number; height: number } | null {
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const context = canvas.getContext('2d');
  if (!context || width === 0 || height === 0) return null;
  const ratio = devicePixelRatio;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  context.setTransform(ratio, 0, 0, ratio, ratio * padding[0], ratio * padding[1]);
  context.clearRect(-padding[0], -padding[1], width, height);
  context.font = '11px system-ui, sans-serif';
  return { context, width: width - 2 * padding[0], height: height - 2 * padding[1] };
}

export function drawChart(canvas: HTMLCanvasElement, chart: Chart): void {
  const prepared = prepareCanvas(canvas);
  if (!prepared) return;
  const { context, width, height } = prepared;
  const top = chart.yLabel ? 50 : 20;
  const found = rangeOf(chart.curves, (curve) => curve.x);
  const x = chart.xRange ? { low: chart.xRange[0], high: chart.xRange[1] } : found;
  const y = niceRange(rangeOf(chart.curves, (curve) => curve.y));
  header(context, chart, width);
  // The ends of the axis stand left of it, where no curve comes.
  const ends = [formatNumber(y.high), formatNumber(y.low)] as const;
  const left = 6 + Math.max(26, ...ends.map((end) => context.measureText(end).width));
  const box = { left, top, width: width - left - 1, height: height - top - (chart.xLabel ? 18 : 4) };
  context.fillStyle = textColor;
  context.textAlign = 'right';
  context.fillText(ends[0], left - 5, box.top + 9);
  context.fillText(ends[1], left - 5, box.top + box.height);
  context.textAlign = 'left';
  if (chart.xLabel) {
    context.fillText(formatNumber(x.low), box.left, height - 5);
    context.textAlign = 'right';
    context.fillText(`${formatNumber(x.high)} ${chart.xLabel}`, width - 2, height - 5);
    context.textAlign = 'left';
  }
  context.strokeStyle = axisColor;
  context.lineWidth = 1;
  const zero = y.low < 0 && y.high > 0 ? y.high / (y.high - y.low) : 1;
  context.strokeRect(box.left, box.top + zero * box.height, box.width, 0);
  context.strokeRect(box.left, box.top, 0, box.height);
  context.save();
  context.beginPath();
  context.rect(box.left - 1, box.top - 1, box.width + 2, box.height + 2);
  context.clip();
  for (const curve of chart.curves) drawCurve(context, curve, box, x, y);
  context.restore();
}

function header(context: CanvasRenderingContext2D, chart: Chart, width: number): void {
  context.fillStyle = titleColor;
  context.fillText(chart.title, 0, 11, width * 0.7);
  let at = Math.min(context.measureText(chart.title).width, width * 0.7) + 10;
  let y = 11;
  if (chart.yLabel) {
    context.fillStyle = textColor;
    context.fillText(chart.yLabel, 0, 43);
    at = 0;
    y = 27;
  }
  for (const { label, color } of chart.curves) {
    if (!label) continue;
    context.fillStyle = color;
    context.fillText(label, at, y);
    at += context.measureText(label).width + 8;
  }
  if (!chart.value) return;
  context.fillStyle = '#ffffff';
  context.textAlign = 'right';
  context.fillText(chart.value, width - 2, 11);
  context.textAlign = 'left';
}

function drawCurve(
  context: CanvasRenderingContext2D, curve: Curve, box: { left: number; top: number; width: number; height: number }, x: Range, y: Range,
): void {
  const scaleX = box.width / Math.max(x.high - x.low, 1e-12);
  const scaleY = box.height / Math.max(y.high - y.low, 1e-12);
  context.strokeStyle = context.fillStyle = curve.color;
  context.lineWidth = 1.5;
  context.lineJoin = 'round';
  context.setLineDash(curve.dashed ? [4, 3] : []);
  context.beginPath();
  let open = false;
  for (let n = 0; n < Math.min(curve.x.length, curve.y.length); n++) {
    const [at, value] = [curve.x[n] as number, curve.y[n] as number];
    if (!Number.isFinite(value)) {
      open = false; // nothing was there to measure
      continue;
    }
    const [px, py] = [box.left + (at - x.low) * scaleX, box.top + (y.high - value) * scaleY];
    if (curve.dots) {
      context.moveTo(px + 2, py);
      context.arc(px, py, 2, 0, 2 * Math.PI);
    } else if (open) {
      context.lineTo(px, py);
    } else {
      context.moveTo(px, py);
    }
    open = true;
  }
  if (curve.dots) context.fill();
  else context.stroke();
  context.setLineDash([]);
}
