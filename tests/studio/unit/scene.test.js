// SPDX-License-Identifier: Apache-2.0
// Pure modules of the scene: edits, camera, daylight, mixer, grids, ZIP, coalescing.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {mkdtempSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import test from "node:test";
import {floatToHalf, halfToFloat} from "../../../integrations/studio/display/half.js";
import {plainFileName} from "../../../integrations/studio/net/files.js";
import {reconnectDelay} from "../../../integrations/studio/net/connection.js";
import {axialDepth, cross, dolly, dot, frameOf, length, orbit, pan, project, sub, turn, walk} from "../../../integrations/studio/scene/camera_moves.js";
import {grouped} from "../../../integrations/studio/panels/parameter_groups.js";
import {between, hourList, hourText, isoTime} from "../../../integrations/studio/scene/daylight.js";
import {connectText, editTarget, editText, fittedText, withoutTarget} from "../../../integrations/studio/scene/edit_text.js";
import {Latest} from "../../../integrations/studio/scene/latest.js";
import {LightMix, mixDown} from "../../../integrations/studio/scene/light_mix.js";
import {gridAbove, gridOnSurface, verticalAxis} from "../../../integrations/studio/scene/lux_grid.js";
import {lightEdits} from "../../../integrations/studio/scene/write_light.js";
import {crc32, zipStored} from "../../../integrations/studio/scene/zip.js";

test("numbers lose digits until they fit", () => {
  const within = (n) => (text) => text.length <= n;
  assert.equal(fittedText(0.1234567, within(9)), "0.1234567");
  assert.equal(fittedText(0.1234567, within(5)), "0.123");
  assert.equal(fittedText(1234.567, within(5)), "1235");
  assert.equal(fittedText(0.00001234567, within(5)), "1e-5");
  assert.equal(fittedText(-0.00001234567, within(7)), "-1.2e-5");
  assert.equal(fittedText(123456789, within(6)), "1.23e8");
  assert.equal(fittedText(0, within(1)), "0");
  assert.equal(fittedText(-1234, within(1)), "-1e3");
  assert.equal(fittedText(Number.NaN, within(5)), "0");
});

test("edits are texts of --set", () => {
  assert.equal(editText("floor.refl_gloss", 0.4), "floor.refl_gloss=0.4");
  assert.equal(editText("floor.diffuse", [0.5, 1 / 3, 0]), "floor.diffuse=0.5 0.3333333 0");
  assert.equal(editText("floor.refl_hl_only", true), "floor.refl_hl_only=on");
  assert.equal(connectText("floor.diffuse", "wood"), "floor.diffuse==wood");
  assert.equal(editTarget("a.b=c=d"), "a.b");
  assert.deepEqual(withoutTarget(["a.b=1", "a.bc=2"], "a.b"), ["a.bc=2"]);
});

test("the newest value of a gesture is sent, gestures keep their order", async () => {
  const sent = [];
  const latest = new Latest(async (values, gesture) => {
    sent.push([gesture, ...values]);
    await new Promise((resolve) => setTimeout(resolve, 5));
  });
  latest.push("a", 1, "g1");
  for (const v of [2, 3, 4]) latest.push("a", v, "g1");
  latest.push("b", 9, "g1");
  latest.push("a", 5, "g2");
  await latest.idle();
  assert.deepEqual(sent, [["g1", 1], ["g1", 4, 9], ["g2", 5]]);
});

const LOOK = {from: /** @type {[number, number, number]} */ ([4, -3, 1.6]), to: /** @type {[number, number, number]} */ ([4, 3, 1.2]), up: /** @type {[number, number, number]} */ ([0, 0, 1])};
const close = (a, b, e = 1e-9) => assert.ok(Math.abs(a - b) < e, `${a} is not ${b}`);

test("camera moves keep what they should keep", () => {
  const distance = length(sub(LOOK.to, LOOK.from));
  for (const moved of [orbit(LOOK, 0.3, 0.2), turn(LOOK, 0.3, -0.2), pan(LOOK, 0.1, 0.2), walk(LOOK, 1, 2, 3)]) close(length(sub(moved.to, moved.from)), distance);
  assert.deepEqual(orbit(LOOK, 0.3, 0.2).to, LOOK.to);
  assert.deepEqual(turn(LOOK, 0.3, 0.2).from, LOOK.from);
  close(length(sub(dolly(LOOK, 0.5).to, dolly(LOOK, 0.5).from)), distance / 2);
  close(walk(LOOK, 1, 0, 0).from[2], LOOK.from[2]);  // walking keeps the height of the eye
  const over = orbit(LOOK, 0, 99);  // the pole is never passed
  assert.ok(length(cross(sub(over.to, over.from), LOOK.up)) > 1e-3);
  const {right, up, forward} = frameOf(LOOK);
  close(dot(right, up), 0);
  close(dot(right, forward), 0);
});

test("the target projects to the middle; half of the field of view to the edge", () => {
  const size = /** @type {[number, number]} */ ([200, 100]);
  const middle = project(LOOK.to, LOOK, 60, size);
  close(Number(middle?.[0]), 100);
  close(Number(middle?.[1]), 50);
  const edge = project([4 + Math.tan(Math.PI / 6), -2, 1.6], {from: [4, -3, 1.6], to: [4, 3, 1.6], up: [0, 0, 1]}, 60, size);
  close(Number(edge?.[0]), 200);
  assert.equal(project([4, -9, 1], LOOK, 60, size), null);
  close(axialDepth({from: [0, 0, 0], to: [0, 5, 0], up: [0, 0, 1]}, [3, 4, 2]), 4);
});

test("times have their zone", () => {
  assert.equal(isoTime("2026-06-21", 9.5, 2), "2026-06-21T09:30:00+02:00");
  assert.equal(isoTime("2026-06-21", 24, -3.5), "2026-06-21T23:59:00-03:30");
  assert.equal(hourText(13.25), "13:15");
  assert.deepEqual(hourList(6, 10, 2), [6, 8, 10]);
});

test("hours between two pictures mix their light linearly", () => {
  const frames = [{hour: 8, still: "a"}, {hour: 10, still: "b"}];
  assert.deepEqual(between(frames, 8.5), {stills: ["a", "b"], factors: [0.75, 0.25]});
  assert.deepEqual(between(frames, 7), {stills: ["a"], factors: [1]});
  assert.deepEqual(between(frames, 12), {stills: ["b"], factors: [1]});
  assert.equal(between([], 1), null);
});

test("the mixer sums layers by their factors", () => {
  const mix = new LightMix(), lights = ["light_a", "light_b"], layers = ["beauty", ...lights];
  assert.deepEqual(mix.weights(layers, lights, "beauty"), [[1, 1, 1], [0, 0, 0], [0, 0, 0]]);
  mix.active = true;
  mix.of("light_a").strength = 2;
  mix.of("light_b").color = [1, 0.5, 0];
  assert.deepEqual(mix.weights(layers, lights, "beauty"), [[0, 0, 0], [2, 2, 2], [1, 0.5, 0]]);
  assert.deepEqual(mix.weights(["beauty"], lights, "beauty"), [[1, 1, 1]]);  // layers are not here yet
  mix.of("light_b").on = false;
  assert.deepEqual(mix.weights(layers, lights, "beauty")[2], [0, 0, 0]);
  const plane = (v) => Uint16Array.from([v, v, v, 1].map(floatToHalf));
  const sum = mixDown([plane(9), plane(1), plane(2)], [[0, 0, 0], [2, 2, 2], [1, 0.5, 0]]);
  assert.deepEqual([...sum].slice(0, 3).map(halfToFloat), [4, 3, 2]);
});

test("the mixer writes strength to a scalar and colour to a colour", () => {
  const p = (name, type, value) => ({name, type, value, set: `lamp.${name}`});
  const setting = (strength, color) => ({on: true, strength, color});
  assert.deepEqual(lightEdits([p("multiplier", "scalar", 3), p("color", "color", [1, 2, 4])], setting(2, [1, 1, 1])), ["lamp.multiplier=6"]);
  assert.deepEqual(lightEdits([p("multiplier", "scalar", 3), p("color", "color", [1, 2, 4])], setting(2, [1, 0.5, 0])), ["lamp.color=2 2 0"]);
  assert.deepEqual(lightEdits([p("color", "color", [1, 2, 4])], {...setting(2, [1, 1, 1]), on: false}), ["lamp.color=0 0 0"]);
  assert.equal(lightEdits([p("exponent", "scalar", 2)], setting(2, [1, 1, 1])), null);
});

test("parameters are grouped as declared, otherwise by the first word", () => {
  const names = (list) => grouped(list).map(([title, group]) => [title, group.length]);
  assert.deepEqual(names([{name: "a", type: "scalar", group: "G"}, {name: "b", type: "scalar"}, {name: "c", type: "scalar", group: "G"}]), [["G", 2], ["Other", 1]]);
  const long = ["diffuse", "diffuse_weight", "diffuse_roughness", "reflectivity", "refl_color", "refl_gloss", "thin_walled", "refr_ior", "refr_gloss", "transparency", "bump", "cutout"];
  assert.deepEqual(names(long.map((name) => ({name, type: "scalar"}))), [["Diffuse", 3], ["Reflection", 3], ["Refraction", 3], ["Other", 3]]);
  assert.deepEqual(names(long.slice(0, 5).map((name) => ({name, type: "scalar"}))), [["Parameters", 5]]);
});

test("grids lie on the surface around the picked point", () => {
  const g = gridOnSurface({position: [1, 2, 0], normal: [0, 0, 2]}, 2, 4, 3.2, 5);
  for (let k = 0; k < 2; ++k) close(g.origin[k] + g.u[k] / 2 + g.v[k] / 2, [1, 2][k]);
  close(length(g.u), 2);
  close(length(g.v), 4);
  close(dot(g.u, g.normal), 0);
  assert.deepEqual([g.columns, g.rows], [3, 5]);
  const wall = gridOnSurface({position: [0, 0, 1], normal: [1, 0, 0]}, 1, 1, 2, 2);
  close(wall.u[2], 0);  // the first edge is horizontal
  const wallOfY = gridOnSurface({position: [0, 1, 0], normal: [1, 0, 0]}, 1, 1, 2, 2, [0, 1, 0]);
  close(wallOfY.u[1], 0);
});

test("a grid above a point is horizontal, also where y is up", () => {
  for (const up of [[0, 0, 1], [0, 1, 0]]) {
    assert.deepEqual(verticalAxis(up), up);
    const g = gridAbove({position: [1, 2, 3]}, 0.85, 2, 4, 3, 5, up);
    const centre = [0, 1, 2].map((k) => g.origin[k] + g.u[k] / 2 + g.v[k] / 2);
    [0, 1, 2].forEach((k) => close(centre[k], [1, 2, 3][k] + 0.85 * up[k]));
    assert.deepEqual(g.normal, up);
    close(dot(g.u, up), 0);
    close(dot(g.v, up), 0);
  }
});

test("ZIP files open in another program", () => {
  assert.equal(crc32(new TextEncoder().encode("123456789")), 0xcbf43926);  // check value of CRC-32
  const folder = mkdtempSync(join(tmpdir(), "oriel-zip-"));
  try {
    const file = join(folder, "a.zip");
    writeFileSync(file, zipStored([{name: "one.txt", bytes: new TextEncoder().encode("first")}, {name: "two.txt", bytes: new Uint8Array(5000).fill(65)}]));
    const script = "import sys, zipfile; z = zipfile.ZipFile(sys.argv[1]); assert z.testzip() is None; print(z.namelist(), z.read('one.txt'), len(z.read('two.txt')))";
    assert.equal(execFileSync("python3", ["-c", script, file], {encoding: "utf8"}).trim(), "['one.txt', 'two.txt'] b'first' 5000");
  } finally {
    rmSync(folder, {recursive: true});
  }
});

test("attempts to connect slow down to five seconds; file names become plain", () => {
  assert.deepEqual([0, 1, 2, 3, 4, 99].map(reconnectDelay), [500, 1000, 2000, 4000, 5000, 5000]);
  assert.equal(plainFileName("../a b/ç?.png"), "_a b___.png");
});
