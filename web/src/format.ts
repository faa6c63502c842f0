// Numbers for people.

const grouped = new Intl.NumberFormat('en-US');

export const formatCount = (value: number): string => grouped.format(Math.round(value));

// About three digits: 12300, 123, 1.23, 0.00123, 1.23e-5.
export function formatNumber(value: number, digits = 3): string {
  if (!Number.isFinite(value)) return String(value);
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(digits - 1).replace('e+', 'e');
  if (size >= 10 ** (digits - 1)) return String(Math.round(value));
  return String(Number(value.toPrecision(digits)));
}

// The next of 1, 2, 5, 10, ... (or of other steps) that is not below `value`.
export function niceCeil(value: number, steps: readonly number[] = [1, 2, 5]): number {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  const part = value / power;
  return (steps.find((step) => part <= step + 0.001) ?? 10) * power;
}
