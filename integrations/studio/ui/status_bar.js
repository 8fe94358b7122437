// SPDX-License-Identifier: Apache-2.0
// The line below the picture: progress, noise, latency, and the pixel below the pointer.
import {durationText} from "../panels/deliver.js";
import {h} from "./dom.js";

const STATUS = {loading: "Loading", preparing: "Preparing", rendering: "Rendering", converged: "Finished", paused: "Paused", failed: "Failed", crashed: "Renderer ended"};

/** @param {import("../panels/app.js").App} app */
export function createStatusBar(app) {
  const {session, toasts} = app;
  const state = h("span", {class: "state"}), preview = h("span", {class: "preview-mark", text: "preview"});
  const progress = h("progress", {attributes: {max: "1", value: "0", "aria-label": "Progress of the picture"}});
  const samples = h("span", {}), noise = h("span", {}), time = h("span", {}), latency = h("span", {class: "wide-only"}), size = h("span", {class: "wide-only"}), pixel = h("span", {class: "pixel"});
  const more = h("button", {class: "button small", text: "Continue", attributes: {type: "button"}, on: {click: () => {
    const b = session.state.budget;
    session.view({budget: {samples: b.samples ? b.samples * 2 : null, noise: b.noise ? b.noise / 2 : null, seconds: b.seconds ? b.seconds * 2 : null}});
  }}});
  more.title = "Doubles the limits and continues";
  more.hidden = true;
  let last = "";
  session.on("progress", (p) => {
    const name = STATUS[/** @type {"loading"} */ (p.status)] ?? p.status;
    state.textContent = p.stage ? `${name}: ${p.stage}` : name;
    progress.value = Number(p.done ?? 0);
    samples.textContent = `${Math.round(p.samples ?? 0)} spp`;
    noise.textContent = p.noise === null || p.noise === undefined ? "" : `noise ${(100 * p.noise).toFixed(p.noise < 0.1 ? 1 : 0)} %`;
    const left = durationText(p.remaining);
    time.textContent = left && p.status === "rendering" ? `${left} left` : durationText(p.elapsed);
    latency.textContent = p.latency === null || p.latency === undefined ? "" : `response ${Math.round(1000 * p.latency)} ms`;
    more.hidden = p.status !== "converged";
    const s = session.state;
    app.viewport.canvas.setAttribute("aria-label", `Rendered picture of ${session.scene.file}, layer ${app.display.layer}, ${Math.round(p.samples ?? 0)} samples per pixel${noise.textContent ? `, ${noise.textContent}` : ""}`);
    size.textContent = `${s.size[0]} × ${s.size[1]}`;
    toasts.announce(`${name}, ${Math.round(100 * Number(p.done ?? 0))} percent`, p.status !== last);
    last = p.status;
  });
  session.on("frame", () => { preview.hidden = !session.frames.preview; });
  preview.hidden = true;
  const element = h("footer", {class: "status-bar"}, state, progress, samples, noise, time, more, preview, h("span", {class: "spring"}), pixel, latency, size);
  return {
    element,
    /** @param {number} x @param {number} y */
    hover(x, y) {
      const at = Math.max(0, session.frames.names.indexOf(app.display.layer));
      const c = session.frames.colorAt(x, y, at);
      if (!c) {
        pixel.textContent = "";
        return;
      }
      const luminance = session.state.unit_luminance * (0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]);
      const text = c.map((v) => v.toPrecision(3)).join("  ");
      pixel.textContent = `${Math.floor(x)}, ${Math.floor(y)}   ${text}${app.display.layer === "beauty" ? `   ${Number(luminance.toPrecision(3))} cd/m²` : ""}`;
    },
  };
}
