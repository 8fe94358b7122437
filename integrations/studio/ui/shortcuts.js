// SPDX-License-Identifier: Apache-2.0
// Keys of the page and their list. Keys of one letter do nothing in text fields and can be switched off.
import {button, checkField, h} from "./dom.js";
import {TOOLS} from "./top_bar.js";

/**
 * @param {import("../panels/app.js").App} app @param {import("./viewport_input.js").ViewportInput} input
 * @param {{take: () => void, save: () => void, theme: () => void}} actions
 */
export function installShortcuts(app, input, actions) {
  const {session, display, viewport} = app;
  let single = localStorage.getItem("oriel-single-keys") !== "off";
  const panels = ["edit", "display", "lights", "daylight", "measure", "compare", "deliver", "messages"];
  /** @type {[string, string, () => void][]} */
  const keys = [
    ["?", "List of shortcuts", () => show()],
    [" ", "Pause or continue the render", () => session.view({paused: !session.state.paused})],
    ["0", "Fit the picture, or show it 1:1", () => { viewport.zoom = viewport.zoom ? 0 : 1; viewport.invalidate(); }],
    ...TOOLS.map(([tool, title], i) => /** @type {[string, string, () => void]} */ ([String(i + 1), `Tool: ${title}`, () => input.choose(tool)])),
    ["c", "False colours", () => display.change({falseColors: !display.falseColors})],
    ["t", "Take a snapshot", actions.take],
    ["x", "Wipe against the snapshot", () => display.change({compare: display.compare === "wipe" ? "off" : "wipe"})],
    ["[", "Exposure down by 1/3 EV", () => display.changeTone({exposure: display.tone.exposure - 1 / 3})],
    ["]", "Exposure up by 1/3 EV", () => display.changeTone({exposure: display.tone.exposure + 1 / 3})],
    ["Escape", "Remove the render region", () => { if (session.state.region) session.view({region: null}); }],
  ];
  const fixed = [["Ctrl+Z", "Undo"], ["Ctrl+Shift+Z, Ctrl+Y", "Redo"], ["Ctrl+S", "Save edits into the scene"], ["Alt+1 … Alt+8", "Panels"]];
  const viewKeys = [["Arrow keys", "Orbit"], ["Shift + arrow keys", "Pan"], ["W A S D, Q E", "Walk, down and up"], ["+ −", "Dolly"], ["Enter", "Use the tool in the middle of the picture"],
                    ["Drag", "Orbit"], ["Shift + drag, middle button", "Pan"], ["Wheel, right button, Ctrl + drag", "Dolly"], ["Alt + drag", "Look around"], ["Ctrl + wheel", "Zoom the picture"]];
  const rows = (/** @type {any[][]} */ list) => h("dl", {class: "keys"}, ...list.flatMap(([key, text]) => [h("dt", {}, h("kbd", {text: key === " " ? "Space" : key})), h("dd", {text})]));
  const option = checkField("Keys without Ctrl", single, (v) => {
    single = v;
    localStorage.setItem("oriel-single-keys", v ? "on" : "off");
  });
  const dialog = h("dialog", {class: "shortcuts", attributes: {"aria-label": "Shortcuts"}}, h("h2", {text: "Shortcuts"}),
    h("div", {class: "columns"}, h("div", {}, h("h3", {text: "Everywhere"}), rows(keys), rows(fixed)), h("div", {}, h("h3", {text: "In the picture"}), rows(viewKeys))),
    h("div", {class: "dialog-end"}, option.element, h("span", {class: "spring"}), button("Close", () => dialog.close(), {class: "primary"})));
  const show = () => { if (!dialog.open) dialog.showModal(); };

  document.addEventListener("keydown", (event) => {
    const control = event.ctrlKey || event.metaKey;
    if (control && !event.altKey) {
      const key = event.key.toLowerCase();
      const act = key === "s" ? actions.save : key === "z" && event.shiftKey || key === "y" ? () => void session.attempt("redo") : key === "z" ? () => void session.attempt("undo") : null;
      if (!act || (isTextField(event.target) && key !== "s")) return;
      event.preventDefault();
      return act();
    }
    if (event.altKey && /^[1-8]$/.test(event.key)) {
      event.preventDefault();
      return app.showPanel(panels[Number(event.key) - 1]);
    }
    if (!single || event.altKey || dialog.open || isTextField(event.target)) return;
    if (event.key === " " && event.target instanceof HTMLElement && event.target.matches("button, summary, input, select, a")) return;
    const found = keys.find(([key]) => key === event.key);
    if (!found) return;
    event.preventDefault();
    found[2]();
  });
  return {dialog, show};
}

/** @param {EventTarget | null} target */
function isTextField(target) {
  return target instanceof HTMLElement && target.matches("input:not([type=range]):not([type=checkbox]):not([type=color]), textarea, select, [contenteditable]");
}
