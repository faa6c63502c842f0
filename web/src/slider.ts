// A slider beside a Tweakpane number: logarithmic where the range spans decades. The number itself takes any value,
// so that the core can say what is wrong with it.

export type SliderRange = { low: number; high: number; log: boolean; fromZero: boolean };

// The useful part of an allowed range around a usual value.
export function sliderRange(usual: number, minimum: number, maximum: number): SliderRange {
  if (minimum === 0 && maximum <= 1) return { low: minimum, high: maximum, log: false, fromZero: false };
  const middle = usual > 0 ? usual : 1;
  const low = Math.max(minimum, middle / 20);
  return { low, high: Math.min(maximum, middle * 20), log: true, fromZero: minimum <= 0 };
}

const steps = 1000;

export function toValue(position: number, range: SliderRange): number {
  const share = position / steps;
  if (!range.log) return range.low + share * (range.high - range.low);
  if (range.fromZero && position === 0) return 0;
  return Number((range.low * (range.high / range.low) ** share).toPrecision(3));
}

export function toPosition(value: number, range: SliderRange): number {
  const share = range.log
    ? value > 0 ? Math.log(value / range.low) / Math.log(range.high / range.low) : 0
    : (value - range.low) / (range.high - range.low);
  return Math.round(steps * Math.min(Math.max(share, 0), 1));
}

// Adds the slider to a binding's row. `set` gets each new value; the returned function moves the knob.
export function addSlider(row: HTMLElement, label: string, range: SliderRange, set: (value: number) => void): (value: number) => void {
  const input = document.createElement('input');
  input.type = 'range';
  input.min = '0';
  input.max = String(steps);
  input.setAttribute('aria-label', label);
  input.dataset['name'] = label;
  input.addEventListener('input', () => set(toValue(Number(input.value), range)));
  const place = row.querySelector('.tp-lblv_v');
  place?.prepend(input);
  row.classList.add('slider-row');
  return (value) => {
    input.value = String(toPosition(value, range));
    input.setAttribute('aria-valuetext', String(value));
  };
}
