// SPDX-License-Identifier: Apache-2.0
// Legend of false colours beside the picture.
import {VIRIDIS} from "../display/tone_shader.js";
import {scalePosition, scaleTicks, tickText} from "../display/false_color.js";
import {mapColor} from "../display/srgb.js";
import {h} from "./dom.js";

/** @param {string} layer */
const unitOf = (layer) => layer === "illuminance" ? "lx" : layer === "depth" ? "scene units" : "cd/m²";

/** @param {import("../panels/app.js").App} app */
export function createLegend(app) {
  const bar = h("canvas", {class: "legend-bar", attributes: {width: "12", height: "200", "aria-hidden": "true"}});
  const ticks = h("ul", {class: "legend-ticks"}), unit = h("span", {class: "legend-unit"});
  const element = h("div", {class: "legend", attributes: {role: "group", "aria-label": "Legend of false colours"}}, unit, h("div", {class: "legend-body"}, bar, ticks));
  const context = bar.getContext("2d");
  for (let y = 0; context && y < 200; ++y) {
    context.fillStyle = mapColor(VIRIDIS, 1 - y / 199);
    context.fillRect(0, y, 12, 1);
  }
  const update = () => {
    const d = app.display;
    element.hidden = !d.falseColors && d.layer !== "depth" && d.layer !== "illuminance";
    unit.textContent = unitOf(d.layer);
    ticks.replaceChildren(...scaleTicks(d.scale).map((value) => {
      const item = h("li", {text: tickText(value)});
      item.style.setProperty("bottom", `${100 * scalePosition(d.scale, value)}%`);
      return item;
    }));
  };
  app.display.on("change", update);
  update();
  return element;
}
