#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the house of the sun and sky pictures as .mi files beside this script.

    python3 scenes/manual/sky/generate.py

Metres, z up; the house's front looks along -y. Materials, light and pictures are written by hand.
"""
import math
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "interior"))

from mesh import (Mesh, box, dot, lathe, rounded_box, sheet, tube,  # noqa: E402
                  write_object)
from place import camera, instance, looking  # noqa: E402

EYE, TARGET = (9.2, -14.8, 1.7), (1.0, 0.0, 2.9)
POOL = (0.6, -9.4, 7.4, -6.2)


def sun(elevation, azimuth):
    """Toward the sun; the azimuth turns from +x to +y, in degrees."""
    e, a = math.radians(elevation), math.radians(azimuth)
    return (math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e))


def along(eye, elevation, azimuth):
    return tuple(e + d for e, d in zip(eye, sun(elevation, azimuth)))


def ground_floor():
    plaster = Mesh().merge(box(-4, 6.2, 0.15, 5.4, 6.5, 3.1), box(-4, 0.4, 0.15, -3.75, 6.2, 3.1),
                           box(5.15, 1.6, 0.15, 5.4, 6.2, 3.1))
    timber = Mesh()
    for k in range(25):
        x = -4 + 0.1 * k
        timber.merge(box(x + 0.006, 0.36, 0.15, x + 0.094, 0.46, 3.1))
    timber.merge(box(-4, 0.42, 0.15, -1.5, 0.56, 3.1))
    for k in range(17):
        z = 0.2 + 0.17 * k
        timber.merge(box(5.38, 1.6, z, 5.42, 6.3, z + 0.155))
    frames, glass = Mesh(), Mesh()
    cuts = [-1.5 + 6.65 * k / 4 for k in range(5)]
    for x in cuts:
        frames.merge(box(x - 0.03, 1.55, 0.15, x + 0.03, 1.65, 3.1))
    frames.merge(box(-1.5, 1.56, 0.15, 5.15, 1.64, 0.21), box(-1.5, 1.56, 2.96, 5.15, 1.64, 3.1))
    glass.add([(-1.5, 1.6, 0.15), (5.15, 1.6, 0.15), (5.15, 1.6, 3.1), (-1.5, 1.6, 3.1)])
    side = box(-1.5, 0.46, 0.15, -1.4, 1.6, 3.1)
    return [("plaster", plaster, "plaster", 0), ("timber", timber.merge(side), "timber", 0),
            ("frames", frames, "frame", 0), ("glass", glass, "glass", 0)]


def upper_floor():
    """A white tube, open to the front, its glazing set back; it reaches out to the right."""
    x0, x1, y0, y1, z0, z1, t = -2.6, 7.6, -0.9, 6.3, 3.1, 6.3, 0.28
    tube_ = Mesh().merge(box(x0, y0, z0, x1, y1, z0 + t), box(x0, y0, z1 - t, x1, y1, z1),
                         box(x0, y0, z0 + t, x0 + t, y1, z1 - t),
                         box(x1 - t, y0, z0 + t, x1, y1, z1 - t),
                         box(x0 + t, y1 - t, z0 + t, x1 - t, y1, z1 - t))
    back, frames, glass = Mesh(), Mesh(), Mesh()
    back.merge(box(x0 + t, 0.5, z0 + t, 0.2, 0.7, z1 - t))
    cuts = [0.2 + (x1 - t - 0.2) * k / 4 for k in range(5)]
    for x in cuts:
        frames.merge(box(x - 0.03, 0.5, z0 + t, x + 0.03, 0.6, z1 - t))
    glass.add([(0.2, 0.55, z0 + t), (x1 - t, 0.55, z0 + t), (x1 - t, 0.55, z1 - t),
               (0.2, 0.55, z1 - t)])
    rail = Mesh().merge(tube((0.2, y0 + 0.1, z0 + 1.15), (x1 - t, y0 + 0.1, z0 + 1.15), 0.02))
    for k in range(30):
        x = 0.3 + k * (x1 - t - 0.4) / 29
        rail.merge(box(x - 0.007, y0 + 0.09, z0 + t, x + 0.007, y0 + 0.104, z0 + 1.15))
    legs = Mesh().merge(*[box(x - 0.06, y - 0.06, 0, x + 0.06, y + 0.06, z0)
                          for x, y in ((7.2, -0.5), (7.2, 5.9))])
    chimney = box(-1.2, 3.2, z1, -0.4, 4.2, z1 + 0.8)
    return [("tube", tube_.merge(chimney), "plaster", 0), ("back", back, "plaster", 0),
            ("frames", frames, "frame", 0), ("glass", glass, "glass", 0),
            ("rail", rail, "frame", 0), ("legs", legs, "frame", 0)]


def inside():
    """What is seen through the glass: floors, a wall, a sofa, curtains."""
    rooms = Mesh().merge(box(-3.7, 0.6, 0.13, 5.1, 6.2, 0.17))
    wall = Mesh().merge(box(-1.3, 4.6, 0.17, 5.1, 4.7, 3.1), box(0.4, 3.4, 3.4, 7.2, 3.5, 6.0))
    sofa = Mesh().merge(rounded_box(2.2, 0.9, 0.42, 0.05, 1).moved(2.2, 3.9, 0.17),
                        rounded_box(2.2, 0.22, 0.85, 0.05, 1).moved(2.2, 4.3, 0.17))
    curtains = Mesh()
    for x in (0.45, 6.9):
        for k in range(9):
            a = x + 0.05 * k
            curtains.add([(a, 0.85 + 0.05 * (k % 2), 3.4), (a + 0.05, 0.9 - 0.05 * (k % 2), 3.4),
                          (a + 0.05, 0.9 - 0.05 * (k % 2), 6.0), (a, 0.85 + 0.05 * (k % 2), 6.0)])
    return [("floor", rooms, "timber", 0), ("wall", wall, "plaster", 0),
            ("sofa", sofa, "cushion", 40), ("curtains", curtains, "plaster", 0)]


def terrace():
    x0, y0, x1, y1 = POOL
    slabs = Mesh()
    for i in range(12):
        for j in range(4):
            x, y = -4.6 + 1.1 * i, -4.4 + 1.2 * j
            slabs.merge(box(x + 0.005, y + 0.005, 0.0, x + 1.095, y + 1.195, 0.15))
    rim = Mesh().merge(box(x0 - 0.5, y0 - 0.5, 0, x1 + 0.5, y0, 0.1),
                       box(x0 - 0.5, y1, 0, x1 + 0.5, y1 + 0.5, 0.1),
                       box(x0 - 0.5, y0, 0, x0, y1, 0.1), box(x1, y0, 0, x1 + 0.5, y1, 0.1))
    path = Mesh().merge(*[rounded_box(1.5, 0.55, 0.06, 0.01, 1).moved(-2.6, -5.0 - 0.8 * k, 0.0)
                          for k in range(7)])
    water = Mesh().add([(x0, y0, 0.05), (x1, y0, 0.05), (x1, y1, 0.05), (x0, y1, 0.05)])
    return [("slabs", slabs, "concrete", 0), ("rim", rim.merge(path), "concrete", 0),
            ("water", water, "water", 0)]


def lounger(x, y, turn):
    wood, cloth = Mesh(), Mesh()
    wood.merge(box(-0.33, -1.0, 0.24, 0.33, 0.35, 0.28),
               *[box(a - 0.025, b - 0.025, 0, a + 0.025, b + 0.025, 0.24)
                 for a in (-0.3, 0.3) for b in (-0.9, 0.8)],
               box(-0.33, 0.35, 0.22, 0.33, 0.95, 0.26))
    cloth.merge(rounded_box(0.62, 1.32, 0.09, 0.03, 1).moved(0, -0.33, 0.28),
                rounded_box(0.62, 0.72, 0.09, 0.03, 1).turned(38, "x").moved(0, 0.6, 0.47))
    return [m.turned(turn).moved(x, y, 0.15) for m in (wood, cloth)]


def pots():
    """Loungers, and pots on the terrace."""
    wood, cloth = Mesh(), Mesh()
    for place in ((4.3, -2.7, 8), (5.7, -2.6, 4)):
        a, b = lounger(*place)
        wood.merge(a)
        cloth.merge(b)
    pot = lathe([(0, 0), (0.24, 0), (0.3, 0.5), (0.3, 0.54), (0.27, 0.54), (0.26, 0.48), (0, 0.48)],
                32)
    return [("wood", wood, "timber", 0), ("cloth", cloth, "cushion", 40),
            ("pots", Mesh().merge(pot.moved(-3.3, -0.4, 0.15), pot.moved(-2.2, -0.5, 0.15)),
             "concrete", 40)]


def land():
    """Round and finite: 70 m about the house."""
    disc = [(70 * math.cos(2 * math.pi * k / 96), 70 * math.sin(2 * math.pi * k / 96), 0)
            for k in range(96)]
    x0, y0, x1, y1 = POOL
    hole = [(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)]
    lawn = Mesh()
    for k in range(96):
        a, b = disc[k], disc[(k + 1) % 96]
        angle = 2 * math.pi * (k + 0.5) / 96
        # Corner of the hole that this part of the rim goes to.
        corner = [2, 3, 0, 1][int(angle / (math.pi / 2))]
        lawn.add([hole[corner], a, b])
    for k, (a, b) in enumerate(zip(hole, hole[1:] + hole[:1])):
        lawn.add([b, a, disc[(72 + 24 * k) % 96]])
    return [("lawn", lawn, "lawn", 0)]


def blades():
    """Grass, 3 x 3 m."""
    dice, mesh = random.Random(2), Mesh()
    for _ in range(1300):
        x, y, turn = dice.uniform(-1.5, 1.5), dice.uniform(-1.5, 1.5), dice.uniform(0, 2 * math.pi)
        high, lean = dice.uniform(0.05, 0.12), dice.uniform(0, 0.05)
        dx, dy = 0.009 * math.cos(turn), 0.009 * math.sin(turn)
        mesh.add([(x - dx, y - dy, 0), (x + dx, y + dy, 0),
                  (x - dy * lean / 0.009, y + dx * lean / 0.009, high)])
    return [("patch", mesh, "grass", 0)]


def leaves():
    """Leaves in a ball of about 1.2 m."""
    dice, mesh = random.Random(5), Mesh()
    while len(mesh.faces) < 420:
        p = [dice.gauss(0, 1) for _ in range(3)]
        r = 0.6 * dice.uniform(0.3, 1) ** 0.4 / math.sqrt(dot(p, p))
        one = Mesh().add([(-0.08, 0, 0), (0, -0.04, 0.01), (0.08, 0, 0), (0, 0.04, 0.01)])
        one = one.turned(dice.uniform(0, 360), "x").turned(dice.uniform(-70, 70), "y")
        mesh.merge(one.turned(dice.uniform(0, 360)).moved(*(r * x for x in p)))
    return [("cloud", mesh, "leaf", 0)]


def crown():
    """Places of leaf clouds in a tree of 7 m, about its foot."""
    dice, places = random.Random(8), []
    while len(places) < 34:
        p = [dice.uniform(-1, 1) for _ in range(3)]
        if 0.25 < dot(p, p) < 1:
            places.append((2.1 * p[0], 2.1 * p[1], 4.9 + 2.0 * p[2], dice.uniform(0, 360),
                           dice.uniform(0.9, 1.4)))
    return places


def wood():
    dice, mesh = random.Random(3), Mesh().merge(tube((0, 0, -0.1), (0.1, 0.05, 3.2), 0.16, 0.1, 10))
    for k in range(9):
        a, z = 2.4 * k, 2.4 + 0.25 * k
        r = dice.uniform(0.8, 1.5)
        tip = (r * math.cos(a), r * math.sin(a), z + 1.5)
        mesh.merge(tube((0.08, 0.04, z), tip, 0.05, 0.02, 8))
    return [("wood", mesh, "bark", 40)]


TREES = ((-7.6, 1.5, 15, 1.1), (-10.5, 9, 80, 1.35), (10.5, 11, 140, 1.3), (3, 14, 200, 1.35),
         (-4, 16, 30, 1.5), (15, 16, 250, 1.5), (-18, 20, 100, 1.6), (-13, -2, 310, 0.9),
         (24, 24, 10, 1.6), (-30, 38, 50, 1.7), (-42, 30, 70, 1.6), (8, 30, 160, 1.7))


def hedge():
    dice, places = random.Random(9), []
    for n in range(26):
        places.append((-22 + 1.05 * n, 11.5 + dice.uniform(-0.2, 0.2),
                       0.55 + dice.uniform(-0.1, 0.2), dice.uniform(0, 360),
                       dice.uniform(1.0, 1.3)))
    for x, y in ((-3.3, -0.4), (-2.2, -0.5)):
        places.append((x, y, 0.95, dice.uniform(0, 360), 0.6))
    return places


def patches():
    places = []
    for i in range(-7, 8):
        for j in range(-9, 1):
            x, y = 3.0 * i, 3.0 * j - 1.5
            hit = POOL[0] - 2 < x < POOL[2] + 2 and POOL[1] - 2 < y < POOL[3] + 2
            if hit or (-6.2 < x < 10.2 and y > -6) or y > -4:
                continue
            places.append((x, y, 0, 90 * ((i * 7 + j * 3) % 4), 1))
    return places


def ridges():
    """A plain, and four ranges of hills behind one another at 0.9 to 9 km to the north (+y)."""
    plain = Mesh().add([(-9000, -300, -0.6), (9000, -300, -0.6), (9000, 9500, -0.6),
                        (-9000, 9500, -0.6)])
    parts, dice = [("plain", plain, "hill", 0)], random.Random(12)
    for n, (far, high) in enumerate(((900, 75), (2200, 200), (4600, 520), (9000, 1350))):
        phases = [dice.uniform(0, 6.28) for _ in range(14)]

        def surface(u, v, far=far, high=high, phases=phases):
            x = far * (-1.3 + 2.6 * u)
            s = sum(math.sin(x / far * 2 ** (k + 1) + 3 * v * k + p) / 1.7 ** k
                    for k, p in enumerate(phases[:7]))
            t = sum(math.sin(5 * v * k + 3.1 * x / far * k + p) / k
                    for k, p in enumerate(phases[7:], 1))
            rise = math.sin(math.pi / 2 * v) ** 1.2
            return (x, far * (1 + 0.25 * v),
                    -0.6 + high * rise * (0.8 + 0.28 * s + 0.12 * t * (1 - v)))

        parts.append((f"{n + 1}", sheet(surface, 90, 8), "hill", 60))
    return parts


def dial():
    card = lathe([(0, -0.05), (1.0, -0.05), (1.0, 0), (0, 0)], 96)
    return [("card", card, "card", 0), ("rod", tube((0, 0, 0), (0, 0, 0.3), 0.018), "rod", 40)]


def placed(out, prefix, element, places, words=""):
    names = []
    for n, (x, y, z, turn, size) in enumerate(places):
        c, s = (f(math.radians(turn)) / size for f in (math.cos, math.sin))
        rows = [(c, -s, 0, 0), (s, c, 0, 0), (0, 0, 1 / size, 0),
                (-(x * c + y * s), -(-x * s + y * c), -z / size, 1)]
        names.append(f"{prefix}_{n + 1}")
        instance(out, names[-1], element, rows, words)
    return names


def group(out, name, members):
    out.write(f'instgroup "{name}"\n  "' + '"\n  "'.join(members) + '"\nend instgroup\n')


def objects(out, makers, instanced=True):
    members = []
    for maker in makers:
        for name, mesh, material, crease in maker():
            element = f"{maker.__name__}_{name}"
            write_object(out, element, mesh, crease)
            if instanced:
                out.write(f'instance "{element}_inst" "{element}" material "{material}" '
                          "end instance\n")
                members.append(f"{element}_inst")
    return members


def opened(name, title):
    out = open(HERE / f"{name}.mi", "w", encoding="utf-8")
    out.write(f"# SPDX-License-Identifier: Apache-2.0\n# {title}; metres, z up.\n"
              "# Written by generate.py: change it there.\n\n")
    return out


def write_trees(out):
    objects(out, (leaves, blades), False)
    parts = objects(out, (wood,))
    group(out, "tree", parts + placed(out, "crown", "leaves_cloud", crown(), ' material "leaf"'))
    names = placed(out, "tree", "tree", [(x, y, 0, a, s) for x, y, a, s in TREES])
    names += placed(out, "hedge", "leaves_cloud", hedge(), ' material "leaf"')
    return names + placed(out, "grass", "blades_patch", patches(), ' material "grass"')


def main():
    with opened("house", "The house with terrace, pool, loungers") as out:
        group(out, "house", objects(out, (ground_floor, upper_floor, inside, terrace, pots)))
    with opened("garden", "Lawn of 70 m around, grass, hedge, trees") as out:
        group(out, "garden", objects(out, (land,)) + write_trees(out))
    with opened("hills", "Four ranges of hills at 0.9, 2.2, 4.6 and 9 km") as out:
        group(out, "hills", objects(out, (ridges,)))
    with opened("dial-objects", "A white disc of 1 m with a rod of 0.3 m") as out:
        group(out, "dial", objects(out, (dial,)))
        instance(out, "dial_camera", "camera", camera((0.35, -2.3, 1.5), (0.35, 0, 0.02)))
    with opened("places", "Where sun and cameras stand") as out:
        out.write("# The sun 35 degrees high, left behind the eye; 11 degrees in the picture.\n")
        instance(out, "sun_inst", "sun", looking(sun(35, 232)))
        instance(out, "low_sun_inst", "sun", looking(sun(11, 163)))
        out.write("# For the card: 60, 30 and 10 degrees high.\n")
        for elevation in (60, 30, 10):
            instance(out, f"sun_{elevation}_inst", "sun", looking(sun(elevation, 205)))
        out.write(f"# From {EYE} to {TARGET}.\n")
        instance(out, "camera_inst", "camera", camera(EYE, TARGET))
        out.write("# Along the land.\n")
        instance(out, "far_inst", "far", camera((16, -24, 1.7), (2, 4, 2.9)))
        out.write("# Toward the low sun.\n")
        instance(out, "west_inst", "west", camera((9, -13, 1.7), (1.0, -7.0, 2.9)))
        instance(out, "disk_inst", "disk", camera((9, -13, 1.7), along((9, -13, 1.7), 10.5, 163)))
        out.write("# From 14 m above, over the house to the hills.\n")
        instance(out, "view_inst", "view", camera((14, -60, 14), (2, 60, 13)))


if __name__ == "__main__":
    main()
