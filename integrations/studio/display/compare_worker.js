// SPDX-License-Identifier: Apache-2.0
// Worker: difference or FLIP of two display pictures as an RGBA picture with its mean.
import {flipError} from "./flip.js";
import {VIRIDIS} from "./tone_shader.js";

/** Error as a colour. @param {number} t @param {Uint8ClampedArray} out @param {number} at */
function paint(t, out, at) {
  const p = Math.max(0, Math.min(1, t)) * (VIRIDIS.length - 1);
  const i = Math.min(Math.floor(p), VIRIDIS.length - 2), f = p - i;
  for (let k = 0; k < 3; ++k) {
    const shift = 16 - 8 * k;
    out[at + k] = ((VIRIDIS[i] >> shift) & 255) * (1 - f) + ((VIRIDIS[i + 1] >> shift) & 255) * f;
  }
  out[at + 3] = 255;
}

self.onmessage = (event) => {
  const {id, kind, a, b, width, height, gain} = event.data;
  const out = new Uint8ClampedArray(4 * width * height);
  let mean = 0;
  if (kind === "flip") {
    const error = flipError(a, b, width, height);
    for (let i = 0; i < error.length; ++i) {
      mean += error[i] / error.length;
      paint(error[i], out, 4 * i);
    }
  } else {
    for (let i = 0; i < out.length; i += 4) {
      for (let k = 0; k < 3; ++k) {
        const difference = Math.abs(a[i + k] - b[i + k]);
        mean += difference / (255 * 3 * width * height);
        out[i + k] = gain * difference;
      }
      out[i + 3] = 255;
    }
  }
  self.postMessage({id, pixels: out, mean, width, height});
};
