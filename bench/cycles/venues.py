# SPDX-License-Identifier: Apache-2.0
"""Lit coves, lampshades, blinds, gems and a pergola, as data in the form of scenes.py."""
import math
import random

from everyday import leaves, ring
from homes import turned, wall_z
from interiors import DIFFUSE, chair, materials, shell, table
from scenes import box, camera, cylinder, quad, sphere


def gallery():
    """Two strips hidden in coves light the ceiling, twelve spots the walls; a polished floor and panes."""
    meshes = shell(5, 4, 3)
    meshes[0]["material"] = "stone"
    for side in (-1, 1):
        z0, z1 = sorted((side * 3, side * 2.6))
        lip0, lip1 = sorted((side * 2.62, side * 2.58))
        s0, s1 = sorted((side * 2.9, side * 2.84))
        meshes += [box("white", (-5, 3.3, z0), (5, 3.34, z1)), box("white", (-5, 3.34, lip0), (5, 3.46, lip1)),
                   # In pieces: Cycles 3.4 shows a tenth less light of triangles 490 times as long as wide.
                   *[box("strip", (-4.9 + .2 * k, 3.35, s0), (-4.7 + .2 * k, 3.37, s1)) for k in range(49)]]
    lights = []
    rng = random.Random(21)
    for k in range(12):
        x, side = -4.4 + 1.76 * (k // 2), 1 if k % 2 else -1
        lights.append({"kind": "spot", "centre": (x, 3.7, side * 1.2), "direction": (0, -1.9, side * 1.7),
                       "half_angle": 16, "intensity": rng.choice((2.0, 3.0, 5.0))})
        low, high = sorted((side * 2.99, side * 2.95))
        meshes.append(box(rng.choice(("brick", "cloth", "dark")), (x - .5, 1.1, low), (x + .5, 2.2, high)))
    meshes += [box("pane", (-2, 0, -.6), (-1.98, 1.1, .6)), box("pane", (1.2, 0, -.6), (1.22, 1.1, .6)),
               box("white", (-.3, 0, -.3), (.3, 1, .3)), sphere("bronze", (0, 1.3, 0), .3, 64),
               box("cloth", (2.2, 0, -.4), (3.6, .45, .4))]
    kinds = {"strip": {"kind": "glow", "radiance": (30, 26, 20)},
             "stone": {"kind": "plastic", "diffuse": (.45, .43, .4), "roughness": .25},
             "bronze": {"kind": "metal", "colour": (.7, .5, .3), "roughness": .35},
             "pane": {"kind": "glass", "ior": 1.5, "straight": True}}
    return {"meshes": meshes, "materials": {**materials(*DIFFUSE), **kinds}, "lights": lights,
            "background": 0.0, "bounces": 12, "camera": camera((4.6, 1.7, 1.9), (-1, 1.5, -.6), 1.5)}


def lounge():
    """Bulbs in shades of cloth at night, with a mirror, a table of glass and a polished floor."""
    meshes = shell(3, 2.7, 2.4)
    meshes[0]["material"] = "parquet"
    for x, y, z, r in ((-2.3, 1.4, -1.8, .2), (1.9, 1.1, -1.7, .16), (-.2, 2.1, .3, .25)):
        meshes += [cylinder("shade", (x, y, z), r, .3, 48), sphere("bulb", (x, y, z), .04, 12)]
        if y < 2:
            meshes.append(cylinder("dark", (x, y / 2 - .1, z), .015, y - .2, 12))
    meshes += [quad("mirror", (2.98, .4, 1.6), (2.98, .4, -.8), (2.98, 2.2, -.8), (2.98, 2.2, 1.6)),
               box("pane", (-.9, .42, -.3), (.5, .44, .7)), box("dark", (-.8, 0, -.2), (-.74, .42, -.14)),
               box("dark", (.34, 0, .54), (.4, .42, .6)), box("cloth", (-1.6, 0, -2.2), (1.0, .42, -1.4)),
               box("cloth", (-1.6, .42, -2.2), (1.0, .85, -2.0)), sphere("steel", (-.4, .54, .2), .1, 48),
               box("brick", (-2.9, 0, .4), (-2.5, 1.9, 1.6))]
    kinds = {"shade": {"kind": "cloth", "diffuse": (.4, .37, .3), "through": (.42, .38, .28)},
             "bulb": {"kind": "glow", "radiance": (260, 200, 120)},
             "mirror": {"kind": "mirror", "colour": (.9, .9, .9)},
             "parquet": {"kind": "plastic", "diffuse": (.35, .22, .12), "roughness": .35},
             "steel": {"kind": "metal", "colour": (.8, .8, .82), "roughness": .3},
             "pane": {"kind": "glass", "ior": 1.5, "straight": True}}
    return {"meshes": meshes, "materials": {**materials(*DIFFUSE), **kinds}, "lights": [],
            "background": 0.0, "bounces": 12, "camera": camera((2.5, 1.5, 2.2), (-.6, 1.0, -.7), 1.5)}


def blinds():
    """An office behind a window with forty slats, under sun and even sky."""
    meshes = shell(2.6, 2.8, 2.2, (-1.8, 1.8, .8, 2.4))
    c, s = math.cos(.6), math.sin(.6)
    for k in range(40):
        y = .84 + .04 * k
        a, b = (y - .022 * s, -2.14 - .022 * c), (y + .022 * s, -2.14 + .022 * c)
        meshes.append(quad("slat", (-1.8, a[0], a[1]), (1.8, a[0], a[1]), (1.8, b[0], b[1]), (-1.8, b[0], b[1])))
    meshes += [*table(-.4, -.9, .8, .4, .74), *chair(-.3, -.2), *table(1.5, .6, .4, .8, .74),
               box("dark", (-.7, .74, -1.1), (-.1, 1.15, -1.06)), box("floor", (-2.5, 0, .4), (-2.1, 2.0, 2.0)),
               sphere("plastic", (1.5, .86, .4), .12, 32)]
    kinds = {"slat": {"kind": "plastic", "diffuse": (.7, .7, .68), "roughness": .4},
             "plastic": {"kind": "plastic", "diffuse": (.5, .1, .05), "roughness": .3}}
    sun = {"kind": "sun", "direction": (.3, -.55, .75), "albedo_one": 10.0}
    return {"meshes": meshes, "materials": {**materials(*DIFFUSE), **kinds}, "lights": [sun],
            "background": 2.5, "camera": camera((2.3, 1.6, 2.0), (-.7, 1.1, -.9), 1.5)}


def gem(material, centre, radius, sides=8):
    """A cut stone: table, crown and pavilion, with flat faces."""
    x, y, z = centre

    def circle(r, h, shift=0.0):
        return [(x + radius * r * math.cos(2 * math.pi * (i + shift) / sides), y + radius * h,
                 z - radius * r * math.sin(2 * math.pi * (i + shift) / sides)) for i in range(sides)]
    vertices = circle(.55, .42, .5) + circle(1, .1) + circle(1, .04) + [(x, y - radius * .85, z)]
    faces = [tuple(range(sides))]
    for i in range(sides):
        k = (i + 1) % sides
        faces += [(sides + i, sides + k, i), (i, sides + k, k),
                  (2 * sides + i, 2 * sides + k, sides + k, sides + i), (3 * sides, 2 * sides + k, 2 * sides + i)]
    return {"material": material, "vertices": vertices, "faces": faces}


def gems():
    """Cut stones that refract light, a ring of gold and a bowl of steel, under three small lamps and the probe."""
    rng = random.Random(12)
    meshes = [quad("table", (-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)), ring("gold", (-.25, .05, .1), .2, .05),
              cylinder("steel", (.45, .12, -.3), .16, .24, 96)]
    for k in range(9):
        x, z = -.6 + .3 * (k % 3) + .1 * rng.random() + (.3 if k > 5 else 0), -.5 + .4 * (k // 3)
        meshes.append(gem("stone", (x, .085, z), .1))
    lamps = [{"kind": "area", "centre": p, "across": (.15, 0, 0), "up": (0, 0, .15), "radiance": 120.0}
             for p in ((-.7, 1.3, -.5), (.6, 1.5, .3), (0, 1.4, -1.0))]
    kinds = {"table": {"kind": "plastic", "diffuse": (.3, .28, .27), "roughness": .3},
             "stone": {"kind": "glass", "ior": 1.76, "straight": False},
             "gold": {"kind": "metal", "colour": (.95, .7, .35), "roughness": .25},
             "steel": {"kind": "metal", "colour": (.75, .75, .78), "roughness": .4}}
    return {"meshes": meshes, "materials": kinds, "lights": lamps, "probe": True, "background": 1.0,
            "bounces": 16, "camera": camera((0, .75, 1.3), (0, .05, -.05), .9)}


def terrace():
    """Under a pergola before doors of glass, with plants and a paved floor, under sun and even sky."""
    rng = random.Random(14)
    meshes = [quad("paving", (-30, 0, 30), (30, 0, 30), (30, 0, -30), (-30, 0, -30)),
              *wall_z("white", -5, 5, 3.2, -3, [(-3.6, 3.6, 0, 2.5)]), box("white", (-5, 3.2, -9), (5, 3.5, -2.9)),
              *turned(wall_z("brick", -9, -3, 3.2, -5, [])), *turned(wall_z("white", -9, -3, 3.2, 4.9, [])),
              box("white", (-5, 0, -9.1), (5, 3.2, -9)), *table(0, -6, 1.2, .6, .74), *chair(.3, -5.2),
              *table(.2, 0, .8, .5, .74), *chair(-.6, .9), *chair(.9, .9)]
    for k in range(4):
        meshes += [box("pane", (-3.58 + 1.8 * k, 0, -2.96), (-1.84 + 1.8 * k, 2.5, -2.95)),
                   box("dark", (-3.6 + 1.8 * k, 0, -2.98), (-3.55 + 1.8 * k, 2.5, -2.92))]
    for k in range(18):
        meshes.append(box("floor", (-3.6 + .42 * k, 2.75, -2.9), (-3.54 + .42 * k, 2.9, 2.2)))
    for x in (-3.6, 3.5):
        meshes.append(box("floor", (x, 0, 2.0), (x + .1, 2.6, 2.1)))
    meshes.append(box("floor", (-3.8, 2.6, 2.0), (3.8, 2.75, 2.1)))
    crowns = []
    for x, z in ((-3.2, 1.4), (3.1, .8), (-2.6, -2.2), (2.8, -2.0)):
        meshes.append(cylinder("brick", (x, .3, z), .3, .6, 32))
        crowns += leaves((x, 1.1, z), (.5, .6, .5), 1500, rng)
    meshes += [{"material": "leaf", "vertices": crowns, "faces": [(i, i + 1, i + 2) for i in range(0, len(crowns), 3)]},
               sphere("glass", (.1, .86, 0), .12, 48)]
    kinds = {"pane": {"kind": "glass", "ior": 1.5, "straight": True}, "glass": {"kind": "glass", "ior": 1.5, "straight": True},
             "leaf": {"kind": "diffuse", "diffuse": (.12, .3, .06)},
             "paving": {"kind": "plastic", "diffuse": (.4, .38, .34), "roughness": .6}}
    sun = {"kind": "sun", "direction": (.4, -.75, -.45), "albedo_one": 4.0}
    return {"meshes": meshes, "materials": {**materials(*DIFFUSE), **kinds}, "lights": [sun], "background": 1.0,
            "bounces": 12, "camera": camera((3.4, 1.6, 5.2), (-.6, 1.2, -2), 1.3)}
