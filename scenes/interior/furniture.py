# SPDX-License-Identifier: Apache-2.0
"""The pieces of the interior. Each function returns parts: (name, mesh, material, crease angle).

A piece stands on z = 0 around its own origin and faces -y; generate.py puts it into the room.
"""
import math
import random

from mesh import Mesh, box, cushion, lathe, rounded_box, sheet, tube

BOOKS = ["book_cream", "book_blue", "book_cream", "book_grey", "book_green", "book_white",
         "book_ochre", "book_grey", "book_white", "book_red", "book_blue"]


def legs(half_x, half_y, height, splay=0.03, r0=0.013, r1=0.022):
    """Four tapered legs."""
    mesh = Mesh()
    for sx in (-1, 1):
        for sy in (-1, 1):
            foot = (sx * (half_x + splay), sy * (half_y + splay), 0)
            mesh.merge(tube(foot, (sx * half_x, sy * half_y, height), r0, r1))
    return mesh


def sofa():
    frame = Mesh().merge(
        rounded_box(1.79, 0.85, 0.19, 0.02).moved(0, 0, 0.15),
        rounded_box(1.79, 0.2, 0.5, 0.06).moved(0, 0.32, 0.28),
        *[rounded_box(0.17, 0.88, 0.44, 0.05).moved(x, 0, 0.14) for x in (-0.965, 0.965)])
    seats = Mesh().merge(*[cushion(0.875, 0.7, 0.15, 0.025, 0.045).moved(x, -0.1, 0.34)
                           for x in (-0.44, 0.44)])
    backs = Mesh().merge(*[cushion(0.84, 0.44, 0.15, 0.03, 0.055).turned(76, "x")
                           .moved(x, 0.22, 0.5) for x in (-0.44, 0.44)])
    left = cushion(0.44, 0.44, 0.09, 0.05, 0.04).turned(66, "x").turned(16).moved(-0.66, 0.0, 0.55)
    right = cushion(0.44, 0.44, 0.09, 0.05, 0.04).turned(64, "x").turned(-20).moved(0.7, 0.0, 0.55)
    small = cushion(0.5, 0.3, 0.09, 0.045, 0.04).turned(60, "x").turned(-8).moved(0.4, -0.1, 0.54)
    return [("frame", frame, "linen", 50), ("seats", seats, "linen", 60),
            ("backs", backs, "linen", 60), ("pillow_left", left, "wool_ochre", 60),
            ("pillow_right", right, "wool_blue", 60), ("pillow_small", small, "wool_cream", 60),
            ("legs", legs(0.9, 0.34, 0.15), "oak_furniture", 40)]


def armchair():
    seat = cushion(0.58, 0.6, 0.13, 0.025, 0.045).turned(-5, "x").moved(0, -0.02, 0.33)
    back = cushion(0.58, 0.56, 0.13, 0.03, 0.045).turned(70, "x").moved(0, 0.3, 0.62)
    wood = legs(0.32, 0.3, 0.4, 0.04)
    for x in (-0.34, 0.34):
        wood.merge(rounded_box(0.065, 0.66, 0.028, 0.012).moved(x, -0.01, 0.56),
                   tube((x, -0.27, 0.38), (x, -0.27, 0.565), 0.018),
                   tube((x, 0.26, 0.38), (x, 0.28, 0.565), 0.018),
                   tube((x, -0.3, 0.36), (x, 0.3, 0.3), 0.016))
    for y in (-0.28, 0.27):
        wood.merge(tube((-0.34, y, 0.335), (0.34, y, 0.335), 0.016))
    wood.merge(tube((-0.3, 0.42, 0.84), (0.3, 0.42, 0.84), 0.014))
    for x in (-0.27, 0.27):
        wood.merge(tube((x, 0.27, 0.33), (x, 0.43, 0.86), 0.014))
    return [("seat", seat, "leather", 60), ("back", back, "leather", 60),
            ("wood", wood, "oak_furniture", 40)]


def coffee_table():
    top = rounded_box(1.25, 0.68, 0.036, 0.008).moved(0, 0, 0.384)
    steel = Mesh()
    for x in (-0.52, 0.52):
        steel.merge(rounded_box(0.03, 0.56, 0.03, 0.004).moved(x, 0, 0),
                    rounded_box(0.03, 0.56, 0.03, 0.004).moved(x, 0, 0.354),
                    *[rounded_box(0.03, 0.03, 0.36, 0.004).moved(x, y, 0.01)
                      for y in (-0.265, 0.265)])
    books = Mesh()
    for k, (size, turn, name) in enumerate((((0.27, 0.2), 8, "book_blue"),
                                            ((0.25, 0.18), 3, "book_cream"),
                                            ((0.22, 0.16), -9, "book_red"))):
        books.merge(book(*size, 0.026, name).turned(turn).moved(0.43, 0.1, 0.42 + 0.026 * k))
    return [("top", top, "oak_furniture", 40), ("steel", steel, "steel_black", 40),
            ("books", books, None, 0)]


def book(width, depth, thick, cover):
    """A book lying on its back: cover boards and spine, pages inset by 4 mm."""
    mesh = Mesh().merge(box(-width / 2, -depth / 2, 0, width / 2, depth / 2, 0.003),
                        box(-width / 2, -depth / 2, thick - 0.003, width / 2, depth / 2, thick),
                        box(-width / 2, -depth / 2, 0, -width / 2 + 0.003, depth / 2, thick))
    pages = box(-width / 2 + 0.003, -depth / 2 + 0.004, 0.003, width / 2 - 0.004, depth / 2 - 0.004,
                thick - 0.003)
    return mesh.painted(cover).merge(pages.painted("paper"))


def crockery():
    """Two cups with saucers, for the table top."""
    cup = lathe([(0, 0), (0.022, 0), (0.024, 0.006), (0.036, 0.03), (0.041, 0.058), (0.043, 0.072),
                 (0.0405, 0.072), (0.038, 0.058), (0.033, 0.031), (0.021, 0.009), (0, 0.008)])
    saucer = lathe([(0, 0), (0.035, 0), (0.04, 0.004), (0.075, 0.014), (0.075, 0.017),
                    (0.04, 0.008), (0, 0.007)])
    tea = lathe([(0.0368, 0.052), (0, 0.052)])
    return [("cups", Mesh().merge(cup.moved(0.2, -0.17, 0.007), cup.moved(-0.13, -0.22, 0.007)),
             "porcelain", 40),
            ("saucers", Mesh().merge(saucer.moved(0.2, -0.17), saucer.moved(-0.13, -0.22)),
             "porcelain", 40),
            ("tea", tea.moved(0.2, -0.17, 0.007), "tea", 40)]


def bowl():
    """A bowl of polished brass, 4 mm thick."""
    outer = [(0.135 * math.sin(a), 0.085 - 0.085 * math.cos(a))
             for a in (math.pi / 2 * k / 10 for k in range(11))]
    inner = [(0.131 * math.sin(a), 0.086 - 0.081 * math.cos(a))
             for a in (math.pi / 2 * k / 10 for k in range(10, -1, -1))]
    return [("shell", lathe(outer + inner, 64), "brass", 40)]


def glass_ball():
    ball = [(0.048 * math.sin(a), 0.048 - 0.048 * math.cos(a))
            for a in (math.pi * k / 24 for k in range(25))]
    ball[0], ball[-1] = (0, 0), (0, 0.096)
    return [("ball", lathe(ball, 48), "glass", 60)]


def vase():
    """A closed body of glass (outside and inside wall), and olive twigs in it."""
    outer = [(0, 0), (0.038, 0), (0.043, 0.004), (0.052, 0.04), (0.055, 0.08), (0.05, 0.12),
             (0.038, 0.155), (0.031, 0.18), (0.031, 0.2), (0.036, 0.22), (0.0375, 0.222)]
    inner = [(0.0365, 0.2215), (0.033, 0.219), (0.028, 0.2), (0.028, 0.181), (0.0348, 0.154),
             (0.0465, 0.119), (0.0515, 0.08), (0.0485, 0.042), (0.039, 0.014), (0, 0.013)]
    dice = random.Random(7)
    twigs, leaves = Mesh(), Mesh()
    for k in range(5):
        turn, lean = 72 * k + dice.uniform(-15, 15), dice.uniform(0.1, 0.2)
        height = dice.uniform(0.36, 0.5)
        points = [(0.014 + lean * t ** 1.8, 0, 0.03 + height * t) for t in (0, 0.4, 0.7, 1)]
        for a, b in zip(points, points[1:]):
            twigs.merge(tube(a, b, 0.0022, 0.0018, 8).turned(turn))
        for n in range(16):
            t = 0.5 + 0.5 * n / 15
            base = (0.014 + lean * t ** 1.8, 0, 0.03 + height * t)
            one = leaf(0.052, 0.013, 0.15, 3, 2).turned(-dice.uniform(10, 50), "y")
            leaves.merge(one.turned(137.5 * n).moved(*base).turned(turn))
    return [("glass", lathe(outer + inner, 48), "glass", 40), ("twigs", twigs, "bark", 40),
            ("leaves", leaves, "leaf_olive", 60)]


def leaf(length, width, droop, nu=6, nv=4):
    """A leaf that grows along +x and bends down, folded a little along its middle."""
    def surface(u, v):
        w = width * math.sin(math.pi * min(1.0, 0.04 + 0.96 * u) ** 0.75) * (v - 0.5) * 2 / 2
        return (length * u, w, -droop * length * u * u + 0.35 * abs(w))
    return sheet(surface, nu, nv)


def plant():
    """A rubber plant in a white pot."""
    dice = random.Random(3)
    pot = lathe([(0, 0), (0.13, 0), (0.14, 0.01), (0.185, 0.33), (0.185, 0.35), (0.172, 0.35),
                 (0.168, 0.31), (0, 0.31)])
    soil = lathe([(0.1695, 0.318), (0, 0.322)])
    stems, leaves = Mesh(), Mesh()
    for stem, (lean, turn, height, count) in enumerate(((0.1, 20, 1.3, 17), (0.28, 150, 1.0, 13),
                                                        (0.24, 265, 0.8, 11))):
        def at(t, lean=lean, height=height):
            return (0.03 + lean * t * t, 0, 0.3 + height * t)
        for k in range(6):
            stems.merge(tube(at(k / 6), at((k + 1) / 6), 0.012 - 0.001 * k, 0.011 - 0.001 * k, 10)
                        .turned(turn))
        for n in range(count):
            t = 0.22 + 0.78 * n / (count - 1)
            size = dice.uniform(0.85, 1.1) * (1.0 if t < 0.9 else 0.7)
            one = leaf(0.27 * size, 0.125 * size, dice.uniform(0.1, 0.45))
            one = one.moved(0.03, 0).turned(-dice.uniform(5, 40) - 30 * (t > 0.93), "y")
            leaves.merge(one.turned(137.5 * n + 60 * stem).moved(*at(t)).turned(turn))
    return [("pot", pot, "porcelain", 40), ("soil", soil, "soil", 40), ("stems", stems, "bark", 40),
            ("leaves", leaves, "leaf_rubber", 60)]


def floor_lamp():
    stand = Mesh().merge(lathe([(0, 0), (0.14, 0), (0.142, 0.004), (0.14, 0.018), (0.02, 0.022),
                                (0.014, 0.03), (0, 0.03)], 48),
                         tube((0, 0, 0.02), (0, 0, 1.5), 0.011),
                         lathe([(0, 1.48), (0.03, 1.49), (0.036, 1.54), (0.03, 1.59), (0, 1.6)],
                               24))
    shade = lathe([(0.235, 1.38), (0.165, 1.7)], 64)
    return [("stand", stand, "brass", 40), ("shade", shade, "shade", 60)]


def shelf():
    """Open oak shelf, 1 m wide, with books and a few things."""
    dice = random.Random(11)
    oak = Mesh()
    for x in (-0.49, 0.49):
        oak.merge(rounded_box(0.025, 0.3, 1.95, 0.003).moved(x, 0))
    heights = [0.06, 0.44, 0.8, 1.16, 1.52, 1.92]
    for z in heights:
        oak.merge(rounded_box(0.96, 0.3, 0.025, 0.003).moved(0, 0, z))
    oak.merge(box(-0.48, 0.14, 0.06, 0.48, 0.148, 1.94))
    books = Mesh()
    rows = {0: (-0.46, 0.3), 1: (-0.46, -0.06), 2: (-0.1, 0.45), 3: (-0.46, 0.12), 4: (0.06, 0.4)}
    for row, (x, end) in rows.items():
        while x < end:
            thick, tall = dice.uniform(0.014, 0.045), dice.triangular(0.17, 0.31, 0.23)
            one = book(dice.uniform(0.15, 0.21), tall, thick, dice.choice(BOOKS))
            # Stand it up: its spine faces the room, its foot is on the board.
            foot = heights[row] + 0.026 + tall / 2
            books.merge(one.map(lambda p: (p[2], p[0], p[1])).moved(x, -0.03, foot))
            x += thick + 0.002
    urn = lathe([(0, 0), (0.05, 0), (0.085, 0.05), (0.095, 0.11), (0.07, 0.17), (0.032, 0.2),
                 (0.035, 0.22), (0.03, 0.22), (0.026, 0.2), (0, 0.19)], 48)
    ball = [(0.075 * math.sin(a), 0.075 - 0.075 * math.cos(a))
            for a in (math.pi * k / 24 for k in range(25))]
    ball[0], ball[-1] = (0, 0), (0, 0.15)
    return [("oak", oak, "oak_furniture", 40), ("books", books, None, 0),
            ("urn", urn.moved(-0.3, 0, heights[2] + 0.026), "terracotta", 40),
            ("chrome_ball", lathe(ball, 48).moved(0.1, -0.04, heights[1] + 0.026), "chrome", 60),
            ("dish", bowl()[0][1].moved(0.3, -0.01, heights[3] + 0.026), "porcelain", 40),
            ("bottle", lathe([(0, 0), (0.045, 0), (0.05, 0.01), (0.05, 0.14), (0.016, 0.2),
                              (0.016, 0.26), (0, 0.26)], 40).moved(-0.25, 0, heights[4] + 0.026),
             "glaze_blue", 40)]


def rug():
    """Flat weave, cream with blue bands; lies along x."""
    mesh, half_x, half_y, top = Mesh(), 1.25, 0.9, 0.012
    cuts = [-1.25, -1.17, -1.1, -1.07, -1.04, -0.55, -0.5, -0.05, 0.05, 0.5, 0.55, 1.04, 1.07, 1.1,
            1.17, 1.25]
    colours = ["rug_blue", "rug_cream", "rug_ochre", "rug_cream", "rug_cream", "rug_blue",
               "rug_cream", "rug_blue", "rug_cream", "rug_blue", "rug_cream", "rug_cream",
               "rug_ochre", "rug_cream", "rug_blue"]
    for a, b, colour in zip(cuts, cuts[1:], colours):
        mesh.add([(a, -half_y, top), (b, -half_y, top), (b, half_y, top), (a, half_y, top)], colour)
    side = box(-half_x, -half_y, 0, half_x, half_y, top)
    side.faces = [side.faces[k] for k in (2, 3, 4, 5)]
    return [("weave", mesh.merge(side.painted("rug_cream")), None, 0)]


def picture(width, height, art):
    """Frame, mat and a few plain shapes; hangs on y = 0 with its centre at the origin."""
    bar, deep = 0.022, 0.03
    x, z = width / 2, height / 2
    frame = Mesh().merge(box(-x, -deep, -z, -x + bar, 0, z), box(x - bar, -deep, -z, x, 0, z),
                         box(-x + bar, -deep, -z, x - bar, 0, -z + bar),
                         box(-x + bar, -deep, z - bar, x - bar, 0, z))
    sheets = Mesh()

    def shape(points, material, layer):
        sheets.add([(px * x, -0.006 - 0.0005 * layer, pz * z) for px, pz in points], material)

    shape([(-1, -1), (1, -1), (1, 1), (-1, 1)], "paper", 0)
    for layer, (points, material) in enumerate(art, 1):
        shape(points, material, layer)
    return [("frame", frame, "steel_black", 0), ("sheet", sheets, None, 0)]


def disc(cx, cz, r, aspect, first=0, last=360, n=40):
    """Part of a disc in a picture's coordinates (-1 to 1), round on a sheet of that aspect."""
    return [(cx + r * math.cos(math.radians(first + (last - first) * k / n)),
             cz + r * aspect * math.sin(math.radians(first + (last - first) * k / n)))
            for k in range(n + (last - first < 360))]


def pictures():
    a = 0.5 / 0.68
    hills = [([(-0.68, -0.72), (0.68, -0.72), (0.68, 0.72), (-0.68, 0.72)], "paint_sand"),
             (disc(0.12, 0.2, 0.36, a), "paint_terracotta"),
             (disc(-0.2, -0.72, 0.48, a, 0, 180), "paint_blue"),
             (disc(0.36, -0.72, 0.32, a, 0, 180), "paint_ochre")]
    stones = [(disc(0, -0.45, 0.42, a), "paint_blue"), (disc(0.05, 0.02, 0.27, a), "paint_ochre"),
              (disc(-0.03, 0.36, 0.19, a), "paint_terracotta")]
    arcs = [(disc(0, -0.5, r, a, 0, 180), m)
            for r, m in ((0.62, "paint_terracotta"), (0.48, "paper"), (0.36, "paint_ochre"),
                         (0.24, "paper"), (0.13, "paint_blue"))]
    parts = []
    for n, art in enumerate((hills, stones, arcs)):
        for name, mesh, material, crease in picture(0.5, 0.68, art):
            parts.append((f"{name}_{n + 1}", mesh.moved((n - 1) * 0.62, 0), material, crease))
    return parts


def curtain():
    """A drawn-back sheer curtain; hangs in the y-z plane between y = 0 and 0.6."""
    def surface(u, v):
        fold = math.sin(2 * math.pi * 7.5 * u) * (0.055 - 0.02 * v)
        loose = 0.02 * math.sin(2 * math.pi * 1.3 * u + 1) * (1 - v)
        return (fold + loose, 0.56 * u + 0.04 * math.sin(9 * u) * (1 - v), 2.56 * v)
    return [("cloth", sheet(surface, 120, 8), "sheer", 60)]


def bush():
    """Leaves in a ball of about 0.8 m, for the hedge outside."""
    dice, leaves = random.Random(5), Mesh()
    while len(leaves.faces) < 900:
        p = [dice.gauss(0, 1) for _ in range(3)]
        length = math.sqrt(sum(x * x for x in p))
        r = 0.62 * dice.uniform(0.45, 1) ** 0.4
        one = Mesh().add([(-0.055, 0, 0), (0, -0.028, 0.008), (0.055, 0, 0), (0, 0.028, 0.008)])
        one = one.turned(dice.uniform(0, 360), "x").turned(dice.uniform(-70, 70), "y")
        leaves.merge(one.turned(dice.uniform(0, 360)).moved(*(r * x / length for x in p)))
    return [("leaves", leaves, "leaf_hedge", 0)]
