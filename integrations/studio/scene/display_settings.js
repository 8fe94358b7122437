// SPDX-License-Identifier: Apache-2.0
// What the viewport shows and how: tone curve, layer, false colours, light mixer, comparison.
import {defaultTone} from "../display/tone.js";
import {Events} from "./events.js";
import {LightMix} from "./light_mix.js";

/** @typedef {import("../display/false_color.js").Scale} Scale */

/** Event: change. */
export class DisplaySettings extends Events {
  tone = defaultTone();
  mix = new LightMix();
  /** Layer in the viewport. */ layer = "beauty";
  falseColors = false;
  /** @type {Scale} */ scale = {low: 0, high: 1000, logarithmic: false};
  automaticScale = true;
  /** @type {"off" | "wipe" | "difference" | "flip"} */ compare = "off";
  /** Snapshot that is compared. @type {number | null} */ reference = null;
  /** Position of the wipe, a share of the width. */ wipe = 0.5;

  /** @param {object} [fields] assigned before the event */
  change(fields = {}) {
    Object.assign(this, fields);
    this.emit("change", this);
  }

  /** @param {Partial<import("../display/tone.js").ToneSettings>} fields */
  changeTone(fields) {
    this.tone = {...this.tone, ...fields};
    this.emit("change", this);
  }

  /** Layers that the viewport needs. @param {import("../net/types.js").SceneState} state */
  neededLayers(state) {
    const names = new Set(["beauty"]);
    if (this.mix.active) for (const name of state.light_layers) names.add(name);
    if (state.available_layers.includes(this.layer)) names.add(this.layer);
    return [...names];
  }
}
