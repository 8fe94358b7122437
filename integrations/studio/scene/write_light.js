// SPDX-License-Identifier: Apache-2.0
// Writes a setting of the light mixer into the scene, as edits of the light's shader.
import {editText} from "./edit_text.js";
import {newGesture} from "./latest.js";

/** @typedef {import("../net/types.js").Parameter} Parameter */
/** @typedef {import("./light_mix.js").LightSetting} LightSetting */

/** Parameters that multiply the light of a light shader or statement; the first that exists is used. */
const COLORS = ["rgb_multiplier", "color", "light_color", "energy", "filter_color"];
const SCALARS = ["multiplier", "intensity", "intensity_mult"];

/**
 * Edits that multiply a light by strength and colour, or null if no parameter allows it.
 * @param {Parameter[]} parameters of the light @param {LightSetting} s
 * @returns {string[] | null}
 */
export function lightEdits(parameters, s) {
  const usable = (/** @type {string} */ name, /** @type {string} */ type) =>
      parameters.find((p) => p.name === name && p.type === type && p.set && !p.connection);
  const factor = s.color.map((v) => s.on ? v * s.strength : 0);
  const scalar = SCALARS.map((n) => usable(n, "scalar")).find(Boolean);
  if (scalar?.set && factor.every((v) => v === factor[0])) return [editText(scalar.set, Number(scalar.value ?? scalar.default ?? 1) * factor[0])];
  const color = COLORS.map((n) => usable(n, "color")).find(Boolean);
  const value = color?.value ?? color?.default;
  if (!color?.set || !Array.isArray(value)) return null;
  return [editText(color.set, factor.map((f, i) => f * Number(value[i])))];
}

/** @param {import("../panels/app.js").App} app @param {string} name @param {LightSetting} setting @param {() => void} rebuild */
export async function writeLight(app, name, setting, rebuild) {
  const {session, toasts, display} = app;
  const light = session.outline?.lights.find((l) => l.name === name || l.instance === name);
  const element = await session.attempt("element", {name: light?.name ?? name});
  if (!element) return;
  const parameters = element.shaders.flatMap((/** @type {any} */ c) => c.parameters.filter((/** @type {any} */ p) => typeof p !== "string"));
  const edits = lightEdits(parameters, setting);
  if (!edits) return toasts.show(`${name} has no parameter for its strength.`, "error");
  const reply = await session.attempt("edit", {edits, gesture: newGesture("light")});
  if (!reply) return;
  Object.assign(setting, {on: true, strength: 1, color: [1, 1, 1]});
  rebuild();
  display.change();
  toasts.show(edits.join(", "));
}
