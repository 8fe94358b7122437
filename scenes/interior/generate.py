#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the geometry of the interior as .mi files, one per piece, beside this script.

    python3 scenes/interior/generate.py

The room spans x 0 to 5.6, y 0 to 4.8, z 0 to 2.75 metres. Its window is in the wall x = 0.
interior.mi (camera, light, options) and materials.mi are written by hand and include these files.
"""
import math
import pathlib
import random

import furniture
from mesh import Mesh, box, number, tube, write_object

HERE = pathlib.Path(__file__).resolve().parent
WIDTH, DEPTH, HEIGHT = 5.6, 4.8, 2.75
WALL = 0.25
FOOT = -0.05  # walls go down past the floor, so that no light creeps in under them
WINDOW = {"y0": 0.4, "y1": 4.45, "z0": 0.1, "z1": 2.5, "columns": 5, "rows": 3}


def room():
    w, shell = WINDOW, Mesh()
    left = [(0, w["y0"], FOOT, HEIGHT), (w["y1"], DEPTH, FOOT, HEIGHT),
            (w["y0"], w["y1"], FOOT, w["z0"]), (w["y0"], w["y1"], w["z1"], HEIGHT)]
    for y0, y1, z0, z1 in left:
        shell.merge(box(-WALL, y0, z0, 0, y1, z1))
    shell.merge(box(-WALL, DEPTH, FOOT, WIDTH + WALL, DEPTH + WALL, HEIGHT),
                box(-WALL, -WALL, FOOT, WIDTH + WALL, 0, HEIGHT),
                box(WIDTH, 0, FOOT, WIDTH + WALL, DEPTH, HEIGHT))
    ceiling = box(-WALL, -WALL, HEIGHT, WIDTH + WALL, DEPTH + WALL, HEIGHT + WALL)
    beams = Mesh().merge(*[box(0, y, HEIGHT - 0.17, WIDTH, y + 0.13, HEIGHT)
                           for y in (0.55, 1.75, 2.95, 4.15)])
    skirting = Mesh().merge(box(0, DEPTH - 0.015, 0, WIDTH, DEPTH, 0.09),
                            box(WIDTH - 0.015, 0, 0, WIDTH, DEPTH - 0.015, 0.09))
    sill = box(-WALL + 0.06, w["y0"], w["z0"], 0.06, w["y1"], w["z0"] + 0.025)
    return [("walls", shell, "white_paint", 0), ("ceiling", ceiling, "white_paint", 0),
            ("beams", beams, "oak_furniture", 0), ("skirting", skirting, "white_gloss", 0),
            ("sill", sill, "white_gloss", 0)]


def floor():
    """Oak planks along y with gaps of 1.5 mm over a dark ground; six tones."""
    dice, planks, gap, wide = random.Random(2), Mesh(), 0.0015, 0.14
    x = 0.0
    while x < WIDTH:
        y = -dice.uniform(0.2, 1.6)
        while y < DEPTH:
            end = y + dice.uniform(1.1, 1.9)
            x0, x1 = x + gap / 2, min(x + wide, WIDTH) - gap / 2
            y0, y1 = max(y, 0) + gap / 2, min(end, DEPTH) - gap / 2
            if y1 > y0:
                planks.add([(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)],
                           f"oak_{dice.randrange(6) + 1}")
            y = end
        x += wide
    ground = box(-WALL, -WALL, -0.3, WIDTH + WALL, DEPTH + WALL, -0.004)
    return [("planks", planks, None, 0), ("ground", ground, "soil", 0)]


def window():
    """Slim steel frames in a grid, one thin-walled sheet of glass in each field."""
    w, bars, panes, x = WINDOW, Mesh(), Mesh(), -0.1
    z0 = w["z0"] + 0.025

    def cuts(first, last, count):
        return [first + (last - first) * k / count for k in range(count + 1)]

    ys, zs = cuts(w["y0"], w["y1"], w["columns"]), cuts(z0, w["z1"], w["rows"])
    for k, y in enumerate(ys):
        half = 0.03 if k in (0, len(ys) - 1) else 0.018
        bars.merge(box(x - 0.025, max(y - half, w["y0"]), z0, x + 0.025, min(y + half, w["y1"]),
                       w["z1"]))
    for k, z in enumerate(zs):
        half = 0.03 if k in (0, len(zs) - 1) else 0.014
        bars.merge(box(x - 0.022, w["y0"], max(z - half, z0), x + 0.022, w["y1"],
                       min(z + half, w["z1"])))
    for a, b in zip(ys, ys[1:]):
        for c, d in zip(zs, zs[1:]):
            panes.add([(x, a, c), (x, a, d), (x, b, d), (x, b, c)])
    handle = tube((x + 0.05, ys[3] - 0.05, 1.0), (x + 0.05, ys[3] - 0.05, 1.12), 0.008)
    return [("bars", bars, "steel_black", 0), ("panes", panes, "window_glass", 0),
            ("handle", handle, "chrome", 40)]


def curtain_rod():
    return [("rod", tube((0.13, 0.1, 2.62), (0.13, 4.72, 2.62), 0.012), "brass", 40)]


def garden():
    """Terrace and a low wall; the hedge of bush.mi stands behind it."""
    terrace = Mesh()
    for i in range(9):
        for j in range(22):
            x, y = -WALL - 0.6 * (i + 1), -4 + 0.6 * j
            terrace.add([(x, y, -0.12), (x + 0.594, y, -0.12), (x + 0.594, y + 0.594, -0.12),
                         (x, y + 0.594, -0.12)])
    bed = box(-8, -5, -0.4, -WALL, 10, -0.125)
    wall = box(-6.0, -5, -0.12, -5.75, 10, 0.35)
    return [("terrace", terrace, "stone", 0), ("bed", bed, "soil", 0),
            ("wall", wall, "white_paint", 0)]


def teapot():
    """The Utah teapot, 17 cm high, from assets/teapot.obj (y up there)."""
    points, mesh = [], Mesh()
    for line in (HERE / "assets/teapot.obj").read_text(encoding="utf-8").splitlines():
        word, *rest = line.split() or [""]
        if word == "v":
            x, y, z = map(float, rest[:3])
            points.append((x, -z, y))
        elif word == "f":
            mesh.add([points[int(index.split("/")[0]) - 1] for index in rest])
    low = min(p[2] for p in points)
    high = max(p[2] for p in points)
    return [("body", mesh.moved(0, 0, -low).scaled(0.17 / (high - low)), "glaze_teal", 60)]


def world_to_local(place):
    """Row-vector matrix of the inverse of: scale, turn about z by degrees, then move."""
    x, y, z, degrees, scale = (*place, 0, 1)[:5] if len(place) == 3 else (*place, 1)[:5]
    c, s = math.cos(math.radians(degrees)) / scale, math.sin(math.radians(degrees)) / scale
    rows = [(c, -s, 0, 0), (s, c, 0, 0), (0, 0, 1 / scale, 0)]
    return rows + [(-(x * c + y * s), -(-x * s + y * c), -z / scale, 1)]


def write_piece(piece, title, parts, places):
    """One file: objects, an instance of each with its material, the group, and its placements."""
    with open(HERE / f"{piece}.mi", "w", encoding="utf-8") as out:
        out.write(f"# SPDX-License-Identifier: Apache-2.0\n# {title}\n"
                  "# Written by generate.py: change it there.\n")
        members = []
        for name, mesh, material, crease in parts:
            element = f"{piece}_{name}"
            out.write("\n")
            write_object(out, element, mesh, crease)
            out.write(f'instance "{element}_inst" "{element}"\n')
            if material:
                out.write(f'  material "{material}"\n')
            out.write("end instance\n")
            members.append(f'"{element}_inst"')
        out.write(f'\ninstgroup "{piece}"\n  ' + "\n  ".join(members) + "\nend instgroup\n")
        for n, place in enumerate(places):
            suffix = f"_{n + 1}" if len(places) > 1 else ""
            matrix = "\n            ".join(" ".join(number(x, 6) for x in row)
                                           for row in world_to_local(place))
            out.write(f'\n# at {", ".join(number(x, 2) for x in place)}\n'
                      f'instance "{piece}{suffix}_inst" "{piece}"\n'
                      f"  transform {matrix}\nend instance\n")


def hedge_places():
    dice = random.Random(9)
    places = []
    for row, (x, z, scale) in enumerate(((-6.7, 0.45, 1.15), (-7.4, 1.15, 1.35))):
        for n in range(15):
            places.append((x + dice.uniform(-0.2, 0.2), -4.6 + 0.95 * n + 0.5 * row,
                           z + dice.uniform(-0.12, 0.18), dice.uniform(0, 360),
                           scale * dice.uniform(0.9, 1.15)))
    # Three trees behind the hedge, each a cloud of bushes.
    for cx, cy, cz, size in ((-9.0, 1.0, 2.9, 1.0), (-11.0, 6.4, 3.6, 1.3), (-9.5, 9.4, 2.6, 0.9)):
        for _ in range(14):
            places.append((cx + dice.gauss(0, 0.6) * size, cy + dice.gauss(0, 0.75) * size,
                           cz + dice.gauss(0, 0.6) * size, dice.uniform(0, 360),
                           dice.uniform(1.0, 1.4)))
    return places


TABLE = (3.05, 2.45)
TABLE_TOP = 0.42

PIECES = [
    ("room", "Walls, ceiling, beams, skirting, sill", room, [(0, 0, 0)]),
    ("floor", "Oak planks", floor, [(0, 0, 0)]),
    ("window", "Steel frames and thin panes", window, [(0, 0, 0)]),
    ("curtain_rod", "Brass rod", curtain_rod, [(0, 0, 0)]),
    ("curtain", "Sheer curtain", furniture.curtain, [(0.13, 4.02, 0.05)]),
    ("garden", "Terrace", garden, [(0, 0, 0)]),
    ("bush", "Hedge and trees", furniture.bush, hedge_places()),
    ("rug", "Rug", furniture.rug, [(2.8, 2.75, 0)]),
    ("sofa", "Sofa", furniture.sofa, [(2.5, 4.2, 0)]),
    ("armchair", "Armchair", furniture.armchair, [(1.25, 2.35, 0, 68)]),
    ("table", "Coffee table with books", furniture.coffee_table, [(*TABLE, 0.012)]),
    ("crockery", "Cups and saucers", furniture.crockery, [(*TABLE, TABLE_TOP + 0.012)]),
    ("teapot", "The Utah teapot", teapot, [(3.04, 2.5, TABLE_TOP + 0.012, 200)]),
    ("bowl", "Brass bowl", furniture.bowl, [(3.5, 2.25, TABLE_TOP + 0.012)]),
    ("glass_ball", "Ball of solid glass", furniture.glass_ball,
     [(3.48, 2.56, TABLE_TOP + 0.012 + 0.078)]),
    ("vase", "Glass vase with olive twigs", furniture.vase, [(2.62, 2.56, TABLE_TOP + 0.012)]),
    ("plant", "Rubber plant", furniture.plant, [(0.6, 3.55, 0, 40)]),
    ("floor_lamp", "Floor lamp", furniture.floor_lamp, [(1.08, 4.42, 0)]),
    ("shelf", "Shelf with books", furniture.shelf, [(4.35, 4.63, 0)]),
    ("pictures", "Three pictures", furniture.pictures, [(2.5, 4.799, 1.55)]),
]


def main():
    for piece, title, parts, places in PIECES:
        write_piece(piece, title, parts(), places)
    names = []
    for piece, _, _, places in PIECES:
        names += [f"{piece}_{n + 1}_inst" for n in range(len(places))] if len(places) > 1 \
            else [f"{piece}_inst"]
    with open(HERE / "pieces.mi", "w", encoding="utf-8") as out:
        out.write("# SPDX-License-Identifier: Apache-2.0\n# Every piece, and the group of all.\n"
                  "# Written by generate.py: change it there.\n\n")
        out.writelines(f'$include "{piece}.mi"\n' for piece, *_ in PIECES)
        out.write('\ninstgroup "furnished_room"\n  ')
        out.write("\n  ".join(f'"{name}"' for name in names) + "\nend instgroup\n")


if __name__ == "__main__":
    main()
