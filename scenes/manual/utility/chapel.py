#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes chapel.hdr: a stone hall with windows and many small lamps, as a latitude-longitude
picture that is hard on glossy reflections.

    python3 scenes/manual/utility/chapel.py
"""
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "props"))
sys.dont_write_bytecode = True
import room_picture  # noqa: E402

# Metres; x across, y up, z along. The picture is taken from the origin.
HALF_WIDE, HALF_LONG, FLOOR, SPRING = 6.0, 13.0, -1.7, 6.0
LAMPS = [(math.cos(a) * 1.6, 3.1, z + math.sin(a) * 1.6)
         for z in (-5.5, 5.5) for a in (math.pi / 6 * k for k in range(12))]
LAMPS += [(s * 5.6, 0.9 + 0.5 * (k % 2), -11 + 4.4 * k) for s in (-1, 1) for k in range(6)]
LAMPS += [(-1.6 + 0.4 * k, 0.4 + 0.25 * (k % 3), -11.5) for k in range(9)]
FLAME, GLOW = (300.0, 190.0, 80.0), (0.9, 0.5, 0.18)


def colour(direction):
    base = surface(direction)
    for lamp in LAMPS:
        far = math.sqrt(sum(x * x for x in lamp))
        angle = math.acos(max(-1.0, min(1.0, sum(a * b for a, b in zip(lamp, direction)) / far)))
        size = 0.075 / far
        if angle < 12 * size:
            share = min(1.0, max(0.0, (size - angle) / 0.004 + 0.5))
            halo = max(0.0, 1 - angle / (12 * size)) ** 3
            base = [b * (1 - share) + f * share + g * halo
                    for b, f, g in zip(base, FLAME, GLOW)]
    return base


def surface(direction):
    """What a ray from the origin meets first: floor, side wall, end wall or the round vault."""
    x, y, z = direction
    tx = HALF_WIDE / abs(x) if x else 1e9
    tz = HALF_LONG / abs(z) if z else 1e9
    tf = FLOOR / y if y < 0 else 1e9
    tv = vault(x, y)
    t = min(tx, tz, tf, tv)
    p = (x * t, y * t, z * t)
    if t == tf:
        return floor(p)
    if t == tz:
        return end_wall(p, z)
    if t == tv and p[1] > SPRING:
        return ceiling(p)
    return side_wall(p, x)


def vault(x, y):
    """Distance to the half round barrel above the walls."""
    a, b, c = x * x + y * y, -2 * SPRING * y, SPRING ** 2 - HALF_WIDE ** 2
    root = b * b - 4 * a * c
    t = (-b + math.sqrt(root)) / (2 * a) if root >= 0 and a else 1e9
    return t if t * y > SPRING else 1e9


def stones(u, v, size=0.55):
    """Courses of blocks: darker joints, and a tone of its own for each."""
    row = math.floor(v / size)
    u += size * (row % 2)
    column = math.floor(u / (2 * size))
    joint = min(v / size - row, (u / (2 * size) - column) * 2)
    tone = 0.85 + 0.3 * ((math.sin(row * 12.9898 + column * 78.233) * 43758.5453) % 1)
    return tone * (0.55 if joint < 0.07 else 1.0)


def pointed(u, v, wide, low, high):
    """Inside of a pointed arch of this half width, 0 or 1."""
    if v < low or abs(u) > wide:
        return 0
    return 1 if v < high or (abs(u) + wide) ** 2 + (v - high) ** 2 < 4 * wide * wide else 0


def side_wall(p, side):
    u, v = p[2], p[1]
    near = (u + 13) % 5.2 - 2.6
    if pointed(near, v, 0.8, 0.6, 4.4):
        if abs(near) < 0.06 or (v - 0.6) % 1.3 < 0.09:
            return (0.03, 0.03, 0.03)
        bright = 26 if side > 0 else 7
        tint = ((1, 0.92, 0.75), (0.8, 0.9, 1), (1, 0.8, 0.6))[int((v - 0.6) // 1.3) % 3]
        return [bright * c for c in tint]
    if pointed(near, v, 1.05, 0.3, 4.4):
        return (0.5, 0.45, 0.36)
    light = (0.11 if side > 0 else 0.3) * (0.65 + 0.35 * math.cos(u * 2 * math.pi / 5.2))
    column = 1.5 if abs(abs(near) - 2.6) < 0.45 else 1.0
    return [light * column * stones(u, v) * c for c in (1, 0.87, 0.68)]


def end_wall(p, z):
    u, v = p[0], p[1]
    ring = math.hypot(u, v - 7.2)
    if z < 0 and ring < 2.4:
        spoke = (math.atan2(v - 7.2, u) * 6 / math.pi) % 1
        if ring > 0.7 and (spoke < 0.12 or abs(ring - 1.6) < 0.08):
            return (0.03, 0.03, 0.03)
        tint = ((1, 0.35, 0.2), (0.3, 0.5, 1), (1, 0.85, 0.4))[int(ring / 0.82) % 3]
        return [14 * c for c in tint]
    if z > 0 and pointed(u, v, 1.5, FLOOR, 2.2):
        return (0.07, 0.035, 0.015)
    if z < 0 and abs(u) < 2.2 and v < 0.2:
        return (0.55, 0.5, 0.42)
    return [0.2 * stones(u, v) * c for c in (1, 0.87, 0.68)]


def ceiling(p):
    rib = abs((p[2] + 13 + 2.6) % 5.2 - 2.6)
    light = 0.16 if rib > 0.3 else 0.3
    return [light * (1.0 + 0.06 * p[0]) * c for c in (1, 0.9, 0.74)]


def floor(p):
    light = (math.floor(p[0] / 1.1) + math.floor(p[2] / 1.1)) % 2
    beam = max(0.0, 1 - abs((p[2] + 13) % 5.2 - 2.6) / 0.9)
    shine = 2.2 * beam * max(0.0, 1 - abs(p[0] + 2.4) / 1.8)
    base = (0.26, 0.23, 0.18) if light else (0.06, 0.045, 0.04)
    return [b * (1 + shine * 3) for b in base]


def mean_colour(azimuth, height):
    """Four looks into a pixel; degrees."""
    total = [0.0, 0.0, 0.0]
    for n in range(4):
        a = math.radians(azimuth + (n % 2 - 0.5) * 180 / room_picture.WIDTH)
        h = math.radians(height + (n // 2 - 0.5) * 180 / room_picture.WIDTH)
        c = colour((math.cos(h) * math.sin(a), math.sin(h), -math.cos(h) * math.cos(a)))
        total = [t + x / 4 for t, x in zip(total, c)]
    return total


if __name__ == "__main__":
    room_picture.WIDTH, room_picture.HEIGHT = 768, 384
    room_picture.studio = mean_colour
    room_picture.write(HERE / "chapel.hdr")
