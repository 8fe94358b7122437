// SPDX-License-Identifier: Apache-2.0
// The state of the server as this page knows it, and requests that change it.
import {FrameStore} from "../display/frame_store.js";
import {Connection, RequestError} from "../net/connection.js";
import {editTarget} from "./edit_text.js";
import {Events} from "./events.js";
import {Latest, newGesture} from "./latest.js";

/** @typedef {import("../net/types.js").SceneState} SceneState */
/** @typedef {import("../net/types.js").Progress} Progress */
/** @typedef {import("../net/types.js").Strip} Strip */

const POINTER_MS = 150;  // between messages about the pointer

/** @returns {SceneState} */
function emptyState() {
  return {
    epoch: 0, edits: [], undo: 0, redo: 0, saved: true, size: [1, 1], region: null, scale: 1, camera: "",
    cameras: [], look: null, fov: 50, layers: ["beauty"], available_layers: ["beauty"], light_layers: [],
    unit_luminance: 1, paused: false, budget: {samples: null, noise: null, seconds: null},
    look_stored: true, bounds: null,
  };
}

/**
 * Events: state, progress, frame, outline, messages, job, crashed, status, welcome, failed.
 */
export class Session extends Events {
  state = emptyState();
  /** @type {Progress | null} */ progress = null;
  /** @type {{file: string, folder: string, model: boolean}} */
  scene = {file: "", folder: "", model: false};
  program = "";
  shadersLoaded = true;
  /** @type {import("../net/types.js").Outline | null} */ outline = null;
  /** @type {import("../net/types.js").SceneMessage[]} */ messages = [];
  /** @type {import("../net/types.js").MissingTexture[]} */ missing = [];
  /** @type {import("../net/types.js").Job | null} */ job = null;
  /** @type {{message: string, edits: number} | null} */ crash = null;
  frames = new FrameStore();
  /** Number of the last frame that is on the screen. */ drawnFrame = 0;
  /** @type {Record<string, any>} */ #pendingView = {};
  #viewScheduled = false;
  /** @type {[number, number] | null} */ #pointer = null;
  #pointerTimer = 0;
  #edits = new Latest((texts, gesture) => this.#reporting("edit", {edits: texts, gesture}));
  #daylight = new Latest(([fields], gesture) => this.#reporting("daylight", {...fields, gesture}));

  /** @param {string} url @param {string} token */
  constructor(url, token) {
    super();
    this.token = token;
    this.connection = new Connection(url, token, {
      onMessage: (message) => this.#receive(message),
      onStrip: (strip) => this.#addStrip(strip),
      onStatus: (status, detail) => {
        if (status !== "open") this.frames.reset();
        this.emit("status", {status, detail});
      },
    });
  }

  start() {
    this.connection.connect();
    // A hidden page needs no new pictures.
    document.addEventListener("visibilitychange", () => this.#sendHidden());
    this.on("welcome", () => { if (document.hidden) this.#sendHidden(); });
  }

  #sendHidden() {
    if (this.connection.isOpen) void this.attempt("view", {hidden: document.hidden});
  }

  /** @param {string} type @param {object} [fields] @param {AbortSignal} [signal] @returns {Promise<any>} */
  request(type, fields = {}, signal = undefined) {
    return this.connection.request(type, fields, signal);
  }

  /**
   * Sends a request and reports an error to the user. Resolves to null after an error.
   * @param {string} type @param {object} [fields]
   */
  async attempt(type, fields = {}) {
    try {
      return await this.request(type, fields);
    } catch (error) {
      this.emit("failed", error);
      return null;
    }
  }

  /** @param {string} type @param {object} fields */
  async #reporting(type, fields) {
    try {
      return await this.request(type, fields);
    } catch (error) {
      this.emit("failed", error);
      throw error;
    }
  }

  /** Sends one edit; edits of a gesture become one step of undo. @param {string} text @param {string} [gesture] */
  edit(text, gesture = newGesture("edit")) {
    this.#edits.push(editTarget(text), text, gesture);
    return this.#edits.idle();
  }

  /** @param {object} fields of a request `daylight` @param {string} [gesture] */
  daylight(fields, gesture = newGesture("daylight")) {
    this.#daylight.push("daylight", fields, gesture);
    return this.#daylight.idle();
  }

  /** Changes the view; changes of one picture of the screen are sent together. @param {Record<string, any>} fields */
  view(fields) {
    Object.assign(this.#pendingView, fields);
    if (this.#viewScheduled) return;
    this.#viewScheduled = true;
    requestAnimationFrame(() => {
      this.#viewScheduled = false;
      const pending = this.#pendingView;
      this.#pendingView = {};
      if (this.connection.isOpen) void this.attempt("view", pending);
    });
  }

  /**
   * Tells the renderer near which pixel it should refine first.
   * @param {[number, number] | null} pixel of the full-size picture; null: none
   */
  pointer(pixel) {
    this.#pointer = pixel;
    if (this.#pointerTimer) return;
    this.#pointerTimer = window.setTimeout(() => {
      this.#pointerTimer = 0;
      const p = this.#pointer;
      this.connection.tell(p ? {type: "pointer", x: Math.floor(p[0]), y: Math.floor(p[1])} : {type: "pointer"});
    }, POINTER_MS);
  }

  async loadOutline() {
    try {
      this.outline = await this.request("outline");
      this.emit("outline", this.outline);
    } catch (error) {
      const expected = error instanceof RequestError && (error.code === "offline" || this.crash !== null);
      if (!expected) this.emit("failed", error);
    }
  }

  /** @param {any} m */
  #receive(m) {
    switch (m.type) {
      case "welcome":
        this.scene = {...this.scene, ...m.scene};
        this.program = String(m.program ?? "");
        this.shadersLoaded = m.shaders !== false;
        this.crash = null;
        this.emit("welcome", m);
        void this.loadOutline();
        break;
      case "state":
        this.state = {...emptyState(), ...m};
        this.emit("state", this.state);
        break;
      case "progress":
        this.progress = m;
        if (m.status !== "crashed" && this.crash) {
          this.crash = null;
          this.emit("crashed", null);
          void this.loadOutline();
        }
        this.emit("progress", m);
        break;
      case "messages":
        this.messages = Array.isArray(m.list) ? m.list : [];
        this.missing = Array.isArray(m.missing) ? m.missing : [];
        this.emit("messages", this.messages);
        break;
      case "job":
        this.job = m;
        this.emit("job", m);
        break;
      case "crashed":
        this.crash = {message: String(m.message ?? ""), edits: Number(m.edits ?? 0)};
        this.emit("crashed", this.crash);
        break;
      case "error":
        this.emit("failed", new RequestError(String(m.code), String(m.message)));
        break;
      default:  // messages of later versions are ignored
    }
  }

  /** @param {Strip} strip */
  #addStrip(strip) {
    const change = this.frames.add(strip, this.state.size, this.state.layers);
    if (change) this.emit("frame", change);
    if (strip.last) this.connection.acknowledge(strip.frame);
  }
}
