// SPDX-License-Identifier: Apache-2.0
// Focus on the surface below a pixel.
import {axialDepth} from "./camera_moves.js";
import {editText} from "./edit_text.js";
import {RequestError} from "../net/connection.js";

/** Parameters of lens shaders that set the focus; `plane` of mental ray lies at negative depth. */
const FOCUS_PARAMETERS = ["plane", "focus_distance", "focus_plane", "focus"];

/** @param {import("./session.js").Session} session @param {number} x @param {number} y @returns {Promise<{text: string, failed: boolean}>} */
export async function focusAt(session, x, y) {
  try {
    await session.request("focus", {x, y});
    return {text: "The focus is on this surface.", failed: false};
  } catch (error) {
    if (!(error instanceof RequestError) || error.code !== "unknown-type")
      return {text: error instanceof Error ? error.message : String(error), failed: true};
  }
  return focusByParameter(session, x, y);
}

/** For servers without the request `focus`. @param {import("./session.js").Session} session @param {number} x @param {number} y */
async function focusByParameter(session, x, y) {
  const picked = await session.attempt("pick", {x, y});
  if (!picked?.hit || !session.state.look) return {text: "There is no surface below this pixel.", failed: true};
  const instance = session.state.camera;
  const name = session.outline?.cameras.find((c) => c.instance === instance || c.name === instance)?.name ?? instance;
  const camera = await session.attempt("element", {name});
  for (const call of camera?.shaders ?? [])
    for (const p of call.parameters) {
      if (typeof p === "string" || !p.set || !FOCUS_PARAMETERS.includes(p.name)) continue;
      const depth = axialDepth(session.state.look, picked.position);
      await session.edit(editText(p.set, p.name === "plane" ? -depth : depth));
      return {text: `Focus at ${Number(depth.toPrecision(4))}.`, failed: false};
    }
  return {text: "The camera has no lens shader with depth of field.", failed: true};
}
