# SPDX-License-Identifier: Apache-2.0
"""Writes small OpenEXR files: half floats, zip compression, nothing but the standard library."""
import struct
import zlib

ROWS_PER_BLOCK = 16  # of the zip compression
HALF = 1


def attribute(name, kind, data):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data


def packed(raw):
    """Bytes of even place before those of odd place, then differences, then deflate."""
    split = raw[0::2] + raw[1::2]
    steps = bytes([split[0]]) + bytes((b - a + 128) & 255 for a, b in zip(split, split[1:]))
    small = zlib.compress(steps, 9)
    return small if len(small) < len(raw) else raw


def write_exr(path, width, height, pixel, names="RGB"):
    """`pixel(x, y)` gives one value per name; y = 0 is the top row."""
    order = sorted(range(len(names)), key=lambda c: names[c])  # files list channels by name
    channels = b"".join(names[c].encode() + b"\0" + struct.pack("<iBxxxii", HALF, 0, 1, 1)
                        for c in order) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = (struct.pack("<ii", 20000630, 2) + attribute("channels", "chlist", channels)
              + attribute("compression", "compression", b"\3")
              + attribute("dataWindow", "box2i", window)
              + attribute("displayWindow", "box2i", window)
              + attribute("lineOrder", "lineOrder", b"\0")
              + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
              + attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
              + attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0")
    blocks = []
    for first in range(0, height, ROWS_PER_BLOCK):
        raw = b""
        for y in range(first, min(first + ROWS_PER_BLOCK, height)):
            row = [pixel(x, y) for x in range(width)]
            for c in order:
                raw += struct.pack(f"<{width}e", *(values[c] for values in row))
        data = packed(raw)
        blocks.append(struct.pack("<ii", first, len(data)) + data)
    at = len(header) + 8 * len(blocks)
    table = b""
    for block in blocks:
        table += struct.pack("<Q", at)
        at += len(block)
    with open(path, "wb") as out:
        out.write(header + table + b"".join(blocks))
