// SPDX-License-Identifier: Apache-2.0
// Screenshots of docs/studio.md, of the program with the interior:
//     ORIEL=build/release/bin/oriel node browser/program_shots.mjs FOLDER [SAMPLES]
// Works on a copy of the scene. Pictures are denoised.
import {spawn} from "node:child_process";
import {cpSync, mkdirSync, mkdtempSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {createInterface} from "node:readline";
import {fileURLToPath} from "node:url";
import {openBrowser, openStudio} from "./page.js";

const [to = "/tmp/studio-shots", samples = "32"] = process.argv.slice(2);
const ROOT = fileURLToPath(new URL("../../../", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "oriel-studio-"));
mkdirSync(to, {recursive: true});
cpSync(join(ROOT, "scenes/interior"), folder, {recursive: true});
const program = spawn(process.env.ORIEL ?? "oriel", ["studio", join(folder, "interior.mi"), "--page", join(ROOT, "integrations/studio")],
                      {stdio: ["ignore", "pipe", "inherit"], env: {...process.env, XDG_STATE_HOME: folder}});
const line = await new Promise((resolve) => createInterface({input: program.stdout}).once("line", resolve));
const [, url, token] = /^(http:[^#]*)#token=(\w+)$/.exec(line);
const browser = await openBrowser();

/** Waits for the finished picture, denoised; longer than one call of the browser may take. */
async function finished(page) {
  for (let second = 0; second < 1500; ++second) {
    const done = await page.evaluate(() => {
      const {session} = window.__studio.app, p = session.progress;
      return p?.status === "converged" && p.epoch === session.state.epoch && session.frames.epoch === p.epoch &&
             session.frames.names.includes("denoised") && window.__studio.drawnFrame === session.frames.frame;
    });
    if (done) return;
    await new Promise((resolve) => setTimeout(resolve, 1000));
  }
  throw new Error("the picture is not finished");
}

async function clickPicture(page, u, v) {
  const [x, y] = await page.evaluate((a, b) => {
    const {viewport, session} = window.__studio.app, box = viewport.canvas.getBoundingClientRect(), [w, h] = session.state.size;
    const [cx, cy] = viewport.canvasPoint([a * w, b * h]);
    return [box.left + cx, box.top + cy];
  }, u, v);
  await page.mouse.click(x, y);
}

try {
  const {page} = await openStudio(browser, {url, token}, {width: 1440, height: 860, timeout: 300000});
  const app = (body, ...args) => page.evaluate(body, ...args);
  await app((n) => {
    const a = window.__studio.app;
    a.session.view({size: [768, 512], budget: {samples: n, noise: null, seconds: null}});
    a.display.change({layer: "denoised"});
    a.select("oak_1");
  }, Number(samples));
  await page.waitForFunction(() => window.__studio.app.session.state.size[0] === 768, {timeout: 120000});
  await app(() => window.__studio.app.session.edit("oak_1_s.refl_gloss=0.35"));
  await page.waitForFunction(() => window.__studio.app.session.state.edits.length === 1, {timeout: 60000});
  await finished(page);
  await page.screenshot({path: join(to, "material.png")});

  await page.keyboard.press("5");
  await clickPicture(page, 0.5, 0.9);
  await page.waitForFunction(() => document.querySelector("#panel-measure").textContent.includes("Centre:"), {timeout: 60000});
  await app(() => {
    for (const [label, value] of [["Columns", "5"], ["Rows", "4"], ["Time limit", "10"]]) {
      const field = [...document.querySelectorAll("#panel-measure .field")].find((x) => x.querySelector("label")?.textContent === label).querySelector("input[type=number]");
      field.value = value;
      field.dispatchEvent(new Event("change"));
    }
    [...document.querySelectorAll("#panel-measure button")].find((b) => b.textContent.trim() === "Measure grid").click();
  });
  await page.waitForSelector(".lux td", {timeout: 240000});
  await finished(page);
  await page.screenshot({path: join(to, "grid.png")});

  await page.keyboard.press("1");
  await page.click("#tab-daylight");
  await app(() => {
    const slider = [...document.querySelectorAll("#panel-daylight input[type=range]")].find((s) => s.getAttribute("aria-label") === "Hour");
    slider.value = String(1000 * 16.5 / 24);
    slider.dispatchEvent(new Event("input"));
    slider.dispatchEvent(new Event("change"));
  });
  await page.waitForFunction(() => window.__studio.app.session.state.edits.length > 1, {timeout: 60000});
  await finished(page);
  await page.screenshot({path: join(to, "daylight.png")});
} finally {
  await browser.close();
  program.kill("SIGINT");
  rmSync(folder, {recursive: true});
}
