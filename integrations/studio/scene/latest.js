// SPDX-License-Identifier: Apache-2.0
// Sends the newest value of each key while an earlier request is under way, so that dragging a slider
// leaves no queue of outdated requests.

/** @typedef {{gesture: string, values: Map<string, any>}} Group */

export class Latest {
  /** @type {Group[]} */ #groups = [];
  #busy = false;
  /** @type {(() => void)[]} */ #idle = [];

  /** @param {(values: any[], gesture: string) => Promise<any>} send */
  constructor(send) {
    this.send = send;
  }

  /**
   * Values of one gesture replace each other by key; gestures keep their order.
   * @param {string} key @param {any} value @param {string} gesture
   */
  push(key, value, gesture) {
    const last = this.#groups[this.#groups.length - 1];
    if (last && last.gesture === gesture) last.values.set(key, value);
    else this.#groups.push({gesture, values: new Map([[key, value]])});
    if (!this.#busy) void this.#pump();
  }

  /** Resolves when every value was sent and answered. @returns {Promise<void>} */
  idle() {
    if (!this.#busy && this.#groups.length === 0) return Promise.resolve();
    return new Promise((resolve) => this.#idle.push(resolve));
  }

  async #pump() {
    this.#busy = true;
    for (let group = this.#groups.shift(); group; group = this.#groups.shift()) {
      try {
        await this.send([...group.values.values()], group.gesture);
      } catch {
        // The sender reports errors; later values are still sent.
      }
    }
    this.#busy = false;
    for (const resolve of this.#idle.splice(0)) resolve();
  }
}

let gestures = 0;

/** A name that no other gesture of this page has. @param {string} subject */
export const newGesture = (subject) => `${subject}#${++gestures}`;
