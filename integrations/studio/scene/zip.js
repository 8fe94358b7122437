// SPDX-License-Identifier: Apache-2.0
// A ZIP file without compression, for PNG frames (APPNOTE 6.3.10, sections 4.3.7 to 4.3.16).

const TABLE = Uint32Array.from({length: 256}, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n >>> 0;
});

/** @param {Uint8Array} bytes */
export function crc32(bytes) {
  let c = 0xffffffff;
  for (const b of bytes) c = TABLE[(c ^ b) & 255] ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}

const DOS_DATE = 0x21;  // 1980-01-01; equal frames give equal files

/** @param {{name: string, bytes: Uint8Array}[]} files names in ASCII @returns {Uint8Array} */
export function zipStored(files) {
  const encoder = new TextEncoder();
  /** @type {Uint8Array[]} */ const parts = [];
  /** @type {Uint8Array[]} */ const directory = [];
  let offset = 0;
  const add = (/** @type {Uint8Array} */ part) => {
    parts.push(part);
    offset += part.length;
  };
  for (const {name, bytes} of files) {
    const path = encoder.encode(name), common = new DataView(new ArrayBuffer(26));
    common.setUint16(0, 20, true);
    common.setUint16(8, DOS_DATE, true);
    common.setUint32(10, crc32(bytes), true);
    common.setUint32(14, bytes.length, true);
    common.setUint32(18, bytes.length, true);
    common.setUint16(22, path.length, true);
    const shared = new Uint8Array(common.buffer), start = offset;
    add(Uint8Array.of(0x50, 0x4b, 3, 4));
    add(shared);
    add(path);
    add(bytes);
    const entry = new DataView(new ArrayBuffer(14));
    entry.setUint32(10, start, true);
    directory.push(Uint8Array.of(0x50, 0x4b, 1, 2, 20, 0), shared, new Uint8Array(entry.buffer), path);
  }
  const start = offset;
  directory.forEach(add);
  const end = new DataView(new ArrayBuffer(22));
  end.setUint32(0, 0x06054b50, true);
  end.setUint16(8, files.length, true);
  end.setUint16(10, files.length, true);
  end.setUint32(12, offset - start, true);
  end.setUint32(16, start, true);
  add(new Uint8Array(end.buffer));
  const out = new Uint8Array(offset);
  let at = 0;
  for (const part of parts) {
    out.set(part, at);
    at += part.length;
  }
  return out;
}
