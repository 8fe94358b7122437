// SPDX-License-Identifier: Apache-2.0
// The light mixer: strength and colour of each light layer, applied in the page.
import {colorField} from "../ui/color_field.js";
import {button, checkField, h, uniqueId} from "../ui/dom.js";
import {numberField} from "../ui/number_field.js";
import {writeLight} from "../scene/write_light.js";

/** @typedef {import("./app.js").App} App */

/** "light_sun" is the layer of the light "sun". @param {string} layer */
export const lightName = (layer) => layer.replace(/^light_/, "");

/** @param {App} app */
export function createLightsPanel(app) {
  const {display, session} = app;
  const list = h("div", {});
  const toggle = checkField("Mix lights", false, (v) => {
    display.mix.active = v;
    requestLayers();
    display.change();
  }, "Receives the layer of each light group. The mixer then changes the picture without rendering.");
  const reset = button("Reset mixer", () => {
    display.mix.settings.clear();
    build();
    display.change();
  });
  const none = h("div", {class: "group"}, h("p", {class: "muted", text: "The scene defines no light groups."}),
                 h("div", {class: "actions"}, button("Make a group for each light", () => {
                   display.mix.active = true;
                   session.view({light_groups: "auto"});
                 }, {title: "Renders again with one layer per light; the scene does not change"})));
  const element = h("div", {class: "panel"}, h("header", {}, h("h2", {text: "Light mixer"})),
                    h("p", {class: "muted", text: "The picture is the sum of its light layers. Sliders act at once and never restart the render."}),
                    none, h("div", {class: "group"}, toggle.element, h("div", {class: "actions"}, reset)), list);

  const requestLayers = () => session.view({layers: display.neededLayers(session.state)});
  const change = () => {
    if (!display.mix.active) {
      display.mix.active = true;
      requestLayers();
    }
    display.change();
  };

  const build = () => {
    list.replaceChildren(...session.state.light_layers.map((layer) => {
      const s = display.mix.of(layer), name = lightName(layer), id = uniqueId("light");
      const on = h("input", {attributes: {id, type: "checkbox"}, on: {change: () => { s.on = on.checked; change(); }}});
      on.checked = s.on;
      const strength = numberField({label: "Strength", value: s.strength, min: 0, low: 0, high: 4, reset: 1, onInput: (v) => { s.strength = v; change(); }});
      const color = colorField({label: "Colour", value: s.color, onInput: (v) => { s.color = /** @type {any} */ (v); change(); }});
      const solo = button("Solo", () => {
        for (const other of session.state.light_layers) display.mix.of(other).on = other === layer;
        change();
        build();
      }, {class: "small", title: `Shows only ${name}`});
      const apply = button("Write", () => void writeLight(app, name, s, build), {class: "small", title: `Multiplies the light ${name} of the scene by strength and colour, as an edit`});
      const isLight = (session.outline?.lights ?? []).some((l) => l.name === name || l.instance === name);
      const group = h("section", {class: "group"}, h("div", {class: "light-head"}, on, h("label", {text: name, attributes: {for: id}}), h("span", {class: "spring"}), solo, isLight ? apply : null),
                      strength.element, color.element);
      group.dataset.layer = layer;
      return group;
    }));
  };
  let known = "";
  session.on("state", (state) => {
    none.hidden = state.light_layers.length > 0;
    toggle.element.hidden = reset.hidden = state.light_layers.length === 0;
    const names = state.light_layers.join("\n");
    if (names === known) return;
    known = names;
    build();
    if (display.mix.active) requestLayers();
  });
  let shownLayer = display.layer;
  display.on("change", () => {
    toggle.input.checked = display.mix.active;
    if (display.layer === shownLayer) return;
    shownLayer = display.layer;
    requestLayers();
  });
  // A new server process knows no layers of this page; the scene is read when the outline arrives.
  session.on("outline", () => { if (display.neededLayers(session.state).length > 1) requestLayers(); });
  display.on("restored", build);
  session.on("outline", build);
  return element;
}
