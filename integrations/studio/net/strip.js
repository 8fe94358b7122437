// SPDX-License-Identifier: Apache-2.0
// Reads binary messages: strips of pixels.

/** @typedef {import("./types.js").Strip} Strip */

export const HEADER_BYTES = 32;
const MAGIC = 0x4c49524f;  // bytes "ORIL"
const VERSION = 1;
const KIND_STRIP = 0;

/** Formats of strips, by their number. */
export const FORMAT = {RGB16F: 0, RGBA16F: 1, R32F: 2};
const CHANNELS = [3, 4, 1];
const BYTES_PER_CHANNEL = [2, 2, 4];

export const FLAG = {LAST: 1, PREVIEW: 2, FIRST: 4};

/**
 * Returns the strip of a message, or null if the message is malformed or of an unknown kind.
 * @param {ArrayBuffer} message
 * @returns {Strip | null}
 */
export function readStrip(message) {
  if (message.byteLength < HEADER_BYTES) return null;
  const view = new DataView(message);
  if (view.getUint32(0, true) !== MAGIC || view.getUint8(4) !== VERSION) return null;
  if (view.getUint8(5) !== KIND_STRIP) return null;
  const format = view.getUint8(6), flags = view.getUint8(7);
  if (format >= CHANNELS.length) return null;
  const width = view.getUint16(20, true), height = view.getUint16(22, true);
  const values = width * height * CHANNELS[format];
  if (message.byteLength !== HEADER_BYTES + values * BYTES_PER_CHANNEL[format]) return null;
  const data = format === FORMAT.R32F ? new Float32Array(message, HEADER_BYTES, values)
                                      : new Uint16Array(message, HEADER_BYTES, values);
  const divider = view.getUint16(14, true);
  if (divider < 1) return null;
  return {
    format, data, width, height, divider,
    last: (flags & FLAG.LAST) !== 0,
    preview: (flags & FLAG.PREVIEW) !== 0,
    epoch: view.getUint32(8, true),
    layer: view.getUint16(12, true),
    x: view.getUint16(16, true),
    y: view.getUint16(18, true),
    samples: view.getUint32(24, true),
    frame: view.getUint32(28, true),
  };
}
