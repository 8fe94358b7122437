// SPDX-License-Identifier: Apache-2.0
// The light mixer: factors of the light layers, which sum to the picture.
import {HALF_VALUES, floatToHalf} from "../display/half.js";

/** @typedef {{on: boolean, strength: number, color: [number, number, number]}} LightSetting */

export class LightMix {
  active = false;
  /** @type {Map<string, LightSetting>} */
  settings = new Map();

  /** @param {string} layer @returns {LightSetting} */
  of(layer) {
    let found = this.settings.get(layer);
    if (!found) {
      found = {on: true, strength: 1, color: [1, 1, 1]};
      this.settings.set(layer, found);
    }
    return found;
  }

  /** True if the mix shows the light of the scene. @param {string[]} lightLayers */
  isNeutral(lightLayers) {
    return lightLayers.every((name) => {
      const s = this.of(name);
      return s.on && s.strength === 1 && s.color.every((v) => v === 1);
    });
  }

  /**
   * Factor of each layer. Without mixing: 1 for `shown` and 0 for the others.
   * @param {string[]} layers @param {string[]} lightLayers @param {string} shown
   * @returns {number[][]}
   */
  weights(layers, lightLayers, shown) {
    const mixes = this.active && shown === "beauty" && lightLayers.length > 0 &&
        lightLayers.every((name) => layers.includes(name));
    const visible = layers.includes(shown) ? shown : layers[0];
    return layers.map((name) => {
      if (!mixes) return name === visible ? [1, 1, 1] : [0, 0, 0];
      if (!lightLayers.includes(name)) return [0, 0, 0];
      const s = this.of(name);
      return s.on ? s.color.map((v) => v * s.strength) : [0, 0, 0];
    });
  }

  /** @returns {Record<string, LightSetting>} */
  toJSON() { return Object.fromEntries([...this.settings].map(([k, v]) => [k, structuredClone(v)])); }

  /** @param {Record<string, LightSetting>} saved @param {boolean} active */
  restore(saved, active) {
    this.settings = new Map(Object.entries(structuredClone(saved)));
    this.active = active;
  }
}

/**
 * Weighted sum of layers as RGBA halves.
 * @param {Uint16Array[]} layers @param {number[][]} weights
 */
export function mixDown(layers, weights) {
  const used = weights.map((w, i) => ({w, p: layers[i]})).filter(({w, p}) => p && w.some((v) => v !== 0));
  if (used.length === 1 && used[0].w.every((v) => v === 1)) return used[0].p.slice();
  const out = new Uint16Array(layers[0].length);
  for (let i = 0; i < out.length; i += 4) {
    for (let k = 0; k < 3; ++k) {
      let sum = 0;
      for (const {w, p} of used) sum += w[k] * HALF_VALUES[p[i + k]];
      out[i + k] = floatToHalf(sum);
    }
    out[i + 3] = 0x3c00;
  }
  return out;
}
