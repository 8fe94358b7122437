// SPDX-License-Identifier: Apache-2.0
// The bar at the top: scene, tools, undo, camera, resolution, save.
import {button, h} from "./dom.js";
import {icon} from "./icons.js";

/** @type {[import("./viewport_input.js").Tool, string][]} */
export const TOOLS = [["navigate", "Navigate and select"], ["region", "Render region"], ["focus", "Focus"], ["probe", "Probe"], ["grid", "Lux grid"], ["explain", "Explain"]];

/**
 * @param {import("../panels/app.js").App} app @param {import("./viewport_input.js").ViewportInput} input
 * @param {{help: () => void, theme: {next: () => string}, save: () => void}} actions
 */
export function createTopBar(app, input, actions) {
  const {session, toasts} = app;
  const file = h("strong", {class: "scene-file"}), dirty = h("span", {class: "dirty", title: "There are edits that are not saved", text: "●"});
  const tools = new Map(TOOLS.map(([tool, title], i) => [tool, button("", () => input.choose(tool), {class: "tool", title: `${title} (${i + 1})`, icon: icon(tool), pressed: false})]));
  const undo = button("", () => void session.attempt("undo"), {class: "tool", title: "Undo (Ctrl+Z)", icon: icon("undo")});
  const redo = button("", () => void session.attempt("redo"), {class: "tool", title: "Redo (Ctrl+Shift+Z)", icon: icon("redo")});
  const camera = h("select", {attributes: {"aria-label": "Camera"}, on: {change: () => session.view({camera: camera.value, look: null})}});
  const scale = h("select", {attributes: {"aria-label": "Resolution scale"}, on: {change: () => session.view({scale: Number(scale.value)})}},
                  ...[1, 2, 4, 8].map((v) => h("option", {text: v === 1 ? "Full size" : `1/${v} size`, attributes: {value: String(v)}})));
  const fit = button("", () => {
    app.viewport.zoom = app.viewport.zoom ? 0 : 1;
    app.viewport.invalidate();
  }, {class: "tool", title: "Fit or 1:1 (0)", icon: icon("fit")});
  const store = button("Store view", () => void session.attempt("store_camera"), {title: "Makes the present view an edit of the camera"});
  const original = button("Reset view", () => session.view({look: null}), {title: "Returns to the camera of the scene"});
  const pause = button("", () => session.view({paused: !session.state.paused}), {class: "tool", title: "Pause (Space)", icon: icon("pause")});
  const theme = button("", () => toasts.show(`Theme: ${actions.theme.next()}`), {class: "tool", title: "Theme", icon: icon("theme")});
  const help = button("", actions.help, {class: "tool", title: "Shortcuts (?)", icon: icon("help")});
  const save = button("Save", () => actions.save(), {class: "primary", title: "Save edits into the scene (Ctrl+S)"});
  const group = (/** @type {string} */ label, /** @type {Node[]} */ ...nodes) => h("div", {class: "tool-group", attributes: {role: "group", "aria-label": label}}, ...nodes);

  session.on("welcome", () => {
    file.textContent = session.scene.file.split("/").pop() ?? "";
    file.title = `${session.scene.folder}/${session.scene.file}`;
    document.title = `${file.textContent} – Oriel Studio`;
  });
  session.on("state", (s) => {
    dirty.hidden = s.saved || s.edits.length === 0;
    undo.disabled = !s.undo;
    redo.disabled = !s.redo;
    store.hidden = original.hidden = s.look_stored;
    if (s.cameras.join() !== [...camera.options].map((o) => o.value).join())
      camera.replaceChildren(...s.cameras.map((/** @type {string} */ c) => h("option", {text: c, attributes: {value: c}})));
    camera.value = s.camera;
    scale.value = String(s.scale);
    pause.setAttribute("aria-pressed", String(s.paused));
    pause.replaceChildren(icon(s.paused ? "play" : "pause"));
  });
  const element = h("header", {class: "top-bar"},
    h("div", {class: "brand"}, h("h1", {text: "Oriel Studio"}), file, dirty), group("Tools", ...tools.values()), group("History", undo, redo), group("Render", pause, fit),
    h("div", {class: "tool-group views"}, camera, scale, store, original), h("span", {class: "spring"}), group("Window", theme, help), save);
  return {
    element,
    /** @param {string} tool */
    showTool(tool) {
      for (const [name, b] of tools) b.setAttribute("aria-pressed", String(name === tool));
    },
  };
}
