# SPDX-License-Identifier: Apache-2.0
"""Three interiors for the comparison, as data in the form of scenes.py.

Further keys of a scene: `sky` (physical sun and sky), `profile` (intensities in candela, for lights
of the kind `profile`). Further lights: `profile` shines its profile down, `spot` shines with an even
intensity inside a cone. Further materials: `mirror`; `glass` with `straight` casts transparent shadows.
"""
import math
import random

from scenes import box, camera, cylinder, quad, sphere

DIFFUSE = {"white": (.75, .74, .7), "floor": (.4, .28, .17), "cloth": (.2, .27, .35),
           "shade": (.7, .6, .45), "brick": (.5, .25, .18), "dark": (.06, .06, .07)}


def materials(*names):
    return {n: {"kind": "diffuse", "diffuse": DIFFUSE[n]} for n in names}


def shell(x, y, z, window=None):
    """Walls of a room 2x by y by 2z. `window` = (x0, x1, y0, y1) in the wall at -z."""
    walls = [quad("floor", (-x, 0, z), (x, 0, z), (x, 0, -z), (-x, 0, -z)),
             quad("white", (-x, y, -z), (x, y, -z), (x, y, z), (-x, y, z)),
             quad("white", (x, 0, z), (-x, 0, z), (-x, y, z), (x, y, z)),
             quad("brick", (-x, 0, z), (-x, 0, -z), (-x, y, -z), (-x, y, z)),
             quad("white", (x, 0, -z), (x, 0, z), (x, y, z), (x, y, -z))]
    x0, x1, y0, y1 = window or (-x, -x, y, y)
    for a, b, c, d in ((-x, x0, 0, y), (x1, x, 0, y), (x0, x1, 0, y0), (x0, x1, y1, y)):
        if b > a and d > c:
            walls.append(quad("white", (a, c, -z), (b, c, -z), (b, d, -z), (a, d, -z)))
    return walls


def table(x, z, w, d, h, degrees=0.0):
    """A top on four legs; turned about its middle."""
    parts = [box("floor", (x - w, h - .04, z - d), (x + w, h, z + d), degrees)]
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    for lx in (-w + .05, w - .05):
        for lz in (-d + .05, d - .05):
            px, pz = x + c * lx + s * lz, z - s * lx + c * lz
            parts.append(box("dark", (px - .025, 0, pz - .025), (px + .025, h - .04, pz + .025),
                             degrees))
    return parts


def chair(x, z):
    parts = table(x, z, .22, .22, .45)
    return [*parts, box("cloth", (x - .22, .45, z + .18), (x + .22, .95, z + .22))]


def shelf(x, z, rng):
    """Five boards with books, against the wall at z."""
    parts = []
    for k in range(5):
        y = .2 + .4 * k
        parts.append(box("floor", (x, y - .03, z), (x + 1.4, y, z + .3)))
        at = x + .02
        while at < x + 1.3:
            wide, high = rng.uniform(.02, .06), rng.uniform(.2, .32)
            parts.append(box(rng.choice(("brick", "cloth", "shade")), (at, y, z + .02),
                             (at + wide, y + high, z + rng.uniform(.2, .26))))
            at += wide + rng.choice((.002, .002, .15))
    return parts


def furniture(rng):
    parts = table(.5, -.3, .9, .45, .75)
    for x, z in ((0, .35), (1, .35), (0, -1.1), (1, -1.1)):
        parts += chair(x, z)
    parts += [box("cloth", (-2.8, .1, -.8), (-1.9, .42, 1.2)),
              box("cloth", (-2.9, .1, -.8), (-2.65, .85, 1.2)), *table(-1.2, .2, .3, .5, .4, 8)]
    parts += shelf(1.3, -1.98, rng)
    return [*parts, sphere("white", (.6, .87, -.3), .12, 24), sphere("brick", (-1.2, .5, .2), .1, 24)]


def day_room():
    """Furnished room with physical sun and sky through a window without a portal."""
    meshes = shell(3.0, 2.6, 2.0, (-1.8, .8, .8, 2.2)) + furniture(random.Random(3))
    return {"meshes": meshes, "materials": materials(*DIFFUSE), "lights": [], "background": 1.0,
            "sky": {"to_sun": (-.35, .62, -.7), "haze": 1.0},
            "camera": camera((2.7, 1.5, 1.85), (-.9, .9, -.7), 1.5)}


def candela(degrees):
    """A downlight: a lobe with a shoulder, dark from the horizontal on."""
    c = math.cos(math.radians(min(degrees, 90)))
    return 60 * c ** 1.5 + 240 * c ** 12


def night_room():
    """Forty profile lamps in lampshades: a grid below the ceiling and rows on the walls."""
    meshes = shell(3.0, 2.6, 2.0) + furniture(random.Random(3))
    places = [(-2.6 + 1.04 * i, 2.2, -1.6 + .8 * j) for i in range(6) for j in range(5)]
    places += [(-2.5 + 1.25 * i, 1.5, side * 1.8) for i in range(5) for side in (-1, 1)]
    lights = []
    for x, y, z in places:
        meshes.append(cylinder("shade", (x, y - .12, z), .09, .2))
        lights.append({"kind": "profile", "centre": (x, y, z), "factor": .02})
    return {"meshes": meshes, "materials": materials(*DIFFUSE), "lights": lights, "background": 0.0,
            "profile": [candela(5 * i) if i < 18 else 0.0 for i in range(37)],
            "camera": camera((2.7, 1.6, 1.7), (-.9, .9, -.6), 1.5)}


def bathroom():
    """Mirrors, a shower of glass, spot lights in the ceiling; shadows of glass are transparent."""
    x, y, z = 1.6, 2.4, 1.4
    meshes = shell(x, y, z)
    meshes += [quad("mirror", (-1.2, 1.0, -1.39), (.2, 1.0, -1.39), (.2, 2.1, -1.39), (-1.2, 2.1, -1.39)),
               quad("mirror", (-1.59, .9, .9), (-1.59, .9, -.9), (-1.59, 2.0, -.9), (-1.59, 2.0, .9)),
               box("white", (-1.2, .6, -1.38), (.2, .85, -.95)), sphere("white", (-.5, .95, -1.1), .12, 32),
               box("glass", (.55, .05, -1.35), (.57, 2.0, .0)), box("glass", (.6, .05, .0), (1.59, 2.0, .02)),
               box("dark", (.6, .02, -1.35), (1.58, .05, -.05)), sphere("metal", (1.1, 1.9, -.8), .1, 32),
               box("cloth", (-1.5, .0, .2), (-1.1, .5, .8)), cylinder("brick", (-.5, .25, .3), .2, .5)]
    spots = [{"kind": "spot", "centre": (a, 2.35, b), "direction": (.1, -1, .08), "half_angle": 38.0,
              "intensity": 6.0} for a in (-1.0, .0, 1.1) for b in (-.7, .5)]
    rest = {"mirror": {"kind": "mirror", "colour": (.9, .9, .9)},
            "metal": {"kind": "metal", "colour": (.75, .75, .77), "roughness": .3},
            "glass": {"kind": "glass", "ior": 1.5, "straight": True}}
    return {"meshes": meshes, "materials": {**materials(*DIFFUSE), **rest}, "lights": spots,
            "background": 0.0, "bounces": 12, "camera": camera((-.2, 1.55, 1.3), (.1, 1.05, -.9), 1.7)}
