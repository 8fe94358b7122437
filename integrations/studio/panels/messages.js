// SPDX-License-Identifier: Apache-2.0
// The messages panel: messages of the scene with their places, and missing textures.
import {uploadTexture} from "../net/files.js";
import {button, h, section} from "../ui/dom.js";
import {shortPath} from "./element.js";

/** @typedef {import("./app.js").App} App */
/** @typedef {import("../net/types.js").SceneMessage} SceneMessage */

const ORDER = {error: 0, warning: 1, note: 2};

/** @param {SceneMessage} m */
export const placeText = (m) => m.file ? [m.file, m.line, m.column].filter((v) => v !== undefined && v !== null).join(":") : "";

/** @param {App} app @param {(text: string) => void} badge */
export function createMessagesPanel(app, badge) {
  const missing = h("div", {}), list = h("ul", {class: "messages"});
  const reload = button("Reload scene files", () => void app.session.attempt("reload"));
  const element = h("div", {class: "panel"}, h("header", {}, h("h2", {text: "Messages"})), h("div", {class: "actions group"}, reload), missing, list);

  const relink = async (/** @type {string} */ texture, /** @type {File} */ file) => {
    try {
      const path = await uploadTexture(file, app.session.token);
      if (await app.session.attempt("relink", {texture, file: path})) app.toasts.show(`${texture}: ${path}`);
    } catch (error) {
      app.toasts.show(String(/** @type {Error} */ (error).message), "error");
    }
  };
  const dropZone = (/** @type {import("../net/types.js").MissingTexture} */ m) => {
    const input = h("input", {class: "visually-hidden", attributes: {type: "file", tabindex: "-1", "aria-label": `File for ${m.texture}`},
                              on: {change: () => { if (input.files?.[0]) void relink(m.texture, input.files[0]); }}});
    const zone = h("div", {class: "drop"}, h("strong", {text: m.texture}), h("span", {class: "muted", text: m.file}),
                   h("span", {text: "Drop the file here, or "}), button("choose a file", () => input.click(), {class: "small"}), input);
    zone.addEventListener("dragover", (event) => {
      event.preventDefault();
      zone.classList.add("over");
    });
    zone.addEventListener("dragleave", () => zone.classList.remove("over"));
    zone.addEventListener("drop", (event) => {
      event.preventDefault();
      zone.classList.remove("over");
      const file = event.dataTransfer?.files[0];
      if (file) void relink(m.texture, file);
    });
    return zone;
  };
  app.session.on("messages", () => {
    const {messages} = app.session, lost = app.session.missing;
    missing.replaceChildren(...(lost.length ? [section(`Missing textures (${lost.length})`, ...lost.map(dropZone))] : []));
    const sorted = [...messages].sort((a, b) => (ORDER[a.severity] ?? 3) - (ORDER[b.severity] ?? 3));
    list.replaceChildren(...sorted.map((m) => h("li", {class: m.severity}, h("span", {class: "severity", text: m.severity}),
      h("div", {}, h("p", {text: m.message}), m.hint ? h("p", {class: "muted", text: m.hint}) : null,
        h("p", {class: "muted"}, h("code", {text: shortPath(placeText(m), app.session.scene.folder)}), h("span", {text: ` ${m.code ?? ""}`}))))));
    if (messages.length === 0) list.replaceChildren(h("li", {class: "empty", text: "The scene has no messages."}));
    const serious = messages.filter((m) => m.severity !== "note").length + lost.length;
    badge(serious ? String(serious) : "");
  });
  return element;
}
