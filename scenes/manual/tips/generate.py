#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Writes what nobody writes by hand: grooves.mi, streaks.png, waves.png. Pictures are linear."""
import math
import random
import struct
import zlib
from pathlib import Path

HERE = Path(__file__).resolve().parent


def write_grey(name, rows):
    """`rows` from above, of values 0 ... 1."""
    raw = b"".join(b"\0" + bytes(round(255 * min(1, max(0, v))) for v in row) for row in rows)

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))

    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    (HERE / name).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                              + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def streaks(size=192):
    """Noise that is stretched along u, from middle grey to white, and repeats."""
    rng = random.Random(5)
    rows = []
    for _ in range(size):
        level, row = rng.uniform(.5, 1), []
        knots = [level + rng.gauss(0, .1) for _ in range(6)]
        for i in range(size):
            k, t = divmod(i / size * 6, 1)
            t = t * t * (3 - 2 * t)
            row.append(min(1, max(.5, knots[int(k)] * (1 - t) + knots[(int(k) + 1) % 6] * t)))
        rows.append(row)
    write_grey("streaks.png", rows)


def waves(size=256):
    """Heights of water: waves of many lengths around one direction, which repeat."""
    rng = random.Random(3)
    parts = []
    for _ in range(46):
        length = rng.uniform(2, 16)
        angle = rng.gauss(.5, .65)
        u, v = round(length * math.sin(angle)), round(length * math.cos(angle))
        if u or v:
            parts.append((u, v, rng.uniform(0, 2 * math.pi), 1 / math.hypot(u, v) ** 1.15))
    rows = [[sum(a * math.sin(2 * math.pi * (u * i + v * j) / size + p) for u, v, p, a in parts)
             for i in range(size)] for j in range(size)]
    low, high = min(map(min, rows)), max(map(max, rows))
    write_grey("waves.png", [[((h - low) / (high - low)) ** 1.3 for h in row] for row in rows])


def grooves(count=70, steps=10):
    """Half cylinders side by side along z, each a strip with smooth normals; centimetres, y up."""
    radius = 14 / count
    lines = ["# SPDX-License-Identifier: Apache-2.0",
             f"# {count} thin cylinders side by side: 28 x 28 on y = 0, along z.",
             "# Written by generate.py: change it there.",
             'object "grooves" visible trace shadow', "group"]
    arc = [math.pi * (k + .5) / (steps + 1) for k in range(steps + 1)]
    faces, vertices = [], []
    for n in range(count):
        x = -14 + radius * (2 * n + 1)
        for a in arc:
            c, s = math.cos(a), math.sin(a)
            base = 3 * len(vertices) // 2
            lines.append(f"{x - radius * c:.4f} {radius * s:.4f} 14  "
                         f"{x - radius * c:.4f} {radius * s:.4f} -14  {-c:.4f} {s:.4f} 0")
            vertices += [f"v {base} n {base + 2}", f"v {base + 1} n {base + 2}"]
        first = 2 * n * (steps + 1)
        faces += [f"c {i} {i + 2} {i + 3} {i + 1}" for i in
                  range(first, first + 2 * steps, 2)]
    lines += [" ".join(vertices[k:k + 8]) for k in range(0, len(vertices), 8)]
    lines += [" ".join(faces[k:k + 8]) for k in range(0, len(faces), 8)]
    lines += ["end group", "end object", ""]
    (HERE / "grooves.mi").write_text("\n".join(lines))


streaks()
waves()
grooves()
