# SPDX-License-Identifier: Apache-2.0
"""Homes and a shop for the comparison that nothing was tuned for, as data in the form of scenes.py.

Further materials: `glow` emits a `radiance` on both sides; `cloth` scatters the share `through` to
its other side.
"""
import math
import random

from everyday import ring
from interiors import DIFFUSE, chair, materials, shell, table
from scenes import box, camera, cylinder, quad, sphere


def wall_z(material, x0, x1, high, z, holes):
    """A wall of .1 m with its holes (x0, x1, y0, y1), from left to right."""
    parts, at = [], x0
    for a, b, c, d in holes:
        parts.append(box(material, (at, 0, z), (a, high, z + .1)))
        if c > 0:
            parts.append(box(material, (a, 0, z), (b, c, z + .1)))
        parts.append(box(material, (a, d, z), (b, high, z + .1)))
        at = b
    parts.append(box(material, (at, 0, z), (x1, high, z + .1)))
    return parts


def turned(parts):
    """z to x."""
    for p in parts:
        p["vertices"] = [(z, y, -x) for x, y, z in p["vertices"]]
    return parts


def apartment():
    """Four rooms with doors between and eight windows with portals, under sun and sky."""
    h = 2.6
    meshes = [box("floor", (-6, -.1, -4), (6, 0, 4)), box("white", (-6, h, -4), (6, h + .1, 4))]
    windows = [(-5, -3.6, .8, 2.2), (-2.4, -1.0, .8, 2.2), (1.0, 2.4, .8, 2.2), (3.6, 5, .8, 2.2)]
    meshes += wall_z("white", -6, 6, h, -4, windows)
    meshes += wall_z("white", -6, 6, h, 3.9, windows)
    meshes += wall_z("white", -6, 6, h, 0, [(-3.0, -2.1, 0, 2.05), (2.1, 3.0, 0, 2.05)])
    meshes += turned(wall_z("brick", -4, 4, h, -6, []))
    meshes += turned(wall_z("white", -4, 4, h, 0, [(-2.6, -1.7, 0, 2.05), (1.7, 2.6, 0, 2.05)]))
    meshes += turned(wall_z("cloth", -4, 4, h, 5.9, []))
    for x in (-4, 4):
        for z in (-2, 2):
            meshes += table(x, z, .7, .5, .72, 10) + chair(x + .3, z + .8) + chair(x - .3, z + .8)
    portals = [{"kind": "portal", "centre": ((x0 + x1) / 2, 1.5, 4 * side), "up": (0, y1 - y0, 0),
                "across": ((x0 - x1) * side, 0, 0)}
               for x0, x1, y0, y1 in windows for side in (-1, 1)]
    sun = {"kind": "sun", "direction": (.35, -.6, .7), "albedo_one": 8.0}
    return {"meshes": meshes, "materials": materials(*DIFFUSE), "lights": [sun, *portals],
            "background": 2.0, "camera": camera((-.6, 1.5, 3.2), (-4.2, 1.0, .6), 1.5)}


def lamplit_apartment():
    """The same at night, with sixteen emissive globes of which the camera's room has four."""
    scene = apartment()
    scene.update(lights=[], background=0.0)
    scene["materials"]["globe"] = {"kind": "glow", "radiance": (60, 50, 40)}
    for x in (-4.4, -1.6, 1.6, 4.4):
        for z in (-2.6, -1.2, 1.2, 2.6):
            scene["meshes"] += [sphere("globe", (x, 2.2, z), .08, 12),
                                box("dark", (x - .02, 2.28, z - .02), (x + .02, 2.6, z + .02))]
    return scene


def shop():
    """Emissive tubes, balls and a ring, and goods."""
    rng = random.Random(4)
    meshes = shell(3, 3, 2.5)
    for k in range(6):
        t = cylinder("tube", (-2.5 + k, 0, 0), .03, 3.0, 24)
        t["vertices"] = [(x, 2.8 + z, y) for x, y, z in t["vertices"]]
        t["normals"] = [(x, z, y) for x, y, z in t["normals"]]
        t["faces"] = [tuple(reversed(f)) for f in t["faces"]]
        meshes.append(t)
    for k in range(5):
        meshes.append(sphere("ball", (-2 + k, 1.9, -2.0), .12, 24))
    meshes.append(ring("neon", (0, 2.2, -2.3), .5, .02))
    for k in range(12):
        goods = rng.choice(("cloth", "brick", "dark", "white"))
        meshes.append(box(goods, (-2.6 + .45 * k, 0, -2.3),
                          (-2.3 + .45 * k, .4 + .8 * rng.random(), -1.9)))
    meshes += [*table(0, 0, .9, .5, .9), sphere("plastic", (0, 1.1, 0), .2, 32),
               sphere("metal", (.5, 1.05, 0), .15, 32)]
    kinds = {"tube": {"kind": "glow", "radiance": (9, 9, 8)},
             "ball": {"kind": "glow", "radiance": (10, 7, 4)},
             "neon": {"kind": "glow", "radiance": (20, 2, 6)},
             "plastic": {"kind": "plastic", "diffuse": (.1, .3, .5), "roughness": .3},
             "metal": {"kind": "metal", "colour": (.9, .8, .6), "roughness": .35}}
    return {"meshes": meshes, "materials": {**materials(*DIFFUSE), **kinds}, "lights": [],
            "background": 0.0, "camera": camera((2.4, 1.6, 2.2), (-.5, 1.1, -.8), 1.4)}


def bedroom():
    """A window with a pane of glass and a curtain that lets light through, under sun and sky."""
    meshes = shell(2.4, 2.6, 2.0, (-1.5, 1.0, .6, 2.2)) + [
        box("pane", (-1.5, .6, -2.01), (1.0, 2.2, -2.004))]
    curtain = {"material": "curtain", "vertices": [], "faces": []}
    n = 120
    for i in range(n + 1):
        x = -1.6 + 1.5 * i / n
        z = -1.85 + .05 * math.sin(40 * x)
        curtain["vertices"] += [(x, .05, z), (x, 2.4, z)]
    curtain["faces"] = [(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1) for i in range(n)]
    meshes += [curtain, box("cloth", (-1.8, .3, -.6), (.3, .6, 1.3)),
               box("white", (-1.8, .6, -.6), (-1.2, .75, 1.3)),
               box("floor", (1.4, 0, -1.2), (2.3, 1.0, -.2)),
               sphere("plastic", (1.8, 1.2, -.7), .2, 32)]
    kinds = {"pane": {"kind": "glass", "ior": 1.5, "straight": True},
             "curtain": {"kind": "cloth", "diffuse": (.35, .34, .3), "through": (.4, .38, .33)},
             "plastic": {"kind": "plastic", "diffuse": (.1, .3, .5), "roughness": .3}}
    sun = {"kind": "sun", "direction": (.35, -.6, .7), "albedo_one": 8.0}
    return {"meshes": meshes, "materials": {**materials(*DIFFUSE), **kinds}, "lights": [sun],
            "background": 2.0, "bounces": 12, "camera": camera((2.2, 1.5, 1.8), (-.5, 1.0, -.9), 1.5)}


def villa():
    """A house of concrete and glass with a terrace and a pool, under the probe and a sun."""
    rng = random.Random(2)
    meshes = [quad("grass", (-60, 0, 60), (60, 0, 60), (60, 0, -60), (-60, 0, -60)),
              box("white", (-6, 0, -8), (6, .3, 0)), box("white", (-6, 3.0, -8), (6, 3.3, 1)),
              box("white", (-6, .3, -8), (-5.8, 3, 0)), box("brick", (5.8, .3, -8), (6, 3, 0)),
              box("white", (-5.8, .3, -8), (5.8, 3, -7.8)),
              quad("pool", (-5, .02, 8), (5, .02, 8), (5, .02, 3), (-5, .02, 3))]
    for k in range(6):
        x = -5.8 + 1.95 * k
        meshes += [box("pane", (x, .3, -.5), (x + 1.85, 3, -.48)),
                   box("dark", (x + 1.85, .3, -.52), (x + 1.95, 3, -.46))]
    meshes += [*table(-2, -3, .9, .5, 1.05), box("cloth", (1, .3, -5), (3, 1.1, -4)),
               *table(2.5, 1.2, .6, .4, .75)]
    for k in range(4):
        x = -4 + 2.2 * k
        meshes.append(box("floor", (x, 0, 2.0), (x + .6, .4, 2.6), 30 * rng.random()))
    kinds = {"pane": {"kind": "glass", "ior": 1.5, "straight": True},
             "grass": {"kind": "diffuse", "diffuse": (.12, .25, .06)},
             "pool": {"kind": "plastic", "diffuse": (.02, .1, .14), "roughness": .1}}
    sun = {"kind": "sun", "direction": (.5, -.6, -.6), "albedo_one": 3.0}
    return {"meshes": meshes, "materials": {**materials(*DIFFUSE), **kinds}, "lights": [sun],
            "probe": True, "background": 1.0, "bounces": 12,
            "camera": camera((5, 2.0, 9), (-.5, 1.3, 0), 1.2)}
