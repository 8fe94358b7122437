// SPDX-License-Identifier: Apache-2.0
// Scale and legend of false colours, as in src/image/false_color.cpp.

/** @typedef {{low: number, high: number, logarithmic: boolean}} Scale */

const SHARE_OUTSIDE = 0.01;  // of the values, above the scale

/** The nearest 1, 2 or 5 times a power of ten above or below a value. @param {number} value @param {boolean} up */
export function roundNumber(value, up) {
  const decade = 10 ** Math.floor(Math.log10(value));
  const digit = value / decade, slack = 1.0001;
  let found = up ? 10 : 1;
  for (const d of [1, 2, 5, 10])
    if (up ? d * slack >= digit && d < found : d <= digit * slack) found = d;
  return Number((found * decade).toPrecision(12));  // 0.05, not 0.05000000000000001
}

/** Scale that contains 99 % of the values. @param {number[]} values @param {boolean} logarithmic @returns {Scale} */
export function scaleOf(values, logarithmic) {
  const sorted = values.filter((v) => Number.isFinite(v) && v > 0).sort((a, b) => a - b);
  if (sorted.length === 0) return {low: logarithmic ? 0.1 : 0, high: 1, logarithmic};
  const at = (/** @type {number} */ share) => sorted[Math.floor(share * (sorted.length - 1))];
  const high = roundNumber(at(1 - SHARE_OUTSIDE), true);
  const low = logarithmic ? Math.min(roundNumber(at(SHARE_OUTSIDE), false), high / 10) : 0;
  return {low, high, logarithmic};
}

/** Position of a value, 0...1. @param {Scale} s @param {number} value */
export function scalePosition(s, value) {
  const t = s.logarithmic ? Math.log(Math.max(value, s.low) / s.low) / Math.log(s.high / s.low)
                          : (value - s.low) / (s.high - s.low);
  return Math.max(0, Math.min(1, t));
}

/** @param {Scale} s @returns {number[]} */
function linearTicks(s) {
  const step = roundNumber((s.high - s.low) / 8, true), slack = step * 1e-3;
  const ticks = [];
  for (let i = Math.ceil((s.low - slack) / step); i * step <= s.high + slack; ++i) ticks.push(Number((i * step).toPrecision(12)));
  return ticks;
}

/** Values with a mark in the legend. @param {Scale} s @returns {number[]} */
export function scaleTicks(s) {
  const decades = s.logarithmic ? Math.log10(s.high / s.low) : 0;
  if (decades < 1) return linearTicks(s);
  const first = Math.floor(Math.log10(s.low)), last = Math.ceil(Math.log10(s.high));
  const stride = Math.max(1, Math.round(decades / 8));
  const ticks = [];
  for (let e = first; e <= last; ++e)
    for (const digit of [1, 2, 5]) {
      if (digit > 1 && decades > 3) continue;
      if (digit === 1 && (e - first) % stride !== 0) continue;
      const value = digit * 10 ** e;
      if (value >= s.low * 0.999 && value <= s.high * 1.001) ticks.push(value);
    }
  return ticks;
}

/** @param {number} value */
export function tickText(value) {
  const four = (/** @type {number} */ v) => String(Number(v.toPrecision(4)));
  if (Math.abs(value) >= 1e6) return `${four(value * 1e-6)}M`;
  if (Math.abs(value) >= 1e4) return `${four(value * 1e-3)}k`;
  return four(value);
}
