// SPDX-License-Identifier: Apache-2.0
// Text of edits: ELEMENT.PARAMETER=VALUE, as for --set.

/** Shortest text of a number with seven digits. @param {number} v */
export function numberText(v) {
  return Number.isFinite(v) ? String(Number(v.toPrecision(7))) : "0";
}

/**
 * The most exact text of a number that fits; one digit if none does.
 * @param {number} v @param {(text: string) => boolean} fits
 */
export function fittedText(v, fits) {
  if (!Number.isFinite(v)) return "0";
  for (let digits = 7; digits > 0; --digits) {
    const rounded = Number(v.toPrecision(digits));
    const text = [String(rounded), rounded.toExponential().replace("e+", "e")].find(fits);
    if (text !== undefined) return text;
  }
  return v.toExponential(0).replace("e+", "e");
}

/** @param {any} value @returns {string} */
export function valueText(value) {
  if (typeof value === "boolean") return value ? "on" : "off";
  if (typeof value === "number") return numberText(value);
  if (Array.isArray(value)) return value.map(valueText).join(" ");
  return value === null || value === undefined ? "" : String(value);
}

/** @param {string} target @param {any} value */
export const editText = (target, value) => `${target}=${valueText(value)}`;

/** Edit that connects a shader. @param {string} target @param {string} shader */
export const connectText = (target, shader) => `${target}==${shader}`;

/** Part of an edit before the first "=". @param {string} edit */
export function editTarget(edit) {
  const at = edit.indexOf("=");
  return at < 0 ? edit : edit.slice(0, at);
}

/** The edits without those of a target. @param {string[]} edits @param {string} target */
export const withoutTarget = (edits, target) => edits.filter((e) => editTarget(e) !== target);
