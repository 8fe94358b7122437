#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the props of the manual's pictures as .mi files beside this script.

    python3 scenes/manual/props/generate.py
    python3 scenes/manual/props/generate.py --camera 0 16 46  0 4 0

The second form prints the `transform` of a camera at the first point that looks at the second;
three numbers alone are the place of a prop, a fourth is its turn about y in degrees.
"""
import math
import sys

import room_picture
from shape import HERE, faces_of, grid, lathe, moved, spline, sweep, write_object
from mesh import Mesh, box, cross, rounded_box, subtract, tube, unit
from place import camera, matrix


STAGE = HERE.parent / "stage"


def cup():
    """A tea cup on a foot ring: outside upwards, over the rim, inside down; and its handle."""
    outside = spline([(2.15, 0.05), (2.45, 0), (2.6, 0.25), (2.55, 0.7), (3.25, 1.35),
                      (3.95, 2.7), (4.2, 4.4), (4.3, 6.0), (4.42, 7.05)], 3)
    rim = [(4.42 - 0.14 + 0.14 * math.cos(a), 7.05 + 0.14 * math.sin(a))
           for a in (math.pi * k / 8 for k in range(1, 8))]
    inside = spline([(4.14, 7.05), (4.02, 6.0), (3.92, 4.4), (3.66, 2.8), (2.9, 1.5),
                     (1.6, 1.08), (0, 1.0)], 3)
    base = [(0, 0.42), (1.2, 0.42), (1.85, 0.38), (2.02, 0.12)]
    # The ends lie within the wall, so that nothing of them shows inside.
    path = spline([(4.05, 0, 5.75), (4.9, 0, 6.1), (5.9, 0, 5.9), (6.45, 0, 5.0),
                   (6.15, 0, 3.9), (5.2, 0, 3.0), (3.9, 0, 2.45)], 5)
    ends = {0: 1.25, 1: 1.15, len(path) - 2: 1.1, len(path) - 1: 1.2}
    handle = sweep(path, lambda n: 0.46 * ends.get(n, 1), lambda n: 0.27 * ends.get(n, 1), 14)
    return [("cup", lathe(base + outside + rim + inside) + handle)]


def bowl_inside(level=None):
    """Profile of the goblet's inside, from the rim down, and where a liquid's surface meets it."""
    points = spline([(3.02, 17.0), (3.42, 15.2), (3.75, 13.2), (3.7, 11.4), (3.1, 9.75),
                     (1.8, 8.65), (0, 8.3)], 4)
    if level is None:
        return points
    for n, ((r0, z0), (r1, z1)) in enumerate(zip(points, points[1:])):
        if z0 > level >= z1:
            t = (z0 - level) / (z0 - z1)
            edge = (r0 + t * (r1 - r0), level)
            return points[:n + 1] + [edge], [edge] + points[n + 1:]
    raise ValueError("no such level")


def goblet_outside():
    foot = [(0, 0.12), (2.6, 0.06), (3.2, 0), (3.42, 0.05), (3.42, 0.18)]
    outside = foot + spline([(3.3, 0.27), (2.0, 0.5), (0.75, 0.95), (0.42, 2.2), (0.4, 4.5),
                             (0.48, 6.6), (0.95, 7.75), (2.1, 8.35), (3.3, 9.45), (3.92, 11.3),
                             (3.96, 13.2), (3.62, 15.2), (3.2, 17.0)], 3)
    rim = [(3.11 + 0.09 * math.cos(a), 17 + 0.09 * math.sin(a))
           for a in (math.pi * k / 6 for k in range(1, 6))]
    return outside + rim


def goblet():
    return [("goblet", lathe(goblet_outside() + bowl_inside()))]


def goblet_filled():
    level = 12.6
    dry, wet = bowl_inside(level)
    surface = [(wet[0][0] * k / 6, level) for k in range(6, -1, -1)]
    gap = [(max(r - 0.03, 0), z + 0.03) for r, z in reversed(wet)]
    gap[-1] = (gap[-1][0], level)
    return [("goblet_air_glass", lathe(goblet_outside() + dry)),
            ("goblet_glass_liquid", lathe(wet[::-1])),
            ("goblet_air_liquid", lathe(surface)),
            ("goblet_drink_apart", lathe(gap + [(gap[-1][0] * k / 6, level)
                                                for k in range(5, -1, -1)]))]


def vase():
    outside = spline([(2.6, 0.0), (2.95, 0.25), (3.7, 2.4), (4.3, 5.4), (3.9, 8.6), (2.6, 11.2),
                      (1.9, 13.0), (2.1, 14.6), (2.75, 15.8)], 4)
    inside = spline([(2.5, 15.85), (1.85, 14.6), (1.62, 13.0), (2.3, 11.1), (3.6, 8.5),
                     (4.0, 5.4), (3.4, 2.5), (2.2, 0.8), (0, 0.6)], 4)
    return [("vase", lathe([(0, 0.02), (1.6, 0.02)] + outside + inside))]


def ball(radius, rows=40, segments=80):
    angles = [math.pi * k / rows for k in range(rows + 1)]
    profile = [(radius * math.sin(a), -radius * math.cos(a)) for a in angles]
    profile[0], profile[-1] = (0, -radius), (0, radius)
    return lathe(profile, segments)


def sphere():
    return [("sphere", moved(ball(5), 0, 0, 5))]


def boxes():
    return [("box", faces_of(box(-5, -5, 0, 5, 5, 10), 1)),
            ("box_round", faces_of(rounded_box(10, 10, 10, 0.5, 4), 60))]


def spot():
    """Spot the cow, 12 cm high, from the CC0 mesh beside this script."""
    points, coordinates, faces = [], [], []
    for line in (HERE / "spot.obj").read_text(encoding="utf-8").splitlines():
        word, *rest = line.split() or [""]
        if word == "v":
            x, y, z = map(float, rest)
            points.append((x, -z, y))
        elif word == "vt":
            coordinates.append(tuple(map(float, rest[:2])))
        elif word == "f":
            faces.append([tuple(int(n) - 1 for n in corner.split("/")) for corner in rest])
    low, high = min(p[2] for p in points), max(p[2] for p in points)
    size = 12 / (high - low)
    points = [(-x * size, -(y + 0.19) * size, (z - low) * size) for x, y, z in points]
    normals = [[0.0, 0.0, 0.0] for _ in points]
    for face in faces:
        a, b, c = (points[v] for v, _ in face)
        n = cross(subtract(b, a), subtract(c, a))
        for v, _ in face:
            normals[v] = [x + y for x, y in zip(normals[v], n)]
    return [("spot", [[(points[v], unit(normals[v]), coordinates[t]) for v, t in face]
                      for face in faces])]


def loft(sections, segments=22):
    """Closed skin over ellipses along -x: (x, middle z, half width, half height)."""
    rows = []
    for x, z, wide, high in sections:
        rows.append([(x, wide * math.cos(a), z - high * math.sin(a))
                     for a in (2 * math.pi * k / segments for k in range(segments))])
    return grid(rows, ring=True)


def canopy(rows=14, columns=26):
    """The front of an ellipsoid, an open sheet; its normals look outwards."""
    def point(i, k):
        a, b = 0.5 * math.pi * 1.02 * i / rows, 2 * math.pi * k / columns
        return (1.2 + 5.2 * math.cos(a), 3.0 * math.sin(a) * math.cos(b),
                5.9 + 3.1 * math.sin(a) * math.sin(b))
    return grid([[point(i, k) for k in range(columns)] for i in range(rows, -1, -1)], ring=True)


def helicopter():
    """A toy of 27 cm: nose towards +x, skids on the ground."""
    body = loft([(1.14, 5.9, 0, 0), (1.14, 5.9, 2.9, 3.0), (1.12, 5.9, 3.0, 3.1),
                 (0.2, 6.0, 3.02, 3.1), (-1.5, 6.3, 2.75, 2.9), (-3.4, 6.8, 2.0, 2.3),
                 (-5.4, 7.3, 1.1, 1.3), (-7.5, 7.6, 0.72, 0.8), (-15.5, 8.2, 0.38, 0.42),
                 (-15.8, 8.2, 0.2, 0.22), (-15.82, 8.2, 0, 0)])
    fin = rounded_box(2.2, 0.3, 3.6, 0.12, 2).turned(-24, "y").moved(-15.4, 0, 7.6)
    wing = rounded_box(1.5, 4.6, 0.22, 0.1, 2).moved(-12.2, 0, 7.85)
    hub = rounded_box(2.4, 2.0, 1.2, 0.4, 3).moved(-0.8, 0, 8.6)
    blades = Mesh()
    for turn in (25, 205):
        blades.merge(rounded_box(12.5, 1.25, 0.16, 0.07, 2).moved(7.0, 0, -0.08)
                     .turned(5, "x").turned(2.0, "y").moved(0, 0, 11.1).turned(turn)
                     .moved(-0.8, 0, 0))
    for turn in (15, 105):
        blades.merge(rounded_box(3.6, 0.1, 0.42, 0.045, 2).moved(0, 0, -0.21).turned(turn, "y")
                     .moved(-15.3, 0.62, 8.9))
    metal = Mesh().merge(tube((-0.8, 0, 9.4), (-0.8, 0, 11.3), 0.24),
                         tube((-0.8, 0, 10.9), (-0.8, 0, 11.35), 0.6),
                         tube((-15.3, 0, 8.9), (-15.3, 0.7, 8.9), 0.14))
    bars = []
    for side in (-1, 1):
        for x in (-2.2, 2.2):
            metal.merge(tube((x, side * 1.6, 3.7), (x, side * 3.1, 0.3), 0.17))
        path = spline([(-5, 0, 0.24), (-2, 0, 0.24), (2, 0, 0.24), (4.6, 0, 0.3), (5.7, 0, 0.8),
                       (6.2, 0, 1.6)], 5)
        bars += moved(sweep(path, lambda n: 0.24, lambda n: 0.24, 12), 0, side * 3.1, 0)
    seats = Mesh()
    for side in (-1, 1):
        seats.merge(rounded_box(1.9, 1.8, 0.7, 0.3).moved(2.6, side * 1.15, 4.0),
                    rounded_box(0.7, 1.8, 2.6, 0.3).turned(-14, "y").moved(1.9, side * 1.15, 4.4))
    seats.merge(rounded_box(0.9, 2.4, 1.5, 0.3).turned(20, "y").moved(4.3, 0, 3.9))
    return [("helicopter_paint", body + faces_of(fin.merge(wing, hub), 50)),
            ("helicopter_glass", canopy()), ("helicopter_blade", faces_of(blades, 50)),
            ("helicopter_steel", faces_of(metal, 50) + bars),
            ("helicopter_seat", faces_of(seats, 50))]


def window():
    """A small frame that stands, with one pane and one curtain, each an open sheet."""
    frame = Mesh().merge(box(-8, -0.5, 0, 8, 0.5, 1), box(-8, -0.5, 19, 8, 0.5, 20),
                         box(-8, -0.5, 1, -7, 0.5, 19), box(7, -0.5, 1, 8, 0.5, 19),
                         box(-9, -1.6, -0.0, 9, 1.6, 0.35))
    pane = grid([[(7 - 14 * k, 0, 1 + 18 * i) for k in (1, 0)] for i in (0, 1)])
    folds = [[(7.4 - 14.8 * k / 96, 0.55 * math.sin(k * 0.62) * (1.15 - 0.3 * i / 12)
               + 0.2 * math.sin(k * 0.23 + 0.1 * i), 0.05 + 19.2 * i / 12)
              for k in range(96, -1, -1)] for i in range(13)]
    return [("window_frame", faces_of(frame, 1)), ("window_pane", pane),
            ("window_curtain", grid(folds))]


PROPS = [
    ("cup", "Tea cup: 7.2 high, 8.8 wide, handle to x = 6.7.", cup),
    ("goblet", "Empty wine glass: 17.1 high, 7.9 wide.", goblet),
    ("goblet_filled", "The interfaces of a wine glass filled to y = 12.6, as the manual has them:\n"
     "# goblet_air_glass (normals out of the glass), goblet_glass_liquid and goblet_air_liquid\n"
     "# (normals out of the liquid). goblet_drink_apart is a closed liquid with a gap of 0.03 to\n"
     "# the glass of goblet.mi.", goblet_filled),
    ("vase", "Vase: 15.9 high, 8.6 wide.", vase),
    ("sphere", "Ball of radius 5 on the ground: its centre is (0, 5, 0).", sphere),
    ("box", "Cube of edge 10 on the ground: box with sharp edges, box_round with radius 0.5.",
     boxes),
    ("spot", "Spot the cow, by Keenan Crane, CC0: 12 high, 6.7 wide, 12.2 long.",
     spot),
    ("helicopter", "Toy helicopter: nose towards +x, 27 long with the rotor, 11.4 high.\n"
     "# Materials to define before: helicopter_paint, _glass (a thin sheet), _blade, _steel,\n"
     "# _seat (stage/toy-paint.mi has them); then instance the instgroup \"helicopter\".",
     helicopter),
    ("window", "Small window: frame 16 wide, 20 high; pane and curtain are open sheets in z = 0.",
     window),
]
GROUPS = {"helicopter"}


def write_prop(name, note, parts):
    with open(HERE / f"{name}.mi", "w", encoding="utf-8") as out:
        out.write(f"# SPDX-License-Identifier: Apache-2.0\n# {note}\n"
                  "# Centimetres, y up, origin on the ground in the middle.\n"
                  "# Written by generate.py: change it there.\n")
        for part, faces in parts:
            write_object(out, f"{part}_part" if name in GROUPS else part, faces)
        if name in GROUPS:
            for part, _ in parts:
                out.write(f'\ninstance "{part}_inst" "{part}_part" material [ "{part}" ]\n'
                          "end instance\n")
            members = " ".join(f'"{part}_inst"' for part, _ in parts)
            out.write(f'\ninstgroup "{name}"\n  {members}\nend instgroup\n')


def place(x, y, z, degrees=0.0, scale=1.0):
    """World to object for a prop that is scaled, turned about y and moved."""
    c, s = math.cos(math.radians(degrees)) / scale, math.sin(math.radians(degrees)) / scale
    return [[c, 0, s, 0], [0, 1 / scale, 0, 0], [-s, 0, c, 0],
            [-(x * c - z * s), -y / scale, -(x * s + z * c), 1]]


def write_backdrop():
    """A wall at z = -150 with a round foot, wide enough for every camera."""
    arc = [(-150 + 60 * (1 - math.sin(a)), -70 + 60 * (1 - math.cos(a)))
           for a in (math.pi / 2 * k / 12 for k in range(12, -1, -1))]
    profile = [(-150, 260)] + arc + [(160, -70)]
    # Written with y up, as built: z of the shapes is height, their y runs backwards.
    rows = [[(x, -z, y) for x in (-400, 400)] for z, y in profile[::-1]]
    with open(STAGE / "backdrop.mi", "w", encoding="utf-8") as out:
        out.write("# SPDX-License-Identifier: Apache-2.0\n# The wall behind the table.\n"
                  "# Written by ../props/generate.py: change it there.\n")
        write_object(out, "studio_backdrop", grid(rows))


def main():
    numbers = [float(word) for word in sys.argv[1:] if word != "--camera"]
    if "--camera" in sys.argv:
        print("  transform " + matrix(camera(tuple(numbers[:3]), tuple(numbers[3:]), (0, 1, 0))))
    elif numbers:
        print("  transform " + matrix(place(*numbers)))
    else:
        for name, note, make in PROPS:
            write_prop(name, note, make())
        write_backdrop()
        room_picture.write(STAGE / "studio.hdr")


if __name__ == "__main__":
    main()
