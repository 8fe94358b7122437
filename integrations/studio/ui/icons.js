// SPDX-License-Identifier: Apache-2.0
// Icons of 16 x 16 units, drawn with lines.

const PATHS = {
  edit: "M3 13l1-3 7-7 2 2-7 7zM10 4l2 2",
  display: "M8 3a5 5 0 100 10A5 5 0 008 3zM8 3v10M8 5h4M8 8h5M8 11h4",
  lights: "M5.5 9.5a3.8 3.8 0 115 0c-.6.5-.8 1-.8 1.8H6.3c0-.8-.2-1.300-.8-1.800zM6.500 13.500h3",
  sun: "M8 5.500a2.500 2.500 0 100 5 2.500 2.500 0 000-5zM8 1.500v2M8 12.500v2M1.500 8h2M12.500 8h2M3.400 3.400l1.400 1.400M11.200 11.200l1.400 1.400M3.400 12.600l1.400-1.400M11.200 4.800l1.400-1.400",
  measure: "M2 11l9-9 3 3-9 9zM5 8l1.500 1.500M7 6l1 1M9 4l1.500 1.500",
  compare: "M2.500 3.500h11v9h-11zM8 2v12M10 6l1.500 2L10 10M6 6L4.500 8 6 10",
  deliver: "M8 2v7M5 6.500L8 9.500l3-3M3 11v2.500h10V11",
  messages: "M2.500 3h11v7.500H8L5 13v-2.500H2.500z",
  undo: "M6 4L3 7l3 3M3 7h6a3.500 3.500 0 010 7H7",
  redo: "M10 4l3 3-3 3M13 7H7a3.500 3.500 0 000 7h2",
  save: "M3 3h8l2 2v8H3zM5.500 3v3.500h4V3M5.500 13V9.500h5V13",
  help: "M6 6a2 2 0 113 1.700c-.7.400-1 .8-1 1.500M8 11.500v.5",
  pause: "M6 4v8M10 4v8",
  play: "M5 3.500l7 4.500-7 4.500z",
  fit: "M3 6V3h3M10 3h3v3M13 10v3h-3M6 13H3v-3",
  theme: "M8 3a5 5 0 100 10 4 4 0 010-10z",
  navigate: "M8 2v12M2 8h12M8 2L6.500 3.500M8 2l1.500 1.500M8 14l-1.500-1.500M8 14l1.500-1.500M2 8l1.500-1.500M2 8l1.500 1.500M14 8l-1.500-1.500M14 8l-1.500 1.500",
  region: "M3 3h2M7 3h2M11 3h2v2M13 7v2M13 11v2h-2M9 13H7M5 13H3v-2M3 9V7M3 5V3",
  focus: "M8 6a2 2 0 100 4 2 2 0 000-4zM8 2v2.500M8 11.500V14M2 8h2.500M11.500 8H14",
  probe: "M3 13l2-2M5 11L4 9l4-4 3 3-4 4zM9 4l1.500-1.500 3 3L12 7",
  grid: "M3 3h10v10H3zM3 6.300h10M3 9.700h10M6.300 3v10M9.700 3v10",
  explain: "M8 3a5 5 0 100 10A5 5 0 008 3zM8 7.500V11M8 5v.500",
  reset: "M4 4v3h3M4.500 7A4 4 0 118 12",
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
