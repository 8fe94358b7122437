// SPDX-License-Identifier: Apache-2.0
// Screenshots of the page with the mock server, for people: node browser/shots.mjs FOLDER
import {mkdirSync} from "node:fs";
import {Mock, startMock} from "../mock/server.js";
import {openBrowser, openStudio, waitForSamples} from "./page.js";

const folder = process.argv[2] ?? "/tmp/studio-shots";
mkdirSync(folder, {recursive: true});
const server = await startMock(new Mock({size: [960, 540]}));
const browser = await openBrowser();
try {
  for (const [width, height, scheme] of [[1280, 800, "dark"], [1920, 1080, "light"], [640, 900, "dark"]]) {
    const {page, errors} = await openStudio(browser, server, {width, height, scheme});
    await waitForSamples(page, 16);
    for (const tab of ["edit", "display", "lights", "daylight", "measure", "compare", "deliver", "messages"]) {
      await page.click(`#tab-${tab}`);
      if (tab === "edit") {
        await page.evaluate(() => window.__studio.app.select("floor"));
        await page.waitForSelector(".element-body .field");
      }
      if (tab === "compare") await page.evaluate(() => [...document.querySelectorAll("#panel-compare button")].find((b) => b.textContent === "Take snapshot").click());
      await new Promise((resolve) => setTimeout(resolve, 250));
      await page.screenshot({path: `${folder}/${width}-${scheme}-${tab}.png`});
    }
    if (errors.length) console.log(errors);
    await page.close();
  }
} finally {
  await browser.close();
  await server.close();
}
