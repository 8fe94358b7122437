// SPDX-License-Identifier: Apache-2.0
// Sensors of a lux grid on a surface.
import {add, cross, mul, unit} from "./camera_moves.js";

/** @typedef {import("../net/types.js").Triple} Triple */

/**
 * Request of a grid around a picked point: `origin` is the corner, `u` and `v` are the edges.
 * @param {{position: Triple, normal: Triple}} picked
 * @param {number} width @param {number} depth in scene units
 * @param {number} columns @param {number} rows
 */
export function gridOnSurface(picked, width, depth, columns, rows) {
  const normal = unit(picked.normal);
  // The first edge is horizontal where the surface is not.
  /** @type {Triple} */
  const helper = Math.abs(normal[2]) > 0.9 ? [0, 1, 0] : [0, 0, 1];
  const u = unit(cross(helper, normal)), v = cross(normal, u);
  const lift = 1e-3 * Math.max(width, depth);  // keeps sensors off the surface
  const centre = add(picked.position, mul(normal, lift));
  const origin = add(centre, add(mul(u, -width / 2), mul(v, -depth / 2)));
  return {origin, u: mul(u, width), v: mul(v, depth), normal, columns: Math.round(columns), rows: Math.round(rows)};
}
