// SPDX-License-Identifier: Apache-2.0
// Sensors of a lux grid on a surface, or on a horizontal plane.
import {add, cross, mul, unit} from "./camera_moves.js";

/** @typedef {import("../net/types.js").Triple} Triple */

/**
 * Request of a grid around a picked point: `origin` is the corner, `u` and `v` are the edges.
 * @param {{position: Triple, normal: Triple}} picked
 * @param {number} width @param {number} depth in scene units
 * @param {number} columns @param {number} rows @param {Triple} up vertical axis of the scene
 */
export function gridOnSurface(picked, width, depth, columns, rows, up = /** @type {Triple} */ ([0, 0, 1])) {
  const lift = 1e-3 * Math.max(width, depth);  // keeps sensors off the surface
  return gridAt(picked.position, unit(picked.normal), lift, width, depth, columns, rows, up);
}

/**
 * Request of a horizontal grid at a height above a picked point.
 * @param {{position: Triple}} picked @param {number} height
 * @param {number} width @param {number} depth in scene units
 * @param {number} columns @param {number} rows @param {Triple} up
 */
export const gridAbove = (picked, height, width, depth, columns, rows, up) =>
    gridAt(picked.position, up, height, width, depth, columns, rows, up);

/** The axis that is vertical for a camera. @param {Triple} up of its look @returns {Triple} */
export const verticalAxis = (up) => Math.abs(up[1]) > Math.abs(up[2]) ? [0, 1, 0] : [0, 0, 1];

/**
 * @param {Triple} position @param {Triple} normal @param {number} lift @param {number} width @param {number} depth
 * @param {number} columns @param {number} rows @param {Triple} up
 */
function gridAt(position, normal, lift, width, depth, columns, rows, up) {
  // The first edge is horizontal where the surface is not.
  const flat = Math.abs(normal[0] * up[0] + normal[1] * up[1] + normal[2] * up[2]) > 0.9;
  /** @type {Triple} */
  const helper = !flat ? up : up[1] ? [0, 0, -1] : [0, 1, 0];
  const u = unit(cross(helper, normal)), v = cross(normal, u);
  const centre = add(position, mul(normal, lift));
  const origin = add(centre, add(mul(u, -width / 2), mul(v, -depth / 2)));
  return {origin, u: mul(u, width), v: mul(v, depth), normal, columns: Math.round(columns), rows: Math.round(rows)};
}
