# SPDX-License-Identifier: Apache-2.0
"""Depth of field, bumps, brushed metal, rough glass, fog and mixed light, as data in the form of scenes.py.

Further keys: `lens` of a camera (radius of the aperture, distance of the sharp plane) and `by` (its way while
the shutter is open); `fog` of a scene (extinction; all of it scatters, in a closed room); `motion` of a mesh
while the shutter is open (`centre`, to which its vertices are relative, `by` a vector, `turn` in degrees about
the vertical). Further materials: `frosted` glass; `brushed` metal, with the `ratio` of width to height of its
highlights. `bump` of a glossy material: a picture, and the height of its white.
"""
import math
import random

from everyday import ceiling_lamps, leaves, ring, with_places
from homes import turned, wall_z
from interiors import DIFFUSE, chair, furniture, materials, shell, table
from scenes import box, camera, cylinder, quad, sphere


def still_life():
    """A table close to the lens under two soft boxes: frosted glass, brushed steel, dented lacquer."""
    kinds = {"wood": {"kind": "plastic", "diffuse": (.4, .25, .13), "roughness": .45},
             "lacquer": {"kind": "plastic", "diffuse": (.5, .06, .04), "roughness": .25, "bump": ("dents", .004)},
             "steel": {"kind": "brushed", "colour": (.8, .8, .82), "roughness": .4, "ratio": 4.0},
             "frosted": {"kind": "frosted", "ior": 1.5, "roughness": .35},
             "gold": {"kind": "metal", "colour": (.95, .7, .35), "roughness": .2}}
    lamps = [{"kind": "area", "centre": (-1.4, 1.6, .4), "across": (0, 0, 1.0), "up": (-.5, -.6, 0),
              "radiance": 7.0},
             {"kind": "area", "centre": (1.2, 1.8, -.9), "across": (.6, 0, 0), "up": (0, 0, .6),
              "radiance": 4.0}]
    meshes = [quad("wood", (-2, 0, 2), (2, 0, 2), (2, 0, -2), (-2, 0, -2)),
              quad("white", (-4, -1, -2.2), (4, -1, -2.2), (4, 3, -2.2), (-4, 3, -2.2)),
              with_places(sphere("lacquer", (-.32, .16, -.1), .16, 64)),
              cylinder("steel", (.05, .15, -.35), .12, .3, 96),
              sphere("frosted", (.15, .12, .12), .12, 64), ring("gold", (-.1, .04, .3), .12, .04)]
    for k in range(9):
        meshes.append(sphere("gold" if k % 3 else "lacquer_plain", (-.9 + .22 * k, .05, -1.2 + .02 * k),
                             .05, 24))
    kinds["lacquer_plain"] = {k: v for k, v in kinds["lacquer"].items() if k != "bump"}
    view = camera((.25, .55, 1.25), (-.03, .1, 0), .75)
    view["lens"] = (.03, 1.2)
    return {"meshes": meshes, "materials": {**materials(*DIFFUSE), **kinds}, "lights": lamps,
            "pictures": {"dents": "dents"}, "background": .15, "bounces": 12, "camera": view}


def dusk():
    """A living room between a pale sky in two windows, four lamps, a globe and a spot."""
    meshes = [box("floor", (-3.5, -.1, -2.5), (3.5, 0, 2.5)), box("white", (-3.5, 2.6, -2.5), (3.5, 2.7, 2.5)),
              *wall_z("white", -3.5, 3.5, 2.6, -2.5, [(-2.8, -1.0, .4, 2.3), (.6, 2.4, .4, 2.3)]),
              *wall_z("white", -3.5, 3.5, 2.6, 2.4, []), *turned(wall_z("brick", -2.5, 2.5, 2.6, -3.5, [])),
              *turned(wall_z("white", -2.5, 2.5, 2.6, 3.4, [])), *furniture(random.Random(11)),
              sphere("globe", (1.6, 1.7, -1.4), .12, 16),
              cylinder("dark", (1.6, .8, -1.4), .02, 1.6, 12)]
    lamps, plates = ceiling_lamps([(-2, 2.58, 1), (2, 2.58, 1), (-2, 2.58, -1), (2, 2.58, -1)], .2, .2, 12.0)
    portals = [{"kind": "portal", "centre": (x, 1.35, -2.5), "across": (1.8, 0, 0), "up": (0, 1.9, 0)}
               for x in (-1.9, 1.5)]
    spot = {"kind": "spot", "centre": (0, 2.5, .5), "direction": (-.3, -1, -.4), "half_angle": 25,
            "intensity": 3.0}
    kinds = {"globe": {"kind": "glow", "radiance": (12, 9, 6)}}
    return {"meshes": meshes + plates, "materials": {**materials(*DIFFUSE), **kinds},
            "lights": [*lamps, *portals, spot], "background": .8,
            "camera": camera((3.1, 1.5, 2.1), (-.9, .9, -.8), 1.5)}


def fog():
    """A closed hall full of fog, with a spot and two lamps."""
    meshes = shell(3, 3, 3) + [*table(0, 0, .8, .5, .75), *chair(.4, .9),
                               box("brick", (-1.8, 0, -1.4), (-1.4, 1.8, -1.0), 20),
                               sphere("white", (-.2, .95, 0), .2, 32)]
    lamps, plates = ceiling_lamps([(-1.5, 2.97, -1.5), (1.5, 2.97, .5)], .4, .4, 6.0)
    spot = {"kind": "spot", "centre": (2.5, 2.8, -2.5), "direction": (-1, -.9, .9), "half_angle": 18,
            "intensity": 30.0}
    return {"meshes": meshes + plates, "materials": materials(*DIFFUSE), "lights": [*lamps, spot],
            "background": 0.0, "fog": .15, "camera": camera((2.6, 1.6, 2.6), (-.6, 1.0, -.6), 1.4)}


def mist():
    """A hall with 64 lamps of different strengths and twelve spots in thin fog."""
    rng = random.Random(9)
    meshes = shell(9, 4, 7)
    for x, z in ((-5, -3), (0, -3.5), (4.5, -2), (-4, 2.5), (2, 3)):
        meshes += [*table(x, z, 1.2, .6, .75), *chair(x + .3, z + .9)]
    meshes += [box("brick", (-7, 0, -5), (-6.4, 3, -4.4)), box("brick", (6, 0, -5), (6.6, 3, -4.4))]
    lamps = []
    for i in range(64):
        x, z = -8 + 16 * (i % 8 + .5) / 8, -6 + 12 * (i // 8 + .5) / 8
        found, plates = ceiling_lamps([(x, 3.97, z)], .2, .2, rng.choice((.5, 1, 2, 12)) * 6)
        lamps += found
        meshes += plates
    for k in range(12):
        lamps.append({"kind": "spot", "centre": (-7.5 + 1.4 * k, 3.8, 5 - 10 * (k % 2)), "half_angle": 14,
                      "direction": (rng.uniform(-.5, .5), -1, rng.uniform(-.5, .5)), "intensity": 25.0})
    return {"meshes": meshes, "materials": materials(*DIFFUSE), "lights": lamps, "background": 0.0,
            "fog": .06, "camera": camera((8, 1.7, 6), (-2, 1.6, -2), 1.4)}


def frosted():
    """A bathroom whose lamp stands behind a partition of frosted glass, before a brushed wall."""
    meshes = shell(2.2, 2.6, 2.2) + [
        box("glass", (-2.2, 0, -.6), (.9, 2.2, -.58)), box("cloth", (-1.6, 0, -2.0), (-.2, .55, -1.2)),
        box("floor", (.2, 0, 1.0), (1.4, .5, 1.8)), sphere("plastic", (.7, .7, 1.3), .2, 32),
        quad("steel", (2.19, .6, 2.0), (2.19, .6, -.2), (2.19, 1.9, -.2), (2.19, 1.9, 2.0))]
    lamps, plates = ceiling_lamps([(-.8, 2.58, -1.5)], .5, .5, 25.0)
    more, dim = ceiling_lamps([(.8, 2.58, 1.2)], .3, .3, 5.0)
    kinds = {"glass": {"kind": "frosted", "ior": 1.5, "roughness": .4},
             "steel": {"kind": "brushed", "colour": (.8, .8, .82), "roughness": .4, "ratio": 4.0},
             "plastic": {"kind": "plastic", "diffuse": (.1, .3, .5), "roughness": .3}}
    return {"meshes": meshes + plates + dim, "materials": {**materials(*DIFFUSE), **kinds},
            "lights": lamps + more, "background": 0.0, "bounces": 12,
            "camera": camera((1.6, 1.6, 2.0), (-.7, 1.0, -.6), 1.5)}


def atrium():
    """A court of 14 m under a roof of panes, with galleries and plants, under sun and sky."""
    rng = random.Random(6)
    meshes = [quad("floor", (-10, 0, 14), (10, 0, 14), (10, 0, -14), (-10, 0, -14)),
              box("white", (-10.2, 0, -14), (-10, 14, 14)), box("white", (10, 0, -14), (10.2, 14, 14)),
              box("brick", (-10, 0, -14.2), (10, 14, -14)), box("white", (-10, 0, 14), (10, 14, 14.2))]
    for level in (3.5, 7.0, 10.5):
        for side in (-1, 1):
            x0, x1 = sorted((side * 10, side * 7))
            meshes += [box("white", (x0, level, -14), (x1, level + .3, 14)),
                       box("dark", (side * 7 - .03, level + .3, -14), (side * 7 + .03, level + 1.3, 14))]
    for i in range(5):
        for j in range(7):
            x, z = -10 + 4 * i, -14 + 4 * j
            meshes += [box("pane", (x + .1, 14.1, z + .1), (x + 3.9, 14.12, z + 3.9)),
                       box("dark", (x, 14, z), (x + .1, 14.3, z + 4)),
                       box("dark", (x, 14, z), (x + 4, 14.3, z + .1))]
    crowns = []
    for x, z in ((-4, -8), (3, -9), (-3, 2), (4, 0)):
        meshes += [cylinder("floor", (x, 1.2, z), .1, 2.4, 16), box("brick", (x - .6, 0, z - .6), (x + .6, .5, z + .6))]
        crowns += leaves((x, 3.4, z), (1.3, 1.4, 1.3), 6000, rng)
    meshes.append({"material": "leaf", "vertices": crowns,
                   "faces": [(i, i + 1, i + 2) for i in range(0, len(crowns), 3)]})
    kinds = {"pane": {"kind": "glass", "ior": 1.5, "straight": True},
             "leaf": {"kind": "diffuse", "diffuse": (.12, .3, .06)}}
    sun = {"kind": "sun", "direction": (.45, -.8, -.3), "albedo_one": 4.0}
    return {"meshes": meshes, "materials": {**materials(*DIFFUSE), **kinds}, "lights": [sun],
            "background": 1.0, "bounces": 12, "camera": camera((2, 1.7, 12.5), (-.5, 4.2, -4), 1.4)}


def moving():
    """A workshop under sun and sky through a wide door: a fan, a falling ball, a sliding door, a cart."""
    meshes = [quad("floor", (-6, 0, 6), (6, 0, 6), (6, 0, -6), (-6, 0, -6)),
              box("white", (-4, 3, -4), (4, 3.2, 4)), box("brick", (-4.2, 0, -4), (-4, 3, 4)),
              box("white", (4, 0, -4), (4.2, 3, 4)), *wall_z("white", -4, 4, 3, -4, [(-3, 2, .05, 2.6)]),
              *table(1.5, -1, 1.4, .7, .8), *chair(1.6, .4)]
    for k in range(3):  # a fan below the ceiling
        blade = box("dark", (.15, -.01, -.12), (1.2, .01, .12))
        c, s = math.cos(k * 2.0944), math.sin(k * 2.0944)
        blade["vertices"] = [(c * x + s * z, y, c * z - s * x) for x, y, z in blade["vertices"]]
        meshes.append({**blade, "motion": {"centre": (0, 2.6, -.5), "turn": 50}})
    meshes += [{**sphere("gold", (0, 0, 0), .22, 48), "motion": {"centre": (-.6, 1.3, .8), "by": (.1, -.5, 0)}},
               {**box("plastic", (-.6, -1.2, -.03), (.6, 1.2, .03)),
                "motion": {"centre": (-1.2, 1.25, -3.8), "by": (.7, 0, 0)}},
               {**box("cloth", (-.4, -.25, -.3), (.4, .25, .3), 20),
                "motion": {"centre": (-2, .3, -1.2), "by": (.5, 0, .3), "turn": -25}},
               {**cylinder("dark", (0, 0, 0), .25, .5, 48), "motion": {"centre": (.4, .25, 1.5), "turn": 90}},
               {**box("globe", (-.3, -.04, -.04), (.3, .04, .04)),
                "motion": {"centre": (1.5, 1.9, -1), "by": (0, 0, .5), "turn": 40}}]
    kinds = {"gold": {"kind": "metal", "colour": (.95, .7, .35), "roughness": .3},
             "plastic": {"kind": "plastic", "diffuse": (.1, .3, .5), "roughness": .4},
             "globe": {"kind": "glow", "radiance": (30, 24, 16)}}
    sun = {"kind": "sun", "direction": (.3, -.7, .8), "albedo_one": 4.0}
    return {"meshes": meshes, "materials": {**materials(*DIFFUSE), **kinds}, "lights": [sun],
            "background": 1.0, "camera": camera((2.6, 1.7, 3.6), (-.6, 1.2, -.8), 1.5)}


def passing():
    """The workshop as a camera sees it that moves sideways and forward."""
    scene = moving()
    scene["camera"]["by"] = (-.25, .1, -.3)
    return scene
