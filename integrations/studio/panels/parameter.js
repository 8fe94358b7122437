// SPDX-License-Identifier: Apache-2.0
// The field of one parameter, made from its declaration.
import {connectText, editText, valueText} from "../scene/edit_text.js";
import {newGesture} from "../scene/latest.js";
import {plainFileName, thumbnailUrl, uploadTexture} from "../net/files.js";
import {colorField} from "../ui/color_field.js";
import {button, checkField, h, selectField, textField} from "../ui/dom.js";
import {icon} from "../ui/icons.js";
import {numberField} from "../ui/number_field.js";

/** @typedef {import("../net/types.js").Parameter} Parameter */
/** @typedef {import("./app.js").App} App */
/** @typedef {{element: HTMLElement, update: (p: Parameter) => void}} Field */

/** Range of a slider: wide ranges of positive numbers are logarithmic. @param {Parameter} p @param {number} value */
export function sliderRange(p, value) {
  const min = Number.isFinite(p.min) ? Number(p.min) : undefined, max = Number.isFinite(p.max) ? Number(p.max) : undefined;
  const wide = max !== undefined && max >= 1000 && (min ?? 0) >= 0;
  if (wide) return {min, max, low: Math.max(min ?? 0, max * 1e-6), high: max, logarithmic: true};
  if (min !== undefined && max === undefined) return {min, max, low: min, high: Math.max(min + 1, 2 * Math.abs(value))};
  return {min, max};
}

/** Text of help: what the parameter does, its default and its support. @param {Parameter} p */
function helpText(p) {
  const lines = [p.doc ?? ""];
  if (p.default !== undefined && p.default !== null && typeof p.default !== "object") lines.push(`Default: ${valueText(p.default)}`);
  if (Array.isArray(p.default)) lines.push(`Default: ${valueText(p.default)}`);
  if (p.unit) lines.push(`Unit: ${p.unit}`);
  if (p.form) lines.push(`Values: ${p.form}`);
  if (p.support && p.support !== "exact") lines.push(`Support: ${p.support}`);
  if (p.set) lines.push(p.set);
  return lines.filter(Boolean).join("\n");
}

/** @param {Parameter} p @param {App} app @returns {Field} */
export function parameterField(p, app) {
  const target = p.set;
  if (!target) return readOnlyField(p);
  const edit = (/** @type {any} */ value, /** @type {string} */ gesture) => void app.session.edit(editText(target, value), gesture);
  const reset = () => {
    const edits = app.session.state.edits.filter((e) => !e.startsWith(`${target}=`));
    void app.session.attempt("set_edits", {edits});
  };
  const value = p.value ?? p.default;
  const field = bareField(p, value, edit, reset, app);
  field.element.classList.toggle("edited", Boolean(p.edited));
  return {
    element: field.element,
    update: (next) => {
      field.element.classList.toggle("edited", Boolean(next.edited));
      field.update(next);
    },
  };
}

/**
 * @param {Parameter} p @param {any} value @param {(value: any, gesture: string) => void} edit
 * @param {() => void} reset @param {App} app @returns {Field}
 */
function bareField(p, value, edit, reset, app) {
  const doc = helpText(p);
  switch (p.type) {
    case "boolean": {
      const field = checkField(p.name, Boolean(value), (v) => edit(v, newGesture(p.name)), doc);
      return {element: withReset(field.element, p.name, reset), update: (n) => { field.input.checked = Boolean(n.value ?? n.default); }};
    }
    case "integer": case "scalar": {
      if (p.choices?.length) return choiceField(p, value, edit);
      const number = Number(value ?? 0);
      const field = numberField({label: p.name, value: number, unit: p.unit, doc, integer: p.type === "integer",
                                 ...sliderRange(p, number), onInput: edit, onReset: reset});
      return {element: field.element, update: (n) => field.set(Number(n.value ?? n.default ?? 0))};
    }
    case "color": case "vector": {
      const triple = Array.isArray(value) ? value.slice(0, 3).map(Number) : [0, 0, 0];
      const field = colorField({label: p.name, value: triple, doc, swatch: p.type === "color", onInput: edit, onReset: reset});
      const update = (/** @type {Parameter} */ n) => {
        const v = n.value ?? n.default;
        if (Array.isArray(v)) field.set(v.slice(0, 3).map(Number));
      };
      return {element: field.element, update};
    }
    case "texture": return textureField(p, p.connection?.name ?? value, app);
    case "shader": return shaderField(p, value, app);
    case "string": case "transform": case "lightprofile": case "light": case "material": case "geometry": {
      const field = textField(p.name, valueText(value), (v) => edit(v, newGesture(p.name)));
      field.element.title = doc;
      return {element: withReset(field.element, p.name, reset), update: (n) => {
        if (document.activeElement !== field.input) field.input.value = valueText(n.value ?? n.default);
      }};
    }
    default: {
      if (!isStructured(p.type)) return readOnlyField(p);
      // Arrays and structures are written as in a scene file: [1 0 0, 0 1 0], {"name" 1}.
      const field = textField(p.name, p.text ?? "", (v) => edit(v, newGesture(p.name)));
      field.input.placeholder = p.type.startsWith("array") ? "[ ]" : "{ }";
      field.element.title = doc;
      return {element: withReset(field.element, p.name, reset), update: (n) => {
        if (document.activeElement !== field.input) field.input.value = n.text ?? "";
      }};
    }
  }
}

/** @param {string} type */
const isStructured = (type) => type.startsWith("array") || type === "struct";

/** @param {HTMLElement} element @param {string} name @param {() => void} reset */
function withReset(element, name, reset) {
  element.append(h("button", {class: "reset", title: `Reset ${name}`, attributes: {type: "button", "aria-label": `Reset ${name}`},
                              on: {click: reset}}, icon("reset")));
  return element;
}

/** @param {Parameter} p @param {any} value @param {(value: any, gesture: string) => void} edit @returns {Field} */
function choiceField(p, value, edit) {
  const options = (p.choices ?? []).map((text, i) => /** @type {[string, string]} */ ([String(i), text]));
  const field = selectField(p.name, options, String(value), (v) => edit(Number(v), newGesture(p.name)));
  return {element: field.element, update: (n) => { field.select.value = String(n.value ?? n.default); }};
}

/** @param {Parameter} p @returns {Field} */
function readOnlyField(p) {
  const shown = (/** @type {Parameter} */ n) => {
    const v = n.value ?? n.default;
    if (v !== null && typeof v === "object" && !Array.isArray(v)) return "structure";
    if (Array.isArray(v) && (v.length > 16 || v.some((x) => typeof x === "object"))) return `${v.length} entries`;
    return valueText(v) || "not set";
  };
  const text = h("output", {class: "readonly", text: shown(p)});
  const element = h("div", {class: "field", title: helpText(p)}, h("span", {class: "label", text: p.name}), h("div", {class: "wide"}, text));
  return {element, update: (n) => { text.textContent = shown(n); }};
}

/** @param {Parameter} p @param {any} value @param {App} app @returns {Field} */
function textureField(p, value, app) {
  const target = p.set ?? "";
  const names = (app.session.outline?.textures ?? []).map((t) => t.name);
  const image = h("img", {class: "thumbnail", attributes: {alt: "", width: "40", height: "40"}});
  const options = /** @type {[string, string][]} */ ([["", "none"], ...names.map((n) => [n, n])]);
  const field = selectField(p.name, options, String(value ?? ""), (v) => void app.session.edit(editText(target, v)));
  field.element.title = helpText(p);
  field.element.classList.add("texture");
  const show = async (/** @type {string} */ name) => {
    if (image.src.startsWith("blob:")) URL.revokeObjectURL(image.src);
    const url = name ? await thumbnailUrl(name, app.session) : null;
    if (url) image.src = url;
    else image.removeAttribute("src");
  };
  void show(String(value ?? ""));
  const replace = async (/** @type {File} */ file) => {
    const name = String(field.select.value);
    if (!name) return app.toasts.show("Choose a texture of the scene first; its file is then replaced.", "error");
    try {
      const path = await uploadTexture(file, app.session.token);
      await app.session.attempt("relink", {texture: name, file: path});
      await show(name);
      app.toasts.show(`${plainFileName(file.name)} is now the file of ${name}.`);
    } catch (error) {
      app.toasts.show(String(error instanceof Error ? error.message : error), "error");
    }
  };
  field.element.addEventListener("dragover", (event) => event.preventDefault());
  field.element.addEventListener("drop", (event) => {
    event.preventDefault();
    event.stopPropagation();
    const file = event.dataTransfer?.files[0];
    if (file) void replace(file);
  });
  field.element.querySelector(".wide")?.prepend(image);
  return {element: field.element, update: (n) => {
    const name = String(n.connection?.name ?? n.value ?? "");
    if (field.select.value !== name) void show(name);
    field.select.value = name;
  }};
}

/** @param {Parameter} p @param {any} value @param {App} app @returns {Field} */
function shaderField(p, value, app) {
  const target = p.set ?? "";
  const shaders = app.session.outline?.shaders ?? [];
  const options = /** @type {[string, string][]} */ ([["", "none"], ...shaders.map((s) => [s.name, `${s.name} (${s.shader})`])]);
  const field = selectField(p.name, options, String(p.connection?.name ?? value ?? ""), (v) => {
    if (v) void app.session.edit(connectText(target, v));
  });
  field.element.title = helpText(p);
  return {element: field.element, update: (n) => { field.select.value = String(n.connection?.name ?? n.value ?? ""); }};
}

/** Button that opens a connected shader. @param {string} name @param {App} app */
export const openButton = (name, app) => button(name, () => app.select(name), {class: "link", title: `Edit ${name}`});
