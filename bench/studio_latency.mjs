#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
// Latency of `oriel studio`: time from a request until the first complete picture of it has arrived.
//
//     (cd tests/studio && npm ci)
//     bench/studio_latency.mjs build/release/bin/oriel scenes/interior/interior.mi [CHANGES]
//
// Prints the median and the 95th percentile, in milliseconds, of changes of a colour, of the camera, of
// the placement of an instance, and of the sun. The browser's time to draw is not included.
import { spawn } from "node:child_process";
import { createRequire } from "node:module";
import { createInterface } from "node:readline";

const require = createRequire(new URL("../tests/studio/package.json", import.meta.url));
const WebSocket = require("ws");
const [program, scene, count = "20"] = process.argv.slice(2);
if (!scene) {
  console.error("usage: studio_latency.mjs PROGRAM SCENE [CHANGES]");
  process.exit(2);
}

const LAST_STRIP = 1; // flag of a picture's last strip, see docs/dev/studio-protocol.md
const server = spawn(program, ["studio", scene], { stdio: ["ignore", "pipe", "inherit"] });
process.on("exit", () => server.kill("SIGTERM"));

class Client {
  constructor(url) {
    const [, host, token] = url.match(/http:\/\/([^/]*)\/#token=(.*)/);
    this.socket = new WebSocket(`ws://${host}/ws`, { headers: { Origin: `http://${host}` } });
    this.socket.on("open", () => this.send({ type: "hello", version: 1, token }));
    this.socket.on("message", (data, binary) => (binary ? this.strip(data) : this.answer(JSON.parse(data))));
    this.answers = new Map();
    this.id = 0;
    this.epochs = new Map(); // by epoch: when its first picture was complete
    this.waiting = null;
  }
  send(message) {
    this.socket.send(JSON.stringify(message));
  }
  ask(message) {
    const id = ++this.id;
    return new Promise((resolve, reject) => {
      this.answers.set(id, (m) => (m.type === "error" ? reject(new Error(m.message)) : resolve(m)));
      this.send({ ...message, id });
    });
  }
  answer(message) {
    if (message.type === "welcome") this.ready?.();
    this.answers.get(message.id)?.(message);
    this.answers.delete(message.id);
  }
  strip(data) {
    if (!(data[7] & LAST_STRIP)) return;
    this.send({ type: "ack", frame: data.readUInt32LE(28) });
    const epoch = data.readUInt32LE(8);
    if (!this.epochs.has(epoch)) this.epochs.set(epoch, performance.now());
    if (this.waiting && epoch >= this.waiting.epoch) {
      const { resolve } = this.waiting;
      this.waiting = null;
      resolve();
    }
  }
  async latency(message) {
    const start = performance.now();
    const { epoch } = await this.ask(message);
    if (![...this.epochs.keys()].some((e) => e >= epoch))
      await new Promise((resolve) => (this.waiting = { epoch, resolve }));
    const first = Math.min(...[...this.epochs].filter(([e]) => e >= epoch).map(([, at]) => at));
    return first - start;
  }
}

const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

async function measure(client, name, change) {
  const times = [];
  for (let i = 0; i < Number(count); ++i) {
    times.push(await client.latency(change(i)));
    await pause(500);
  }
  times.sort((a, b) => a - b);
  const at = (share) => times[Math.min(times.length - 1, Math.floor(share * times.length))].toFixed(0);
  console.log(`| ${name} | ${at(0.5)} | ${at(0.95)} |`);
}

const [url] = await new Promise((resolve) => {
  createInterface({ input: server.stdout }).once("line", (line) => resolve([line]));
});
const client = new Client(url);
await new Promise((resolve) => (client.ready = resolve));
await client.ask({ type: "outline" });
const { size } = await client.ask({ type: "view", budget: { samples: 4 } }).then(() => client.ask({ type: "outline" }));
const [width, height] = size ?? [640, 360];
await pause(3000);
const picked = await client.ask({ type: "pick", x: Math.floor(width / 3), y: Math.floor(height / 2) });
console.log("| change | p50 | p95 |\n|---|---|---|");
await measure(client, `colour of ${picked.material}`, (i) => ({ type: "edit", edits: [`${picked.material}.diffuse=${0.3 + i / 100} .3 .3`] }));
await measure(client, "camera", (i) => ({
  type: "view", look: { from: [1 + i / 20, 1, 1.5], to: [3, 3, 1], up: [0, 0, 1] },
}));
await measure(client, "placement", (i) => ({
  type: "edit", edits: [`${picked.instance}.transform=1 0 0 0 0 1 0 0 0 0 1 0 ${i / 100} 0 0 1`],
}));
await measure(client, "sun", (i) => ({
  type: "daylight", latitude: 48.1, longitude: 11.6, time: `2026-06-21T${10 + (i % 8)}:00+02:00`,
}));
client.socket.close();
process.exit(0);
