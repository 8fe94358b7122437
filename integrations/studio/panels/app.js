// SPDX-License-Identifier: Apache-2.0
// What the panels share. This module has types only.

/**
 * @typedef {object} App
 * @property {import("../scene/session.js").Session} session
 * @property {import("../scene/display_settings.js").DisplaySettings} display
 * @property {import("../scene/snapshots.js").Snapshots} snapshots
 * @property {import("../ui/viewport.js").Viewport} viewport
 * @property {import("../ui/toast.js").Toasts} toasts
 * @property {(panel: string) => void} showPanel
 * @property {(name: string) => void} select shows an element in the edit panel
 * @property {import("../scene/events.js").Events} events select, click
 */

export {};
