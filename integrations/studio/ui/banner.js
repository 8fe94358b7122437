// SPDX-License-Identifier: Apache-2.0
// Banner above the picture: lost connection, crash of the renderer.
import {button, h} from "./dom.js";

const CLOSED = {4000: "The token of the address is missing or wrong. Open the address that oriel studio printed.",
                4001: "Another window controls this scene now.", 4002: "The server does not understand this page. Reload it."};

/** @param {import("../panels/app.js").App} app */
export function createBanner(app) {
  const text = h("span", {}), actions = h("div", {class: "actions"});
  const banner = h("div", {class: "banner", attributes: {role: "alert"}}, text, actions);
  banner.hidden = true;
  const show = (/** @type {string} */ message, /** @type {HTMLElement[]} */ ...buttons) => {
    text.textContent = message;
    actions.replaceChildren(...buttons);
    banner.hidden = false;
  };
  app.session.on("status", ({status, detail}) => {
    if (status === "open") banner.hidden = true;
    if (status === "waiting")
      show(`No connection to the renderer. Next attempt in ${(Number(detail) / 1000).toFixed(1)} s; edits are kept by the server.`,
           button("Connect now", () => app.session.connection.retryNow()));
    if (status === "closed")
      show(CLOSED[/** @type {4000} */ (Number(detail))] ?? "The connection ended.",
           ...(detail === "4001" ? [button("Take control", () => app.session.start())] : [button("Reload", () => location.reload())]));
  });
  app.session.on("crashed", (crash) => {
    if (!crash) {
      banner.hidden = true;
      return;
    }
    const edits = crash.edits === 1 ? "1 edit is kept" : `${crash.edits} edits are kept`;
    const restart = button("Restart from saved edits", () => void app.session.attempt("restart"), {class: "primary"});
    const without = button("Undo the last edit and restart", async () => {
      if (await app.session.attempt("undo")) await app.session.attempt("restart");
    });
    show(`The renderer ended unexpectedly (${crash.message || "no reason is known"}). ${edits}.`, restart, ...(crash.edits > 0 ? [without] : []));
  });
  return banner;
}
