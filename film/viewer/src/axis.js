// Axes of charts: what range they have, and the marks on them.

/** What single precision leaves of a number that is constant. */
const ROUND_OFF = 4e-7;
/** The same of a length, over the size of the mechanism, and of an angle (rad), about zero. */
const NOISE = 1e-9;

/** The range of an axis for values from `low` to `high`: of what is constant but for round-off, some room about it. */
export function range(unit, low, high, size) {
  const noise = { m: NOISE * size, rad: NOISE }[unit] ?? 0;
  const largest = Math.max(Math.abs(low), Math.abs(high));
  if (high - low > Math.max(ROUND_OFF * largest, noise)) {
    const slack = 0.08 * (high - low);
    return [low - slack, high + slack];
  }
  const middle = largest > noise ? 0.5 * (low + high) : 0;
  const slack = 0.1 * Math.abs(middle) || 1;
  return [middle - slack, middle + slack];
}

/** Round marks on an axis, and how far one is from the next. */
export function marks(low, high, count) {
  const raw = (high - low) / count || 1;
  const ten = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * ten).find((k) => k >= 0.7 * raw);
  const at = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) at.push(k * step);
  return { at, step };
}

/** A mark as text, in the digits that tell it from the next one. */
export function said(mark, step) {
  if (mark === 0) return "0";
  const figures = Math.max(0, Math.ceil(Math.log10(Math.abs(mark) / step) - 1e-9));
  const size = Math.abs(mark);
  if (size >= 1e5 || size < 1e-3) return mark.toExponential(Math.min(7, figures)).replace(/\.?0+e/, "e");
  return mark.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}
