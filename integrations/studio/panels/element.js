// SPDX-License-Identifier: Apache-2.0
// The edit panel: the parameters of the selected element, in groups, with connected shaders as a tree.
import {button, disclosure, h} from "../ui/dom.js";
import {openButton, parameterField} from "./parameter.js";
import {grouped} from "./parameter_groups.js";

/** @typedef {import("../net/types.js").Parameter} Parameter */
/** @typedef {import("../net/types.js").SceneElement} SceneElement */
/** @typedef {import("../net/types.js").ShaderCall} ShaderCall */
/** @typedef {import("./app.js").App} App */

const REFRESH_MS = 150;

/** @param {ShaderCall} call @returns {(Parameter | string)[]} */
const parametersOf = (call) => call.parameters ?? [];

/** Text of the structure of an element: it changes if fields have to be made again. @param {SceneElement} e */
export function structureOf(e) {
  /** @type {(s: ShaderCall) => string} */
  const call = (s) => `${s.shader}(${parametersOf(s).map((p) => typeof p === "string" ? p :
      `${p.name}:${p.type}${p.connection ? call(p.connection) : ""}`).join(",")})`;
  return `${e.name} ${e.shaders.map(call).join(";")}`;
}

/** Path relative to the scene's folder where it is below. @param {string} file @param {string} folder */
export const shortPath = (file, folder) => folder && file.startsWith(`${folder}/`) ? file.slice(folder.length + 1) : file;

/** @param {App} app */
export function createElementPanel(app) {
  const title = h("h2", {text: "Edit"}), place = h("p", {class: "muted"});
  const filter = h("input", {class: "search", attributes: {type: "search", placeholder: "Filter parameters", "aria-label": "Filter parameters"}});
  const body = h("div", {class: "element-body"});
  const empty = h("p", {class: "empty", text: "Click an object in the picture, or choose an element of the scene on the left."});
  const element = h("div", {class: "panel"}, h("header", {}, title, place), filter, empty, body);
  filter.hidden = true;
  /** @type {Map<string, (p: Parameter) => void>} */
  const updates = new Map();
  /** @type {string | null} */ let name = null;
  let structure = "", timer = 0, edits = "";

  /** @param {ShaderCall} call @param {string} path @param {number} depth @returns {HTMLElement} */
  const shaderView = (call, path, depth) => {
    const parameters = parametersOf(call).filter((p) => typeof p !== "string");
    const groups = grouped(/** @type {Parameter[]} */ (parameters));
    const views = groups.map(([group, list], i) => {
      const fields = list.flatMap((p) => {
        const key = `${path}/${p.name}`, field = parameterField(p, app);
        updates.set(key, field.update);
        if (!p.connection || p.connection.texture) return [field.element];
        const nested = h("details", {class: "connection"}, h("summary", {}, h("span", {text: p.connection.shader}), h("span", {class: "muted", text: ` ${p.connection.name ?? ""}`})));
        if (depth < 8) nested.append(shaderView(p.connection, key, depth + 1));
        if (p.connection.name && parametersOf(p.connection).every((x) => typeof x === "string")) nested.append(openButton(p.connection.name, app));
        return [field.element, nested];
      });
      return groups.length === 1 ? h("div", {class: "group-body"}, ...fields) : disclosure(group, i < 4, ...fields);
    });
    const head = h("div", {class: "shader-head", title: call.doc ?? ""}, h("strong", {text: call.shader || "Statements"}), h("span", {class: "muted", text: call.shader ? call.slot ?? "" : ""}));
    return h("div", {class: "shader"}, depth === 0 ? head : null, ...views);
  };

  /** @param {ShaderCall} call @param {string} path */
  const updateCall = (call, path) => {
    for (const p of parametersOf(call)) {
      if (typeof p === "string") continue;
      updates.get(`${path}/${p.name}`)?.(p);
      if (p.connection) updateCall(p.connection, `${path}/${p.name}`);
    }
  };

  /** @param {SceneElement} e */
  const show = (e) => {
    empty.hidden = true;
    filter.hidden = false;
    title.textContent = e.name;
    place.textContent = [e.kind, e.file ? `${shortPath(e.file, app.session.scene.folder)}${e.line ? `:${e.line}` : ""}` : ""].filter(Boolean).join(" · ");
    const next = structureOf(e);
    if (next === structure) {
      e.shaders.forEach((call, i) => updateCall(call, String(i)));
      return;
    }
    structure = next;
    updates.clear();
    body.replaceChildren(...e.shaders.map((call, i) => shaderView(call, String(i), 0)));
    applyFilter();
  };

  const applyFilter = () => {
    const word = filter.value.trim().toLowerCase();
    for (const field of body.querySelectorAll(".field")) {
      const label = field.querySelector("label, .label")?.textContent?.toLowerCase() ?? "";
      field.classList.toggle("filtered", word !== "" && !label.includes(word));
    }
    if (word) for (const details of body.querySelectorAll("details")) details.open = true;
  };
  filter.addEventListener("input", applyFilter);

  const load = async () => {
    if (!name) return;
    const reply = await app.session.attempt("element", {name});
    if (reply && Array.isArray(reply.shaders)) show(reply);
  };

  app.events.on("select", (selected) => {
    name = selected;
    structure = "";
    void load();
  });
  app.session.on("state", (state) => {
    const now = state.edits.join("\n");
    if (now === edits) return;
    edits = now;
    clearTimeout(timer);
    timer = window.setTimeout(load, REFRESH_MS);
  });
  app.session.on("welcome", () => { structure = ""; });
  return {element, get selected() { return name; }, button};
}
