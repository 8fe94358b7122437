// SPDX-License-Identifier: Apache-2.0
// Elevation of the sun over the hours of a day.
import {hourText} from "../scene/daylight.js";
import {h} from "./dom.js";

const WIDTH = 288, HEIGHT = 92, BOTTOM = 74, TOP = 6;

/** @param {string} name @param {Record<string, string | number>} attributes */
function svg(name, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  return element;
}

export function sunChart() {
  const picture = svg("svg", {viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "sun-chart", role: "img", "aria-label": "Elevation of the sun"});
  const element = h("div", {class: "chart"});
  element.append(picture);
  /** @type {{hour: number, elevation: number, azimuth: number}[]} */ let points = [];
  const x = (/** @type {number} */ hour) => 4 + hour / 24 * (WIDTH - 8);
  const y = (/** @type {number} */ elevation) => BOTTOM - Math.max(-5, Math.min(90, elevation)) / 90 * (BOTTOM - TOP);
  const dot = svg("circle", {r: 5, class: "sun-dot", cx: -20, cy: 0});
  const label = svg("text", {class: "sun-label", x: 6, y: 14});

  const draw = () => {
    const parts = [svg("rect", {class: "night", x: 0, y: BOTTOM, width: WIDTH, height: HEIGHT - BOTTOM})];
    for (const hour of [0, 6, 12, 18, 24]) {
      parts.push(svg("line", {class: "grid", x1: x(hour), x2: x(hour), y1: TOP, y2: BOTTOM}));
      const text = svg("text", {class: "tick", x: Math.max(10, Math.min(WIDTH - 10, x(hour))), y: HEIGHT - 4});
      text.textContent = String(hour);
      parts.push(text);
    }
    parts.push(svg("line", {class: "horizon", x1: 0, x2: WIDTH, y1: BOTTOM, y2: BOTTOM}));
    if (points.length > 1)
      parts.push(svg("path", {class: "sun-path", d: points.map((p, i) => `${i ? "L" : "M"}${x(p.hour).toFixed(1)} ${y(p.elevation).toFixed(1)}`).join("")}));
    picture.replaceChildren(...parts, dot, label);
  };
  draw();
  return {
    element,
    /** @param {{time: string, elevation: number, azimuth: number}[]} hours every half hour from 0 */
    show(hours) {
      points = hours.map((p, i) => ({hour: i / 2, elevation: Number(p.elevation), azimuth: Number(p.azimuth)}));
      draw();
    },
    /** @param {number} hour */
    mark(hour) {
      const i = Math.min(Math.floor(hour * 2), points.length - 2);
      if (i < 0) return;
      const t = hour * 2 - i, elevation = points[i].elevation * (1 - t) + points[i + 1].elevation * t;
      dot.setAttribute("cx", String(x(hour)));
      dot.setAttribute("cy", String(y(elevation)));
      dot.classList.toggle("below", elevation < 0);
      label.textContent = `${hourText(hour)}   ${elevation.toFixed(1)}° above the horizon`;
    },
  };
}
