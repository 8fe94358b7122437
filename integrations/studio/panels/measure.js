// SPDX-License-Identifier: Apache-2.0
// The measure panel: probe, lux grid and explanation of a pixel.
import {VIRIDIS} from "../display/tone_shader.js";
import {scaleOf, scalePosition, tickText} from "../display/false_color.js";
import {mapColor} from "../display/srgb.js";
import {project} from "../scene/camera_moves.js";
import {gridAbove, gridOnSurface, verticalAxis} from "../scene/lux_grid.js";
import {pixelKey, sceneKey} from "../scene/measured_state.js";
import {button, factTable, h, section, selectField} from "../ui/dom.js";
import {numberField} from "../ui/number_field.js";

/** @typedef {import("./app.js").App} App */
/** @typedef {import("../net/types.js").Measured} Measured */
/** @typedef {import("../net/types.js").LuxGrid} LuxGrid */

const LABEL_WIDTH = 38, LABEL_HEIGHT = 13;  // of a number in the picture, CSS pixels

/** @param {number} v */
const digits = (v) => Number.isFinite(v) ? String(Number(v.toPrecision(4))) : "–";
/** @param {number[] | undefined} v */
const triple = (v) => v ? v.map(digits).join("  ") : "–";
/** @param {Measured | undefined} m @param {string} unit */
const interval = (m, unit) => m ? `${digits(m.value)} ± ${digits(m.half_width)} ${unit}` : "–";

/** Logarithmic if sun and shade differ by more than ten. @param {LuxGrid} g */
const gridScale = (g) => scaleOf(g.sensors.map((s) => s.value), g.min > 0 && g.max > 10 * g.min);

/**
 * Marks an element while the values in it are not those of the present scene.
 * @param {App} app @param {HTMLElement} out @param {(state: import("../net/types.js").SceneState) => string} keyOf
 */
function watchAge(app, out, keyOf) {
  let key = "";
  const note = h("p", {class: "stale-note", text: "Measured before the last change."});
  note.hidden = true;
  const isOld = () => key !== "" && key !== keyOf(app.session.state);
  const update = () => {
    note.hidden = !isOld();
    out.classList.toggle("stale", isOld());
  };
  app.session.on("state", update);
  /** The state at the start of a measurement. */ const present = () => keyOf(app.session.state);
  return {note, isOld, present, set: (/** @type {string} */ value) => { key = value; update(); }};
}

/** @param {App} app */
export function createMeasurePanel(app) {
  const probe = createProbe(app), grid = createGrid(app), explain = createExplain(app);
  app.events.on("click", ({tool, x, y}) => {
    if (tool === "probe") void probe.measure(x, y);
    else if (tool === "grid") void grid.pick(x, y);
    else if (tool === "explain") void explain.ask(x, y);
    else return;
    app.showPanel("measure");
  });
  return h("div", {class: "panel"}, h("header", {}, h("h2", {text: "Measure"})), probe.element, grid.element, explain.element);
}

/** @param {App} app */
function createProbe(app) {
  const out = h("div", {attributes: {"aria-live": "polite"}}, h("p", {class: "empty", text: "Choose the probe tool (4) and click the picture."}));
  const age = watchAge(app, out, pixelKey);
  /** @type {AbortController | null} */ let running = null;
  /** @type {[number, number] | null} */ let mark = null;
  app.viewport.painters.push((context, viewport) => {
    if (!mark || age.isOld()) return;
    const [x, y] = viewport.canvasPoint([mark[0] + 0.5, mark[1] + 0.5]);
    for (const [color, width] of /** @type {[string, number][]} */ ([["#000", 3], ["#fff", 1]])) {
      context.strokeStyle = color;
      context.lineWidth = width;
      context.beginPath();
      context.arc(x, y, 7, 0, 7);
      context.moveTo(x - 12, y); context.lineTo(x - 3, y);
      context.moveTo(x + 3, y); context.lineTo(x + 12, y);
      context.stroke();
    }
  });
  const measure = async (/** @type {number} */ x, /** @type {number} */ y) => {
    running?.abort();
    const control = running = new AbortController();
    mark = [x, y];
    const at = age.present();
    age.set("");
    app.viewport.invalidate();
    out.replaceChildren(h("p", {class: "muted", text: `Measuring pixel ${x}, ${y} …`}));
    try {
      const r = await app.session.request("probe", {x, y}, control.signal);
      if (control.signal.aborted) return;
      out.replaceChildren(factTable([
        ["Pixel", `${x}, ${y}`], ["Luminance", interval(r.luminance, "cd/m²")], ["Illuminance", interval(r.illuminance, "lx")],
        ["Radiance", triple(r.radiance)], ["Object", r.object ?? "–"], ["Instance", r.instance ?? "–"], ["Material", r.material ?? "–"],
        ["Position", triple(r.position)], ["Normal", triple(r.normal)], ["Distance", r.distance === undefined ? "–" : digits(r.distance)]]));
      age.set(at);
      if (r.material) out.append(h("div", {class: "actions"}, button(`Edit ${r.material}`, () => app.select(r.material))));
    } catch (error) {
      if (!control.signal.aborted) out.replaceChildren(h("p", {class: "error", text: String(/** @type {Error} */ (error).message)}));
    }
  };
  return {element: section("Probe", age.note, out), measure};
}

/** @param {App} app */
function createGrid(app) {
  const s = {kind: "surface", width: 2, depth: 2, columns: 5, rows: 5, height: 0.85, seconds: 20};
  /** @type {any} */ let picked = null;
  /** @type {LuxGrid | null} */ let result = null;
  /** @type {AbortController | null} */ let running = null;
  const out = h("div", {attributes: {"aria-live": "polite"}}, h("p", {class: "empty", text: "Choose the grid tool (5) and click a surface."}));
  const age = watchAge(app, out, sceneKey);
  const kind = selectField("Grid", [["surface", "on the surface"], ["plane", "horizontal plane above"]], "surface", (v) => { s.kind = v; show(); });
  /** @param {keyof typeof s} key @param {string} label @param {object} o */
  const number = (key, label, o) => numberField({label, value: Number(s[key]), onInput: (v) => Object.assign(s, {[key]: v}), ...o}).element;
  const size = h("div", {}, number("width", "Width", {min: 0.01, high: 20}), number("depth", "Depth", {min: 0.01, high: 20}),
                    number("columns", "Columns", {min: 1, max: 30, integer: true}), number("rows", "Rows", {min: 1, max: 30, integer: true}));
  const plane = h("div", {}, number("height", "Height above", {min: 0, high: 5}));
  const show = () => { plane.hidden = s.kind !== "plane"; };
  show();
  app.viewport.painters.push((context, viewport) => {
    const {state} = app.session;
    if (!result || !state.look) return;
    const scale = gridScale(result), ratio = window.devicePixelRatio || 1;
    context.globalAlpha = age.isOld() ? 0.4 : 1;
    context.font = `${11 * ratio}px system-ui, sans-serif`;
    context.textAlign = "center";
    /** @type {number[][]} */ const labels = [];
    for (const sensor of result.sensors) {
      const pixel = project(sensor.position, state.look, state.fov, state.size);
      if (!pixel || pixel[0] < 0 || pixel[1] < 0 || pixel[0] > state.size[0] || pixel[1] > state.size[1]) continue;
      const [x, y] = viewport.canvasPoint(pixel);
      context.beginPath();
      context.arc(x, y, 4 * ratio, 0, 7);
      context.fillStyle = mapColor(VIRIDIS, scalePosition(scale, sensor.value));
      context.fill();
      context.lineWidth = ratio;
      context.strokeStyle = "#fff";
      context.stroke();
      // Numbers that would cover others are left out; the table has them all.
      if (labels.some((l) => Math.abs(l[0] - x) < LABEL_WIDTH * ratio && Math.abs(l[1] - y) < LABEL_HEIGHT * ratio)) continue;
      labels.push([x, y]);
      context.lineWidth = 3 * ratio;
      context.strokeStyle = "rgb(0 0 0 / 0.75)";
      context.fillStyle = "#fff";
      context.strokeText(tickText(Math.round(sensor.value)), x, y - 8 * ratio);
      context.fillText(tickText(Math.round(sensor.value)), x, y - 8 * ratio);
    }
    context.globalAlpha = 1;
  });

  const measure = async () => {
    if (running) return running.abort();
    if (!picked?.hit) return app.toasts.show("Choose the grid tool and click a surface first.", "error");
    const up = verticalAxis(app.session.state.look?.up ?? [0, 0, 1]), at = age.present();
    const fields = s.kind === "surface" ? gridOnSurface(picked, s.width, s.depth, s.columns, s.rows, up)
        : gridAbove(picked, s.height, s.width, s.depth, s.columns, s.rows, up);
    age.set("");
    const control = running = new AbortController();
    start.querySelector("span")?.replaceChildren("Stop");
    out.replaceChildren(h("p", {class: "muted", text: "Measuring …"}));
    try {
      const reply = await app.session.request("lux_grid", {...fields, seconds: s.seconds}, control.signal);
      result = /** @type {LuxGrid} */ (reply.illuminance);
      age.set(at);
      showResult(result);
    } catch (error) {
      out.replaceChildren(h("p", {class: "error", text: String(/** @type {Error} */ (error).message)}));
    }
    running = null;
    start.querySelector("span")?.replaceChildren("Measure grid");
    app.viewport.invalidate();
  };
  const showResult = (/** @type {LuxGrid} */ g) => {
    const scale = gridScale(g);
    const body = [];
    for (let r = 0; r < g.rows; ++r) {
      const cells = [];
      for (let c = 0; c < g.columns; ++c) {
        const sensor = g.sensors[r * g.columns + c];
        if (!sensor) continue;
        const t = scalePosition(scale, sensor.value);
        const cell = h("td", {text: tickText(Math.round(sensor.value)), title: `${digits(sensor.value)} ± ${digits(sensor.half_width)} lx`});
        cell.style.setProperty("background-color", mapColor(VIRIDIS, t));
        cell.style.setProperty("color", t > 0.55 ? "#000" : "#fff");
        cells.push(cell);
      }
      body.push(h("tr", {}, ...cells));
    }
    out.replaceChildren(factTable([["Mean", interval(g.mean, "lx")], ["Minimum", `${digits(g.min)} lx`], ["Maximum", `${digits(g.max)} lx`], ["Uniformity", digits(g.uniformity)]]),
                        h("div", {class: "grid-scroll", attributes: {tabindex: "0", role: "region", "aria-label": "Lux grid"}},
                          h("table", {class: "lux"}, h("caption", {class: "visually-hidden", text: "Illuminance in lux"}), ...body)));
  };
  const start = button("Measure grid", () => void measure(), {class: "primary"});
  const clear = button("Clear", () => { result = null; age.set(""); out.replaceChildren(); app.viewport.invalidate(); });
  const pick = async (/** @type {number} */ x, /** @type {number} */ y) => {
    picked = await app.session.attempt("pick", {x, y});
    if (!picked?.hit) return out.replaceChildren(h("p", {class: "error", text: "There is no surface below this pixel."}));
    out.replaceChildren(h("p", {class: "muted", text: `Centre: ${triple(picked.position)} on ${picked.object ?? picked.instance}`}));
  };
  return {element: section("Lux grid", kind.element, plane, size, number("seconds", "Time limit", {min: 1, high: 120, unit: "s"}), h("div", {class: "actions"}, start, clear), age.note, out), pick};
}

/** @param {App} app */
function createExplain(app) {
  const out = h("pre", {class: "explain", attributes: {tabindex: "0", "aria-label": "Explanation of a pixel"}, text: "Choose the explain tool (6) and click the picture."});
  const age = watchAge(app, out, pixelKey);
  /** @type {AbortController | null} */ let running = null;
  const ask = async (/** @type {number} */ x, /** @type {number} */ y) => {
    running?.abort();
    const control = running = new AbortController();
    const at = age.present();
    age.set("");
    out.textContent = `Tracing pixel ${x}, ${y} …`;
    try {
      const reply = await app.session.request("explain", {x, y}, control.signal);
      if (control.signal.aborted) return;
      out.textContent = String(reply.text);
      age.set(at);
    } catch (error) {
      if (!control.signal.aborted) out.textContent = String(/** @type {Error} */ (error).message);
    }
  };
  return {element: section("Explain a pixel", age.note, out), ask};
}
