// SPDX-License-Identifier: Apache-2.0
// The WebSocket: handshake, requests with answers, reconnection with increasing delays.
import {readStrip} from "./strip.js";

/** @typedef {import("./types.js").Strip} Strip */

export const PROTOCOL_VERSION = 1;
const FIRST_DELAY_MS = 500, LARGEST_DELAY_MS = 5000;
/** Interval of pings, and the longest time until their answers or the start of a connection. */
const PING_MS = 3000, SILENCE_MS = 8000;

/** Close codes after which a new connection is useless. */
export const FINAL_CLOSE_CODES = new Set([4000, 4001, 4002]);
const NO_ANSWER = 1006;

/**
 * Delay before a further attempt: doubles from 0.5 s to 5 s.
 * @param {number} attempt 0 for the first
 */
export function reconnectDelay(attempt) {
  return Math.min(FIRST_DELAY_MS * 2 ** Math.min(attempt, 10), LARGEST_DELAY_MS);
}

/** An answer of type "error". */
export class RequestError extends Error {
  /** @param {string} code @param {string} message */
  constructor(code, message) {
    super(message);
    this.name = "RequestError";
    this.code = code;
  }
}

/**
 * Token of the address' fragment. It moves from the address to the session storage, so that neither
 * the history nor a copied address contains it.
 * @returns {string}
 */
export function takeToken() {
  const found = /(?:^#|&)token=([0-9a-zA-Z_-]+)/.exec(location.hash);
  if (found) {
    sessionStorage.setItem("oriel-token", found[1]);
    history.replaceState(null, "", location.pathname + location.search);
    return found[1];
  }
  return sessionStorage.getItem("oriel-token") ?? "";
}

/**
 * @typedef {object} Listener
 * @property {(message: any) => void} onMessage text messages that are no answers
 * @property {(strip: Strip) => void} onStrip
 * @property {(status: "connecting" | "open" | "waiting" | "closed", detail: string) => void} onStatus
 */

export class Connection {
  /** @type {WebSocket | null} */ #socket = null;
  #nextId = 1;
  #attempt = 0;
  #open = false;
  /** @type {ReturnType<typeof setTimeout> | undefined} */ #timer;
  /** @type {ReturnType<typeof setInterval> | undefined} */ #pings;
  #unansweredSince = 0;  // when the first ping without a later message was sent; 0 = none
  /** @type {Map<number, {resolve: (reply: any) => void, reject: (error: Error) => void}>} */
  #waiting = new Map();

  /**
   * @param {string} url
   * @param {string} token
   * @param {Listener} listener
   */
  constructor(url, token, listener) {
    this.url = url;
    this.token = token;
    this.listener = listener;
  }

  get isOpen() { return this.#open; }

  connect() {
    clearTimeout(this.#timer);
    this.listener.onStatus("connecting", "");
    const socket = new WebSocket(this.url);
    socket.binaryType = "arraybuffer";
    this.#socket = socket;
    socket.onopen = () => this.#post({type: "hello", version: PROTOCOL_VERSION, token: this.token});
    socket.onmessage = (event) => { if (socket === this.#socket) this.#receive(event.data); };
    socket.onclose = (event) => this.#closed(socket, event.code);
    clearInterval(this.#pings);
    this.#unansweredSince = Date.now();
    this.#pings = setInterval(() => this.#ping(socket), PING_MS);
  }

  /**
   * A tunnel that lost its network, or a computer that slept, may not close the connection.
   * @param {WebSocket} socket
   */
  #ping(socket) {
    if (this.#unansweredSince && Date.now() - this.#unansweredSince > SILENCE_MS) {
      socket.close();
      this.#closed(socket, NO_ANSWER);
    } else if (this.#open) {
      this.#unansweredSince ||= Date.now();
      this.#post({type: "ping"});
    }
  }

  /** Attempts a connection at once instead of after the delay. */
  retryNow() {
    if (this.#open || this.#socket?.readyState === WebSocket.CONNECTING) return;
    this.#attempt = 0;
    this.connect();
  }

  /**
   * Sends a request. Rejects with RequestError for an error of the server and if the connection ends.
   * @param {string} type
   * @param {object} [fields]
   * @param {AbortSignal} [signal] cancels a slow request
   * @returns {Promise<any>}
   */
  request(type, fields = {}, signal = undefined) {
    if (!this.#open)
      return Promise.reject(new RequestError("offline", "No connection to the renderer."));
    const id = this.#nextId++;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, {resolve, reject});
      this.#post({...fields, type, id});
      signal?.addEventListener("abort", () => {
        if (this.#waiting.has(id)) this.#post({type: "cancel", target: id, id: this.#nextId++});
      });
    });
  }

  /** @param {number} frame number of a frame that was uploaded */
  acknowledge(frame) {
    this.tell({type: "ack", frame});
  }

  /** Sends a message that has no answer. @param {object} message */
  tell(message) {
    if (this.#open) this.#post(message);
  }

  /** @param {object} message */
  #post(message) {
    if (this.#socket?.readyState === WebSocket.OPEN) this.#socket.send(JSON.stringify(message));
  }

  /** @param {string | ArrayBuffer} data */
  #receive(data) {
    if (this.#open) this.#unansweredSince = 0;
    if (typeof data !== "string") {
      const strip = readStrip(data);
      if (strip) this.listener.onStrip(strip);
      return;
    }
    let message;
    try {
      message = JSON.parse(data);
    } catch {
      return;  // a malformed message is ignored
    }
    if (!message || typeof message !== "object") return;
    if (message.type === "welcome") {
      this.#open = true;
      this.#unansweredSince = 0;
      this.#attempt = 0;
      this.listener.onStatus("open", "");
    }
    const waiting = this.#waiting.get(message.id);
    if (message.type === "reply" && waiting) {
      this.#waiting.delete(message.id);
      waiting.resolve(message);
    } else if (message.type === "error" && waiting) {
      this.#waiting.delete(message.id);
      waiting.reject(new RequestError(String(message.code), String(message.message)));
    } else if (message.type !== "reply" && message.type !== "pong") {
      this.listener.onMessage(message);
    }
  }

  /** @param {WebSocket} socket @param {number} code */
  #closed(socket, code) {
    if (socket !== this.#socket) return;
    this.#socket = null;
    clearInterval(this.#pings);
    this.#open = false;
    for (const {reject} of this.#waiting.values())
      reject(new RequestError("offline", "The connection to the renderer ended."));
    this.#waiting.clear();
    if (FINAL_CLOSE_CODES.has(code)) {
      this.listener.onStatus("closed", String(code));
      return;
    }
    const delay = reconnectDelay(this.#attempt++);
    this.listener.onStatus("waiting", String(delay));
    this.#timer = setTimeout(() => this.connect(), delay);
  }
}
