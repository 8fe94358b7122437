// SPDX-License-Identifier: Apache-2.0
// Builds elements. Texts of the scene go through textContent only.

/**
 * @typedef {object} Properties
 * @property {string} [class]
 * @property {string} [text]
 * @property {string} [title]
 * @property {Record<string, string>} [attributes]
 * @property {Record<string, (event: any) => void>} [on]
 */

/**
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag @param {Properties} [properties] @param {...(Node | string | null | undefined)} children
 * @returns {HTMLElementTagNameMap[T]}
 */
export function h(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  if (properties.class) element.className = properties.class;
  if (properties.text !== undefined) element.textContent = properties.text;
  if (properties.title) element.title = properties.title;
  for (const [name, value] of Object.entries(properties.attributes ?? {})) element.setAttribute(name, value);
  for (const [name, listener] of Object.entries(properties.on ?? {})) element.addEventListener(name, listener);
  for (const child of children) if (child !== null && child !== undefined) element.append(child);
  return element;
}

let ids = 0;
/** @param {string} prefix */
export const uniqueId = (prefix) => `${prefix}-${++ids}`;

/**
 * @param {string} text @param {() => void} action
 * @param {{class?: string, title?: string, icon?: SVGElement, pressed?: boolean}} [options]
 */
export function button(text, action, options = {}) {
  const element = h("button", {class: `button ${options.class ?? ""}`, title: options.title, attributes: {type: "button"},
                               on: {click: action}});
  if (options.icon) element.append(options.icon);
  if (text) element.append(h("span", {text}));
  if (!text && options.title) element.setAttribute("aria-label", options.title);
  if (options.pressed !== undefined) element.setAttribute("aria-pressed", String(options.pressed));
  return element;
}

/** @param {string} title @param {...(Node | string | null)} children */
export function section(title, ...children) {
  return h("section", {class: "group"}, h("h3", {text: title}), ...children);
}

/** @param {string} title @param {boolean} open @param {...(Node | string | null)} children */
export function disclosure(title, open, ...children) {
  const details = h("details", {class: "group"}, h("summary", {text: title}), h("div", {class: "group-body"}, ...children));
  details.open = open;
  return details;
}

/** Label, value pairs as a table. @param {[string, string][]} rows */
export function factTable(rows) {
  return h("dl", {class: "facts"}, ...rows.flatMap(([k, v]) => [h("dt", {text: k}), h("dd", {text: v})]));
}

/**
 * @param {string} label @param {[string, string][]} options value and text @param {string} value
 * @param {(value: string) => void} onChange
 */
export function selectField(label, options, value, onChange) {
  const id = uniqueId("select");
  const select = h("select", {attributes: {id}, on: {change: () => onChange(select.value)}});
  const fill = (/** @type {[string, string][]} */ list, /** @type {string} */ chosen) => {
    select.replaceChildren(...list.map(([v, text]) => h("option", {text, attributes: {value: v}})));
    select.value = chosen;
  };
  fill(options, value);
  return {element: h("div", {class: "field"}, h("label", {text: label, attributes: {for: id}}), h("div", {class: "wide"}, select)),
          select, fill};
}

/** @param {string} label @param {boolean} value @param {(value: boolean) => void} onChange @param {string} [doc] */
export function checkField(label, value, onChange, doc = "") {
  const id = uniqueId("check");
  const input = h("input", {attributes: {id, type: "checkbox"}, on: {change: () => onChange(input.checked)}});
  input.checked = value;
  return {element: h("div", {class: "field", title: doc}, h("label", {text: label, attributes: {for: id}}),
                     h("div", {class: "wide"}, input)), input};
}

/** @param {string} label @param {string} value @param {(value: string) => void} onChange @param {Record<string, string>} [attributes] */
export function textField(label, value, onChange, attributes = {}) {
  const id = uniqueId("text");
  const input = h("input", {attributes: {id, type: "text", spellcheck: "false", ...attributes}, on: {change: () => onChange(input.value)}});
  input.value = value;
  return {element: h("div", {class: "field"}, h("label", {text: label, attributes: {for: id}}), h("div", {class: "wide"}, input)), input};
}
