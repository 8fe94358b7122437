// SPDX-License-Identifier: Apache-2.0
// The layers of the shown picture in memory, and the strips of the frame that arrives. A frame
// becomes visible when its last strip is here.
import {FORMAT} from "../net/strip.js";
import {HALF_VALUES, floatToHalf} from "./half.js";

/** @typedef {import("../net/types.js").Strip} Strip */
/** @typedef {{layer: number, y: number, rows: number}} DirtyRows */

const ONE = 0x3c00;  // 1.0 as half

/**
 * Writes a strip into RGBA halves of a picture.
 * @param {Strip} strip @param {Uint16Array} pixels @param {number} width of the picture
 */
function copyStrip(strip, pixels, width) {
  for (let row = 0; row < strip.height; ++row) {
    let to = 4 * ((strip.y + row) * width + strip.x);
    if (strip.format === FORMAT.RGBA16F) {
      const from = row * strip.width * 4;
      pixels.set(/** @type {Uint16Array} */ (strip.data).subarray(from, from + 4 * strip.width), to);
      continue;
    }
    if (strip.format === FORMAT.RGB16F) {
      let from = row * strip.width * 3;
      for (let x = 0; x < strip.width; ++x, to += 4, from += 3) {
        pixels[to] = strip.data[from];
        pixels[to + 1] = strip.data[from + 1];
        pixels[to + 2] = strip.data[from + 2];
        pixels[to + 3] = ONE;
      }
      continue;
    }
    let from = row * strip.width;
    for (let x = 0; x < strip.width; ++x, to += 4, ++from) {
      pixels[to] = pixels[to + 1] = pixels[to + 2] = floatToHalf(strip.data[from]);
      pixels[to + 3] = ONE;
    }
  }
}

export class FrameStore {
  width = 0;
  height = 0;
  divider = 1;
  epoch = -1;
  frame = 0;
  samples = 0;
  preview = false;
  /** RGBA halves of each layer. @type {Uint16Array[]} */
  layers = [];
  /** @type {string[]} */
  names = [];
  /** @type {Strip[]} */
  #arriving = [];

  get isEmpty() { return this.layers.length === 0; }

  /**
   * Takes a strip. Returns the rows that changed when the strip completed a frame, otherwise null.
   * `resized` is true if every layer is new.
   * @param {Strip} strip
   * @param {[number, number]} fullSize size of the picture at divider 1
   * @param {string[]} names of the layers
   * @returns {{dirty: DirtyRows[], resized: boolean} | null}
   */
  add(strip, fullSize, names) {
    const newest = this.#arriving.length ? this.#arriving[0].epoch : this.epoch;
    if (strip.epoch < newest) return null;
    const first = this.#arriving[0];
    if (first && (first.epoch !== strip.epoch || first.frame !== strip.frame)) this.#arriving = [];
    const width = Math.ceil(fullSize[0] / strip.divider);
    const height = Math.ceil(fullSize[1] / strip.divider);
    const fits = strip.x + strip.width <= width && strip.y + strip.height <= height &&
        strip.layer < Math.max(1, names.length);
    if (fits) this.#arriving.push(strip);
    if (!strip.last) return null;
    const strips = this.#arriving;
    this.#arriving = [];
    if (strips.length === 0) return null;
    return this.#show(strips, width, height, names);
  }

  /**
   * @param {Strip[]} strips @param {number} width @param {number} height @param {string[]} names
   */
  #show(strips, width, height, names) {
    const count = Math.max(1, names.length);
    const same = width === this.width && height === this.height &&
        names.join("\n") === this.names.join("\n") && this.layers.length === count;
    if (!same) {
      const old = {width: this.width, height: this.height, pixels: this.layers[0]};
      this.layers = [];
      for (let i = 0; i < count; ++i) this.layers.push(new Uint16Array(4 * width * height));
      // A region covers a part of the picture only; the rest shows the previous picture.
      if (old.pixels && !coversAll(strips, width, height)) stretch(old, this.layers[0], width, height);
      this.width = width;
      this.height = height;
      this.names = [...names];
    }
    const dirty = [];
    for (const strip of strips) {
      copyStrip(strip, this.layers[strip.layer], width);
      dirty.push({layer: strip.layer, y: strip.y, rows: strip.height});
    }
    const last = strips[strips.length - 1];
    this.divider = last.divider;
    this.epoch = last.epoch;
    this.frame = last.frame;
    this.samples = last.samples;
    this.preview = last.preview;
    return {dirty, resized: !same};
  }

  /** Forgets strips of an unfinished frame, after the connection ended. */
  reset() {
    this.#arriving = [];
    this.epoch = -1;
  }

  /**
   * Linear colour of a pixel of a layer, or null outside.
   * @param {number} x @param {number} y in pixels of the full-size picture
   * @param {number} [layer]
   * @returns {[number, number, number] | null}
   */
  colorAt(x, y, layer = 0) {
    const px = Math.floor(x / this.divider), py = Math.floor(y / this.divider);
    if (px < 0 || py < 0 || px >= this.width || py >= this.height || !this.layers[layer]) return null;
    const at = 4 * (py * this.width + px), p = this.layers[layer];
    return [HALF_VALUES[p[at]], HALF_VALUES[p[at + 1]], HALF_VALUES[p[at + 2]]];
  }
}

/** @param {Strip[]} strips @param {number} width @param {number} height */
function coversAll(strips, width, height) {
  let area = 0;
  for (const s of strips) if (s.layer === 0) area += s.width * s.height;
  return area >= width * height;
}

/**
 * Nearest-neighbour copy of a picture of another size.
 * @param {{width: number, height: number, pixels: Uint16Array}} from
 * @param {Uint16Array} to @param {number} width @param {number} height
 */
function stretch(from, to, width, height) {
  for (let y = 0; y < height; ++y) {
    const fy = Math.min(from.height - 1, Math.floor(y * from.height / height));
    for (let x = 0; x < width; ++x) {
      const fx = Math.min(from.width - 1, Math.floor(x * from.width / width));
      const a = 4 * (y * width + x), b = 4 * (fy * from.width + fx);
      for (let k = 0; k < 4; ++k) to[a + k] = from.pixels[b + k];
    }
  }
}
