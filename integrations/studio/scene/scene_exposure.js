// SPDX-License-Identifier: Apache-2.0
// Display settings from the exposure shader of the scene's camera.

/** @typedef {import("../net/types.js").SceneState} SceneState */
/** @typedef {import("../display/tone.js").ToneSettings} ToneSettings */

/** Settings that show the beauty as the scene's own exposure does; vignetting is left out. @param {SceneState} state @returns {Partial<ToneSettings>} */
export function toneOfScene(state) {
  const shader = state.exposure?.shader ?? "", p = state.exposure?.parameters ?? {};
  const number = (/** @type {string} */ name, /** @type {number} */ otherwise) => Number.isFinite(p[name]) ? Number(p[name]) : otherwise;
  if (shader.startsWith("mia_exposure_photographic")) {
    const iso = number("film_iso", 100);
    return {operator: "photographic", cm2: number("cm2_factor", 1), measured: iso > 0, iso: iso > 0 ? iso : 100, shutter: number("camera_shutter", 100), fNumber: number("f_number", 16),
            burn: number("burn_highlights", 0), crush: number("crush_blacks", 0.25), saturation: number("saturation", 1), gamma: number("gamma", 2.2)};
  }
  if (shader === "mia_exposure_simple")
    return {operator: "simple", pedestal: number("pedestal", 0), gain: number("gain", 1), knee: number("knee", 0.5), compression: number("compression", 2), gamma: number("gamma", 2.2)};
  return {cm2: state.unit_luminance};
}
