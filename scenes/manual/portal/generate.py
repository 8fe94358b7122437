#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the room of the portal pictures as .mi files beside this script.

    python3 scenes/manual/portal/generate.py

The room spans x 0 to 4.4, y 0 to 5, z 0 to 2.7 metres; its window is in the wall x = 0 and its
shelves hang on the wall y = 5. Materials, light and stages are written by hand.
"""
import math
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "interior"))

import furniture  # noqa: E402
from mesh import (Mesh, box, cushion, dot, lathe, number, rounded_box, tube,  # noqa: E402
                  write_object)
from place import camera, instance, looking, matrix, to_local  # noqa: E402

WIDTH, DEPTH, HEIGHT, WALL, FOOT = 4.4, 5.0, 2.7, 0.26, -0.05
Y0, Y1, Z0, Z1 = 1.75, 4.05, 0.72, 2.36  # the window's opening
SUN = (-math.cos(math.radians(36)) * math.cos(math.radians(-12)),
       math.cos(math.radians(36)) * math.sin(math.radians(-12)), math.sin(math.radians(36)))
EYE, TARGET = (3.78, 0.3, 1.32), (1.9, 3.9, 1.08)
DETAIL_EYE, DETAIL_TARGET = (1.75, 2.95, 1.42), (2.95, 5.0, 1.5)


def shell():
    walls = Mesh()
    for y0, y1, z0, z1 in ((-WALL, Y0, FOOT, HEIGHT), (Y1, DEPTH, FOOT, HEIGHT),
                           (Y0, Y1, FOOT, Z0), (Y0, Y1, Z1, HEIGHT)):
        walls.merge(box(-WALL, y0, z0, 0, y1, z1))
    walls.merge(box(-WALL, DEPTH, FOOT, WIDTH + WALL, DEPTH + WALL, HEIGHT),
                box(0, -WALL, FOOT, WIDTH + WALL, 0, HEIGHT),
                box(WIDTH, 0, FOOT, WIDTH + WALL, DEPTH, HEIGHT))
    ceiling = box(-WALL, -WALL, HEIGHT, WIDTH + WALL, DEPTH + WALL, HEIGHT + WALL)
    skirting = Mesh().merge(box(0, DEPTH - 0.014, 0, WIDTH, DEPTH, 0.08),
                            box(0, 0, 0, 0.014, DEPTH - 0.014, 0.08),
                            box(WIDTH - 0.014, 0, 0, WIDTH, DEPTH - 0.014, 0.08))
    sill = rounded_box(0.3, Y1 - Y0 + 0.08, 0.03, 0.006, 1).moved(-0.1, (Y0 + Y1) / 2, Z0 - 0.03)
    return [("walls", walls, "wall", 0), ("ceiling", ceiling, "wall", 0),
            ("skirting", skirting, "lacquer", 0), ("sill", sill, "lacquer", 40)]


def floor():
    """Oak planks along y with fine gaps, five tones."""
    dice, planks, gap, wide, x = random.Random(4), Mesh(), 0.0016, 0.155, 0.0
    while x < WIDTH:
        y = -dice.uniform(0.2, 1.6)
        while y < DEPTH:
            end = y + dice.uniform(1.2, 2.1)
            x0, x1 = x + gap / 2, min(x + wide, WIDTH) - gap / 2
            y0, y1 = max(y, 0) + gap / 2, min(end, DEPTH) - gap / 2
            if y1 > y0:
                planks.add([(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)],
                           f"oak_{dice.randrange(5) + 1}")
            y = end
        x += wide
    under = box(-WALL, -WALL, -0.3, WIDTH + WALL, DEPTH + WALL, -0.004)
    return [("planks", planks, None, 0), ("under", under, "under", 0)]


def window():
    """Three casements of dark steel with a transom."""
    bars, x = Mesh(), -0.1
    for k in range(4):
        y, half = Y0 + (Y1 - Y0) * k / 3, 0.032 if k in (0, 3) else 0.022
        bars.merge(box(x - 0.028, max(y - half, Y0), Z0, x + 0.028, min(y + half, Y1), Z1))
    for z, half in ((Z0, 0.032), (Z0 + 1.18, 0.02), (Z1, 0.032)):
        bars.merge(box(x - 0.025, Y0, max(z - half, Z0), x + 0.025, Y1, min(z + half, Z1)))
    return [("bars", bars, "steel", 0)]


def standing_books(x, end, foot, dice, lean=0.0):
    """A row of books from x to end on a board, spines to the room."""
    books = Mesh()
    while x < end:
        thick, tall = dice.uniform(0.016, 0.042), dice.triangular(0.17, 0.29, 0.22)
        one = furniture.book(dice.uniform(0.14, 0.185), tall, thick, dice.choice(furniture.BOOKS))
        one = one.map(lambda p: (p[2], p[0], p[1]))
        books.merge(one.moved(x, 4.865, foot + tall / 2))
        x += thick + 0.0015
    if lean:
        one = furniture.book(0.15, 0.22, 0.025, "book_ochre").map(lambda p: (p[2], p[0], p[1]))
        books.merge(one.moved(0, 0, 0.11).turned(-lean, "y").moved(x + 0.052, 4.865, foot))
    return books


def lying_books(x, foot, covers, turn):
    books = Mesh()
    for k, cover in enumerate(covers):
        one = furniture.book(0.25 - 0.02 * k, 0.18 - 0.012 * k, 0.028, cover)
        books.merge(one.turned(turn * (k - 1)).moved(x, 4.86, foot + 0.028 * k))
    return books


def urn(scale=1.0):
    return lathe([(0, 0), (0.05, 0), (0.083, 0.045), (0.096, 0.1), (0.085, 0.15), (0.05, 0.19),
                  (0.034, 0.215), (0.034, 0.235), (0.043, 0.25), (0.039, 0.25), (0.029, 0.235),
                  (0.029, 0.21), (0, 0.2)], 32).scaled(scale)


def bottle():
    return lathe([(0, 0), (0.04, 0), (0.046, 0.008), (0.046, 0.14), (0.04, 0.17), (0.016, 0.21),
                  (0.016, 0.29), (0.02, 0.293), (0.02, 0.305), (0.013, 0.305), (0.013, 0.21),
                  (0, 0.2)], 28)


def dish(radius, height):
    outer = [(radius * math.sin(a), height * (1 - math.cos(a)))
             for a in (math.pi / 2 * k / 10 for k in range(11))]
    inner = [(radius * 0.96 * math.sin(a), height * (1.03 - 0.97 * math.cos(a)))
             for a in (math.pi / 2 * k / 10 for k in range(10, -1, -1))]
    return lathe(outer + inner[:-1] + [(0, inner[-1][1])], 36)


def ball(radius):
    profile = [(radius * math.sin(math.pi * k / 24), radius * (1 - math.cos(math.pi * k / 24)))
               for k in range(25)]
    profile[0], profile[-1] = (0, 0), (0, 2 * radius)
    return lathe(profile, 32)


BOARDS = ((1.95, 4.15, 1.0), (2.4, 4.15, 1.42), (1.95, 3.55, 1.84))


def shelves():
    dice = random.Random(21)
    oak, thick = Mesh(), 0.036
    for x0, x1, z in BOARDS:
        board = rounded_box(x1 - x0, 0.25, thick, 0.004, 1)
        oak.merge(board.moved((x0 + x1) / 2, 4.875, z - thick))
    a, b, c = (z for _, _, z in BOARDS)
    books = Mesh().merge(standing_books(2.68, 3.2, a, dice, 14), standing_books(3.5, 4.06, b, dice),
                         standing_books(2.05, 2.5, c, dice, 12),
                         lying_books(3.85, a, ("book_blue", "book_cream", "book_red"), 6),
                         lying_books(2.72, b, ("book_grey", "book_ochre"), 9))
    return [("oak", oak, "oak_board", 40), ("books", books, None, 0),
            ("urn", urn(1.05).moved(2.2, 4.87, a), "terracotta", 40),
            ("bottle", bottle().moved(2.46, 4.88, a), "glaze_blue", 40),
            ("ball", ball(0.062).moved(3.5, 4.86, a), "chrome", 60),
            ("bowl", dish(0.13, 0.1).moved(3.18, 4.87, b), "porcelain", 40),
            ("small_urn", urn(0.5).moved(2.72, 4.86, b + 0.056), "glaze_teal", 40),
            ("tall", bottle().scaled(0.9).moved(2.98, 4.89, c), "porcelain", 40),
            ("second", urn(0.8).moved(3.2, 4.87, c), "glaze_teal", 40)]


def sideboard():
    body = rounded_box(2.2, 0.42, 0.4, 0.006, 1).moved(3.05, 4.785, 0.14)
    fronts = Mesh()
    for k in range(4):
        front = rounded_box(0.535, 0.018, 0.368, 0.003, 1)
        fronts.merge(front.moved(2.227 + 0.549 * k, 4.566, 0.156))
    legs = Mesh()
    for x in (2.08, 4.02):
        for y in (4.64, 4.93):
            legs.merge(tube((x, y, 0), (x, y, 0.15), 0.012, 0.016))
    knob = lathe([(0, 0), (0.012, 0), (0.014, 0.006), (0.01, 0.014), (0, 0.015)], 20)
    knobs = Mesh().merge(*[knob.turned(90, "x").moved(x, 4.557, 0.43)
                           for x in (2.44, 2.56, 3.54, 3.66)])
    return [("body", body, "oak_board", 40), ("fronts", fronts, "lacquer", 40),
            ("legs", legs, "steel", 40), ("knobs", knobs, "brass", 40)]


def armchair():
    place = (1.28, 3.55, 0.0)
    parts = []
    for name, mesh, material, crease in furniture.armchair():
        mesh = mesh.turned(38).moved(*place)
        parts.append((name, mesh, "leather" if material == "leather" else "oak_board", crease))
    pillow = cushion(0.42, 0.42, 0.1, 0.05, 0.045).turned(66, "x").moved(0.02, 0.16, 0.47)
    return parts + [("pillow", pillow.turned(38).moved(*place), "wool_ochre", 60)]


def side_table():
    top = lathe([(0, 0), (0.232, 0), (0.24, 0.006), (0.24, 0.018), (0.236, 0.024), (0, 0.024)], 64)
    legs = Mesh()
    for k in range(3):
        a = math.radians(120 * k + 20)
        legs.merge(tube((0.19 * math.cos(a), 0.19 * math.sin(a), 0),
                        (0.1 * math.cos(a), 0.1 * math.sin(a), 0.475), 0.01, 0.013))
    cup = lathe([(0, 0), (0.026, 0), (0.034, 0.012), (0.039, 0.05), (0.04, 0.085), (0.0375, 0.085),
                 (0.0365, 0.05), (0.031, 0.014), (0, 0.01)], 40)
    at, z = (2.02, 3.05), 0.499
    book = furniture.book(0.2, 0.14, 0.024, "book_red").turned(24).moved(at[0] + 0.05,
                                                                     at[1] - 0.09, z)
    return [("top", top.moved(*at, 0.475), "lacquer_dark", 40),
            ("legs", legs.moved(*at), "steel", 40),
            ("cup", cup.moved(at[0] - 0.1, at[1] + 0.05, z), "porcelain", 40),
            ("book", book, None, 0)]


def lamp():
    """Floor lamp behind the chair; its bulb is a light of its own, in lamp.mi."""
    at = (0.62, 4.5)
    stand = Mesh().merge(lathe([(0, 0), (0.14, 0), (0.142, 0.004), (0.14, 0.016), (0.02, 0.02),
                                (0, 0.02)], 48), tube((0, 0, 0.015), (0, 0, 1.43), 0.011))
    shade = lathe([(0.235, 1.36), (0.165, 1.7)], 48)
    return [("stand", stand.moved(*at), "brass", 40), ("shade", shade.moved(*at), "shade", 60)]


def rug():
    mesh = rounded_box(1.9, 1.35, 0.014, 0.006, 2).turned(0).moved(1.62, 3.05, 0.001)
    stripes = Mesh().merge(*[box(x, 2.385, 0.0152, x + w, 3.715, 0.0156)
                             for x, w in ((0.78, 0.05), (0.9, 0.02), (2.29, 0.02), (2.4, 0.05))])
    return [("weave", mesh, "wool_cream", 40), ("stripes", stripes, "rug_grey", 0)]


def twigs():
    """Vase with olive twigs on the sideboard."""
    parts = []
    for name, mesh, material, crease in furniture.vase():
        scaled = mesh.scaled(1.15).moved(3.74, 4.78, 0.542)
        parts.append((name, scaled, "porcelain" if name == "glass" else material, crease))
    return parts


def leaves():
    """Leaves in a ball of about 1.2 m, for the trees outside."""
    dice, mesh = random.Random(5), Mesh()
    while len(mesh.faces) < 420:
        p = [dice.gauss(0, 1) for _ in range(3)]
        r = 0.6 * dice.uniform(0.3, 1) ** 0.4 / math.sqrt(dot(p, p))
        one = Mesh().add([(-0.075, 0, 0), (0, -0.038, 0.01), (0.075, 0, 0), (0, 0.038, 0.01)])
        one = one.turned(dice.uniform(0, 360), "x").turned(dice.uniform(-70, 70), "y")
        mesh.merge(one.turned(dice.uniform(0, 360)).moved(*(r * x for x in p)))
    return [("cloud", mesh, "leaf_tree", 0)]


def garden():
    lawn = Mesh().add([(-60, -60, -0.35), (-WALL, -60, -0.35), (-WALL, 60, -0.35),
                       (-60, 60, -0.35)])
    terrace = box(-3.2, -6, -0.34, -WALL, 10, -0.2)
    trunks = Mesh()
    for x, y, z, _ in TREES:
        trunks.merge(tube((x, y, -0.35), (x + 0.1, y, z), 0.16, 0.09, 10))
    return [("lawn", lawn, "lawn", 0), ("terrace", terrace, "stone", 0),
            ("trunks", trunks, "bark", 40)]


TREES = ((-11.5, 6.2, 2.9, 1.25), (-15.5, 12.5, 3.6, 1.6), (-12.0, 17.5, 3.0, 1.3),
         (-17.0, 4.0, 3.4, 1.5))


def leaf_places():
    dice, places = random.Random(9), []
    for cx, cy, cz, size in TREES:
        for _ in range(15):
            places.append((cx + dice.gauss(0, 0.75) * size, cy + dice.gauss(0, 0.75) * size,
                           cz + dice.gauss(0, 0.6) * size, dice.uniform(0, 360),
                           dice.uniform(1.1, 1.6)))
    for n in range(22):
        places.append((-8.3 + dice.uniform(-0.2, 0.2), -3 + 0.95 * n, 0.1 + dice.uniform(-0.1, 0.2),
                       dice.uniform(0, 360), dice.uniform(0.85, 1.1)))
    return places


def photon_box():
    """The opening in the sun's own space."""
    rows = looking(SUN)
    corners = [(x, y, z) for x in (-WALL, 0) for y in (Y0, Y1) for z in (Z0, Z1)]
    local = [[dot(p, [row[i] for row in rows[:3]]) for i in range(3)] for p in corners]
    return ([min(p[i] for p in local) for i in range(3)],
            [max(p[i] for p in local) for i in range(3)])


def write_places():
    low, high = (" ".join(number(x, 3) for x in p) for p in photon_box())
    middle = (-WALL + 0.03, (Y0 + Y1) / 2, (Z0 + Z1) / 2)
    with open(HERE / "places.mi", "w", encoding="utf-8") as out:
        out.write("# SPDX-License-Identifier: Apache-2.0\n# Where sun and cameras stand.\n"
                  "# Written by generate.py: change it there.\n")
        out.write(f"# The window in the sun's space, to aim photons at: {low}  to  {high}\n")
        instance(out, "sun_inst", "sun", looking(SUN))
        out.write(f"# From {EYE} to {TARGET}.\n")
        instance(out, "camera_inst", "camera", camera(EYE, TARGET))
        out.write(f"# From {DETAIL_EYE} to {DETAIL_TARGET}.\n")
        instance(out, "detail_inst", "detail", camera(DETAIL_EYE, DETAIL_TARGET))
    print(f"portal: rectangle {Y1 - Y0:.2f} x {Z1 - Z0:.2f}, instance at {middle}:")
    print(matrix(to_local((0, 1, 0), (0, 0, 1), (1, 0, 0), middle)))


PIECES = {"shell": ("Walls, ceiling, skirting, sill, planks, window", (shell, floor, window)),
          "shelves": ("Boards with books and pots", (shelves,)),
          "sideboard": ("A sideboard with a vase of twigs", (sideboard, twigs)),
          "furniture": ("Chair, table, lamp, rug", (armchair, side_table, lamp, rug)),
          "garden": ("What the window shows: lawn, terrace and trees", (garden, leaves))}


def write_piece(piece, title, makers):
    members = []
    with open(HERE / f"{piece}.mi", "w", encoding="utf-8") as out:
        out.write(f"# SPDX-License-Identifier: Apache-2.0\n# {title}; metres, z up.\n"
                  "# Written by generate.py: change it there.\n")
        for maker in makers:
            for name, mesh, material, crease in maker():
                element = f"{maker.__name__}_{name}"
                out.write("\n")
                write_object(out, element, mesh, crease)
                if maker is leaves:
                    continue
                words = f' material "{material}"' if material else ""
                out.write(f'instance "{element}_inst" "{element}"{words} end instance\n')
                members.append(f"{element}_inst")
        if leaves in makers:
            members += write_leaves(out)
        out.write(f'\ninstgroup "{piece}"\n  "' + '"\n  "'.join(members) + '"\nend instgroup\n')


def write_leaves(out):
    names = []
    for n, (x, y, z, turn, size) in enumerate(leaf_places()):
        c, s = (f(math.radians(turn)) / size for f in (math.cos, math.sin))
        rows = [(c, -s, 0, 0), (s, c, 0, 0), (0, 0, 1 / size, 0),
                (-(x * c + y * s), -(-x * s + y * c), -z / size, 1)]
        names.append(f"leaves_{n + 1}")
        instance(out, names[-1], "leaves_cloud", rows, ' material "leaf_tree"')
    return names


def main():
    for piece, (title, makers) in PIECES.items():
        write_piece(piece, title, makers)
    write_places()


if __name__ == "__main__":
    main()
