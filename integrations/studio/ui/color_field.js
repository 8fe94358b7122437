// SPDX-License-Identifier: Apache-2.0
// A scene-linear colour: the swatch shows its sRGB encoding; the numbers are linear.
import {hexOfLinear, linearOfHex} from "../display/srgb.js";
import {newGesture} from "../scene/latest.js";
import {h, uniqueId} from "./dom.js";
import {icon} from "./icons.js";
import {fitNumber, showNumber} from "./number_field.js";

/**
 * @param {{label: string, value: number[], doc?: string, swatch?: boolean,
 *          onInput: (value: number[], gesture: string) => void, onReset?: () => void}} o
 */
export function colorField(o) {
  const id = uniqueId("color");
  let value = [...o.value], gesture = "";
  const names = o.swatch === false ? ["x", "y", "z"] : ["red", "green", "blue"];
  const inputs = names.map((name, i) => h("input", {
    attributes: {type: "number", step: "any", "aria-label": `${o.label}, ${name}`},
    on: {change: () => {
      const v = inputs[i].valueAsNumber;
      if (Number.isFinite(v)) {
        value[i] = v;
        o.onInput([...value], newGesture(o.label));
      }
      show();
    }},
  }));
  const swatch = h("input", {attributes: {id, type: "color", "aria-label": `${o.label}, sRGB`}});
  const show = () => {
    inputs.forEach((input, i) => showNumber(input, value[i]));
    swatch.value = hexOfLinear(value);
  };
  swatch.addEventListener("input", () => {
    const intensity = Math.max(1, ...value);
    value = linearOfHex(swatch.value).map((v) => v * intensity);
    if (!gesture) gesture = newGesture(o.label);
    show();
    o.onInput([...value], gesture);
  });
  swatch.addEventListener("change", () => { gesture = ""; });
  inputs.forEach((input, i) => fitNumber(input, () => value[i], show));
  show();
  const reset = o.onReset ? h("button", {class: "reset", title: `Reset ${o.label}`, attributes: {type: "button", "aria-label": `Reset ${o.label}`},
                                         on: {click: () => o.onReset?.()}}, icon("reset")) : null;
  const element = h("div", {class: "field color", title: o.doc ?? ""},
                    h("label", {text: o.label, attributes: o.swatch === false ? {} : {for: id}}),
                    h("div", {class: "triple"}, o.swatch === false ? null : swatch, ...inputs), reset);
  return {
    element, reset,
    /** @param {number[]} v */
    set(v) {
      if (gesture) return;
      value = [...v];
      show();
    },
  };
}
