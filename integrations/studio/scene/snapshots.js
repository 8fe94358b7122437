// SPDX-License-Identifier: Apache-2.0
// Stored pictures with their settings.
import {mixDown} from "./light_mix.js";

/**
 * @typedef {object} Snapshot
 * @property {number} id
 * @property {string} name
 * @property {number} width
 * @property {number} height
 * @property {Uint16Array} pixels linear RGBA halves, lights mixed
 * @property {number} samples
 * @property {string[]} edits
 * @property {import("../net/types.js").Look | null} look
 * @property {import("../display/tone.js").ToneSettings} tone
 * @property {{active: boolean, settings: Record<string, any>}} mix
 */

/** Pictures in memory are limited: 1920 x 1080 pixels have 16 MB. */
export const MAX_SNAPSHOTS = 12;

export class Snapshots {
  /** @type {Snapshot[]} */ list = [];
  #next = 1;

  /**
   * Stores the shown picture. Returns null if there is none.
   * @param {import("./session.js").Session} session
   * @param {import("./display_settings.js").DisplaySettings} display
   */
  take(session, display) {
    const {frames, state} = session;
    if (frames.isEmpty) return null;
    const id = this.#next++;
    const weights = display.mix.weights(frames.names, state.light_layers, "beauty");
    /** @type {Snapshot} */
    const snapshot = {
      id, name: `Snapshot ${id}`, width: frames.width, height: frames.height,
      pixels: mixDown(frames.layers, weights), samples: frames.samples, edits: [...state.edits],
      look: state.look ? structuredClone(state.look) : null, tone: {...display.tone},
      mix: {active: display.mix.active, settings: display.mix.toJSON()},
    };
    this.list.push(snapshot);
    if (this.list.length > MAX_SNAPSHOTS) this.list.shift();
    return snapshot;
  }

  /** @param {number} id */
  remove(id) { this.list = this.list.filter((s) => s.id !== id); }

  /** @param {number} id */
  find(id) { return this.list.find((s) => s.id === id) ?? null; }
}
