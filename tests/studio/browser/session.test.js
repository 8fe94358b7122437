// SPDX-License-Identifier: Apache-2.0
// The page with the mock server: editing, mixing, measuring, comparing, delivering, failures, keyboard.
import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import {createRequire} from "node:module";
import test, {after, before} from "node:test";
import {halfToFloat} from "../../../integrations/studio/display/half.js";
import {Mock, startMock} from "../mock/server.js";
import {CHROMIUM, TIMEOUT_MS, openBrowser, openStudio, readCanvas, waitForSamples} from "./page.js";

const skip = CHROMIUM ? false : "chromium is not installed";
/** @type {import("puppeteer-core").Browser} */ let browser;
before(async () => { if (!skip) browser = await openBrowser(); });
after(async () => { await browser?.close(); });

/** Runs a test with a new mock and a new page; errors of the page fail it. */
function withStudio(name, body, options = {}) {
  test(name, {skip}, async () => {
    const server = await startMock(new Mock({size: [160, 90], ...options.mock}));
    const studio = await openStudio(browser, server, options);
    try {
      await waitForSamples(studio.page, 16);
      await body({...studio, server, mock: server.mock});
      if (!options.expectErrors) studio.check();
    } finally {
      await studio.page.close();
      await server.close();
    }
  });
}

const sent = (mock, type) => mock.requests.filter((m) => m.type === type);
const until = async (condition, what) => {
  for (const end = Date.now() + TIMEOUT_MS; Date.now() < end;) {
    if (condition()) return;
    await new Promise((resolve) => setTimeout(resolve, 25));
  }
  assert.fail(`did not happen: ${what}`);
};
const clickButton = (page, panel, text) => page.evaluate((p, t) => {
  const found = [...document.querySelectorAll(`${p} button`)].find((b) => b.textContent.trim() === t);
  if (!found) throw new Error(`no button ${t}`);
  found.click();
}, panel, text);
const clickPicture = async (page, x, y) => {
  const at = await page.evaluate((px, py) => {
    const {viewport} = window.__studio.app, box = viewport.canvas.getBoundingClientRect(), [cx, cy] = viewport.canvasPoint([px, py]);
    return [box.left + cx, box.top + cy];
  }, x + 0.5, y + 0.5);
  await page.mouse.click(at[0], at[1]);
};
const mean = (pixels) => pixels.reduce((s, v) => s + v, 0) / pixels.length;

withStudio("the canvas shows the picture of the server, neither constant nor black", async ({page}) => {
  const {pixels} = await readCanvas(page);
  assert.ok(new Set(pixels).size > 60);
  assert.equal(await page.evaluate(() => window.__studio.app.viewport.gl.gl.isContextLost()), false);
  assert.match(await page.$eval("canvas.picture", (c) => c.getAttribute("aria-label")), /room\.mi.*samples/);
});

withStudio("the token leaves the address; every frame is acknowledged", async ({page, mock}) => {
  assert.doesNotMatch(page.url(), /token/);
  await until(() => mock.unacknowledged === 0, "acknowledgement");
  assert.ok(sent(mock, "ack").length >= 3);
});

// acceptance: W2
withStudio("a click selects the material; a slider edits it as text; undo restores", async ({page, mock}) => {
  await clickPicture(page, 80, 80);
  await page.waitForSelector("#panel-edit .element-body .field");
  assert.equal(await page.$eval("#panel-edit h2", (e) => e.textContent), "floor");
  const field = await page.evaluateHandle(() => [...document.querySelectorAll(".element-body .field")].find((f) => f.querySelector("label")?.textContent === "refl_gloss"));
  const number = await field.$("input[type=number]");
  await number.click({clickCount: 3});
  await number.type("0.4\n");
  await until(() => mock.edits.includes("floor.refl_gloss=0.4"), "edit");
  await page.waitForFunction(() => document.querySelector(".edits code")?.textContent === "floor.refl_gloss=0.4");
  await page.waitForSelector(".field.edited");
  await page.click("button[title^=Undo]");
  await until(() => mock.edits.length === 0, "undo");
  await page.waitForFunction(() => !document.querySelector(".field.edited"));
  await page.click("button[title^=Redo]");
  await until(() => mock.edits.length === 1, "redo");
  await page.keyboard.down("Control");
  await page.keyboard.press("s");
  await page.keyboard.up("Control");
  await until(() => sent(mock, "save").some((m) => m.mode === "mi"), "save");
});

withStudio("a drag of a slider is one gesture, with at most one request under way", async ({page, mock}) => {
  await page.evaluate(() => window.__studio.app.select("floor"));
  await page.waitForSelector(".element-body .field");
  await page.evaluate(() => {
    const f = [...document.querySelectorAll(".element-body .field")].find((x) => x.querySelector("label")?.textContent === "refl_gloss"), s = f.querySelector("input[type=range]");
    for (let i = 1; i <= 40; ++i) {
      s.value = String(1000 - 20 * i);
      s.dispatchEvent(new Event("input"));
    }
    s.dispatchEvent(new Event("change"));
  });
  await until(() => mock.edits.includes("floor.refl_gloss=0.2"), "last value");
  assert.ok(sent(mock, "edit").length <= 3, "intermediate values are replaced");
  assert.equal(new Set(sent(mock, "edit").map((m) => m.gesture)).size, 1);
  assert.equal(mock.past.length, 1);
});

withStudio("exposure and tone curve send nothing to the server", async ({page, mock}) => {
  const commands = () => mock.requests.filter((m) => m.type !== "ack" && m.type !== "ping").length;
  const before = commands(), dark = mean((await readCanvas(page)).pixels);
  await page.evaluate(() => window.__studio.app.display.changeTone({exposure: window.__studio.app.display.tone.exposure + 1}));
  assert.ok(mean((await readCanvas(page)).pixels) > dark + 5);
  assert.equal(commands(), before);
});

// acceptance: W3
withStudio("the mixer changes the picture by the layers, without a restart", async ({page, mock}) => {
  await page.click("#tab-lights");
  await page.click("#panel-lights input[type=checkbox]");
  await page.waitForFunction(() => window.__studio.app.session.frames.names.length === 4);
  await waitForSamples(page, 64);  // the last frame: `expected` is of the same one as the canvas
  await page.evaluate(() => window.__studio.app.display.change());
  const epoch = mock.epoch, all = await readCanvas(page);
  await page.evaluate(() => {
    const {mix} = window.__studio.app.display;
    mix.of("light_lamp").on = mix.of("light_rest").on = false;
    mix.of("light_sun").strength = 2;
    window.__studio.app.display.changeTone({operator: "photographic", burn: 1, crush: 0, saturation: 1, gamma: 1, exposure: -5});
  });
  const sun = await readCanvas(page);
  assert.notDeepEqual(sun.pixels, all.pixels);
  const expected = await page.evaluate(() => [...window.__studio.app.session.frames.layers[1].subarray(0, 4)]);
  assert.ok(Math.abs(sun.pixels[0] - Math.min(255, 255 * 2 * 2 ** -5 * halfToFloat(expected[0]))) <= 1.5);
  assert.ok(sun.pixels[0] > 50, "the value is large enough to compare");
  assert.equal(mock.epoch, epoch);
});

withStudio("hours are rendered once, scrubbed and left, and the edits are as before", async ({page, mock}) => {
  await page.click("#tab-daylight");
  await page.waitForSelector(".sun-path");
  await clickButton(page, "#panel-daylight", "Render hours");
  await page.waitForFunction(() => window.__studio.app.viewport.substitute !== null);
  assert.equal(sent(mock, "daylight").length, 8);
  assert.equal(new Set(sent(mock, "daylight").map((m) => m.gesture)).size, 1);
  assert.match(sent(mock, "daylight")[0].time, /^2026-06-21T06:00:00\+01:00$/);
  await until(() => mock.edits.length === 0, "undo of the hours");
  const epoch = mock.epoch;
  const shown = await page.evaluate(async () => {
    const sums = [];
    const slider = [...document.querySelectorAll("#panel-daylight input[type=range]")].find((s) => s.getAttribute("aria-label") === "Scrub");
    for (const hour of [6, 11, 20]) {
      slider.value = String(1000 * hour / 24);
      slider.dispatchEvent(new Event("input"));
      sums.push([...window.__studio.readCanvas().pixels].reduce((a, v, i) => a + v * (i % 7), 0));
    }
    return sums;
  });
  assert.equal(new Set(shown).size, 3);
  assert.equal(mock.epoch, epoch, "scrubbing does not render");
  await clickButton(page, "#panel-daylight", "Live picture");
  assert.equal(await page.evaluate(() => window.__studio.app.viewport.substitute), null);
});

// acceptance: W4
withStudio("probe, lux grid, explain and false colours show values of the server", async ({page, mock}) => {
  await page.keyboard.press("4");
  await clickPicture(page, 40, 50);
  await page.waitForFunction(() => document.querySelector("#panel-measure .facts")?.textContent.includes("9.15 ± 0.1 cd/m²"));
  await page.keyboard.press("5");
  await clickPicture(page, 60, 80);
  await until(() => sent(mock, "pick").length > 0, "pick");
  await page.waitForFunction(() => document.querySelector("#panel-measure")?.textContent.includes("Centre:"));
  await clickButton(page, "#panel-measure", "Measure grid");
  await page.waitForSelector(".lux td");
  assert.equal(await page.$$eval(".lux td", (cells) => cells.length), 25);
  assert.equal(await page.$eval(".lux td", (cell) => cell.textContent), "100");
  await page.keyboard.press("6");
  await clickPicture(page, 10, 10);
  await page.waitForFunction(() => document.querySelector(".explain").textContent.includes("62 %"));
  await page.keyboard.press("c");
  await page.waitForFunction(() => !document.querySelector(".legend").hidden && document.querySelectorAll(".legend-ticks li").length > 2);
});

withStudio("snapshots: wipe, difference and FLIP; restore", async ({page, mock}) => {
  await page.keyboard.press("t");
  await page.waitForSelector(".snapshots li");
  const frame = await page.evaluate(() => window.__studio.drawnFrame);
  await page.evaluate(() => void window.__studio.app.session.edit("floor.refl_gloss=0.3"));
  await until(() => mock.edits.length === 1, "edit");
  await page.waitForFunction((before) => window.__studio.drawnFrame !== before, {}, frame);
  await waitForSamples(page, 64);
  const change = await readCanvas(page);
  await page.click("#tab-compare");
  await page.select("#panel-compare select", "wipe");
  await page.evaluate(() => window.__studio.app.display.change({wipe: 1}));
  const other = await readCanvas(page);
  assert.notDeepEqual(other.pixels, change.pixels);
  // The line of the wipe is dragged; the camera stays.
  await page.evaluate(() => window.__studio.app.display.change({wipe: 0.5}));
  const box = await (await page.$("canvas.picture")).boundingBox(), looks = sent(mock, "view").filter((m) => "look" in m).length;
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.7, box.y + box.height / 2, {steps: 3});
  await page.mouse.up();
  assert.ok(await page.evaluate(() => window.__studio.app.display.wipe) > 0.6);
  assert.equal(sent(mock, "view").filter((m) => "look" in m).length, looks);
  for (const [mode, label] of [["difference", /Mean difference [\d.]*[1-9]/], ["flip", /Mean FLIP error 0\.\d*[1-9]/]]) {
    await page.select("#panel-compare select", mode);
    await page.waitForFunction((p) => new RegExp(p).test(document.querySelector("#panel-compare").textContent), {}, label.source);
  }
  await clickButton(page, "#panel-compare", "Restore");
  await until(() => mock.edits.length === 0, "restored edits");
});

withStudio("deliver: files, command, job with pause and resume", async ({page, mock}) => {
  await page.click("#tab-deliver");
  await clickButton(page, "#panel-deliver", "PNG");
  await until(() => sent(mock, "deliver").length === 1, "deliver");
  assert.match(sent(mock, "deliver")[0].tone, /^--view agx --cm2 /);
  await clickButton(page, "#panel-deliver", "Show command");
  await page.waitForFunction(() => document.querySelector("#panel-deliver .command").textContent.startsWith("oriel render"));
  await clickButton(page, "#panel-deliver", "Start final render");
  await page.waitForFunction(() => document.querySelector("#panel-deliver").textContent.includes("40 %, 102 samples, 1 min 15 s left"));
  for (const action of ["Pause", "Resume", "Cancel"]) {
    await clickButton(page, "#panel-deliver", action);
    await until(() => sent(mock, "job").some((m) => m.action === action.toLowerCase()), action);
  }
});

withStudio("messages have places; a dropped file relinks a texture", async ({page, mock}) => {
  await page.click("#tab-messages");
  assert.match(await page.$eval("#panel-messages .messages", (e) => e.textContent), /warning.*carpet.*room\.mi:88:3/s);
  await page.evaluate(() => {
    const data = new DataTransfer();
    data.items.add(new File(["x"], "../new carpet.jpg", {type: "image/jpeg"}));
    document.querySelector(".drop").dispatchEvent(new DragEvent("drop", {dataTransfer: data, bubbles: true, cancelable: true}));
  });
  await until(() => sent(mock, "relink").length === 1, "relink");
  assert.deepEqual(mock.uploads, ["_new carpet.jpg"]);
  assert.equal(sent(mock, "relink")[0].file, "textures/_new carpet.jpg");
  await page.waitForFunction(() => !document.querySelector(".drop"));
});

withStudio("names of the scene are text, not markup", async ({page}) => {
  assert.equal(await page.$eval(".outline-list", (e) => e.querySelectorAll("b").length), 0);
  assert.match(await page.$eval(".outline-list", (e) => e.textContent), /<b>glass<\/b>/);
});

// acceptance: W6
withStudio("after a crash the page offers to restart from the edits", async ({page, mock}) => {
  mock.crash();
  await page.waitForFunction(() => document.querySelector(".banner")?.textContent.includes("0 edits are kept"));
  await clickButton(page, ".banner", "Restart from saved edits");
  await until(() => sent(mock, "restart").length === 1, "restart");
  await page.waitForFunction(() => document.querySelector(".banner").hidden);
});

withStudio("the page connects again after the connection ended, and drops late strips", async ({page, mock}) => {
  mock.socket.terminate();
  await page.waitForFunction(() => document.querySelector(".banner")?.textContent.includes("No connection"));
  await page.waitForFunction(() => document.querySelector(".banner").hidden);
  await waitForSamples(page, 64);
}, {expectErrors: true});

withStudio("the page connects again after the network was lost without a word", async ({page, mock}) => {
  const socket = mock.socket;
  mock.silent = true;
  await page.waitForFunction(() => document.querySelector(".banner")?.textContent.includes("No connection"));
  mock.silent = false;
  await page.waitForFunction(() => document.querySelector(".banner").hidden);
  await waitForSamples(page, 64);
  assert.notEqual(mock.socket, socket);
});

withStudio("long numbers fit into their fields and are complete while they are edited", async ({page, mock}) => {
  await clickPicture(page, 80, 80);
  await page.waitForSelector("#panel-edit .element-body .field");
  for (const edit of ["floor.refl_gloss=0.1234567", "floor.diffuse=0.1234567 1234.567 0.00001234567"])
    await page.evaluate((e) => window.__studio.app.session.edit(e), edit);
  const field = (name) => page.evaluateHandle((n) => [...document.querySelectorAll(".element-body .field")].find((f) => f.querySelector("label")?.textContent === n), name);
  const inputs = [...await (await field("refl_gloss")).$$("input[type=number]"), ...await (await field("diffuse")).$$("input[type=number]")];
  const whole = ["0.1234567", "0.1234567", "1234.567", "0.00001234567"];
  assert.equal(inputs.length, whole.length);
  await until(() => mock.edits.length === 2, "edits");
  await page.waitForFunction((e) => Number(e.title) > 1234, {}, inputs[2]);
  for (const [i, input] of inputs.entries()) {
    const shown = await input.evaluate((e) => ({text: e.value, title: e.title, fits: e.scrollWidth <= e.clientWidth, width: `${e.scrollWidth} of ${e.clientWidth}`}));
    assert.ok(shown.fits, `${shown.text} has ${shown.width}`);
    assert.ok(Math.abs(Number(shown.text) / Number(whole[i]) - 1) < 0.2, shown.text);
    assert.equal(Number(shown.title), Number(whole[i]));
    await input.focus();
    assert.equal(Number(await input.evaluate((e) => e.value)), Number(whole[i]));
  }
  await page.focus("button");
  assert.equal(mock.edits.length, 2, "looking changes nothing");
});

withStudio("the picture returns after the WebGL context was lost", async ({page}) => {
  const before = await readCanvas(page);
  await page.evaluate(async () => {
    const {canvas, gl: {gl}} = window.__studio.app.viewport, lose = gl.getExtension("WEBGL_lose_context");
    const event = (name) => new Promise((resolve) => canvas.addEventListener(name, resolve, {once: true}));
    const lost = event("webglcontextlost"), restored = event("webglcontextrestored");
    lose.loseContext();
    await lost;
    await new Promise((resolve) => setTimeout(resolve));  // a context can be restored after its event
    lose.restoreContext();
    await restored;
  });
  assert.deepEqual((await readCanvas(page)).pixels, before.pixels);
}, {expectErrors: true});

withStudio("a region is dragged and removed; the camera orbits by drag and by keys", async ({page, mock}) => {
  await page.keyboard.press("2");
  const box = await (await page.$("canvas.picture")).boundingBox();
  await page.mouse.move(box.x + box.width * 0.4, box.y + box.height * 0.45);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.6, box.y + box.height * 0.55, {steps: 4});
  await page.mouse.up();
  await until(() => mock.view.region !== null, "region");
  await until(() => sent(mock, "pointer").some((m) => m.x > 80 && m.y > 40), "place of the pointer");
  await page.mouse.move(box.x - 20, box.y + 5);
  await until(() => sent(mock, "pointer").some((m) => m.x === undefined), "the pointer leaves");
  assert.ok(mock.view.region[2] > mock.view.region[0] && mock.view.region[3] > mock.view.region[1]);
  await page.keyboard.press("Escape");
  await until(() => mock.view.region === null, "no region");
  await page.keyboard.press("1");
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2, {steps: 4});
  await page.mouse.up();
  await until(() => sent(mock, "view").some((m) => m.dragging === false), "end of the drag");
  const turned = mock.view.look.from;
  assert.ok(Math.abs(turned[0] - 4) > 0.1);
  await page.focus("canvas.picture");
  await page.keyboard.press("w");
  await until(() => mock.view.look.from[1] !== turned[1], "walk");
  assert.equal(mock.past.length, 0, "navigation is no edit");
});

withStudio("a session by keyboard only", async ({page, mock}) => {
  const focusText = () => page.evaluate(() => `${document.activeElement?.className} ${document.activeElement?.textContent}`);
  await page.keyboard.press("Tab");
  assert.match(await focusText(), /skip/);
  await page.keyboard.down("Alt");
  await page.keyboard.press("2");
  await page.keyboard.up("Alt");
  assert.equal(await page.$eval("#panel-display", (p) => p.hidden), false);
  // From the outline to a material.
  await page.focus(".row");
  await page.keyboard.press("Enter");
  await page.waitForSelector(".element-body .field");
  // Arrow keys change a slider and send an edit.
  await page.evaluate(() => [...document.querySelectorAll(".element-body .field")].find((f) => f.querySelector("label")?.textContent === "reflectivity").querySelector("input[type=range]").focus());
  await page.keyboard.press("ArrowRight");
  await until(() => mock.edits.some((e) => e === "floor.reflectivity=0.61"), "edit by arrow key");
  // Letters in text fields are text.
  await page.focus(".sidebar .search");
  await page.keyboard.type("ct4");
  assert.equal(await page.$eval(".sidebar .search", (e) => e.value), "ct4");
  assert.equal(await page.evaluate(() => window.__studio.app.display.falseColors), false);
  // The list of shortcuts opens and closes.
  await page.focus("canvas.picture");
  await page.keyboard.type("?");
  await page.waitForSelector("dialog[open]");
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => !document.querySelector("dialog[open]"));
  // The tab key reaches the controls and is never trapped.
  await page.evaluate(() => document.body.focus());
  const seen = new Set();
  for (let i = 0; i < 120; ++i) {
    await page.keyboard.press("Tab");
    seen.add(await page.evaluate(() => {
      const e = document.activeElement;
      return e === document.body ? "body" : `${e.tagName} ${e.id || e.title || e.textContent || e.getAttribute("aria-label")}`;
    }));
  }
  assert.ok(seen.size > 30, `${seen.size} controls were reached`);
});

for (const scheme of ["dark", "light"])
  withStudio(`axe finds no violations, ${scheme}`, async ({page}) => {
    const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
    await page.evaluate(axe);
    await page.evaluate(() => window.__studio.app.select("floor"));
    await page.waitForSelector(".element-body .field");
    await page.evaluate(() => window.__studio.app.display.change({falseColors: true}));
    for (const tab of ["edit", "display", "lights", "daylight", "measure", "compare", "deliver", "messages"]) {
      await page.click(`#tab-${tab}`);
      const found = await page.evaluate(async () => (await window.axe.run(document, {runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]})).violations
          .map((v) => `${v.id}: ${v.nodes.map((n) => n.target.join(" ")).join(", ")}`));
      assert.deepEqual(found, [], tab);
    }
  }, {scheme});

withStudio("resizing and reduced pictures leave one texture", async ({page}) => {
  for (let i = 0; i < 20; ++i) await page.setViewport({width: 900 + 20 * i, height: 700, deviceScaleFactor: 1});
  await page.select("select[aria-label='Resolution scale']", "2");
  await page.waitForFunction(() => window.__studio.app.session.frames.width === 80);
  await waitForSamples(page, 16);
  assert.ok(new Set((await readCanvas(page)).pixels).size > 60);
});
