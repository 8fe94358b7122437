// SPDX-License-Identifier: Apache-2.0
// The left side: elements of the scene, and the list of edits.
import {editTarget, withoutTarget} from "../scene/edit_text.js";
import {button, disclosure, h} from "../ui/dom.js";

/** @typedef {import("./app.js").App} App */
/** @typedef {{name: string, detail: string, warning?: boolean}} Row */

const MOST_ROWS = 400;  // of a list: more slow the page down

/**
 * The keys of a list: Tab enters and leaves it, arrows move within it.
 * @param {HTMLElement} list
 */
function installListKeys(list) {
  const stops = () => /** @type {HTMLElement[]} */ ([...list.querySelectorAll("summary, .row")].filter((e) => /** @type {HTMLElement} */ (e).offsetParent !== null));
  list.addEventListener("keydown", (event) => {
    const all = stops(), at = all.indexOf(/** @type {HTMLElement} */ (document.activeElement));
    const to = {ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: all.length - 1}[event.key];
    if (to === undefined || at < 0) return;
    event.preventDefault();
    event.stopPropagation();
    all[Math.max(0, Math.min(all.length - 1, to))]?.focus();
  });
  // Tab comes back to the row that had the focus.
  list.addEventListener("focusin", (event) => {
    const row = /** @type {HTMLElement} */ (event.target);
    if (!row.classList.contains("row")) return;
    for (const other of row.closest("ul")?.querySelectorAll(".row[tabindex='0']") ?? []) other.setAttribute("tabindex", "-1");
    row.setAttribute("tabindex", "0");
  });
}

/** @param {import("../net/types.js").Outline} o @returns {[string, Row[]][]} */
export function outlineRows(o) {
  /** @type {(list: any[] | undefined, detail: string) => Row[]} */
  const rows = (list, detail) => (list ?? []).map((e) => ({name: e.name, detail: String(e[detail] ?? "")}));
  return [
    ["Materials", rows(o.materials, "shader")],
    ["Lights", (o.lights ?? []).map((l) => ({name: l.name, detail: l.kind || l.shader}))],
    ["Cameras", rows(o.cameras, "instance")],
    ["Instances", rows(o.instances, "item")],
    ["Textures", (o.textures ?? []).map((t) => ({name: t.name, detail: t.missing ? "missing" : t.file, warning: t.missing}))],
    ["Shaders", rows(o.shaders, "shader")],
    ["Options", (o.options ?? []).map((name) => ({name, detail: ""}))],
  ];
}

/** @param {App} app */
export function createOutline(app) {
  const search = h("input", {class: "search", attributes: {type: "search", placeholder: "Find an element", "aria-label": "Find an element"}});
  const list = h("div", {class: "outline-list"});
  const edits = h("ol", {class: "edits"});
  const count = h("span", {class: "muted"});
  const clear = button("Clear", () => void app.session.attempt("set_edits", {edits: []}), {class: "small", title: "Removes all edits; undo restores them"});
  const copy = button("Copy", async () => {
    await navigator.clipboard.writeText(app.session.state.edits.map((e) => `--set '${e.replaceAll("'", "'\\''")}'`).join(" "));
    app.toasts.show("The edits are in the clipboard, as options of the command line.");
  }, {class: "small", title: "Copies the edits as options of the command line"});
  const editSection = h("section", {class: "edit-list", attributes: {"aria-label": "Edits"}},
                        h("header", {}, h("h2", {text: "Edits"}), count, h("span", {class: "spring"}), copy, clear), edits);
  const element = h("aside", {class: "sidebar", attributes: {"aria-label": "Scene"}}, h("header", {}, h("h2", {text: "Scene"})), search, list, editSection);
  let selected = "";
  const open = new Set(["Materials", "Lights"]);

  const draw = () => {
    const outline = app.session.outline;
    if (!outline) return;
    const word = search.value.trim().toLowerCase();
    list.replaceChildren(...outlineRows(outline).flatMap(([title, rows]) => {
      const found = rows.filter((r) => !word || `${r.name} ${r.detail}`.toLowerCase().includes(word));
      if (found.length === 0) return [];
      const current = Math.max(0, found.findIndex((row) => row.name === selected));
      const items = found.slice(0, MOST_ROWS).map((row, i) => h("li", {}, h("button", {
        class: `row${row.warning ? " warning" : ""}`, title: `${row.name}\n${row.detail}`,
        attributes: {type: "button", tabindex: i === (current < MOST_ROWS ? current : 0) ? "0" : "-1", ...(row.name === selected ? {"aria-current": "true"} : {})}, on: {click: () => app.select(row.name)},
      }, h("span", {class: "name", text: row.name}), h("span", {class: "detail", text: row.detail}))));
      if (found.length > MOST_ROWS) items.push(h("li", {class: "muted", text: `${found.length - MOST_ROWS} more: search for a part of the name.`}));
      const details = disclosure(`${title} (${found.length === rows.length ? rows.length : `${found.length} of ${rows.length}`})`, open.has(title) || word !== "", h("ul", {class: "rows"}, ...items));
      details.addEventListener("toggle", () => { if (!word) details.open ? open.add(title) : open.delete(title); });
      return [details];
    }), ...(outline.cut ? [h("p", {class: "muted", text: "Long lists are cut after 20000 entries."})] : []));
  };
  installListKeys(list);
  search.addEventListener("input", draw);
  app.session.on("outline", draw);
  app.events.on("select", (name) => {
    selected = name;
    draw();
  });

  app.session.on("state", (state) => {
    count.textContent = state.edits.length ? String(state.edits.length) : "";
    clear.disabled = copy.disabled = state.edits.length === 0;
    edits.replaceChildren(...state.edits.map((/** @type {string} */ text) => h("li", {}, h("code", {text, title: text}),
        h("button", {class: "reset", title: `Remove ${text}`, text: "×", attributes: {type: "button", "aria-label": `Remove ${text}`},
                     on: {click: () => void app.session.attempt("set_edits", {edits: withoutTarget(app.session.state.edits, editTarget(text))})}}))));
    if (state.edits.length === 0) edits.append(h("li", {class: "muted", text: "No edits. The picture shows the scene as its files describe it."}));
  });
  return element;
}
