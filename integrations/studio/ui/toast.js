// SPDX-License-Identifier: Apache-2.0
// Short messages above the status line, and the live region of screen readers.
import {h} from "./dom.js";

const SHOWN_MS = 6000, STATUS_INTERVAL_MS = 10_000;

export class Toasts {
  element = h("div", {class: "toasts"});
  status = h("div", {class: "visually-hidden", attributes: {role: "status", "aria-live": "polite"}});
  #lastStatus = -STATUS_INTERVAL_MS;

  /** @param {string} text @param {"note" | "error"} [severity] */
  show(text, severity = "note") {
    const toast = h("div", {class: `toast ${severity}`, text, attributes: {role: severity === "error" ? "alert" : "status"}});
    this.element.append(toast);
    while (this.element.children.length > 3) this.element.firstElementChild?.remove();
    setTimeout(() => toast.remove(), SHOWN_MS);
  }

  /** Announces progress, at most once in ten seconds. @param {string} text @param {boolean} [changed] a change of state */
  announce(text, changed = false) {
    const now = performance.now();
    if (!changed && now - this.#lastStatus < STATUS_INTERVAL_MS) return;
    this.#lastStatus = now;
    this.status.textContent = text;
  }
}
