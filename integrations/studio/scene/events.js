// SPDX-License-Identifier: Apache-2.0
// A list of functions per event.

export class Events {
  /** @type {Map<string, Set<(value: any) => void>>} */
  #listeners = new Map();

  /**
   * Calls a function for each event of this name. Returns a function that ends this.
   * @param {string} name @param {(value: any) => void} listener
   */
  on(name, listener) {
    const found = this.#listeners.get(name) ?? new Set();
    this.#listeners.set(name, found.add(listener));
    return () => found.delete(listener);
  }

  /** @param {string} name @param {any} [value] */
  emit(name, value) {
    for (const listener of this.#listeners.get(name) ?? []) listener(value);
  }
}
