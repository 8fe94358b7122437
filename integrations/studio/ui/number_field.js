// SPDX-License-Identifier: Apache-2.0
// A number: slider, number field, unit and reset. Both inputs are native, so both work by keyboard.
import {fittedText, numberText} from "../scene/edit_text.js";
import {newGesture} from "../scene/latest.js";
import {h, uniqueId} from "./dom.js";
import {icon} from "./icons.js";

/**
 * @typedef {object} NumberOptions
 * @property {string} label
 * @property {number} value
 * @property {number} [min] smallest valid value
 * @property {number} [max] largest valid value
 * @property {number} [low] left end of the slider
 * @property {number} [high] right end of the slider
 * @property {boolean} [logarithmic]
 * @property {boolean} [integer]
 * @property {string} [unit]
 * @property {string} [doc]
 * @property {number} [reset] value of the reset button
 * @property {(value: number, gesture: string) => void} onInput
 * @property {() => void} [onReset] instead of the value `reset`
 */

const STEPS = 1000;
const LONGEST_UNIT = 5;  // characters; longer ones are in the help text only

/** Widths and fonts of number fields that are shown. @type {WeakMap<Element, {width: number, font: string, show: () => void}>} */
const fields = new WeakMap();
const ruler = document.createElement("canvas").getContext("2d");
const sizes = new ResizeObserver((entries) => {
  for (const {target, contentRect} of entries) {
    const field = fields.get(target);
    if (!field || !contentRect.width) continue;
    field.width = contentRect.width;
    const style = getComputedStyle(target);
    field.font = `${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
    field.show();
  }
});

/** Range of a slider for a value without declared limits. @param {number} value */
export function guessedRange(value) {
  const size = Math.max(1, Math.abs(value) * 2);
  return value < 0 ? [-size, size] : [0, size];
}

/**
 * Shows a number in a narrow field, all digits in its title if they do not fit; not while it is edited.
 * @param {HTMLInputElement} input @param {number} value
 */
export function showNumber(input, value) {
  if (document.activeElement === input) return;
  const field = fields.get(input);
  input.value = fittedText(value, (text) => {
    if (!field?.width || !ruler) return true;
    ruler.font = field.font;
    return ruler.measureText(text).width <= field.width;
  });
  const whole = numberText(value);
  input.title = Number(input.value) === Number(whole) ? "" : whole;
}

/**
 * Calls `show` when the width of a field changes. The field has all digits while it is edited; they scroll.
 * @param {HTMLInputElement} input @param {() => number} value @param {() => void} show
 */
export function fitNumber(input, value, show) {
  fields.set(input, {width: 0, font: "", show});
  sizes.observe(input);
  input.addEventListener("focus", () => { input.value = numberText(value()); });
  input.addEventListener("blur", show);
}

/** @param {NumberOptions} o */
export function numberField(o) {
  const id = uniqueId("number");
  const guess = guessedRange(o.value);
  let low = o.low ?? (Number.isFinite(o.min) ? Number(o.min) : guess[0]);
  let high = o.high ?? (Number.isFinite(o.max) ? Number(o.max) : Math.max(guess[1], low + 1));
  if (high - low > 1e6) high = Math.max(low + 1, guess[1]);
  const logarithmic = Boolean(o.logarithmic) && low > 0;
  let value = o.value, gesture = "";

  const toSlider = (/** @type {number} */ v) => STEPS * (logarithmic
      ? Math.log(Math.max(v, low) / low) / Math.log(high / low) : (v - low) / (high - low));
  const fromSlider = (/** @type {number} */ s) => {
    const v = logarithmic ? low * (high / low) ** (s / STEPS) : low + (high - low) * s / STEPS;
    return o.integer ? Math.round(v) : Number(v.toPrecision(4));
  };
  const slider = h("input", {attributes: {type: "range", min: "0", max: String(STEPS), step: "any", "aria-label": o.label}});
  const input = h("input", {attributes: {id, type: "number", step: o.integer ? "1" : "any"}});
  if (Number.isFinite(o.min)) input.min = String(o.min);
  if (Number.isFinite(o.max)) input.max = String(o.max);
  const reset = h("button", {class: "reset", title: `Reset ${o.label}`, attributes: {type: "button", "aria-label": `Reset ${o.label}`}}, icon("reset"));
  const shownUnit = (o.unit ?? "").length <= LONGEST_UNIT ? o.unit ?? "" : "";
  const noReset = o.reset === undefined && !o.onReset;

  const show = () => {
    slider.value = String(toSlider(value));
    slider.setAttribute("aria-valuetext", `${numberText(value)} ${o.unit ?? ""}`.trim());
    slider.style.setProperty("--fill", `${Math.max(0, Math.min(100, toSlider(value) / STEPS * 100))}%`);
    showNumber(input, value);
    if (o.reset !== undefined && !o.onReset) reset.disabled = value === o.reset;
  };
  const change = (/** @type {number} */ v) => {
    value = Math.max(o.min ?? -Infinity, Math.min(o.max ?? Infinity, v));
    if (!gesture) gesture = newGesture(o.label);
    show();
    o.onInput(value, gesture);
  };
  slider.addEventListener("input", () => change(fromSlider(Number(slider.value))));
  slider.addEventListener("change", () => { gesture = ""; });
  // Arrow keys move the slider by a hundredth of its range.
  slider.addEventListener("keydown", (event) => {
    const step = {ArrowRight: 10, ArrowUp: 10, ArrowLeft: -10, ArrowDown: -10, PageUp: 100, PageDown: -100}[event.key];
    if (!step) return;
    event.preventDefault();
    change(fromSlider(Math.max(0, Math.min(STEPS, Number(slider.value) + (o.integer ? Math.sign(step) * Math.max(Math.abs(step), STEPS / (high - low)) : step)))));
    gesture = "";
  });
  input.addEventListener("change", () => {
    if (Number.isFinite(input.valueAsNumber)) change(input.valueAsNumber);
    gesture = "";
    input.value = numberText(value);
  });
  fitNumber(input, () => value, show);
  reset.addEventListener("click", () => {
    if (o.onReset) o.onReset();
    else if (o.reset !== undefined) { change(o.reset); gesture = ""; }
  });
  show();
  const element = h("div", {class: "field", title: o.doc ?? ""}, h("label", {text: o.label, attributes: {for: id}}), slider,
                    h("span", {class: "number"}, input, h("span", {class: "unit", text: shownUnit})),
                    noReset ? null : reset);
  return {
    element, input, slider, reset,
    /** @param {number} v */
    set(v) {
      if (gesture) return;  // a drag is under way
      value = v;
      show();
    },
  };
}
