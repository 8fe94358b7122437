#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes pieces.mi, the geometry of the sheet of templates, beside this script.

    python3 scenes/templates/generate.py

The samples stand on four steps in rows along x, before the sea; the camera of sheet.mi looks along +y. Metres, z up.
"""
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "interior"))
sys.dont_write_bytecode = True
from mesh import Mesh, box, lathe, number, rounded_box, sheet, write_object  # noqa: E402

STEP = 0.16  # from sample to sample along x
BALL = 0.055
PLINTH = 0.012
CENTRE = PLINTH + BALL - PLINTH / 3
PANEL = 0.2
ROWS = {"glass": -0.28, "coat": -0.1, "metal": 0.08, "back": 0.27}  # y
HEIGHTS = {"glass": 0, "coat": 0.085, "metal": 0.17, "back": 0.25}  # of the steps
SEA = -3.5


def ball_profile(radius, centre, count=36):
    """A sphere from below, with a flat foot that stands on the plinth."""
    first = math.acos(1 - PLINTH / 3 / radius)
    angles = [first + (math.pi - first) * k / count for k in range(count + 1)]
    profile = [(radius * math.sin(a), centre - radius * math.cos(a)) for a in angles]
    profile[-1] = (0, centre + radius)
    return [(0, profile[0][1])] + profile


def ball():
    return lathe(ball_profile(BALL, CENTRE), 72)


def hollow_ball():
    """A ball of 30 mm wall: the inner face looks into the hollow."""
    inner = BALL - 0.03
    angles = [math.pi * k / 36 for k in range(37)]
    hollow = [(inner * math.sin(a), CENTRE + inner * math.cos(a)) for a in angles]
    hollow[0], hollow[-1] = (0, CENTRE + inner), (0, CENTRE - inner)
    return ball().merge(lathe(hollow, 72))


def plinth():
    foot = [(0, 0), (0.036, 0), (0.038, 0.002), (0.03, PLINTH - 0.002), (0.028, PLINTH),
            (0, PLINTH)]
    return lathe(foot, 64)


def panel():
    """A board that leans back a little; its front looks along -y."""
    return rounded_box(PANEL * 0.74, 0.012, PANEL, 0.003).turned(-10, "x")


def frame():
    x, z, bar = PANEL * 0.74 / 2, PANEL, 0.007
    bars = Mesh()
    for x0, z0, x1, z1 in ((-x, 0, x, bar), (-x, z - bar, x, z), (-x, bar, -x + bar, z - bar),
                           (x - bar, bar, x, z - bar), (-bar / 3, bar, bar / 3, z - bar)):
        bars.merge(box(x0, -0.004, z0, x1, 0.004, z1))
    return bars


def pane():
    x, z = PANEL * 0.74 / 2 - 0.004, PANEL - 0.004
    return Mesh().add([(-x, 0, 0.004), (x, 0, 0.004), (x, 0, z), (-x, 0, z)])


def cloth():
    """A curtain in folds that hangs from a bar."""
    def surface(u, v):
        fold = 0.008 * math.sin(2 * math.pi * 6 * u) * (1.2 - 0.4 * v)
        return (PANEL * 0.74 * (u - 0.5), fold + 0.004 * math.sin(9 * u), 0.006 + (PANEL - 0.01) * v)
    return sheet(surface, 120, 6)


def shade():
    """An open cylinder of paper with soft pleats."""
    def surface(u, v):
        a, r = 2 * math.pi * u, 0.05 + 0.0015 * math.cos(2 * math.pi * 24 * u)
        return (r * math.cos(a), r * math.sin(a), 0.006 + 0.17 * v)
    return sheet(surface, 240, 4)


def bar():
    return rounded_box(PANEL * 0.8, 0.008, 0.008, 0.002).moved(0, 0, PANEL - 0.006)


def stand():
    """Four steps, one for each row, in front of a pier that ends behind the last."""
    steps = Mesh().merge(box(-20, -20, SEA - 1, 20, ROWS["back"] + 0.3, 0))
    for row, height in HEIGHTS.items():
        if height:
            steps.merge(rounded_box(2 * STEP * 3.4, 0.6, height, 0.004)
                        .moved(0, ROWS[row] - 0.085 + 0.3))
    return steps


def floor():
    return Mesh().add([(-20, -20, 0.0005), (20, -20, 0.0005), (20, 0, 0.0005), (-20, 0, 0.0005)])


def bank(x):
    """How far from the pier the shallow water reaches."""
    return 55 + 0.5 * x + 9 * math.sin(0.11 * x) + 4 * math.sin(0.31 * x + 1)


def shallows():
    edge = [(x, bank(x), SEA) for x in range(-80, 301, 4)]
    return Mesh().merge(*[Mesh().add([(a[0], 0, SEA), (b[0], 0, SEA), b, a])
                          for a, b in zip(edge, edge[1:])])


def deep():
    edge = [(x, bank(x), SEA) for x in range(-80, 301, 4)]
    far = Mesh().merge(*[Mesh().add([a, b, (b[0], 6000, SEA), (a[0], 6000, SEA)])
                         for a, b in zip(edge, edge[1:])])
    return far.add([(-6000, 0, SEA), (-80, 0, SEA), (-80, 6000, SEA), (-6000, 6000, SEA)]) \
        .add([(300, 0, SEA), (6000, 0, SEA), (6000, 6000, SEA), (300, 6000, SEA)])


def blocks():
    """Three blocks side by side, 6, 20 and 60 mm deep."""
    steps = Mesh()
    for k, deep in enumerate((0.006, 0.02, 0.06)):
        x = -0.06 + 0.042 * k
        steps.merge(rounded_box(0.036, deep, 0.09, 0.002).moved(x + 0.018, 0))
    return steps


def bowl_of(radius, steps=10):
    """A quarter circle from the axis up, as (radius, height)."""
    return [(radius * math.sin(a), radius * (1 - math.cos(a)))
            for a in (math.pi / 2 * k / steps for k in range(steps + 1))]


def tumbler():
    """Glass, glass to liquid and liquid to air of a beverage: three surfaces that share rims."""
    wall, floor, level, top = 0.004, 0.012, 0.085, 0.115
    inner = [(0, floor), (0.024, floor), (0.028, floor + 0.002), (0.03, floor + 0.006)]
    at_level = 0.03 + 0.006 * (level - floor) / (top - floor)
    outside = [(0, 0), (0.03, 0), (0.0335, 0.002), (0.0345, 0.006), (0.036 + wall, top - 0.001),
               (0.0375, top + 0.0005), (0.036, top - 0.001), (at_level, level)]
    air_glass = lathe(outside, 96)
    glass_liquid = lathe(inner + [(at_level, level)], 96)
    air_liquid = lathe([(at_level, level), (0, level)], 96)
    return air_glass, glass_liquid, air_liquid


def drop():
    """Water as a lens on the table: a flat dome."""
    profile = [(0, 0.0005), (0.052, 0.0005)]
    profile += [(0.055 * math.cos(a), 0.0035 + 0.03 * math.sin(a))
                for a in (math.pi / 2 * k / 24 for k in range(25))]
    profile[-1] = (0, 0.0335)
    return lathe(profile, 96)


# Texture coordinates: a point of the object and the middle of its polygon to u, v.

def around(p, middle):
    """u along x, v twice around that axis, so that the poles of a ball are at its sides."""
    def turn(q):
        return math.atan2(q[2] - CENTRE, -q[1]) / (2 * math.pi)

    v = turn(p) + round(turn(middle) - turn(p))
    return (p[0] / (math.pi * BALL) + 0.5, 2 * v)


def upright(size):
    return lambda p, middle: (p[0] / size + 0.5, p[2] / size)


def lying(size):
    return lambda p, middle: (p[0] / size + 0.5, p[1] / size + 0.5)


def sea(p, middle):
    """A tile of 30 m, turned so that its rows do not run to the horizon in front of the camera."""
    return ((0.83 * p[0] + 0.56 * p[1]) / 30, (0.83 * p[1] - 0.56 * p[0]) / 30)


SCALE = 10  # objects are written this much larger, so that four digits are a hundredth of a mm

# Name of an object: its mesh, crease angle and texture coordinates.
OBJECTS = {
    "plinth": (plinth(), 40, None),
    "ball": (ball(), 60, around),
    "hollow_ball": (hollow_ball(), 60, None),
    "panel": (panel(), 40, upright(PANEL)),
    "curtain": (cloth(), 60, None),
    "curtain_bar": (bar(), 40, None),
    "shade": (shade(), 60, None),
    "window_frame": (frame(), 0, None),
    "window_pane": (pane(), 0, None),
    "blocks": (blocks(), 40, None),
    "drop": (drop(), 50, None),
    "stand": (stand(), 40, None),
    "floor": (floor(), 0, lying(0.4)),
    "shallows": (shallows(), 0, sea),
    "deep": (deep(), 0, sea),
} | {f"tumbler_{name}": (mesh, 30, None)
     for name, mesh in zip(("air_glass", "glass_liquid", "air_liquid"), tumbler())}


def samples():
    """(object, material, x, y, z) of everything."""
    placed = [("stand", "plaster", 0, 0, 0), ("floor", "template_wood_floor", 0, 0, 0),
              ("shallows", "template_tropical_ocean", 0, 0, 0), ("deep", "template_ocean", 0, 0, 0)]

    def put(row, columns, column, *parts):
        x = STEP * (column - (columns - 1) / 2)
        placed.extend((shape, material, x, ROWS[row], HEIGHTS[row] + 0.001)
                      for shape, material in parts)

    for n, name in enumerate(("brick", "wood_floor", "linoleum")):
        put("back", 6, n, ("panel", f"template_{name}"))
    put("back", 6, 3, ("curtain", "template_curtain"), ("curtain_bar", "dark"))
    put("back", 6, 4, ("shade", "template_paper"))
    put("back", 6, 5, ("window_pane", "template_window_pane"), ("window_frame", "dark"))
    for row, names in (
            ("metal", ("chrome", "silver", "aluminium", "brushed_metal", "gold", "copper")),
            ("coat", ("ceramic", "plastic", "lacquer", "stone", "wood_floor", "brick")),
            ("glass", ("clear_glass", "frosted_glass"))):
        for n, name in enumerate(names):
            put(row, 6, n, ("ball", f"template_{name}"), ("plinth", "dark"))
    put("glass", 6, 2, ("hollow_ball", "template_coloured_glass"), ("plinth", "dark"))
    put("glass", 6, 3, ("blocks", "template_coloured_glass"))
    put("glass", 6, 4, *[(f"tumbler_{name}", f"template_beverage_{name}")
                         for name in ("air_glass", "glass_liquid", "air_liquid")])
    put("glass", 6, 5, ("drop", "template_water"))
    return placed


def main():
    with open(HERE / "pieces.mi", "w", encoding="utf-8") as out:
        out.write("# SPDX-License-Identifier: Apache-2.0\n# The samples, their stand and the sea.\n"
                  "# Written by generate.py: change it there.\n")
        for name, (mesh, crease, uv) in OBJECTS.items():
            out.write("\n")
            in_metres = uv and (lambda p, middle, uv=uv: uv(shrunk(p), shrunk(middle)))
            write_object(out, name, mesh.scaled(SCALE), crease, in_metres)
        members = []
        for n, (name, material, *at) in enumerate(samples(), 1):
            place = " ".join(number(-SCALE * x) for x in at)
            out.write(f'\ninstance "{name}_{n}" "{name}"\n  material "{material}"\n'
                      f"  transform {SCALE} 0 0 0  0 {SCALE} 0 0  0 0 {SCALE} 0  {place} 1\n"
                      "end instance\n")
            members.append(f'"{name}_{n}"')
        out.write('\ninstgroup "samples"\n  ' + "\n  ".join(members) + "\nend instgroup\n")


def shrunk(p):
    return tuple(x / SCALE for x in p)


if __name__ == "__main__":
    main()
