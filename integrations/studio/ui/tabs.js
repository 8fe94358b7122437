// SPDX-License-Identifier: Apache-2.0
// Panels behind a rail of tabs (ARIA tabs pattern, automatic activation by arrow keys).
import {h} from "./dom.js";
import {icon} from "./icons.js";

/** @typedef {{id: string, title: string, icon: import("./icons.js").IconName, element: HTMLElement}} Panel */

/** @param {Panel[]} panels */
export function createTabs(panels) {
  /** @type {Map<string, HTMLButtonElement>} */
  const tabs = new Map();
  const badges = new Map();
  const rail = h("div", {class: "rail", attributes: {role: "tablist", "aria-label": "Panels", "aria-orientation": "vertical"}});
  const host = h("div", {class: "panels"});
  let current = panels[0].id;

  const show = (/** @type {string} */ id, focus = false) => {
    current = id;
    for (const panel of panels) {
      const selected = panel.id === id, tab = tabs.get(panel.id);
      panel.element.hidden = !selected;
      tab?.setAttribute("aria-selected", String(selected));
      if (tab) tab.tabIndex = selected ? 0 : -1;
    }
    if (focus) tabs.get(id)?.focus();
    host.dispatchEvent(new CustomEvent("panel", {detail: id}));
  };
  for (const panel of panels) {
    const badge = h("span", {class: "badge", attributes: {hidden: ""}});
    badges.set(panel.id, badge);
    const tab = h("button", {class: "tab", attributes: {type: "button", role: "tab", id: `tab-${panel.id}`, "aria-controls": `panel-${panel.id}`},
                             on: {click: () => show(panel.id)}}, icon(panel.icon), h("span", {text: panel.title}), badge);
    tabs.set(panel.id, tab);
    rail.append(tab);
    panel.element.id = `panel-${panel.id}`;
    panel.element.setAttribute("role", "tabpanel");
    panel.element.setAttribute("aria-labelledby", `tab-${panel.id}`);
    panel.element.tabIndex = -1;
    host.append(panel.element);
  }
  rail.addEventListener("keydown", (event) => {
    const at = panels.findIndex((p) => p.id === current);
    const step = {ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1}[event.key];
    if (step) show(panels[(at + step + panels.length) % panels.length].id, true);
    else if (event.key === "Home") show(panels[0].id, true);
    else if (event.key === "End") show(panels[panels.length - 1].id, true);
    else return;
    event.preventDefault();
  });
  show(current);
  return {
    rail, host, show,
    get current() { return current; },
    /** @param {string} id @param {string} text empty: no badge */
    badge(id, text) {
      const badge = badges.get(id);
      badge.textContent = text;
      badge.hidden = !text;
    },
  };
}
