// SPDX-License-Identifier: Apache-2.0
// A server that speaks the protocol of Oriel Studio with a synthetic picture, for tests of the page.
//
//     node mock/server.js [PORT]      prints the address
import {createReadStream, existsSync, statSync} from "node:fs";
import {createServer} from "node:http";
import {extname, join, normalize} from "node:path";
import {fileURLToPath} from "node:url";
import {WebSocketServer} from "ws";
import {floatToHalf} from "../../../integrations/studio/display/half.js";
import {LIGHTS, MESSAGES, OUTLINE, elementOf, layerPixels} from "./scene.js";

const PAGE = fileURLToPath(new URL("../../../integrations/studio/", import.meta.url));
const MIME = {".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml"};
const TOKEN = "0123456789abcdef".repeat(4);
const PNG = Buffer.from("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNkYPhfDwAChwGA60e6kgAAAABJRU5ErkJggg==", "base64");

/** Scene state and answers; one object per server. */
export class Mock {
  /** @param {{size?: [number, number], picture?: Uint16Array, stillPicture?: boolean}} options picture: RGBA halves instead of the room */
  constructor(options = {}) {
    this.size = options.size ?? [320, 180];
    this.picture = options.picture ?? null;
    this.epoch = 1;
    this.edits = [];
    this.past = [];
    this.future = [];
    this.saved = true;
    this.view = {scale: 1, region: null, layers: ["beauty"], paused: false, look: null, budget: {samples: 64, noise: null, seconds: null}};
    this.hour = 12;
    this.frame = 0;
    this.samples = 0;
    this.unacknowledged = 0;
    this.requests = [];
    this.uploads = [];
    this.lastGesture = null;
    this.socket = null;
    this.crashed = false;
    this.job = null;
  }

  state() {
    const v = this.view;
    return {type: "state", epoch: this.epoch, edits: this.edits, undo: this.past.length, redo: this.future.length, saved: this.saved, size: this.size, region: v.region,
            scale: v.scale, camera: "cam_inst", cameras: ["cam_inst", "cam2_inst"], look: v.look ?? {from: [4, -3, 1.6], to: [4, 3, 1.2], up: [0, 0, 1]}, fov: 60,
            layers: ["beauty", ...v.layers.filter((l) => l !== "beauty")], available_layers: ["beauty", "normal", "depth", ...LIGHTS], light_layers: this.picture ? [] : LIGHTS,
            unit_luminance: 1, paused: v.paused, budget: v.budget, look_stored: v.look === null, bounds: {min: [0, 0, 0], max: [8, 6, 3]}};
  }

  send(message) { this.socket?.send(JSON.stringify(message)); }

  restart() {
    this.epoch += 1;
    this.samples = 0;
    this.send(this.state());
    this.render();
  }

  change(edits, gesture) {
    if (!gesture || gesture !== this.lastGesture) this.past.push([...this.edits]);
    this.lastGesture = gesture ?? null;
    this.future = [];
    this.saved = false;
    this.edits = edits;
    this.restart();
  }

  /** Sends frames until the budget is reached; the first of an epoch is reduced. */
  render() {
    clearTimeout(this.timer);
    if (this.unacknowledged >= 2 || this.view.paused || this.crashed || !this.socket) return;
    const limit = this.view.budget.samples ?? 64;
    if (this.samples >= limit) return;
    const first = this.samples === 0, divider = this.picture ? 1 : (first ? 4 : 1) * this.view.scale;
    this.samples = first ? 1 : Math.min(limit, this.samples * 4);
    this.sendFrame(divider, first);
    this.send({type: "progress", epoch: this.epoch, divider, pass: this.samples, samples: this.samples, noise: 0.5 / Math.sqrt(this.samples), elapsed: 1, remaining: 2, done: this.samples / limit,
               stage: null, status: this.samples >= limit ? "converged" : "rendering", latency: 0.08});
    this.timer = setTimeout(() => this.render(), 15);
  }

  sendFrame(divider, first) {
    const width = Math.ceil(this.size[0] / divider), height = Math.ceil(this.size[1] / divider);
    const layers = this.state().layers, frame = ++this.frame;
    const gloss = Number(this.edits.find((e) => e.startsWith("floor.refl_gloss="))?.split("=")[1] ?? 1);
    this.unacknowledged += 1;
    layers.forEach((name, layer) => {
      const pixels = this.picture ?? layerPixels(name, width, height, this.samples, {hour: this.hour, gloss});
      const rows = Math.max(1, Math.floor(65536 / (8 * width)));
      for (let y = 0; y < height; y += rows) {
        const h = Math.min(rows, height - y), last = layer === layers.length - 1 && y + h >= height;
        const message = Buffer.alloc(32 + 8 * width * h);
        message.writeUInt32LE(0x4c49524f, 0);
        message.set([1, 0, 1, (last ? 1 : 0) | (divider > this.view.scale ? 2 : 0) | (first ? 4 : 0)], 4);
        message.writeUInt32LE(this.epoch, 8);
        [layer, divider, 0, y, width, h].forEach((v, i) => message.writeUInt16LE(v, 12 + 2 * i));
        message.writeUInt32LE(this.samples, 24);
        message.writeUInt32LE(frame, 28);
        message.set(new Uint8Array(pixels.buffer, pixels.byteOffset + 8 * y * width, 8 * width * h), 32);
        this.socket?.send(message);
      }
    });
  }

  crash() {
    this.crashed = true;
    this.send({type: "crashed", message: "signal 11 in user_shader.", edits: this.edits.length});
  }

  /** @returns {object | string} fields of the reply, or the code of an error */
  answer(m) {
    const edited = () => ({epoch: this.epoch, undo: this.past.length, redo: this.future.length});
    switch (m.type) {
      case "view": {
        Object.assign(this.view, m);
        const restarts = ["look", "scale", "region", "layers", "size", "camera"].some((k) => k in m);
        if (restarts) this.restart();
        else { this.send(this.state()); this.render(); }
        return {epoch: this.epoch};
      }
      case "edit": {
        const targets = m.edits.map((e) => e.slice(0, e.indexOf("=")));
        if (targets.some((t) => t.startsWith("bad."))) return "bad-edit";
        this.change([...this.edits.filter((e) => !targets.includes(e.slice(0, e.indexOf("=")))), ...m.edits], m.gesture);
        return edited();
      }
      case "set_edits": this.change(m.edits, null); return edited();
      case "undo": if (this.past.length) { this.future.push(this.edits); this.edits = this.past.pop(); this.lastGesture = null; this.restart(); } return edited();
      case "redo": if (this.future.length) { this.past.push(this.edits); this.edits = this.future.pop(); this.restart(); } return edited();
      case "daylight":
        this.hour = Number(/T(\d\d)/.exec(m.time)?.[1]) + Number(/T\d\d:(\d\d)/.exec(m.time)?.[1]) / 60;
        this.change([...this.edits.filter((e) => !e.startsWith("sun.")), `sun.direction=0 0 -${(this.hour / 24).toFixed(3)}`], m.gesture);
        return {...edited(), azimuth: 180, elevation: 40};
      case "sun_path": return {hours: Array.from({length: 49}, (_, i) => ({time: `${i / 2}`, azimuth: 7.5 * i, elevation: 62 * Math.sin((i / 2 - 5) / 16 * Math.PI)}))};
      case "outline": return OUTLINE;
      case "element": return elementOf(m.name, this.edits);
      case "pick": return {hit: true, instance: "floor_inst", object: "floor_obj", material: m.y > this.size[1] * 0.6 ? "floor" : "wall", position: [4, 2, 0], normal: [0, 0, 1], distance: 5};
      case "probe": return {...this.answer({...m, type: "pick"}), x: m.x, y: m.y, radiance: [10, 9, 8], luminance: {value: 9.15, half_width: 0.1}, illuminance: {value: 120, half_width: 2}};
      case "lux_grid": {
        const columns = m.columns ?? 4, rows = m.rows ?? 3, sensors = [];
        for (let i = 0; i < columns * rows; ++i) sensors.push({position: [3 + i % columns * 0.5, 1 + Math.floor(i / columns) * 0.5, 0.01], normal: [0, 0, 1], value: 100 + 20 * i, half_width: 3});
        const values = sensors.map((s) => s.value), mean = values.reduce((a, b) => a + b) / values.length;
        return {unit_luminance: 1, illuminance: {sensors, columns, rows, mean: {value: mean, half_width: 1}, min: Math.min(...values), max: Math.max(...values), uniformity: Math.min(...values) / mean}};
      }
      case "explain": return {text: `pixel ${m.x}, ${m.y}: 9.15 cd/m2\n  62 %  sun, direct\n  38 %  sky, indirect`, facts: {}};
      case "store_camera": this.view.look = null; this.change([...this.edits, "cam_inst.transform=1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"], null); return edited();
      case "save": this.saved = true; this.send(this.state()); return {files: [m.mode === "mi" ? "room.mi" : "room.edits.mi"]};
      case "command": return {text: `oriel render room.mi ${this.edits.map((e) => `--set '${e}'`).join(" ")}`};
      case "deliver": return {result: 1, url: "/api/result/1", bytes: PNG.length};
      case "relink": this.change([...this.edits, `${m.texture}.file=${m.file}`], null); this.send({type: "messages", list: MESSAGES.list.slice(0, 1), missing: []}); return edited();
      case "reload": this.restart(); return {};
      case "restart": this.crashed = false; this.restart(); return {epoch: this.epoch};
      case "job": {
        const states = {start: "running", pause: "paused", resume: "running", cancel: "cancelled"};
        this.job = {type: "job", state: states[m.action], done: 0.4, samples: 102, noise: 0.05, remaining: 75, files: [m.file ?? "final.exr"], command: "oriel render room.mi"};
        this.send(this.job);
        return {state: this.job.state};
      }
      default: return "unknown-type";
    }
  }

  /** @param {string} text */
  receive(text) {
    const m = JSON.parse(text);
    this.requests.push(m);
    if (this.silent) return;
    if (m.type === "ping") return this.send({type: "pong"});
    if (m.type === "ack") { this.unacknowledged = Math.max(0, this.unacknowledged - 1); return this.render(); }
    if (m.type === "cancel") return undefined;
    const answer = this.answer(m);
    if (typeof answer === "string") this.send({type: "error", id: m.id, code: answer, message: `the request failed: ${answer}`});
    else this.send({type: "reply", id: m.id, ...answer});
  }
}

/** @param {Mock} mock @param {number} [port] */
export async function startMock(mock, port = 0) {
  const server = createServer((request, response) => {
    const url = new URL(request.url ?? "/", "http://localhost");
    const host = request.headers.host ?? "";
    response.setHeader("Content-Security-Policy", `default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self' ws://${host}`);
    response.setHeader("X-Content-Type-Options", "nosniff");
    if (url.pathname.startsWith("/api/")) {
      if (request.headers["x-oriel-token"] !== TOKEN) return response.writeHead(403).end("{}");
      if (url.pathname === "/api/upload") {
        mock.uploads.push(url.searchParams.get("name"));
        request.resume();
        return request.on("end", () => response.writeHead(200, {"Content-Type": "application/json"}).end(JSON.stringify({file: `textures/${url.searchParams.get("name")}`})));
      }
      return response.writeHead(200, {"Content-Type": "image/png"}).end(PNG);
    }
    const path = join(PAGE, normalize(url.pathname === "/" ? "/index.html" : url.pathname));
    if (!path.startsWith(PAGE) || !existsSync(path) || !statSync(path).isFile()) return response.writeHead(404).end();
    response.writeHead(200, {"Content-Type": `${MIME[extname(path)] ?? "application/octet-stream"}; charset=utf-8`});
    return createReadStream(path).pipe(response);
  });
  const sockets = new WebSocketServer({server, path: "/ws", perMessageDeflate: false});
  sockets.on("connection", (socket) => {
    socket.once("message", (data) => {
      const hello = JSON.parse(String(data));
      if (hello.type !== "hello" || hello.token !== TOKEN) return socket.close(4000);
      mock.socket?.close(4001);
      mock.socket = socket;
      mock.unacknowledged = 0;
      mock.samples = 0;
      mock.epoch += 1;
      mock.send({type: "welcome", version: 1, program: "0.1.0", scene: {file: "room.mi", folder: "/scenes", model: false}, shaders: true});
      mock.send(mock.state());
      mock.send({type: "messages", ...MESSAGES});
      mock.render();
      socket.on("message", (text, binary) => { if (!binary) mock.receive(String(text)); });
      socket.on("close", () => { if (mock.socket === socket) mock.socket = null; });
    });
  });
  await new Promise((resolve) => server.listen(port, "127.0.0.1", () => resolve(undefined)));
  const address = /** @type {import("node:net").AddressInfo} */ (server.address());
  return {
    port: address.port, url: `http://127.0.0.1:${address.port}/`, token: TOKEN, mock,
    close: () => {
      clearTimeout(mock.timer);
      for (const client of sockets.clients) client.terminate();
      sockets.close();
      return new Promise((resolve) => server.close(resolve));
    },
  };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const {url, token} = await startMock(new Mock({size: [960, 540]}), Number(process.argv[2] ?? 0));
  console.log(`${url}#token=${token}`);
}
export {floatToHalf};
