// SPDX-License-Identifier: Apache-2.0
// acceptance: W2, W3, W4. The page with the program: a scene is opened, edited, measured, relit, saved and opened again.
// ORIEL_STUDIO_SHOTS=FOLDER writes screenshots, ORIEL_STUDIO_SCENE=interior uses the scene of the README.
import assert from "node:assert/strict";
import {spawn, spawnSync} from "node:child_process";
import {cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {createInterface} from "node:readline";
import test from "node:test";
import {fileURLToPath} from "node:url";
import {CHROMIUM, openBrowser, openStudio, readCanvas} from "./page.js";

const ORIEL = process.env.ORIEL, ROOT = fileURLToPath(new URL("../../../", import.meta.url));
const SHOTS = process.env.ORIEL_STUDIO_SHOTS;
const SCENES = {
  room: {folder: "scenes/guide", file: "room.mi", material: "oak", gloss: "oak.refl_gloss=0.35", saved: "room.mi", size: [160, 108], samples: 4},
  interior: {folder: "scenes/interior", file: "interior.mi", material: "oak_1", gloss: "oak_1_s.refl_gloss=0.35", saved: "materials.mi", size: [640, 360], samples: 8},
};
const SCENE = SCENES[process.env.ORIEL_STUDIO_SCENE ?? "room"];

function reasonToSkip() {
  if (!CHROMIUM) return "chromium is not installed";
  if (!ORIEL) return "the program is not built";
  const help = spawnSync(ORIEL, ["studio", "--help"], {encoding: "utf8"});
  return help.stdout.includes("--page") ? false : "the program has no command studio";
}

/** Starts the program; resolves with address and token of the line that it prints. */
async function startProgram(scene, ...options) {
  const child = spawn(ORIEL, ["studio", scene, "--page", join(ROOT, "integrations/studio"), ...options], {stdio: ["ignore", "pipe", "pipe"]});
  let log = "";
  child.stderr.on("data", (text) => { log += text; });
  const line = await new Promise((resolve, reject) => {
    createInterface({input: child.stdout}).once("line", resolve);
    child.once("exit", (code) => reject(new Error(`oriel studio ended with ${code}: ${log}`)));
  });
  const found = /^(http:\/\/127\.0\.0\.1:\d+\/)#token=(\w+)$/.exec(line);
  assert.ok(found, line);
  const ended = new Promise((resolve) => child.once("exit", resolve));
  return {url: found[1], token: found[2], pid: child.pid, stop: async () => { const timer = setTimeout(() => child.kill("SIGKILL"), 20000); child.kill("SIGINT"); await ended; clearTimeout(timer); }, log: () => log};
}

const converged = (page) => page.waitForFunction(() => {
  const {session} = window.__studio.app, p = session.progress;
  return p?.status === "converged" && p.epoch === session.state.epoch && session.frames.epoch === p.epoch && window.__studio.drawnFrame === session.frames.frame;
}, {timeout: 300000});

const edits = (page) => page.evaluate(() => window.__studio.app.session.state.edits);
const shot = async (page, name) => { if (SHOTS) { mkdirSync(SHOTS, {recursive: true}); await page.screenshot({path: join(SHOTS, `${name}.png`)}); } };
const pressButton = (page, panel, text) => page.evaluate((p, t) => [...document.querySelectorAll(`${p} button`)].find((b) => b.textContent.trim() === t).click(), panel, text);

async function clickPicture(page, u, v) {
  const at = await page.evaluate((x, y) => {
    const {viewport, session} = window.__studio.app, box = viewport.canvas.getBoundingClientRect(), [w, h] = session.state.size;
    const [cx, cy] = viewport.canvasPoint([x * w, y * h]);
    return [box.left + cx, box.top + cy];
  }, u, v);
  await page.mouse.click(at[0], at[1]);
}

async function open(browser, program) {
  const studio = await openStudio(browser, program, {width: 1440, height: 860, timeout: 180000});
  await studio.page.evaluate((size, samples) => window.__studio.app.session.view({size, budget: {samples, noise: null, seconds: null}}), SCENE.size, SCENE.samples);
  await studio.page.waitForFunction((size) => window.__studio.app.session.state.size.join() === size.join(), {}, SCENE.size);
  await converged(studio.page);
  return studio;
}

test("open, edit, move the sun, measure, relight, save, open again: the same picture", {skip: reasonToSkip(), timeout: 1500000}, async (t) => {
  const folder = mkdtempSync(join(tmpdir(), "oriel-studio-"));
  cpSync(join(ROOT, SCENE.folder), folder, {recursive: true});
  const scene = join(folder, SCENE.file), browser = await openBrowser();
  /** @type {{url: string, token: string, stop: () => Promise<void>} | null} */ let program = null;
  try {
    program = await startProgram(scene);
    const {page, check} = await open(browser, program);
    const first = await readCanvas(page);
    assert.ok(new Set(first.pixels).size > 40, "the picture is neither black nor constant");
    await shot(page, "opened");

    // A click selects a material; its panel comes from the declarations.
    await clickPicture(page, 0.5, 0.9);
    await page.waitForSelector("#panel-edit .element-body .field");
    t.diagnostic(`picked ${await page.$eval("#panel-edit h2", (e) => e.textContent)}`);

    await page.evaluate((name) => window.__studio.app.select(name), SCENE.material);
    await page.waitForFunction((name) => document.querySelector("#panel-edit h2").textContent === name && document.querySelector(".element-body .field"), {}, SCENE.material);
    const field = await page.evaluateHandle(() => [...document.querySelectorAll(".element-body .field")].find((f) => f.querySelector("label")?.textContent === "refl_gloss"));
    const input = await field.$("input[type=number]");
    await input.click({clickCount: 3});
    await input.type("0.35\n");
    await page.waitForFunction((e) => window.__studio.app.session.state.edits.includes(e), {}, SCENE.gloss);
    await converged(page);
    await shot(page, "material");

    // The sun moves.
    await page.click("#tab-daylight");
    const editsBeforeSun = (await edits(page)).length;
    await page.evaluate(() => {
      const slider = [...document.querySelectorAll("#panel-daylight input[type=range]")].find((s) => s.getAttribute("aria-label") === "Hour");
      slider.value = String(1000 * 15.5 / 24);
      slider.dispatchEvent(new Event("input"));
      slider.dispatchEvent(new Event("change"));
    });
    await page.waitForFunction((before) => window.__studio.app.session.state.edits.length > before, {}, editsBeforeSun);
    await converged(page);
    const second = await readCanvas(page);
    assert.notDeepEqual(second.pixels, first.pixels);
    await shot(page, "daylight");

    // A lux grid on a picked surface.
    await page.keyboard.press("5");
    await clickPicture(page, 0.5, 0.9);
    await page.waitForFunction(() => document.querySelector("#panel-measure").textContent.includes("Centre:"));
    await page.evaluate(() => {
      const set = (label, value) => {
        const f = [...document.querySelectorAll("#panel-measure .field")].find((x) => x.querySelector("label")?.textContent === label).querySelector("input[type=number]");
        f.value = value;
        f.dispatchEvent(new Event("change"));
      };
      set("Columns", "4");
      set("Rows", "3");
      set("Time limit", "3");
    });
    await pressButton(page, "#panel-measure", "Measure grid");
    await page.waitForSelector(".lux td");
    const values = await page.$$eval(".lux td", (cells) => cells.map((c) => Number.parseFloat(c.title)));
    assert.equal(values.length, 12);
    assert.ok(values.every((v) => v >= 0) && values.some((v) => v > 0), String(values));
    await shot(page, "grid");

    // Numbers of a former scene are marked, those of the present one are not.
    assert.equal(await page.$eval(".lux", (table) => table.closest(".stale") !== null), false);
    await page.evaluate((name) => window.__studio.app.session.edit(`${name}.diffuse_weight=0.5`), SCENE.material);
    await page.waitForFunction(() => document.querySelector(".lux").closest(".stale") !== null);
    await page.click("button[title^=Undo]");
    await page.waitForFunction(() => document.querySelector(".lux").closest(".stale") === null);

    // Relight in the page: the layers sum to the beauty, sliders do not restart the render.
    await page.keyboard.press("1");
    await page.click("#tab-lights");
    const grouped = await page.evaluate(() => window.__studio.app.session.state.light_layers.length > 0);
    if (grouped) await page.click("#panel-lights input[type=checkbox]");
    else await pressButton(page, "#panel-lights", "Make a group for each light");
    await page.waitForFunction(() => {
      const {session} = window.__studio.app;
      return session.state.light_layers.length > 0 && session.state.light_layers.every((l) => session.frames.names.includes(l));
    });
    await converged(page);
    const epoch = await page.evaluate(() => window.__studio.app.session.state.epoch), mixed = await readCanvas(page);
    await page.evaluate(() => {
      const {display, session} = window.__studio.app;
      for (const layer of session.state.light_layers) display.mix.of(layer).strength = 2;
      display.change();
    });
    const doubled = await readCanvas(page);
    await page.evaluate(() => {
      const {display, session} = window.__studio.app;
      for (const layer of session.state.light_layers) display.mix.of(layer).strength = 1;
      display.mix.active = false;
      display.changeTone({exposure: display.tone.exposure + 1});
    });
    const exposed = await readCanvas(page);
    await page.evaluate(() => {
      const {display} = window.__studio.app;
      display.changeTone({exposure: display.tone.exposure - 1});
    });
    assert.notDeepEqual(doubled.pixels, mixed.pixels);
    let different = 0;
    for (let i = 0; i < exposed.pixels.length; ++i) if (Math.abs(exposed.pixels[i] - doubled.pixels[i]) > 2) ++different;
    assert.ok(different < exposed.pixels.length * 0.002, `twice the light of all groups is one stop more: ${different} values differ`);
    assert.equal(await page.evaluate(() => window.__studio.app.session.state.epoch), epoch);
    await shot(page, "lights");

    // Save; the edits are in the files and the other lines are kept.
    const before = readFileSync(join(ROOT, SCENE.folder, SCENE.saved), "utf8");
    await page.evaluate(() => window.__studio.app.session.view({light_groups: []}));
    await page.keyboard.down("Control");
    await page.keyboard.press("s");
    await page.keyboard.up("Control");
    await page.waitForFunction(() => window.__studio.app.session.state.saved);
    await converged(page);
    const picture = await readCanvas(page);
    const after = readFileSync(join(folder, SCENE.saved), "utf8");
    assert.notEqual(after, before);
    for (const line of before.split("\n").filter((l) => l.startsWith("#"))) assert.ok(after.includes(line), line);
    check();
    await page.close();
    await program.stop();

    program = await startProgram(scene);
    const again = await open(browser, program);
    assert.deepEqual(await edits(again.page), []);
    const reopened = await readCanvas(again.page);
    assert.deepEqual([reopened.width, reopened.height], [picture.width, picture.height]);
    let largest = 0;
    for (let i = 0; i < picture.pixels.length; ++i) largest = Math.max(largest, Math.abs(picture.pixels[i] - reopened.pixels[i]));
    assert.equal(largest, 0, "the saved scene gives the same picture");
    again.check();
  } finally {
    await browser.close();
    await program?.stop();
    if (existsSync(folder)) rmSync(folder, {recursive: true});
  }
});

/** A texture shader that ends the renderer if `how` is 2. */
const FAILING_SHADER = `#include <shader.h>
#include <signal.h>
#include <unistd.h>
struct fails { miInteger how; miColor tint; };
DLLEXPORT int fails_version(void) { return 1; }
DLLEXPORT miBoolean fails(miColor* result, miState* state, struct fails* paras) {
  if (*mi_eval_integer(&paras->how) == 2) kill(getpid(), SIGKILL);
  *result = *mi_eval_color(&paras->tint);
  return miTRUE;
}
`;

// acceptance: W6
test("the renderer ends by a signal or by a shader: the page shows it and continues with all edits", {skip: reasonToSkip(), timeout: 600000}, async () => {
  const folder = mkdtempSync(join(tmpdir(), "oriel-studio-")), {file, gloss} = SCENES.room;
  cpSync(join(ROOT, SCENES.room.folder), folder, {recursive: true});
  writeFileSync(join(folder, "fails.c"), FAILING_SHADER);
  const built = spawnSync(ORIEL, ["shader-build", "fails.c", "-o", "fails.so"], {cwd: folder, encoding: "utf8"});
  assert.equal(built.status, 0, built.stderr);
  const declaration = 'link "fails.so"\ndeclare shader color "fails" (integer "how", color "tint") version 1 apply texture end declare\nshader "own" "fails" ("how" 0, "tint" .3 .6 .2)\n';
  const text = readFileSync(join(folder, file), "utf8"), at = text.indexOf("options ");
  assert.ok(at >= 0);
  writeFileSync(join(folder, file), text.slice(0, at) + declaration + text.slice(at));
  const browser = await openBrowser();
  let program = null;
  try {
    program = await startProgram(join(folder, file), "--shader-path", folder);
    const {page} = await open(browser, program);
    const banner = (text) => page.waitForFunction((t) => { const b = document.querySelector(".banner"); return !b.hidden && b.textContent.includes(t); }, {}, text);
    const continues = async (...expected) => {
      await page.waitForFunction(() => document.querySelector(".banner").hidden);
      await page.waitForFunction((list) => JSON.stringify(window.__studio.app.session.state.edits) === list, {}, JSON.stringify(expected));
      await page.waitForFunction(() => window.__studio.app.session.progress?.status !== "crashed" && window.__studio.samples >= 1);
      assert.ok(new Set((await readCanvas(page)).pixels).size > 40);
    };
    await page.evaluate((text) => window.__studio.app.session.edit(text), gloss);
    await page.waitForFunction(() => window.__studio.app.session.state.edits.length === 1);
    const renderer = readFileSync(`/proc/${program.pid}/task/${program.pid}/children`, "utf8").trim().split(" ").map(Number)[0];
    process.kill(renderer, "SIGSEGV");
    await banner("1 edit is kept");
    assert.match(await page.$eval(".banner", (b) => b.textContent), /signal 11/);
    await pressButton(page, ".banner", "Restart from saved edits");
    await continues(gloss);

    // The user's shader is connected; a number in its panel ends the renderer.
    await page.evaluate(() => window.__studio.app.session.edit("oak.diffuse==own"));
    await page.waitForFunction(() => window.__studio.app.session.state.edits.length === 2);
    await page.evaluate(() => window.__studio.app.select("own"));
    await page.waitForFunction(() => document.querySelector("#panel-edit h2").textContent === "own" && document.querySelector(".element-body .field"));
    const input = await (await page.evaluateHandle(() => [...document.querySelectorAll(".element-body .field")].find((f) => f.querySelector("label")?.textContent === "how"))).$("input[type=number]");
    await input.click({clickCount: 3});
    await input.type("2\n");
    await banner("3 edits are kept");
    assert.match(await page.$eval(".banner", (b) => b.textContent), /signal 9/);
    await shot(page, "crashed");
    await pressButton(page, ".banner", "Undo the last edit and restart");
    await continues(gloss, "oak.diffuse==own");
  } finally {
    await browser.close();
    await program?.stop();
    rmSync(folder, {recursive: true});
  }
});
