// SPDX-License-Identifier: Apache-2.0
// The compare panel: snapshots, wipe, difference and FLIP.
import {button, h, section, selectField} from "../ui/dom.js";
import {numberField} from "../ui/number_field.js";

/** @typedef {import("./app.js").App} App */
/** @typedef {import("../scene/snapshots.js").Snapshot} Snapshot */

/** Small picture of display bytes. @param {Uint8Array} pixels @param {number} width @param {number} height */
function thumbnail(pixels, width, height) {
  const full = new OffscreenCanvas(width, height);
  full.getContext("2d")?.putImageData(new ImageData(new Uint8ClampedArray(pixels), width, height), 0, 0);
  const canvas = h("canvas", {class: "snapshot-picture", attributes: {"aria-hidden": "true"}});
  canvas.width = 96;
  canvas.height = Math.max(1, Math.round(96 * height / width));
  canvas.getContext("2d")?.drawImage(full, 0, 0, canvas.width, canvas.height);
  return canvas;
}

/** @param {App} app */
export function createComparePanel(app) {
  const {display, snapshots, viewport, session} = app;
  const list = h("ul", {class: "snapshots"});
  const result = h("p", {class: "muted", attributes: {"aria-live": "polite"}});
  let gain = 8, request = 0;
  /** @type {Worker | null} */ let worker = null;

  const mode = selectField("Mode", [["off", "off"], ["wipe", "wipe"], ["difference", "difference"], ["flip", "FLIP"]], "off", (v) => {
    display.compare = /** @type {any} */ (v);
    if (v !== "off" && display.reference === null && snapshots.list.length) display.reference = snapshots.list[snapshots.list.length - 1].id;
    update();
  });
  const reference = selectField("Snapshot", [], "", (v) => {
    display.reference = Number(v);
    update();
  });
  const wipe = numberField({label: "Wipe", value: 50, min: 0, max: 100, unit: "%", reset: 50, onInput: (v) => display.change({wipe: v / 100})});
  const amplify = numberField({label: "Gain", value: gain, min: 1, max: 64, logarithmic: true, integer: true, reset: 8, onInput: (v) => { gain = v; compute(); }});

  const update = () => {
    const options = snapshots.list.map((s) => /** @type {[string, string]} */ ([String(s.id), s.name]));
    reference.fill(options, String(display.reference ?? ""));
    mode.select.value = display.compare;
    wipe.element.hidden = display.compare !== "wipe";
    amplify.element.hidden = display.compare !== "difference";
    reference.element.hidden = options.length === 0;
    compute();
    display.change();
  };

  const compute = () => {
    const snapshot = snapshots.find(display.reference ?? -1), kind = display.compare;
    viewport.comparison = null;
    result.textContent = "";
    if (!snapshot || (kind !== "difference" && kind !== "flip")) return viewport.invalidate();
    const live = viewport.readLive();
    if (!live || live.width !== snapshot.width || live.height !== snapshot.height) {
      result.textContent = "The pictures differ in size. Wait for full size, or use the same resolution scale.";
      return viewport.invalidate();
    }
    worker ??= new Worker(new URL("../display/compare_worker.js", import.meta.url), {type: "module"});
    const id = ++request;
    result.textContent = "Computing …";
    worker.onmessage = (event) => {
      if (event.data.id !== request) return;
      viewport.comparison = {pixels: new ImageData(event.data.pixels, event.data.width, event.data.height)};
      result.textContent = kind === "flip" ? `Mean FLIP error ${event.data.mean.toFixed(4)} (0 equal, 1 maximum)`
                                           : `Mean difference ${(255 * event.data.mean).toFixed(3)} of 255 levels`;
      viewport.invalidate();
    };
    worker.postMessage({id, kind, gain, a: live.pixels, b: viewport.readSnapshot(snapshot), width: live.width, height: live.height});
  };
  let last = 0;
  session.on("frame", () => {
    if (display.compare !== "difference" && display.compare !== "flip") return;
    if (performance.now() - last < 2000) return;
    last = performance.now();
    compute();
  });

  const restore = async (/** @type {Snapshot} */ s) => {
    await session.attempt("set_edits", {edits: s.edits});
    session.view({look: s.look});
    display.tone = {...s.tone};
    display.mix.restore(s.mix.settings, s.mix.active);
    display.emit("restored");
    display.change();
  };
  const row = (/** @type {Snapshot} */ s) => {
    const name = h("input", {class: "snapshot-name", attributes: {type: "text", "aria-label": "Name of the snapshot"}, on: {change: () => { s.name = name.value; update(); }}});
    name.value = s.name;
    return h("li", {}, thumbnail(viewport.readSnapshot(s), s.width, s.height), h("div", {class: "snapshot-text"}, name,
             h("span", {class: "muted", text: `${s.width} × ${s.height}, ${s.samples} samples, ${s.edits.length} edits`, title: s.edits.join("\n")}),
             h("div", {class: "actions"}, button("Restore", () => void restore(s), {class: "small", title: "Restores edits, view, tone and mixer"}),
               button("Delete", () => {
                 snapshots.remove(s.id);
                 if (display.reference === s.id) Object.assign(display, {reference: null, compare: "off"});
                 draw();
                 update();
               }, {class: "small"}))));
  };
  const draw = () => list.replaceChildren(...snapshots.list.map(row));
  const take = () => {
    const s = snapshots.take(session, display);
    if (!s) return app.toasts.show("There is no picture yet.", "error");
    display.reference ??= s.id;
    draw();
    update();
    app.toasts.show(`${s.name} stored.`);
  };
  display.on("change", () => wipe.set(Math.round(1000 * display.wipe) / 10));
  update();
  const element = h("div", {class: "panel"}, h("header", {}, h("h2", {text: "Compare"})),
                    section("Comparison", mode.element, reference.element, wipe.element, amplify.element, result),
                    section("Snapshots", h("div", {class: "actions"}, button("Take snapshot", take, {class: "primary", title: "Key: T"})), list));
  return {element, take};
}
