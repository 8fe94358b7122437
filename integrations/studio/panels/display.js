// SPDX-License-Identifier: Apache-2.0
// The display panel: layer, exposure, white balance, tone curve, false colours. Nothing here renders.
import {NEUTRAL_TEMPERATURE, automaticExposure, defaultTone, tonemapOptions} from "../display/tone.js";
import {scaleOf} from "../display/false_color.js";
import {button, checkField, h, section, selectField} from "../ui/dom.js";
import {numberField} from "../ui/number_field.js";

/** @typedef {import("./app.js").App} App */
/** @typedef {import("../display/tone.js").ToneSettings} ToneSettings */

/** Colours of the shown layer, at most some thousands. @param {App} app @param {number} [layer] */
export function sampleColors(app, layer = 0) {
  const f = app.session.frames, colors = [];
  const step = Math.max(1, Math.floor(Math.sqrt(f.width * f.height / 20000)));
  for (let y = 0; y < f.height; y += step)
    for (let x = 0; x < f.width; x += step) {
      const c = f.colorAt(x * f.divider, y * f.divider, layer);
      if (c) colors.push(c);
    }
  return colors;
}

/** @param {App} app */
export function createDisplayPanel(app) {
  const {display} = app;
  const neutral = defaultTone();
  /** @type {Map<keyof ToneSettings, ReturnType<typeof numberField>>} */
  const fields = new Map();
  /** @param {keyof ToneSettings} key @param {string} label @param {object} o */
  const number = (key, label, o) => {
    const field = numberField({label, value: Number(display.tone[key]), reset: Number(neutral[key]),
                               onInput: (v) => display.changeTone({[key]: v}), ...o});
    fields.set(key, field);
    return field.element;
  };
  const operator = selectField("View", [["agx", "AgX"], ["neutral", "PBR Neutral"], ["photographic", "Photographic"], ["simple", "Simple"]],
                               display.tone.operator, (v) => display.changeTone({operator: /** @type {any} */ (v)}));
  const layer = selectField("Layer", [["beauty", "beauty"]], "beauty", (v) => display.change({layer: v}));
  const denoise = checkField("Denoise", false, (v) => display.change({layer: v ? "denoised" : "beauty"}),
                             "Removes the noise of the finished picture; of a running one if that is quick");
  const automatic = button("Auto exposure", () => {
    const stops = automaticExposure(sampleColors(app), display.tone);
    if (stops !== null) display.changeTone({exposure: Number(stops.toFixed(2))});
  }, {title: "Exposure for which the logarithmic mean becomes middle grey"});
  const measured = checkField("Camera exposure", display.tone.measured, (v) => display.changeTone({measured: v}),
                              "Exposure from film speed, shutter and aperture. Off: a plain factor.");
  const camera = h("div", {}, number("iso", "Film speed", {min: 0, low: 25, high: 6400, logarithmic: true, unit: "ISO"}),
                   number("shutter", "Shutter 1/", {min: 0.001, low: 0.1, high: 4000, logarithmic: true, unit: "s"}),
                   number("fNumber", "Aperture f/", {min: 0.1, low: 1, high: 32, logarithmic: true}));
  const film = h("div", {}, number("burn", "Burn", {min: 0, max: 1, doc: "1 = linear, 0 = never over-exposed"}),
                 number("crush", "Crush", {min: 0, high: 1, doc: "0 = linear; larger values darken shadows"}),
                 number("saturation", "Saturation", {min: 0, high: 2}));
  const gamma = number("gamma", "Gamma", {min: 0.1, low: 0.5, high: 4});
  const asymptotic = checkField("Asymptotic", false, (v) => display.changeTone({asymptotic: v}), "Smooth at the knee and never above 1");
  const simple = h("div", {}, number("pedestal", "Pedestal", {low: -0.5, high: 0.5}), number("gain", "Gain", {min: 0, low: 0.001, high: 100, logarithmic: true}),
                   number("knee", "Knee", {min: 0, high: 1}), number("compression", "Compression", {min: 0, high: 10}), asymptotic.element);
  const white = h("div", {}, number("temperature", "White point", {min: 1700, max: 25000, low: 2000, high: 12000, logarithmic: true, unit: "K",
                                    doc: "Temperature of the light that becomes neutral", integer: true, reset: NEUTRAL_TEMPERATURE}),
                  number("tint", "Tint", {min: -1, max: 1, doc: "-1 green ... 1 magenta"}));
  const options = h("code", {class: "command"});
  const copy = button("Copy", async () => {
    await navigator.clipboard.writeText(options.textContent ?? "");
    app.toasts.show("The options are in the clipboard.");
  }, {class: "small"});
  const exposure = section("Exposure", number("exposure", "Exposure", {low: -10, high: 10, unit: "EV"}), h("div", {class: "actions"}, automatic), measured.element, camera);
  const balance = section("White balance", white);
  const curve = section("Tone curve", operator.element, film, simple, gamma);
  const element = h("div", {class: "panel"}, h("header", {}, h("h2", {text: "Display"})), section("Show", layer.element, denoise.element, falseColorFields(app)),
                    exposure, balance, curve, section("Same picture by oriel tonemap", h("div", {class: "command-row"}, options, copy)));

  const update = () => {
    const t = display.tone, film_ = t.operator === "photographic";
    for (const [key, field] of fields) field.set(Number(t[key]));
    operator.select.value = t.operator;
    measured.input.checked = t.measured;
    camera.hidden = !t.measured;
    measured.element.hidden = balance.hidden = t.operator === "simple";
    if (t.operator === "simple") camera.hidden = true;
    film.hidden = !film_;
    simple.hidden = t.operator !== "simple";
    gamma.hidden = t.operator === "agx" || t.operator === "neutral";
    options.textContent = tonemapOptions(t);
    layer.select.value = display.layer;
    denoise.input.checked = display.layer === "denoised";
  };
  display.on("change", update);
  let known = "";
  app.session.on("state", (state) => {
    const names = state.available_layers.join("\n");
    if (names === known) return;
    known = names;
    denoise.element.hidden = !state.available_layers.includes("denoised");
    const available = state.available_layers.includes(display.layer);
    layer.fill(state.available_layers.map((/** @type {string} */ n) => [n, n]), available ? display.layer : "beauty");
    if (!available) display.change({layer: "beauty"});
  });
  update();
  return element;
}

/** @param {App} app */
function falseColorFields(app) {
  const {display} = app;
  const refresh = () => {
    if (!display.automaticScale) return;
    const names = app.session.frames.names, at = Math.max(0, names.indexOf(display.layer));
    const unit = display.layer === "beauty" || display.layer === "denoised" ? app.session.state.unit_luminance : 1;
    const values = sampleColors(app, at).map((c) => unit * (0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]));
    display.change({scale: scaleOf(values, display.scale.logarithmic)});
  };
  const on = checkField("False colours", false, (v) => {
    display.falseColors = v;
    refresh();
    display.change();
  }, "Luminance in cd/m²");
  const logarithmic = checkField("Logarithmic", false, (v) => {
    display.scale = {...display.scale, logarithmic: v, low: v ? Math.max(display.scale.low, display.scale.high * 1e-3) : 0};
    refresh();
    display.change();
  });
  const automatic = checkField("Automatic range", true, (v) => {
    display.automaticScale = v;
    refresh();
    display.change();
  });
  const low = numberField({label: "From", value: 0, min: 0, low: 0, high: 1000, onInput: (v) => display.change({automaticScale: false, scale: {...display.scale, low: v}})});
  const high = numberField({label: "To", value: 1000, min: 1e-6, low: 0.1, high: 1e5, logarithmic: true,
                            onInput: (v) => display.change({automaticScale: false, scale: {...display.scale, high: v}})});
  const more = h("div", {}, logarithmic.element, automatic.element, low.element, high.element);
  display.on("change", () => {
    on.input.checked = display.falseColors;
    more.hidden = !display.falseColors && display.layer !== "depth" && display.layer !== "illuminance";
    automatic.input.checked = display.automaticScale;
    low.set(display.scale.low);
    high.set(display.scale.high);
  });
  let wait = 0;
  app.session.on("frame", () => {
    if (more.hidden || !display.automaticScale || performance.now() - wait < 1000) return;
    wait = performance.now();
    refresh();
  });
  more.hidden = true;
  return h("div", {}, on.element, more);
}
