// SPDX-License-Identifier: Apache-2.0
// White point as a linear colour, from temperature and tint.

// CIE 1931 chromaticity of daylight (CIE 15:2004, section 3.1) from 4000 K, and of black bodies
// (B. Kim et al., "Design of advanced color temperature control system", 2002) below.

/** @param {number} kelvin @returns {[number, number]} x, y */
export function chromaticity(kelvin) {
  const t = Math.max(1700, Math.min(25000, kelvin));
  const i = 1000 / t;
  if (t >= 4000) {
    const x = t <= 7000 ? 0.244063 + 0.09911 * i + 2.9678 * i * i - 4.6070 * i * i * i
                        : 0.237040 + 0.24748 * i + 1.9018 * i * i - 2.0064 * i * i * i;
    return [x, -3 * x * x + 2.870 * x - 0.275];
  }
  const x = 0.179910 + 0.8776956 * i - 0.2343589 * i * i - 0.2661239 * i * i * i;
  const y = t < 2222 ? -1.1063814 * x ** 3 - 1.34811020 * x ** 2 + 2.18555832 * x - 0.20219683
                     : -0.9549476 * x ** 3 - 1.37418593 * x ** 2 + 2.09137015 * x - 0.16748867;
  return [x, y];
}

/**
 * Linear sRGB colour whose largest channel is 1; exactly 1,1,1 at 6504 K without tint.
 * @param {number} kelvin
 * @param {number} tint -1 green ... 1 magenta
 * @returns {[number, number, number]}
 */
export function whitePointOfTemperature(kelvin, tint) {
  if (Math.round(kelvin) === 6504 && tint === 0) return [1, 1, 1];
  const [x, y] = chromaticity(kelvin);
  const yy = y - 0.03 * tint;
  const X = x / yy, Z = (1 - x - yy) / yy;
  const c = [3.2409699 * X - 1.5373832 - 0.4986108 * Z, -0.9692436 * X + 1.8759675 + 0.0415551 * Z,
             0.0556301 * X - 0.2039770 + 1.0569715 * Z].map((v) => Math.max(v, 0.001));
  const largest = Math.max(...c);
  // Six digits, so that the text of the command line has the same value.
  return /** @type {[number, number, number]} */ (c.map((v) => Number((v / largest).toPrecision(6))));
}
