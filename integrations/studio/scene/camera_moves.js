// SPDX-License-Identifier: Apache-2.0
// Moves of the camera: orbit, pan, dolly, walk, turn. World space; angles in radians.

/** @typedef {import("../net/types.js").Look} Look */
/** @typedef {import("../net/types.js").Triple} Triple */

/** @param {Triple} a @param {Triple} b @returns {Triple} */
export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
/** @param {Triple} a @param {Triple} b @returns {Triple} */
export const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
/** @param {Triple} a @param {number} k @returns {Triple} */
export const mul = (a, k) => [a[0] * k, a[1] * k, a[2] * k];
/** @param {Triple} a @param {Triple} b */
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
/** @param {Triple} a @param {Triple} b @returns {Triple} */
export const cross = (a, b) =>
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
/** @param {Triple} a */
export const length = (a) => Math.hypot(a[0], a[1], a[2]);
/** @param {Triple} a @returns {Triple} */
export const unit = (a) => {
  const l = length(a);
  return l > 0 ? mul(a, 1 / l) : [0, 0, 1];
};

/** Rotates about an axis of unit length (Rodrigues). @param {Triple} v @param {Triple} axis @param {number} angle @returns {Triple} */
export function rotate(v, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return add(add(mul(v, c), mul(cross(axis, v), s)), mul(axis, dot(axis, v) * (1 - c)));
}

/** Frame of a camera. @param {Look} look */
export function frameOf(look) {
  const forward = unit(sub(look.to, look.from));
  let right = cross(forward, look.up);
  if (length(right) < 1e-6) right = cross(forward, Math.abs(forward[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0]);
  right = unit(right);
  return {forward, right, up: cross(right, forward)};
}

const NEAREST_POLE = 0.02;  // radians between the line of sight and the up axis

/** Limits a tilt so that the line of sight keeps its distance to the axis. @param {Triple} direction @param {Triple} axis @param {number} tilt */
function limitedTilt(direction, axis, tilt) {
  const elevation = Math.asin(Math.max(-1, Math.min(1, dot(unit(direction), axis))));
  const most = Math.PI / 2 - NEAREST_POLE;
  return Math.max(-most, Math.min(most, elevation + tilt)) - elevation;
}

/** Rotates the camera about the point that it looks at. @param {Look} look @param {number} around @param {number} over @returns {Look} */
export function orbit(look, around, over) {
  const axis = unit(look.up), {right} = frameOf(look);
  const direction = sub(look.to, look.from);
  const tilted = rotate(direction, right, limitedTilt(direction, axis, over));
  return {...look, from: sub(look.to, rotate(tilted, axis, around))};
}

/** Rotates the line of sight about the camera. @param {Look} look @param {number} around @param {number} over @returns {Look} */
export function turn(look, around, over) {
  const axis = unit(look.up), {right} = frameOf(look);
  const direction = sub(look.to, look.from);
  const tilted = rotate(direction, right, limitedTilt(direction, axis, over));
  return {...look, to: add(look.from, rotate(tilted, axis, around))};
}

/** Moves camera and target parallel to the picture, by shares of the distance. @param {Look} look @param {number} right @param {number} up @returns {Look} */
export function pan(look, right, up) {
  const frame = frameOf(look), distance = length(sub(look.to, look.from));
  const by = add(mul(frame.right, right * distance), mul(frame.up, up * distance));
  return {...look, from: add(look.from, by), to: add(look.to, by)};
}

/** Multiplies the distance to the target. @param {Look} look @param {number} factor @returns {Look} */
export function dolly(look, factor) {
  return {...look, from: add(look.to, mul(sub(look.from, look.to), Math.max(factor, 1e-3)))};
}

/** Moves camera and target forward, to the right and upward, in scene units. @param {Look} look @param {number} ahead @param {number} right @param {number} up @returns {Look} */
export function walk(look, ahead, right, up) {
  const frame = frameOf(look), axis = unit(look.up);
  const level = unit(sub(frame.forward, mul(axis, dot(frame.forward, axis))));
  const by = add(add(mul(level, ahead), mul(frame.right, right)), mul(axis, up));
  return {...look, from: add(look.from, by), to: add(look.to, by)};
}

/**
 * Pixel of a point, or null behind the camera. Lens shift and distortion are not included.
 * @param {Triple} point @param {Look} look @param {number} fovDeg horizontal
 * @param {[number, number]} size of the picture
 * @returns {[number, number] | null}
 */
export function project(point, look, fovDeg, size) {
  const frame = frameOf(look), p = sub(point, look.from);
  const depth = dot(p, frame.forward);
  if (depth <= 1e-9) return null;
  const scale = size[0] / 2 / Math.tan(fovDeg * Math.PI / 360);
  return [size[0] / 2 + scale * dot(p, frame.right) / depth, size[1] / 2 - scale * dot(p, frame.up) / depth];
}

/** Depth along the axis of a surface at a distance from the camera. @param {Look} look @param {Triple} position */
export const axialDepth = (look, position) => dot(sub(position, look.from), frameOf(look).forward);
