// SPDX-License-Identifier: Apache-2.0
// sRGB transfer function (IEC 61966-2-1) and colours as #rrggbb.

/** @param {number} v linear */
export const srgbEncode = (v) => v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
/** @param {number} v encoded */
export const srgbDecode = (v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;

/**
 * Display of a linear colour; colours above 1 are divided by their largest channel.
 * @param {number[]} linear
 */
export function hexOfLinear(linear) {
  const largest = Math.max(1, ...linear);
  return "#" + linear.slice(0, 3).map((v) => {
    const byte = Math.round(255 * srgbEncode(Math.max(0, v / largest)));
    return byte.toString(16).padStart(2, "0");
  }).join("");
}

/** @param {string} hex @returns {[number, number, number]} */
export function linearOfHex(hex) {
  const bits = Number.parseInt(hex.slice(1), 16);
  return /** @type {[number, number, number]} */ (
    [bits >> 16, (bits >> 8) & 255, bits & 255].map((v) => Number(srgbDecode(v / 255).toPrecision(5))));
}

/** Viridis colour of 0...1 as CSS text. @param {number[]} table @param {number} t */
export function mapColor(table, t) {
  const at = Math.max(0, Math.min(1, t)) * (table.length - 1);
  const i = Math.min(Math.floor(at), table.length - 2), f = at - i;
  const channel = (/** @type {number} */ shift) =>
      Math.round(((table[i] >> shift) & 255) * (1 - f) + ((table[i + 1] >> shift) & 255) * f);
  return `rgb(${channel(16)} ${channel(8)} ${channel(0)})`;
}
