// SPDX-License-Identifier: Apache-2.0
// LDR-FLIP of two display pictures, the same model as src/image/flip.cpp: P. Andersson et al., "FLIP: A
// Difference Evaluator for Alternating Images", 2020, sections 4 and 5.
import {srgbDecode} from "./srgb.js";

export const PIXELS_PER_DEGREE = 67.0206;
const COLOUR_EXPONENT = 0.7, FEATURE_EXPONENT = 0.5, BREAK_SHARE = 0.4, BREAK_ERROR = 0.95;
const FEATURE_WIDTH_DEG = 0.082;

/** @param {number[]} c */
const xyzOf = (c) => [0.4123908 * c[0] + 0.3575843 * c[1] + 0.1804808 * c[2],
                      0.2126390 * c[0] + 0.7151687 * c[1] + 0.0721923 * c[2],
                      0.0193308 * c[0] + 0.1191948 * c[1] + 0.9505322 * c[2]];
/** @param {number[]} c */
const rgbOf = (c) => [3.2409699 * c[0] - 1.5373832 * c[1] - 0.4986108 * c[2],
                      -0.9692436 * c[0] + 1.8759675 * c[1] + 0.0415551 * c[2],
                      0.0556301 * c[0] - 0.2039770 * c[1] + 1.0569715 * c[2]];
const WHITE = xyzOf([1, 1, 1]);

/** Hunt-adjusted L*a*b*. @param {number[]} linear */
function huntLab(linear) {
  const delta = 6 / 29;
  const t = xyzOf(linear).map((v, i) => v / WHITE[i]).map(
      (v) => v > delta ** 3 ? Math.cbrt(v) : v / (3 * delta * delta) + 4 / 29);
  const lightness = 116 * t[1] - 16;
  return [lightness, 5 * lightness * (t[0] - t[1]), 2 * lightness * (t[1] - t[2])];
}

/** @param {number[]} a @param {number[]} b */
const hyab = (a, b) => Math.abs(a[0] - b[0]) + Math.hypot(a[1] - b[1], a[2] - b[2]);

/**
 * Convolves rows with kx, then columns with ky; border pixels are repeated.
 * @param {Float32Array} source @param {number} width @param {number} height
 * @param {number[]} kx @param {number[]} ky
 */
function filtered(source, width, height, kx, ky) {
  const between = new Float32Array(source.length), out = new Float32Array(source.length);
  const rx = kx.length >> 1, ry = ky.length >> 1;
  const padded = new Float32Array(width + 2 * rx);
  for (let y = 0; y < height; ++y) {
    const row = y * width;
    for (let x = -rx; x < width + rx; ++x)
      padded[x + rx] = source[row + Math.max(0, Math.min(width - 1, x))];
    for (let x = 0; x < width; ++x) {
      let sum = 0;
      for (let i = 0; i < kx.length; ++i) sum += kx[i] * padded[x + i];
      between[row + x] = sum;
    }
  }
  for (let y = 0; y < height; ++y)
    for (let i = -ry; i <= ry; ++i) {
      const from = Math.max(0, Math.min(height - 1, y + i)) * width, w = ky[i + ry];
      for (let x = 0; x < width; ++x) out[y * width + x] += w * between[from + x];
    }
  return out;
}

/**
 * Contrast sensitivity filter of one opponent channel: a sum of Gaussians [height, width].
 * @param {Float32Array} plane @param {number} width @param {number} height
 * @param {[number, number][]} parts @param {number} ppd
 */
function contrastFiltered(plane, width, height, parts, ppd) {
  const r = Math.ceil(3 * Math.sqrt(0.04 / (2 * Math.PI ** 2)) * ppd);
  let total = 0;
  const kernels = parts.map(([a, b]) => {
    const k = [];
    for (let i = -r; i <= r; ++i) k.push(Math.exp(-((Math.PI * i / ppd) ** 2) / b));
    const sum = k.reduce((s, v) => s + v, 0);
    const weight = a * Math.sqrt(Math.PI / b) * sum * sum;
    total += weight;
    return {k: k.map((v) => v / sum), weight};
  });
  const out = new Float32Array(plane.length);
  for (const {k, weight} of kernels) {
    const one = filtered(plane, width, height, k, k);
    for (let i = 0; i < out.length; ++i) out[i] += weight / total * one[i];
  }
  return out;
}

/** Planes of YCxCz. @param {Uint8Array} rgba @param {number} count */
function opponentPlanes(rgba, count) {
  const table = Float64Array.from({length: 256}, (_, i) => srgbDecode(i / 255));
  const planes = [new Float32Array(count), new Float32Array(count), new Float32Array(count)];
  for (let i = 0; i < count; ++i) {
    const c = xyzOf([table[rgba[4 * i]], table[rgba[4 * i + 1]], table[rgba[4 * i + 2]]]);
    const x = c[0] / WHITE[0], y = c[1] / WHITE[1], z = c[2] / WHITE[2];
    planes[0][i] = 116 * y - 16;
    planes[1][i] = 500 * (x - y);
    planes[2][i] = 200 * (y - z);
  }
  return planes;
}

/** @param {Float32Array[]} planes @param {number} width @param {number} height @param {number} ppd */
function perceived(planes, width, height, ppd) {
  const y = contrastFiltered(planes[0], width, height, [[1, 0.0047]], ppd);
  const cx = contrastFiltered(planes[1], width, height, [[1, 0.0053]], ppd);
  const cz = contrastFiltered(planes[2], width, height, [[34.1, 0.04], [13.5, 0.025]], ppd);
  return (/** @type {number} */ i) => {
    const t = (y[i] + 16) / 116;
    const xyz = [(t + cx[i] / 500) * WHITE[0], t * WHITE[1], (t - cz[i] / 200) * WHITE[2]];
    return huntLab(rgbOf(xyz).map((v) => Math.max(0, Math.min(1, v))));
  };
}

/** Scales positive and negative weights to sums of 1 and -1. @param {number[]} k */
function normaliseSigns(k) {
  let up = 0, down = 0;
  for (const v of k) if (v > 0) up += v; else down += v;
  return k.map((v) => v > 0 ? v / up : down < 0 ? v / -down : 0);
}

/** Magnitudes of edges and points. @param {Float32Array} luma @param {number} width @param {number} height @param {number} ppd */
function features(luma, width, height, ppd) {
  const sigma = 0.5 * FEATURE_WIDTH_DEG * ppd, r = Math.ceil(3 * sigma);
  const smooth = [], slope = [], bend = [];
  for (let i = -r; i <= r; ++i) {
    const g = Math.exp(-i * i / (2 * sigma * sigma));
    smooth.push(g);
    slope.push(-i * g);
    bend.push(((i / sigma) ** 2 - 1) * g);
  }
  const sum = smooth.reduce((s, v) => s + v, 0);
  const even = smooth.map((v) => v / sum);
  const grey = luma.map((v) => (v + 16) / 116);
  const magnitude = (/** @type {number[]} */ k) => {
    const x = filtered(grey, width, height, k, even), y = filtered(grey, width, height, even, k);
    return x.map((v, i) => Math.hypot(v, y[i]));
  };
  return {edge: magnitude(normaliseSigns(slope)), point: magnitude(normaliseSigns(bend))};
}

const LARGEST = hyab(huntLab([0, 1, 0]), huntLab([0, 0, 1])) ** COLOUR_EXPONENT;

/** @param {number[]} a @param {number[]} b */
function colourError(a, b) {
  const e = hyab(a, b) ** COLOUR_EXPONENT, at = BREAK_SHARE * LARGEST;
  if (e < at) return BREAK_ERROR * e / at;
  return Math.min(1, BREAK_ERROR + (e - at) / (LARGEST - at) * (1 - BREAK_ERROR));
}

/**
 * Error per pixel, 0 (equal) to 1.
 * @param {Uint8Array} a RGBA, sRGB-encoded @param {Uint8Array} b
 * @param {number} width @param {number} height @param {number} [ppd]
 */
export function flipError(a, b, width, height, ppd = PIXELS_PER_DEGREE) {
  const count = width * height;
  const pa = opponentPlanes(a, count), pb = opponentPlanes(b, count);
  const la = perceived(pa, width, height, ppd), lb = perceived(pb, width, height, ppd);
  const fa = features(pa[0], width, height, ppd), fb = features(pb[0], width, height, ppd);
  const out = new Float32Array(count);
  for (let i = 0; i < count; ++i) {
    const change = Math.max(Math.abs(fa.edge[i] - fb.edge[i]), Math.abs(fa.point[i] - fb.point[i]));
    const feature = Math.min(1, (change / Math.SQRT2) ** FEATURE_EXPONENT);
    out[i] = colourError(la(i), lb(i)) ** (1 - feature);
  }
  return out;
}
