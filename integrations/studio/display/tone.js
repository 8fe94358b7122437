// SPDX-License-Identifier: Apache-2.0
// Display settings: the parameters of `oriel tonemap`, what the shader needs of them, and the options
// of the command line that give the same picture.
import {whitePointOfTemperature} from "./white_point.js";

/** @typedef {"photographic" | "simple" | "agx" | "neutral"} ToneOperator */

/**
 * @typedef {object} ToneSettings
 * @property {ToneOperator} operator
 * @property {number} exposure stops, added to the exposure of the camera settings
 * @property {number} iso 0: cm2 is a plain gain
 * @property {number} shutter 1/s
 * @property {number} fNumber
 * @property {number} cm2 cd/m2 per unit of the picture
 * @property {boolean} measured true: iso, shutter and f-number apply; false: gain only
 * @property {number} temperature white point in kelvin
 * @property {number} tint -1 green ... 1 magenta
 * @property {number} burn
 * @property {number} crush
 * @property {number} saturation
 * @property {number} gamma
 * @property {number} pedestal
 * @property {number} gain
 * @property {number} knee
 * @property {number} compression
 * @property {boolean} asymptotic
 */

/** White point of neutral settings: D65, which leaves colours unchanged. */
export const NEUTRAL_TEMPERATURE = 6504;

// ISO 12232: saturation-based speed; the constant of src/tone/exposure.h (kSaturationExposure).
const SATURATION_EXPOSURE = 1.2;

/** @returns {ToneSettings} */
export function defaultTone() {
  return {
    operator: "agx", exposure: 0, iso: 100, shutter: 100, fNumber: 16, cm2: 1, measured: false,
    temperature: NEUTRAL_TEMPERATURE, tint: 0, burn: 0, crush: 0.25, saturation: 1, gamma: 2.2,
    pedestal: 0, gain: 1, knee: 0.5, compression: 2, asymptotic: false,
  };
}

/** @param {number[]} c */
const luminance = (c) => 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];

/**
 * Factor of each channel: exposure and white balance.
 * @param {ToneSettings} t
 * @returns {[number, number, number]}
 */
export function exposureScale(t) {
  const cm2 = t.cm2 * 2 ** t.exposure;
  let scale = cm2;
  if (t.measured && t.iso > 0) {
    if (!(t.shutter > 0) || !(t.fNumber > 0)) return [0, 0, 0];
    scale = cm2 / (SATURATION_EXPOSURE * t.fNumber * t.fNumber * t.shutter * 100 / t.iso);
  }
  const white = whitePointOfTemperature(t.temperature, t.tint).map((v) => Math.max(v, 1e-6));
  const y = luminance(white);
  return [scale * y / white[0], scale * y / white[1], scale * y / white[2]];
}

/**
 * Numbers of the shader (display/tone_shader.js).
 * @param {ToneSettings} t
 */
export function toneUniforms(t) {
  const linear = t.operator === "agx" || t.operator === "neutral";
  return {
    mode: {photographic: 0, simple: 1, agx: 2, neutral: 3}[t.operator],
    scale: t.operator === "simple" ? [1, 1, 1] : exposureScale(t),
    // burn, saturation, exponent of crush, 1 / gamma
    film: linear ? [1, 1, 1, 1] : [t.burn, t.saturation, 1 + 2 * t.crush, t.gamma > 0 ? 1 / t.gamma : 1],
    // pedestal, gain, knee, compression
    simple: [t.pedestal, t.gain * 2 ** t.exposure, t.knee, Math.max(t.compression, 0)],
    asymptotic: t.asymptotic,
  };
}

/** Shortest text of a number that reads back as the same float. @param {number} v */
const text = (v) => String(Number(v.toPrecision(7)));

/**
 * Options of `oriel tonemap` that show the same picture.
 * @param {ToneSettings} t
 */
export function tonemapOptions(t) {
  if (t.operator === "simple") {
    return `--simple --pedestal ${text(t.pedestal)} --gain ${text(t.gain * 2 ** t.exposure)} --knee ` +
        `${text(t.knee)} --compression ${text(t.compression)} --gamma ${text(t.gamma)}` +
        (t.asymptotic ? " --knee-curve asymptotic" : "");
  }
  const options = [];
  if (t.operator !== "photographic") options.push(`--view ${t.operator}`);
  options.push(`--cm2 ${text(t.cm2 * 2 ** t.exposure)}`);
  if (t.measured)
    options.push(`--iso ${text(t.iso)} --shutter ${text(t.shutter)} --f-number ${text(t.fNumber)}`);
  else
    options.push("--iso 0");
  options.push("--vignetting 0");  // the page has no vignetting; a file may record one
  const white = whitePointOfTemperature(t.temperature, t.tint);
  if (white.some((v) => v !== 1)) options.push(`--whitepoint ${white.map(text).join(",")}`);
  if (t.operator === "photographic") {
    options.push(`--burn ${text(t.burn)} --crush ${text(t.crush)} --saturation ${text(t.saturation)}`);
    options.push(`--gamma ${text(t.gamma)}`);
  }
  return options.join(" ");
}

/**
 * Exposure in stops for which the logarithmic mean of a picture becomes middle grey before the display
 * transform, or null for a black picture.
 * @param {Iterable<number[]>} colors linear
 * @param {ToneSettings} t
 */
export function automaticExposure(colors, t) {
  let sum = 0, count = 0;
  for (const c of colors) {
    const y = luminance(c);
    if (!(y > 0) || !Number.isFinite(y)) continue;
    sum += Math.log2(y);
    ++count;
  }
  if (count === 0) return null;
  const scale = luminance(exposureScale({...t, exposure: 0}));
  if (t.operator === "simple") return Math.log2(0.18) - sum / count - Math.log2(Math.max(t.gain, 1e-9));
  return scale > 0 ? Math.log2(0.18 / scale) - sum / count : null;
}
