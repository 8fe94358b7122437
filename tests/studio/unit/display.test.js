// SPDX-License-Identifier: Apache-2.0
// Pure modules of the display: halves, strips, frames, scales, tone options, FLIP.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import test from "node:test";
import {PNG} from "pngjs";
import {roundNumber, scaleOf, scalePosition, scaleTicks, tickText} from "../../../integrations/studio/display/false_color.js";
import {flipError} from "../../../integrations/studio/display/flip.js";
import {FrameStore} from "../../../integrations/studio/display/frame_store.js";
import {floatToHalf, halfToFloat} from "../../../integrations/studio/display/half.js";
import {hexOfLinear, linearOfHex, srgbDecode, srgbEncode} from "../../../integrations/studio/display/srgb.js";
import {automaticExposure, defaultTone, exposureScale, tonemapOptions} from "../../../integrations/studio/display/tone.js";
import {inverse3} from "../../../integrations/studio/display/tone_shader.js";
import {chromaticity, whitePointOfTemperature} from "../../../integrations/studio/display/white_point.js";
import {FORMAT, readStrip} from "../../../integrations/studio/net/strip.js";

test("every half survives a round trip", () => {
  for (let bits = 0; bits < 65536; ++bits) {
    const value = halfToFloat(bits);
    if (Number.isFinite(value) && bits !== 0x8000) assert.equal(floatToHalf(value), bits);
  }
});

test("halves round to nearest even, clamp and drop NaN", () => {
  assert.equal(halfToFloat(floatToHalf(1 + 2 ** -11)), 1);  // tie to even
  assert.equal(halfToFloat(floatToHalf(1 + 3 * 2 ** -11)), 1 + 2 ** -9);
  assert.equal(halfToFloat(floatToHalf(1e9)), 65504);
  assert.equal(halfToFloat(floatToHalf(-1e9)), -65504);
  assert.equal(floatToHalf(NaN), 0);
  assert.equal(halfToFloat(floatToHalf(2 ** -24)), 2 ** -24);
});

/** @returns {ArrayBuffer} a strip of RGB16F */
function strip({epoch = 1, layer = 0, divider = 1, x = 0, y = 0, w = 2, h = 1, flags = 1, frame = 1, value = 1} = {}) {
  const bytes = new ArrayBuffer(32 + 6 * w * h), view = new DataView(bytes);
  view.setUint32(0, 0x4c49524f, true);
  [1, 0, FORMAT.RGB16F, flags].forEach((v, i) => view.setUint8(4 + i, v));
  view.setUint32(8, epoch, true);
  [layer, divider, x, y, w, h].forEach((v, i) => view.setUint16(12 + 2 * i, v, true));
  view.setUint32(28, frame, true);
  for (let i = 0; i < 3 * w * h; ++i) view.setUint16(32 + 2 * i, floatToHalf(value), true);
  return bytes;
}

test("malformed strips are refused", () => {
  assert.equal(readStrip(strip())?.width, 2);
  assert.equal(readStrip(strip().slice(0, 40)), null);
  assert.equal(readStrip(new ArrayBuffer(8)), null);
  for (const [offset, value] of [[0, 0], [4, 9], [5, 1], [6, 7]]) {
    const damaged = strip();
    new DataView(damaged).setUint8(offset, value);
    assert.equal(readStrip(damaged), null, `byte ${offset}`);
  }
  assert.equal(readStrip(strip({divider: 0})), null);
});

test("a frame is shown when its last strip arrives; older epochs and strips outside are dropped", () => {
  const store = new FrameStore(), size = /** @type {[number, number]} */ ([2, 2]), names = ["beauty"];
  const add = (o) => store.add(/** @type {any} */ (readStrip(strip(o))), size, names);
  assert.equal(add({epoch: 5, y: 0, flags: 0, value: 3}), null);
  assert.equal(store.isEmpty, true);
  assert.equal(add({epoch: 5, y: 1, flags: 1, value: 4})?.resized, true);
  assert.deepEqual(store.colorAt(0, 0), [3, 3, 3]);
  assert.deepEqual(store.colorAt(1, 1), [4, 4, 4]);
  assert.equal(add({epoch: 4, value: 9}), null);
  assert.deepEqual(store.colorAt(0, 0), [3, 3, 3]);
  assert.equal(add({epoch: 6, x: 1, value: 9}), null);  // 1 + 2 > 2: outside
  assert.deepEqual(store.colorAt(1, 0), [3, 3, 3]);
  assert.equal(store.colorAt(2, 0), null);
});

test("a region keeps the picture outside of it", () => {
  const store = new FrameStore();
  const add = (o, size) => store.add(/** @type {any} */ (readStrip(strip(o))), size, ["beauty"]);
  add({w: 4, h: 2, value: 2}, [4, 2]);
  add({epoch: 2, x: 1, w: 2, h: 1, value: 8}, [4, 2]);
  assert.deepEqual([0, 1, 2, 3].map((x) => store.colorAt(x, 0)?.[0]), [2, 8, 8, 2]);
  assert.equal(store.colorAt(1, 1)?.[0], 2);
});

test("the scale of false colours and its ticks are round", () => {
  assert.equal(roundNumber(3.1, true), 5);
  assert.equal(roundNumber(3.1, false), 2);
  assert.equal(roundNumber(0.021, true), 0.05);
  assert.deepEqual(scaleOf([...Array(200)].map((_, i) => i), false), {low: 0, high: 200, logarithmic: false});
  assert.deepEqual(scaleTicks({low: 0, high: 200, logarithmic: false}), [0, 50, 100, 150, 200]);
  assert.equal(scalePosition({low: 1, high: 100, logarithmic: true}, 10), 0.5);
  assert.deepEqual(scaleTicks({low: 1, high: 100, logarithmic: true}), [1, 2, 5, 10, 20, 50, 100]);
  assert.equal(tickText(25000), "25k");
});

test("sRGB follows the standard", () => {
  assert.ok(Math.abs(srgbEncode(0.18) - 0.46136) < 1e-5);
  for (const v of [0, 0.001, 0.04, 0.5, 1]) assert.ok(Math.abs(srgbDecode(srgbEncode(v)) - v) < 1e-12);
  assert.equal(hexOfLinear([1, 0, 0.2158605]), "#ff0080");
  assert.equal(hexOfLinear([4, 2, 0]), hexOfLinear([1, 0.5, 0]));
  assert.ok(Math.abs(linearOfHex("#808080")[1] - 0.21586) < 1e-5);
});

test("exposure is that of a photographic camera", () => {
  // A luminance of 1.2 * 2^EV100 saturates: f/16, 1/100 s, ISO 100.
  const t = {...defaultTone(), measured: true, iso: 100, shutter: 100, fNumber: 16};
  assert.ok(Math.abs(exposureScale(t)[1] - 1 / 30720) < 1e-9);
  assert.equal(exposureScale({...defaultTone(), exposure: 3})[0], 8);
  assert.match(tonemapOptions({...t, operator: "agx"}), /^--view agx --cm2 1 --iso 100 --shutter 100 --f-number 16 --vignetting 0$/);
});

test("automatic exposure shows grey pictures as middle grey", () => {
  const stops = automaticExposure([[0.045, 0.045, 0.045], [0, 0, 0]], defaultTone());
  assert.ok(Math.abs(Number(stops) - 2) < 1e-9);
  assert.equal(automaticExposure([[0, 0, 0]], defaultTone()), null);
});

test("white points agree with the CIE table and keep neutral neutral", () => {
  const [x, y] = chromaticity(6504);
  assert.ok(Math.abs(x - 0.3127) < 2e-4 && Math.abs(y - 0.3291) < 2e-4);
  const [ax, ay] = chromaticity(2856);  // illuminant A
  assert.ok(Math.abs(ax - 0.4476) < 2e-3 && Math.abs(ay - 0.4074) < 2e-3);
  assert.deepEqual(whitePointOfTemperature(6504, 0), [1, 1, 1]);
  const warm = whitePointOfTemperature(3000, 0);
  assert.ok(warm[0] > warm[1] && warm[1] > warm[2]);
});

test("a matrix times its inverse is the identity", () => {
  const m = [[2, 1, 0], [0.5, 3, 1], [0, 1, 4]], n = inverse3(m);
  for (let i = 0; i < 3; ++i)
    for (let j = 0; j < 3; ++j) {
      const product = m[i].reduce((s, v, k) => s + v * n[k][j], 0);
      assert.ok(Math.abs(product - (i === j ? 1 : 0)) < 1e-12);
    }
});

const ORIEL = process.env.ORIEL;
test("FLIP equals that of oriel diff", {skip: ORIEL ? false : "the program is not built"}, () => {
  const width = 90, height = 70, a = new PNG({width, height}), b = new PNG({width, height});
  for (let i = 0; i < width * height; ++i) {
    const x = i % width, y = Math.floor(i / width);
    const c = [(x * 3) % 256, (y * 5) % 256, x > 40 ? 200 : 30];
    for (let k = 0; k < 3; ++k) {
      a.data[4 * i + k] = c[k];
      b.data[4 * i + k] = Math.min(255, c[k] + (x > 20 && x < 30 ? 60 : 0) + (y === 35 ? 90 : 0));
    }
    a.data[4 * i + 3] = b.data[4 * i + 3] = 255;
  }
  const error = flipError(new Uint8Array(a.data), new Uint8Array(b.data), width, height);
  const mean = error.reduce((s, v) => s + v, 0) / error.length;
  const folder = mkdtempSync(join(tmpdir(), "oriel-flip-"));
  try {
    writeFileSync(join(folder, "a.png"), PNG.sync.write(a));
    writeFileSync(join(folder, "b.png"), PNG.sync.write(b));
    const text = execFileSync(/** @type {string} */ (ORIEL), ["diff", join(folder, "a.png"), join(folder, "b.png"), "--json", "--flip", join(folder, "flip.png")], {encoding: "utf8"});
    const expected = JSON.parse(text).flip;
    assert.ok(Math.abs(mean - expected) < 1e-4 * expected, `${mean} and ${expected}`);
    const picture = PNG.sync.read(readFileSync(join(folder, "flip.png")));
    for (let i = 0; i < error.length; ++i) assert.ok(Math.abs(255 * error[i] - picture.data[4 * i]) < 1.01, `pixel ${i}`);
    assert.ok(mean > 0.01);
  } finally {
    rmSync(folder, {recursive: true});
  }
});
