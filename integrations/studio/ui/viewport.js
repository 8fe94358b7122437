// SPDX-License-Identifier: Apache-2.0
// The picture on the screen: placement, zoom, textures of the shown frame, comparison, overlay.
import {GlDisplay} from "../display/gl_display.js";
import {h} from "./dom.js";

/** @typedef {import("../display/gl_display.js").Picture} Picture */
/** @typedef {import("../display/gl_display.js").Look} Look */
/** @typedef {import("../scene/snapshots.js").Snapshot} Snapshot */
/** @typedef {{width: number, height: number, pixels: Uint16Array}} Still */

export class Viewport {
  canvas = h("canvas", {class: "picture", attributes: {role: "img", "aria-label": "Rendered picture", tabindex: "0"}});
  overlay = h("canvas", {class: "overlay", attributes: {"aria-hidden": "true"}});
  element = h("div", {class: "viewport"}, this.canvas, this.overlay);
  /** 0: the picture fits into the window; otherwise canvas pixels per picture pixel. */ zoom = 0;
  /** @type {((context: CanvasRenderingContext2D, viewport: Viewport) => void)[]} */ painters = [];
  /** Pictures shown instead of the frame, with their factors. @type {{stills: Still[], factors: number[]} | null} */ substitute = null;
  /** Result of a comparison. @type {{pixels: ImageData} | null} */ comparison = null;
  #comparisonCanvas = document.createElement("canvas");
  /** @type {Picture | null} */ #live = null;
  /** @type {Picture | null} */ #other = null;
  /** @type {Snapshot | null} */ #otherSource = null;
  /** @type {Picture | null} */ #still = null;
  /** @type {Still[]} */ #stillSource = [];
  #dirty = false;

  /**
   * @param {import("../scene/session.js").Session} session
   * @param {import("../scene/display_settings.js").DisplaySettings} display
   * @param {import("../scene/snapshots.js").Snapshots} snapshots
   */
  constructor(session, display, snapshots) {
    this.session = session;
    this.display = display;
    this.snapshots = snapshots;
    this.gl = new GlDisplay(this.canvas);
    session.on("frame", (change) => this.#upload(change));
    session.on("state", () => this.invalidate());
    display.on("change", () => this.invalidate());
    new ResizeObserver(() => this.#resize()).observe(this.element);
    this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => this.#restore());
  }

  #resize() {
    const ratio = window.devicePixelRatio || 1, box = this.element.getBoundingClientRect();
    for (const canvas of [this.canvas, this.overlay]) {
      canvas.width = Math.max(1, Math.round(box.width * ratio));
      canvas.height = Math.max(1, Math.round(box.height * ratio));
    }
    this.invalidate();
  }

  #restore() {
    this.gl.restore();
    this.#live = this.#other = this.#still = null;
    this.#otherSource = null;
    this.#stillSource = [];
    const {frames} = this.session;
    if (!frames.isEmpty) this.#upload({resized: true, dirty: []});
    this.invalidate();
  }

  /** @param {{resized: boolean, dirty: import("../display/frame_store.js").DirtyRows[]}} change */
  #upload(change) {
    const {frames} = this.session, gl = this.gl;
    if (gl.gl.isContextLost()) return;
    if (change.resized || !this.#live) {
      gl.deletePicture(this.#live);
      this.#live = gl.createPicture(frames.width, frames.height, frames.layers.length);
      frames.layers.forEach((pixels, i) => gl.upload(/** @type {Picture} */ (this.#live), pixels, i));
    } else {
      for (const d of change.dirty) gl.upload(this.#live, frames.layers[d.layer], d.layer, d.y, d.rows);
    }
    this.invalidate();
  }

  invalidate() {
    if (this.#dirty) return;
    this.#dirty = true;
    requestAnimationFrame(() => {
      this.#dirty = false;
      this.drawNow();
    });
  }

  /** Rectangle of the picture in canvas pixels; whole numbers, so that 1:1 is exact. */
  place() {
    const [w, h] = this.session.state.size, c = this.canvas;
    const margin = this.zoom ? 0 : 16 * (window.devicePixelRatio || 1);
    const fit = Math.min((c.width - margin) / w, (c.height - margin) / h);
    const scale = this.zoom || Math.max(fit, 1e-3);
    const width = Math.max(1, Math.round(w * scale)), height = Math.max(1, Math.round(h * scale));
    return {x: Math.round((c.width - width) / 2), y: Math.round((c.height - height) / 2), width, height};
  }

  /** Display of the live picture. @param {number[][]} [weights] @returns {Look} */
  look(weights = undefined) {
    const d = this.display, {state, frames} = this.session;
    const shown = d.layer;
    const lux = shown === "illuminance";
    /** @type {Look["show"]} */
    const show = d.falseColors || shown === "depth" || lux ? "false"
        : shown === "normal" ? "direction" : shown === "picture" ? "data" : "light";
    const unit = shown === "depth" || lux || shown === "luminance" ? 1 : state.unit_luminance;
    // The scene's own picture has the gamma of the options in addition to that of its lens shaders.
    const encoded = show === "data" && (state.gamma ?? 1) !== 1;
    const tone = encoded ? {...d.tone, operator: /** @type {"simple"} */ ("simple"), exposure: 0, pedestal: 0, gain: 1, knee: 1, compression: 0, gamma: state.gamma ?? 1} : d.tone;
    return {show: encoded ? "light" : show, unit, tone, scale: d.scale,
            weights: weights ?? d.mix.weights(frames.names, state.light_layers, shown)};
  }

  /** The surround, read from the style sheet: neutral grey. */
  #surround() {
    const found = /(\d+)[ ,]+(\d+)[ ,]+(\d+)/.exec(getComputedStyle(this.element).backgroundColor);
    return found ? [1, 2, 3].map((i) => Number(found[i]) / 255) : [0.2, 0.2, 0.2];
  }

  drawNow() {
    const gl = this.gl, surround = this.#surround();
    if (gl.gl.isContextLost()) return;
    gl.clear(surround);
    const place = this.place(), d = this.display;
    if (this.substitute) this.#drawSubstitute(place, surround);
    else if (this.#live) {
      const snapshot = d.compare === "wipe" ? this.snapshots.find(d.reference ?? -1) : null;
      gl.draw(this.#live, this.look(), place, surround);
      if (snapshot) {
        const edge = Math.round(place.x + d.wipe * place.width);
        gl.draw(this.#otherPicture(snapshot), {...this.look([[1, 1, 1]]), show: d.falseColors ? "false" : "light", tone: snapshot.tone},
                place, surround, [0, edge]);
      }
    }
    this.session.drawnFrame = this.session.frames.frame;
    this.#drawOverlay(place);
  }

  /** @param {import("../display/gl_display.js").Place} place @param {number[]} surround */
  #drawSubstitute(place, surround) {
    const s = /** @type {NonNullable<Viewport["substitute"]>} */ (this.substitute);
    const same = s.stills.length === this.#stillSource.length && s.stills.every((x, i) => x === this.#stillSource[i]);
    if (!same || !this.#still) {
      this.gl.deletePicture(this.#still);
      const {width, height} = s.stills[0];
      this.#still = this.gl.createPicture(width, height, s.stills.length);
      s.stills.forEach((still, i) => this.gl.upload(/** @type {Picture} */ (this.#still), still.pixels, i));
      this.#stillSource = [...s.stills];
    }
    this.gl.draw(this.#still, {...this.look(s.factors.map((f) => [f, f, f])), show: this.display.falseColors ? "false" : "light"}, place, surround);
  }

  /** @param {Snapshot} snapshot @returns {Picture} */
  #otherPicture(snapshot) {
    if (this.#otherSource !== snapshot || !this.#other) {
      this.gl.deletePicture(this.#other);
      this.#other = this.gl.createPicture(snapshot.width, snapshot.height, 1);
      this.gl.upload(this.#other, snapshot.pixels, 0);
      this.#otherSource = snapshot;
    }
    return this.#other;
  }

  /** Display bytes of a snapshot at its own size. @param {Snapshot} snapshot */
  readSnapshot(snapshot) {
    return this.gl.readPicture(this.#otherPicture(snapshot), {...this.look([[1, 1, 1]]), show: "light", tone: snapshot.tone});
  }

  /** Display bytes of the live picture, or null. */
  readLive() {
    return this.#live ? {pixels: this.gl.readPicture(this.#live, this.look()), width: this.#live.width, height: this.#live.height} : null;
  }

  /** Draws and reads the canvas below the picture. */
  readCanvas() {
    this.drawNow();
    const place = this.place();
    return {pixels: this.gl.readCanvas(place), ...place};
  }

  /** Display bytes of a substitute. @param {Still[]} stills @param {number[]} factors */
  readStills(stills, factors) {
    const before = this.substitute;
    this.substitute = {stills, factors};
    this.drawNow();
    const pixels = this.gl.readPicture(/** @type {Picture} */ (this.#still), this.look(factors.map((f) => [f, f, f])));
    this.substitute = before;
    this.invalidate();
    return {pixels, width: stills[0].width, height: stills[0].height};
  }

  /** @param {import("../display/gl_display.js").Place} place */
  #drawOverlay(place) {
    const context = this.overlay.getContext("2d");
    if (!context) return;
    context.clearRect(0, 0, this.overlay.width, this.overlay.height);
    if (this.comparison) {
      const {pixels} = this.comparison, c = this.#comparisonCanvas;
      c.width = pixels.width;
      c.height = pixels.height;
      c.getContext("2d")?.putImageData(pixels, 0, 0);
      context.imageSmoothingEnabled = false;
      context.drawImage(c, place.x, place.y, place.width, place.height);
    }
    for (const paint of this.painters) paint(context, this);
  }

  /** Pixel of the full-size picture below a pointer. @param {{clientX: number, clientY: number}} event @returns {[number, number]} */
  pixelAt(event) {
    const ratio = window.devicePixelRatio || 1, box = this.canvas.getBoundingClientRect(), p = this.place();
    const [w, h] = this.session.state.size;
    return [((event.clientX - box.left) * ratio - p.x) / p.width * w, ((event.clientY - box.top) * ratio - p.y) / p.height * h];
  }

  /** Canvas position of a pixel of the picture. @param {number[]} pixel @returns {[number, number]} */
  canvasPoint(pixel) {
    const p = this.place(), [w, h] = this.session.state.size;
    return [p.x + pixel[0] / w * p.width, p.y + pixel[1] / h * p.height];
  }
}
