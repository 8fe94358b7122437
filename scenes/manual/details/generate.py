#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Writes what the scenes of this folder share and nobody writes by hand: temple.mi, tree.png."""
import math
import random
import struct
import zlib
from pathlib import Path

HERE = Path(__file__).resolve().parent


def number(x):
    return f"{round(x, 3) + 0:g}"


class Mesh:
    """Polygons by shared corners, counter-clockwise from outside."""

    def __init__(self):
        self.points, self.faces = {}, []

    def add(self, *corners):
        face = [self.points.setdefault(tuple(round(c, 3) for c in p), len(self.points))
                for p in corners]
        self.faces.append(face)

    def box(self, x0, y0, z0, x1, y1, z1):
        c = [(x, y, z) for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)]
        for a in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2),
                  (1, 3, 7, 5)):
            self.add(*(c[i] for i in a))

    def write(self, name, title):
        lines = ["# SPDX-License-Identifier: Apache-2.0", f"# {title}",
                 "# Written by generate.py: change it there.",
                 f'object "{name}" visible trace shadow', "group"]
        lines += [" ".join(number(c) for c in p) for p in self.points]
        count = len(self.points)
        lines += [" ".join(f"v {i}" for i in range(k, min(k + 16, count)))
                  for k in range(0, count, 16)]
        lines += ["c " + " ".join(map(str, f)) for f in self.faces]
        lines += ["end group", "end object", ""]
        (HERE / f"{name}.mi").write_text("\n".join(lines))


def column(mesh, x, z, y0, y1, radius):
    """A fluted shaft that narrows upwards, with a round cushion and a square plate on top."""
    flutes, steps = 16, 4
    rings = [(y0, 1), (y0 + (y1 - y0) * .5, .94), (y1 - .5, .8)]
    around = [2 * math.pi * k / (flutes * steps) for k in range(flutes * steps)]

    def place(y, scale, k):
        depth = math.sin(math.pi * (k % steps) / steps)
        r = radius * scale * (1 - .12 * depth)
        return (x + r * math.cos(around[k]), y, z - r * math.sin(around[k]))

    for (ya, sa), (yb, sb) in zip(rings, rings[1:]):
        for k in range(len(around)):
            n = (k + 1) % len(around)
            mesh.add(place(ya, sa, k), place(ya, sa, n), place(yb, sb, n), place(yb, sb, k))
    profile = [(y1 - .5, .78), (y1 - .45, .92), (y1 - .3, 1.18), (y1 - .22, 1.2)]
    for (ya, sa), (yb, sb) in zip(profile, profile[1:]):
        for k in range(0, len(around), 2):
            n = (k + 2) % len(around)
            ring = [(x + radius * s * math.cos(around[i]), y, z - radius * s * math.sin(around[i]))
                    for y, s, i in ((ya, sa, k), (ya, sa, n), (yb, sb, n), (yb, sb, k))]
            mesh.add(*ring)
    w = radius * 1.3
    mesh.box(x - w, y1 - .22, z - w, x + w, y1, z + w)


def temple():
    """Four columns wide, six deep, on three steps; metres, y up, the front towards +z."""
    mesh = Mesh()
    for i in range(3):
        w, d, y = 5.6 - .4 * i, 8.2 - .4 * i, .3 * i
        mesh.box(-w, y, -d, w, y + .3, d)
    xs, zs = [-4.05 + 2.7 * i for i in range(4)], [-6.7 + 2.68 * i for i in range(6)]
    for x in xs:
        for z in zs:
            if x in (xs[0], xs[-1]) or z in (zs[0], zs[-1]):
                column(mesh, x, z, .9, 5.6, .48)
    mesh.box(-2.4, .9, -5, 2.4, 5.6, 4)
    mesh.box(-4.7, 5.6, -7.35, 4.7, 6.2, 7.35)
    mesh.box(-4.6, 6.2, -7.25, 4.6, 6.85, 7.25)
    for i in range(14):
        x = -4.42 + .68 * i
        mesh.box(x - .16, 6.22, 7.25, x + .16, 6.83, 7.36)
    for i in range(21):
        z = -7 + .7 * i
        mesh.box(4.6, 6.22, z - .16, 4.72, 6.83, z + .16)
    mesh.box(-5, 6.85, -7.7, 5, 7.1, 7.7)
    roof(mesh)
    mesh.write("temple", "A small temple: metres, y up, on y = 0, 11.2 x 9.4 x 16.4, front to +z")


def roof(mesh):
    """Two slabs with an overhang over a gable that stands back."""
    e, ridge, t = (5.2, 7.1), 9.2, .25
    a, b, c = (-4.9, e[1]), (4.9, e[1]), (0, 8.95)
    mesh.add((*a, 7.2), (*b, 7.2), (*c, 7.2))
    mesh.add((*b, -7.4), (*a, -7.4), (*c, -7.4))
    for s in (1, -1):
        low, high = (s * e[0], e[1]), (0, ridge)
        section = [low, (s * e[0], e[1] + t), (0, ridge + t), high]
        front = [(*p, 7.8) for p in section]
        back = [(*p, -7.8) for p in section]
        if s < 0:
            front, back = front[::-1], back[::-1]
        mesh.add(*front)
        mesh.add(*back[::-1])
        for i in range(4):
            j = (i + 1) % 4
            mesh.add(front[j], front[i], back[i], back[j])


def write_png(name, width, height, pixels):
    """`pixels` are rows from above of (r, g, b[, a]) bytes."""
    channels = len(pixels[0][0])
    raw = b"".join(b"\0" + bytes(c for p in row for c in p) for row in pixels)

    def chunk(kind, data):
        check = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)

    header = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    (HERE / name).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                              + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


class Canvas:
    """A picture that shapes are drawn into with soft edges; origin at the lower left."""

    def __init__(self, size, ground):
        self.size = size
        self.rows = [[(*ground, 0)] * size for _ in range(size)]

    def blob(self, x, y, r, colour, squash=1, turn=0):
        c, s = math.cos(turn), math.sin(turn)
        for j in range(max(0, int(y - r - 1)), min(self.size, int(y + r + 2))):
            for i in range(max(0, int(x - r - 1)), min(self.size, int(x + r + 2))):
                u, v = i + .5 - x, j + .5 - y
                u, v = c * u + s * v, (c * v - s * u) / squash
                cover = min(1, max(0, r - math.hypot(u, v) + .5))
                if cover > 0:
                    self.put(i, j, colour, cover)

    def put(self, i, j, colour, cover):
        old = self.rows[j][i]
        mixed = tuple(round(o + (c - o) * cover) for o, c in zip(old[:3], colour))
        self.rows[j][i] = (*mixed, round(255 * (1 - (1 - old[3] / 255) * (1 - cover))))

    def stroke(self, a, b, width_a, width_b, colour):
        steps = int(math.dist(a, b)) + 1
        for k in range(steps + 1):
            t = k / steps
            shade = tuple(round(c * (.85 + .3 * t)) for c in colour)
            self.blob(a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t,
                      (width_a + (width_b - width_a) * t) / 2, shade)


def branch(canvas, rng, at, angle, length, width, tips):
    """A branch, and those that grow from it; `tips` collects where leaves go."""
    end = (at[0] + length * math.sin(angle), at[1] + length * math.cos(angle))
    canvas.stroke(at, end, width, width * .65, (92, 70, 52))
    if length < 16:
        tips.append(end)
        return
    if length < 34:
        tips.append(((at[0] + end[0]) / 2, (at[1] + end[1]) / 2))
    for side in (-1, 0, 1) if length > 36 else (-1, 1):
        turn = side * rng.uniform(.35, .75) + rng.uniform(-.12, .12)
        branch(canvas, rng, end, angle * .9 + turn, length * rng.uniform(.62, .8),
               width * .62, tips)


def tree():
    """A broad-leaved tree with gaps between its leaves; alpha is the tree, colours are linear."""
    rng, canvas, tips = random.Random(11), Canvas(320, (70, 92, 38)), []
    branch(canvas, rng, (160, 0), .02, 72, 16, tips)
    leaves = [(x + rng.gauss(0, 12), y + rng.gauss(0, 10)) for x, y in tips for _ in range(19)]
    middle = sum(y for _, y in leaves) / len(leaves)
    rng.shuffle(leaves)
    for k, (x, y) in enumerate(leaves):
        light = .62 + .25 * (y - middle) / 90 + .12 * (160 - x) / 120 + .3 * k / len(leaves)
        light *= rng.uniform(.85, 1.12)
        colour = tuple(max(0, min(255, round(c * light))) for c in (112, 146, 52))
        canvas.blob(x, y, rng.uniform(2.6, 4.6), colour, .55, rng.uniform(0, math.pi))
    rows = [[(*(round(255 * (c / 255) ** 2.2) for c in p[:3]), p[3]) for p in row]
            for row in canvas.rows[::-1]]
    write_png("tree.png", canvas.size, canvas.size, rows)


temple()
tree()
