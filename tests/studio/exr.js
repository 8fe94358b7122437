// SPDX-License-Identifier: Apache-2.0
// Writes an uncompressed EXR file of half floats (OpenEXR file layout, scan lines).

/** @param {Uint16Array} rgba halves from the top; alpha is not written @param {number} width @param {number} height */
export function exrFile(rgba, width, height) {
  const text = (s) => Buffer.from(`${s}\0`, "latin1");
  const int = (...v) => { const b = Buffer.alloc(4 * v.length); v.forEach((x, i) => b.writeInt32LE(x, 4 * i)); return b; };
  const float = (...v) => { const b = Buffer.alloc(4 * v.length); v.forEach((x, i) => b.writeFloatLE(x, 4 * i)); return b; };
  const attribute = (name, type, value) => Buffer.concat([text(name), text(type), int(value.length), value]);
  const HALF = 1;
  const channels = Buffer.concat([...["B", "G", "R"].map((c) => Buffer.concat([text(c), int(HALF), Buffer.alloc(4), int(1, 1)])), Buffer.alloc(1)]);
  const box = int(0, 0, width - 1, height - 1);
  const header = Buffer.concat([
    int(20000630, 2), attribute("channels", "chlist", channels), attribute("compression", "compression", Buffer.alloc(1)), attribute("dataWindow", "box2i", box),
    attribute("displayWindow", "box2i", box), attribute("lineOrder", "lineOrder", Buffer.alloc(1)), attribute("pixelAspectRatio", "float", float(1)),
    attribute("screenWindowCenter", "v2f", float(0, 0)), attribute("screenWindowWidth", "float", float(1)), Buffer.alloc(1)]);
  const row = 8 + 6 * width, offsets = Buffer.alloc(8 * height), lines = [];
  for (let y = 0; y < height; ++y) {
    offsets.writeBigUInt64LE(BigInt(header.length + 8 * height + y * row), 8 * y);
    const line = Buffer.alloc(row);
    line.writeInt32LE(y, 0);
    line.writeInt32LE(6 * width, 4);
    for (let x = 0; x < width; ++x)
      for (let k = 0; k < 3; ++k) line.writeUInt16LE(rgba[4 * (y * width + x) + k], 8 + 2 * ((2 - k) * width + x));
    lines.push(line);
  }
  return Buffer.concat([header, offsets, ...lines]);
}
