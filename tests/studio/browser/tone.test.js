// SPDX-License-Identifier: Apache-2.0
// acceptance: W1. The canvas shows the same bytes as `oriel tonemap`, for each operator.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import test from "node:test";
import {PNG} from "pngjs";
import {floatToHalf} from "../../../integrations/studio/display/half.js";
import {defaultTone, tonemapOptions} from "../../../integrations/studio/display/tone.js";
import {exrFile} from "../exr.js";
import {Mock, startMock} from "../mock/server.js";
import {CHROMIUM, openBrowser, openStudio, readCanvas} from "./page.js";

const ORIEL = process.env.ORIEL;
const NAN = 0x7e00;
const SPECIAL = [0, 1e-4, 0.0031308, 0.0032, 0.18, 0.5, 0.76, 0.8, 1, 4, 100, 65504, -0.5, -100, 6e-8];

/** Colours over ten decades with every special value in each channel, and NaN. */
function wideRange(width, height) {
  const out = new Uint16Array(4 * width * height);
  let state = 12345;
  const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
  for (let i = 0; i < width * height; ++i) {
    for (let k = 0; k < 3; ++k) {
      const special = random() < 0.3 ? SPECIAL[Math.floor(random() * SPECIAL.length)] : 10 ** (random() * 8 - 5);
      out[4 * i + k] = i % 97 === 50 + k ? NAN : floatToHalf(special);
    }
    if (i < SPECIAL.length) for (let k = 0; k < 3; ++k) out[4 * i + k] = floatToHalf(SPECIAL[i]);  // greys
    out[4 * i + 3] = 0x3c00;
  }
  return out;
}

const CASES = {
  agx: {operator: "agx"},
  "agx, exposure and white point": {operator: "agx", exposure: -2.25, temperature: 3200, tint: 0.2},
  neutral: {operator: "neutral"},
  "neutral, camera": {operator: "neutral", measured: true, iso: 200, shutter: 60, fNumber: 4, cm2: 30},
  photographic: {operator: "photographic", burn: 0.3, crush: 0.4, saturation: 1.3, gamma: 2.2},
  "photographic, linear": {operator: "photographic", burn: 1, crush: 0, saturation: 1, gamma: 1, exposure: 1.5},
  "photographic, camera": {operator: "photographic", measured: true, iso: 100, shutter: 100, fNumber: 8, cm2: 800, saturation: 0.4, temperature: 9000},
  simple: {operator: "simple", pedestal: 0.02, gain: 0.8, knee: 0.5, compression: 2},
  "simple, asymptotic": {operator: "simple", asymptotic: true, compression: 1.5, knee: 0.3, gamma: 1.8, exposure: 1},
};

const skip = !CHROMIUM ? "chromium is not installed" : !ORIEL ? "the program is not built" : false;

for (const [width, height] of [[61, 47], [1, 1], [17, 3]]) {
  test(`canvas equals oriel tonemap, ${width} x ${height}`, {skip}, async (t) => {
    const folder = mkdtempSync(join(tmpdir(), "oriel-tone-"));
    const pixels = wideRange(width, height);
    // The protocol sends NaN as 0; the page receives NaN here and has to show 0.
    const server = await startMock(new Mock({size: [width, height], picture: pixels}));
    const browser = await openBrowser();
    try {
      writeFileSync(join(folder, "in.exr"), exrFile(pixels, width, height));
      const {page, check} = await openStudio(browser, server);
      t.diagnostic(await page.evaluate(() => {
        const {gl} = window.__studio.app.viewport.gl, info = gl.getExtension("WEBGL_debug_renderer_info");
        return info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "unknown renderer";
      }));
      for (const [name, fields] of Object.entries(CASES)) {
        const tone = {...defaultTone(), ...fields};
        execFileSync(ORIEL, ["tonemap", join(folder, "in.exr"), "-o", join(folder, "out.png"), ...tonemapOptions(tone).split(" ")]);
        const expected = PNG.sync.read(readFileSync(join(folder, "out.png")));
        assert.deepEqual([expected.width, expected.height], [width, height]);
        await page.evaluate((settings) => {
          window.__studio.app.viewport.zoom = 1;
          window.__studio.app.display.changeTone(settings);
        }, tone);
        const shown = await readCanvas(page);
        assert.deepEqual([shown.width, shown.height], [width, height], "the canvas shows the picture 1:1");
        compare(shown.pixels, expected.data, name, width * height > 100);
      }
      check();
    } finally {
      await browser.close();
      await server.close();
      rmSync(folder, {recursive: true});
    }
  });
}

function compare(shown, expected, name, isLarge) {
  let largest = 0, sum = 0, different = 0, count = 0;
  const distinct = new Set();
  for (let i = 0; i < expected.length; ++i) {
    if (i % 4 === 3) continue;
    const d = Math.abs(shown[i] - expected[i]);
    largest = Math.max(largest, d);
    sum += d;
    different += d > 0 ? 1 : 0;
    count += 1;
    distinct.add(shown[i]);
  }
  assert.ok(largest <= 1, `${name}: largest difference ${largest} of 255`);
  assert.ok(sum / count <= 0.1, `${name}: mean difference ${sum / count}`);
  if (!isLarge) return;
  assert.ok(different / count <= 0.02, `${name}: ${different} of ${count} values differ`);
  assert.ok(distinct.size > 50, `${name}: the canvas has only ${distinct.size} values`);
}
