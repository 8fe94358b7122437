// SPDX-License-Identifier: Apache-2.0
// Pointer and keys in the viewport: navigation, and tools that use a pixel or a rectangle.
import {dolly, length, orbit, pan, sub, turn, walk} from "../scene/camera_moves.js";

/** @typedef {"navigate" | "region" | "focus" | "probe" | "grid" | "explain"} Tool */
/** @typedef {import("../net/types.js").Look} Look */

const CLICK_PIXELS = 4;
const WIPE_PIXELS = 8;  // distance to the wipe line at which a drag moves it
const STILL_MS = 300;  // the picture returns to full size this long after the last move

export class ViewportInput {
  /** @type {Tool} */ tool = "navigate";
  /** @type {[number, number, number, number] | null} */ rectangle = null;
  /** Look after the moves of this page, until the server reports it. @type {Look | null} */ #look = null;
  #stillTimer = 0;
  #moving = false;

  /**
   * @param {import("./viewport.js").Viewport} viewport
   * @param {{click: (tool: Tool, x: number, y: number) => void, region: (r: [number, number, number, number] | null) => void,
   *          hover: (x: number, y: number) => void, tool: (tool: Tool) => void}} actions
   */
  constructor(viewport, actions) {
    this.viewport = viewport;
    this.session = viewport.session;
    this.actions = actions;
    const canvas = viewport.canvas;
    canvas.addEventListener("pointerdown", (event) => this.#down(event));
    canvas.addEventListener("pointermove", (event) => {
      const [x, y] = viewport.pixelAt(event);
      actions.hover(x, y);
      this.session.pointer([x, y]);
    });
    canvas.addEventListener("pointerleave", () => this.session.pointer(null));
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      if (event.ctrlKey) return this.#zoom(event.deltaY < 0 ? 1.25 : 0.8);
      this.#move((look) => dolly(look, Math.exp(Math.max(-100, Math.min(100, event.deltaY)) * 0.002)));
    }, {passive: false});
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("keydown", (event) => this.#key(event));
    viewport.painters.push((context) => this.#paint(context));
    // A state during a move may be older than the look of this page.
    this.session.on("state", () => { if (!this.#moving) this.#look = null; });
  }

  /** @param {Tool} tool */
  choose(tool) {
    this.tool = tool;
    this.viewport.element.dataset.tool = tool;
    this.actions.tool(tool);
  }

  /** @param {number} factor */
  #zoom(factor) {
    const place = this.viewport.place(), scale = place.width / this.session.state.size[0];
    this.viewport.zoom = Math.max(0.05, Math.min(32, scale * factor));
    this.viewport.invalidate();
  }

  /** @param {(look: Look) => Look} change */
  #move(change) {
    const look = this.#look ?? this.session.state.look;
    if (!look) return;
    this.#moving = true;
    this.#look = change(look);
    this.session.view({look: this.#look, dragging: true});
    clearTimeout(this.#stillTimer);
    this.#stillTimer = window.setTimeout(() => this.#still(), STILL_MS);
  }

  #still() {
    this.#moving = false;
    this.session.view({look: this.#look, dragging: false});
  }

  /** @param {PointerEvent} event */
  #down(event) {
    const canvas = this.viewport.canvas;
    canvas.focus({preventScroll: true});
    canvas.setPointerCapture(event.pointerId);
    if (event.button === 0 && this.#isOnWipe(event)) return this.#dragWipe();
    const start = this.viewport.pixelAt(event), startX = event.clientX, startY = event.clientY;
    let moved = false, lastX = startX, lastY = startY;
    const move = (/** @type {PointerEvent} */ e) => {
      if (!moved && Math.hypot(e.clientX - startX, e.clientY - startY) < CLICK_PIXELS) return;
      moved = true;
      if (this.tool === "region" && event.button === 0) {
        this.rectangle = this.#rectangleOf(start, this.viewport.pixelAt(e));
        this.viewport.invalidate();
      } else {
        this.#navigate(event, (e.clientX - lastX) / canvas.clientHeight, (e.clientY - lastY) / canvas.clientHeight);
      }
      lastX = e.clientX;
      lastY = e.clientY;
    };
    const up = (/** @type {PointerEvent} */ e) => {
      canvas.removeEventListener("pointermove", move);
      canvas.removeEventListener("pointerup", up);
      canvas.removeEventListener("pointercancel", up);
      if (this.tool === "region" && event.button === 0) this.#endRegion(moved);
      else if (!moved && event.button === 0 && e.type === "pointerup") this.#click(start);
    };
    canvas.addEventListener("pointermove", move);
    canvas.addEventListener("pointerup", up);
    canvas.addEventListener("pointercancel", up);
  }

  /** @param {PointerEvent} event */
  #isOnWipe(event) {
    const d = this.viewport.display, [width] = this.session.state.size;
    if (d.compare !== "wipe" || d.reference === null) return false;
    const shown = this.viewport.place().width / (window.devicePixelRatio || 1);
    return Math.abs(this.viewport.pixelAt(event)[0] / width - d.wipe) * shown < WIPE_PIXELS;
  }

  #dragWipe() {
    const canvas = this.viewport.canvas, [width] = this.session.state.size;
    const move = (/** @type {PointerEvent} */ e) =>
        this.viewport.display.change({wipe: Math.max(0, Math.min(1, this.viewport.pixelAt(e)[0] / width))});
    const end = () => {
      canvas.removeEventListener("pointermove", move);
      canvas.removeEventListener("pointerup", end);
      canvas.removeEventListener("pointercancel", end);
    };
    canvas.addEventListener("pointermove", move);
    canvas.addEventListener("pointerup", end);
    canvas.addEventListener("pointercancel", end);
  }

  /** @param {PointerEvent} start @param {number} dx @param {number} dy */
  #navigate(start, dx, dy) {
    if (start.button === 1 || (start.button === 0 && start.shiftKey)) this.#move((look) => pan(look, -dx, dy));
    else if (start.button === 2 || (start.button === 0 && start.ctrlKey)) this.#move((look) => dolly(look, Math.exp(dy * 3)));
    else if (start.button === 0 && start.altKey) this.#move((look) => turn(look, dx * 1.5, dy * 1.5));
    else if (start.button === 0) this.#move((look) => orbit(look, -dx * 3, -dy * 3));
  }

  /** @param {number[]} a @param {number[]} b @returns {[number, number, number, number]} */
  #rectangleOf(a, b) {
    const [w, h] = this.session.state.size;
    const x = [a[0], b[0]].map((v) => Math.max(0, Math.min(w, Math.round(v)))).sort((p, q) => p - q);
    const y = [a[1], b[1]].map((v) => Math.max(0, Math.min(h, Math.round(v)))).sort((p, q) => p - q);
    return [x[0], y[0], x[1], y[1]];
  }

  /** @param {boolean} moved */
  #endRegion(moved) {
    const r = this.rectangle;
    this.rectangle = null;
    this.actions.region(moved && r && r[2] - r[0] > 3 && r[3] - r[1] > 3 ? r : null);
    this.viewport.invalidate();
  }

  /** @param {[number, number]} pixel */
  #click(pixel) {
    const [w, h] = this.session.state.size, x = Math.floor(pixel[0]), y = Math.floor(pixel[1]);
    if (x >= 0 && y >= 0 && x < w && y < h) this.actions.click(this.tool, x, y);
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const a = 0.05, look = this.session.state.look;
    // A share of the distance to what the camera looks at: scenes may have wide surroundings.
    const bounds = this.session.state.bounds, size = bounds ? length(sub(bounds.max, bounds.min)) : Infinity;
    const step = Math.min(size * 0.02, look ? length(sub(look.to, look.from)) * 0.06 : 1);
    /** @type {Record<string, (look: Look) => Look>} */
    const moves = event.shiftKey ? {
      ArrowLeft: (l) => pan(l, -a, 0), ArrowRight: (l) => pan(l, a, 0), ArrowUp: (l) => pan(l, 0, a), ArrowDown: (l) => pan(l, 0, -a),
    } : {
      ArrowLeft: (l) => orbit(l, a, 0), ArrowRight: (l) => orbit(l, -a, 0), ArrowUp: (l) => orbit(l, 0, a), ArrowDown: (l) => orbit(l, 0, -a),
      w: (l) => walk(l, step, 0, 0), s: (l) => walk(l, -step, 0, 0), a: (l) => walk(l, 0, -step, 0), d: (l) => walk(l, 0, step, 0),
      e: (l) => walk(l, 0, 0, step), q: (l) => walk(l, 0, 0, -step), "+": (l) => dolly(l, 0.9), "-": (l) => dolly(l, 1 / 0.9),
    };
    if (event.key === "Enter") {
      event.preventDefault();
      const [w, h] = this.session.state.size;
      this.actions.click(this.tool, Math.floor(w / 2), Math.floor(h / 2));  // the middle of the picture
      return;
    }
    const move = moves[event.key];
    if (!move) return;
    event.preventDefault();
    event.stopPropagation();
    this.#move(move);
  }

  /** @param {CanvasRenderingContext2D} context */
  #paint(context) {
    const ratio = window.devicePixelRatio || 1;
    const r = this.rectangle ?? this.session.state.region;
    if (r) {
      const a = this.viewport.canvasPoint([r[0], r[1]]), b = this.viewport.canvasPoint([r[2], r[3]]);
      context.lineWidth = ratio;
      for (const [color, offset] of /** @type {[string, number][]} */ ([["#000", 0], ["#fff", 4]])) {
        context.setLineDash([4 * ratio, 4 * ratio]);
        context.lineDashOffset = offset * ratio;
        context.strokeStyle = color;
        context.strokeRect(a[0] + 0.5, a[1] + 0.5, b[0] - a[0] - 1, b[1] - a[1] - 1);
      }
      context.setLineDash([]);
    }
    const d = this.viewport.display;
    if (d.compare === "wipe" && d.reference !== null) {
      const p = this.viewport.place(), x = Math.round(p.x + d.wipe * p.width);
      context.fillStyle = "#000";
      context.fillRect(x - ratio, p.y, 2 * ratio, p.height);
      context.fillStyle = "#fff";
      context.fillRect(x - ratio / 2, p.y, ratio, p.height);
    }
  }
}
