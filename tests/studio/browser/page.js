// SPDX-License-Identifier: Apache-2.0
// A headless Chromium with the page, for tests. Errors of the page and CSP reports fail the test.
import assert from "node:assert/strict";
import {existsSync} from "node:fs";
import puppeteer from "puppeteer-core";

const PATHS = [process.env.ORIEL_CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
export const CHROMIUM = PATHS.find((path) => path && existsSync(path));

/** Longest wait for one condition: machines that test may be slow and run other tests beside. */
export const TIMEOUT_MS = 120000;

export async function openBrowser() {
  return puppeteer.launch({executablePath: CHROMIUM, headless: true, timeout: TIMEOUT_MS, args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]});
}

/**
 * @param {import("puppeteer-core").Browser} browser @param {{url: string, token: string}} server
 * @param {{width?: number, height?: number, scheme?: string, timeout?: number}} [o]
 */
export async function openStudio(browser, server, o = {}) {
  const page = await browser.newPage();
  page.setDefaultTimeout(TIMEOUT_MS);
  // Looking once per frame of the screen would have the whole page drawn again and again, by software.
  const wait = page.waitForFunction.bind(page);
  page.waitForFunction = (condition, options, ...values) => wait(condition, {polling: 40, ...options}, ...values);
  const errors = [];
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("console", (message) => { if (message.type() === "error") errors.push(message.text()); });
  await page.setViewport({width: o.width ?? 1280, height: o.height ?? 800, deviceScaleFactor: 1});
  await page.emulateMediaFeatures([{name: "prefers-color-scheme", value: o.scheme ?? "dark"}, {name: "prefers-reduced-motion", value: "reduce"}]);
  await page.goto(`${server.url}?test#token=${server.token}`);
  await page.waitForFunction(() => window.__studio?.drawnFrame > 0, {timeout: o.timeout ?? TIMEOUT_MS});
  return {page, errors, check: () => assert.deepEqual(errors, [])};
}

/** Waits until the picture has this many samples and is on the screen. */
export async function waitForSamples(page, samples) {
  await page.waitForFunction((n) => window.__studio.samples >= n && window.__studio.drawnFrame === window.__studio.app.session.frames.frame, {}, samples);
}

/** Bytes of the canvas below the picture, RGBA from the top. */
export async function readCanvas(page) {
  const {text, width, height} = await page.evaluate(() => {
    const {pixels, width, height} = window.__studio.readCanvas();
    let text = "";
    for (let i = 0; i < pixels.length; i += 8192) text += String.fromCharCode(...pixels.subarray(i, i + 8192));
    return {text: btoa(text), width, height};
  });
  return {pixels: new Uint8Array(Buffer.from(text, "base64")), width, height};
}
