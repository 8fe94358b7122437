// SPDX-License-Identifier: Apache-2.0
// Icons of 16 x 16 units, drawn with lines.

const PATHS = {
  edit: "M3 13l1-3 7-7 2 2-7 7zM10 4l2 2",
  display: "M8 3a5 5 0 100 10A5 5 0 008 3zM8 3v10M8 5h4M8 8h5M8 11h4",
  lights: "M5.5 9.5a3.8 3.8 0 115 0c-.6.5-.8 1-.8 1.8H6.3c0-.8-.2-1.3-.8-1.8zM6.5 13.5h3",
  sun: "M8 5.5a2.5 2.5 0 100 5 2.5 2.5 0 000-5zM8 1.5v2M8 12.5v2M1.5 8h2M12.5 8h2M3.4 3.4l1.4 1.4M11.2 11.2l1.4 1.4M3.4 12.6l1.4-1.4M11.2 4.8l1.4-1.4",
  measure: "M2 11l9-9 3 3-9 9zM5 8l1.5 1.5M7 6l1 1M9 4l1.5 1.5",
  compare: "M2.5 3.5h11v9h-11zM8 2v12M10 6l1.5 2L10 10M6 6L4.5 8 6 10",
  deliver: "M8 2v7M5 6.5L8 9.5l3-3M3 11v2.5h10V11",
  messages: "M2.5 3h11v7.5H8L5 13v-2.5H2.5z",
  undo: "M6 4L3 7l3 3M3 7h6a3.5 3.5 0 010 7H7",
  redo: "M10 4l3 3-3 3M13 7H7a3.5 3.5 0 000 7h2",
  save: "M3 3h8l2 2v8H3zM5.5 3v3.5h4V3M5.5 13V9.5h5V13",
  help: "M6 6a2 2 0 113 1.7c-.7.4-1 .8-1 1.5M8 11.5v.5",
  pause: "M6 4v8M10 4v8",
  play: "M5 3.5l7 4.5-7 4.5z",
  fit: "M3 6V3h3M10 3h3v3M13 10v3h-3M6 13H3v-3",
  theme: "M8 3a5 5 0 100 10zM8 3a5 5 0 010 10M5.5 4.5v7M7 3.2v9.6",
  navigate: "M8 2v12M2 8h12M8 2L6.5 3.5M8 2l1.5 1.5M8 14l-1.5-1.5M8 14l1.5-1.5M2 8l1.5-1.5M2 8l1.5 1.5M14 8l-1.5-1.5M14 8l-1.5 1.5",
  region: "M3 3h2M7 3h2M11 3h2v2M13 7v2M13 11v2h-2M9 13H7M5 13H3v-2M3 9V7M3 5V3",
  focus: "M8 6a2 2 0 100 4 2 2 0 000-4zM8 2v2.5M8 11.5V14M2 8h2.5M11.5 8H14",
  probe: "M3 13l2-2M5 11L4 9l4-4 3 3-4 4zM9 4l1.5-1.5 3 3L12 7",
  grid: "M3 3h10v10H3zM3 6.3h10M3 9.7h10M6.3 3v10M9.7 3v10",
  explain: "M8 3a5 5 0 100 10A5 5 0 008 3zM8 7.5V11M8 5v.5",
  reset: "M4 4v3h3M4.5 7A4 4 0 118 12",
};

/** @typedef {keyof typeof PATHS} IconName */

/** @param {IconName} name */
export function icon(name) {
  const space = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(space, "svg");
  svg.setAttribute("viewBox", "0 0 16 16");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(space, "path");
  path.setAttribute("d", PATHS[name]);
  svg.append(path);
  return svg;
}
