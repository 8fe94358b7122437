#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the shapes that only the figures of the utility shaders need, as .mi files beside it.

    python3 scenes/manual/utility/generate.py
"""
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "props"))
sys.dont_write_bytecode = True
from shape import faces_of, spline, sweep, write_object  # noqa: E402
from mesh import Mesh, box, tube  # noqa: E402


def radio():
    """A portable radio of boxes and round bars, all with sharp edges: its front looks to -y."""
    case = box(-11, -3.2, 0.8, 11, 3.2, 15)
    feet = Mesh().merge(*[box(x - 1.1, -2.6, 0, x + 1.1, 2.6, 0.9) for x in (-8, 8)])
    handle = Mesh().merge(box(-9.6, -0.8, 14.9, -8.4, 0.8, 18.2),
                          box(8.4, -0.8, 14.9, 9.6, 0.8, 18.2),
                          box(-9.6, -0.9, 18.2, 9.6, 0.9, 19.3))
    grille = Mesh().merge(*[box(-9.8, -3.75, 2.2 + 1.13 * k, 0.4, -3.1, 2.85 + 1.13 * k)
                            for k in range(10)])
    panel = box(1.6, -3.5, 9.2, 9.9, -3.1, 13.6)
    dial = box(2.1, -3.62, 10.2, 9.4, -3.45, 13.1)
    marks = Mesh().merge(*[box(2.7 + 0.62 * k, -3.66, 11.9, 2.8 + 0.62 * k, -3.6,
                               12.7 if k % 5 == 0 else 12.35) for k in range(11)])
    marks.merge(box(2.5, -3.66, 11.4, 9.0, -3.6, 11.46))
    needle = box(6.62, -3.72, 10.4, 6.78, -3.6, 12.9)
    knobs = Mesh()
    for x in (3.6, 7.9):
        knobs.merge(tube((x, -3.1, 6.2), (x, -4.9, 6.2), 1.45, segments=40))
    keys = Mesh().merge(*[box(2.0 + 1.62 * k, -3.9, 2.3, 3.42 + 1.62 * k, -3.1, 3.5)
                          for k in range(5)])
    rod = Mesh().merge(tube((-7.6, 2.2, 14.6), (-7.6, 2.2, 16), 0.42, segments=24),
                       tube((-7.6, 2.2, 15.6), (-14.6, 2.2, 29), 0.17, segments=16),
                       tube((-14.5, 2.2, 28.8), (-14.8, 2.2, 29.4), 0.3, segments=16))
    return [("radio_case", Mesh().merge(case, handle)), ("radio_feet", feet),
            ("radio_grille", Mesh().merge(grille, panel)), ("radio_dial", dial),
            ("radio_marks", marks), ("radio_needle", needle),
            ("radio_knobs", Mesh().merge(knobs, keys)), ("radio_rod", rod)]


def bar(path, radius, segments=14):
    """A round bar along points (x, z) of the plane y = 0, with round ends."""
    points = [(x, 0, z) for x, z in path]
    first, last = [], []
    for k in range(4):
        a = math.pi / 2 * k / 4
        first.append(radius * (1 - math.sin(a)))
        last.append(math.cos(a))
    ends = [extended(points[1], points[0], s) for s in first]
    tail = [extended(points[-2], points[-1], s) for s in first[::-1]]
    sizes = [max(math.sqrt(max(radius ** 2 - s ** 2, 0)), 1e-3) for s in first]
    whole = ends + points + tail
    radii = sizes + [radius] * len(points) + sizes[::-1]
    return sweep(whole, lambda n: radii[n], lambda n: radii[n], segments)


def extended(inner, end, by):
    """The point that lies beyond the end of a line."""
    length = math.dist(inner, end)
    return tuple(e + (e - i) / length * by for i, e in zip(inner, end))


def arc(x, z, rx, rz, start, stop, steps=18):
    return [(x + rx * math.cos(math.radians(start + (stop - start) * k / steps)),
             z + rz * math.sin(math.radians(start + (stop - start) * k / steps)))
            for k in range(steps + 1)]


def neon():
    """The word "open" of glass tubes, 42 wide and 13 high, its middle at the origin."""
    r = 0.55
    letters = [arc(-16, 0, 4.2, 5.6, 80, 430, 40),
               [(-9.2, -5.9), (-9.2, -1), (-9.2, 4)] + arc(-6.6, 2.6, 3.0, 3.0, 150, -150, 22),
               [(6.4, 5.6), (2.2, 5.6)] + arc(1.2, 4.6, 1, 1, 100, 180, 6)
               + [(0.2, 2), (0.2, -3)] + arc(1.2, -4.6, 1, 1, 180, 260, 6)
               + [(2.2, -5.6), (6.4, -5.6)],
               [(1.8, 0.1), (5.4, 0.1)],
               spline([(10.2, -5.8), (10.2, 0), (10.2, 4.6), (11.3, 4.9), (14.45, 0),
                       (17.6, -4.9), (18.7, -4.6), (18.7, 0), (18.7, 5.8)], 6)]
    faces = []
    for letter in letters:
        faces += bar(letter, r)
    border = arc(-21, 7, 2, 2, 180, 90, 8) + arc(21, 7, 2, 2, 90, 0, 8) \
        + arc(21, -7, 2, 2, 0, -90, 8) + arc(-21, -7, 2, 2, 270, 182, 8)
    return [("neon_word", faces), ("neon_border", bar(border + [(-23, 5.5)], 0.4))]


def fluorescent():
    """A tube of 60 with caps, below a batten; the tube's axis is x, at the origin."""
    rod = Mesh().merge(tube((-29, 0, 0), (29, 0, 0), 1.3, segments=48))
    caps = Mesh().merge(*[tube((s * 28.6, 0, 0), (s * 30.4, 0, 0), 1.42, segments=48)
                          for s in (-1, 1)])
    batten = Mesh().merge(box(-33, -2.2, 2.6, 33, 2.2, 6.2),
                          *[box(min(s * 30.4, s * 32), -1.2, -1.2, max(s * 30.4, s * 32), 1.2, 2.7)
                            for s in (-1, 1)])
    return [("tube_glass", rod), ("tube_caps", caps), ("tube_batten", batten)]


SHAPES = [
    ("radio", "Portable radio: 22 wide, 7 deep, 19.3 high without its rod; front towards +z.\n"
     "# Materials to define before: radio_case, _feet, _grille, _dial, _marks, _needle, _knobs\n"
     "# and _rod with _m after it; then instance the instgroup \"radio\".", radio, 1),
    ("neon", "Neon sign in the plane z = 0, 46 wide, 18 high, its middle at the\n"
     "# origin: the objects neon_word and neon_border.", neon, None),
    ("fluorescent", "Fluorescent lamp: tube of 60 along x, its axis at the origin, batten above.\n"
     "# Materials tube_glass_m, tube_caps_m, tube_batten_m; instgroup \"fluorescent\".",
     fluorescent, 50),
]


def main():
    for name, note, make, crease in SHAPES:
        parts = make()
        with open(HERE / f"{name}.mi", "w", encoding="utf-8") as out:
            out.write(f"# SPDX-License-Identifier: Apache-2.0\n# {note}\n"
                      "# Centimetres, y up. Written by generate.py: change it there.\n")
            for part, shape in parts:
                write_object(out, part, shape if crease is None else faces_of(shape, crease))
                if crease:
                    out.write(f'instance "{part}_inst" "{part}" material [ "{part}_m" ] '
                              "end instance\n")
            if crease:
                members = " ".join(f'"{part}_inst"' for part, _ in parts)
                out.write(f'\ninstgroup "{name}"\n  {members}\nend instgroup\n')


if __name__ == "__main__":
    main()
