// SPDX-License-Identifier: Apache-2.0
// Whether measured values still belong to the present scene.

/** @typedef {import("../net/types.js").SceneState} SceneState */

/** Describes what values of points of the scene depend on. @param {SceneState} state */
export const sceneKey = (state) => state.content ?? JSON.stringify(state.edits);

/** The same for values of pixels. @param {SceneState} state */
export const pixelKey = (state) => JSON.stringify([sceneKey(state), state.look, state.camera, state.size]);
