// SPDX-License-Identifier: Apache-2.0
// IEEE 754 half floats.

const word = new Uint32Array(1);
const real = new Float32Array(word.buffer);

/** Value of the half with these bits. @param {number} bits */
export function halfToFloat(bits) {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31, mantissa = bits & 1023;
  if (exponent === 0) return sign * mantissa * 2 ** -24;
  if (exponent === 31) return mantissa ? NaN : sign * Infinity;
  return sign * (1 + mantissa / 1024) * 2 ** (exponent - 15);
}

const TABLE = new Float32Array(65536);
for (let i = 0; i < 65536; ++i) TABLE[i] = halfToFloat(i);

/** All halves, by their bits. */
export const HALF_VALUES = TABLE;

/**
 * Bits of the nearest half, ties to even. Finite values are clamped to 65504; NaN becomes 0.
 * @param {number} value
 */
export function floatToHalf(value) {
  if (!(Math.abs(value) > 0)) return 0;
  real[0] = Math.max(-65504, Math.min(65504, value));
  const sign = (word[0] >>> 16) & 0x8000;
  const magnitude = word[0] & 0x7fffffff;
  if (magnitude < 0x38800000) {  // below 2^-14: subnormal
    const scaled = Math.abs(real[0]) * 2 ** 24;
    let rounded = Math.floor(scaled);
    const rest = scaled - rounded;
    if (rest > 0.5 || (rest === 0.5 && (rounded & 1))) rounded += 1;
    return sign | rounded;
  }
  const rounded = magnitude - 0x38000000 + 0xfff + ((magnitude >> 13) & 1);
  return sign | (rounded >> 13);
}
