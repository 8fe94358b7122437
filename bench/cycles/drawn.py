# SPDX-License-Identifier: Apache-2.0
"""Scenes that a random generator draws, as data in the form of scenes.py.

A scene is a room with or without windows, a studio, or a place outdoors; its size, lights, furniture, materials
and view are drawn. Nothing overlaps glass, which would be another scene in each program.
"""
import colorsys
import math
import random

from everyday import ceiling_lamps, leaves, ring
from homes import turned, wall_z
from interiors import DIFFUSE, furniture, materials
from scenes import box, camera, cylinder, quad, sphere


def colour(rng, darkest=.1, brightest=.85):
    return colorsys.hsv_to_rgb(rng.random(), rng.random() ** 2, rng.uniform(darkest, brightest))


def surface(rng, kinds):
    kind = rng.choice(kinds)
    drawn = {"kind": kind}
    if kind in ("diffuse", "plastic"):
        drawn["diffuse"] = colour(rng)
    if kind in ("metal", "mirror"):
        drawn["colour"] = colour(rng, .5, .95)
    if kind in ("metal", "plastic"):
        drawn["roughness"] = rng.uniform(.12, .6)
    if kind == "glass":
        drawn.update(ior=rng.uniform(1.3, 1.7), straight=rng.random() < .5)
    if kind == "glow":
        level = 10 ** rng.uniform(-.3, 1)
        drawn["radiance"] = tuple(level * c for c in colour(rng, .8, 1))
    return drawn


def objects(rng, half_x, half_z, size):
    """Solids that stand apart on the ground, each of a material of its own."""
    kinds, meshes, taken = {}, [], []
    often = rng.choice((["diffuse"], ["diffuse", "diffuse", "plastic"],
                        ["diffuse", "plastic", "metal", "glass"],
                        ["diffuse", "diffuse", "metal", "mirror", "glass", "glow"]))
    for k in range(rng.randint(3, 14)):
        r = size * rng.uniform(.3, 1)
        x, z = rng.uniform(r - half_x, half_x - r), rng.uniform(r - half_z, half_z - r)
        if any(math.hypot(x - a, z - b) < 1.5 * (r + s) for a, b, s in taken):
            continue
        taken.append((x, z, r))
        name = f"own{k}"
        kinds[name] = surface(rng, often)
        shape, above = rng.choice(("box", "box", "sphere", "post", "ring")), .002
        if shape == "box":
            high = r * rng.uniform(.5, 3)
            meshes.append(box(name, (x - r * .7, above, z - r * .7), (x + r * .7, above + high, z + r * .7),
                              rng.uniform(0, 90)))
        elif shape == "sphere":
            meshes.append(sphere(name, (x, above + r, z), r, 48))
        elif shape == "ring":
            meshes.append(ring(name, (x, above + r * .3, z), r * .7, r * .3))
        else:
            kinds[name] = surface(rng, ["diffuse", "plastic", "metal"])
            meshes.append(cylinder(name, (x, above + r, z), r * .5, 2 * r))
    return kinds, meshes


def daylight(rng, scene, towards):
    """Sun and sky, or an even sky with or without a sun that stands towards (x, z)."""
    x, z = towards[0] + rng.uniform(-.8, .8), towards[1] + rng.uniform(-.8, .8)
    high = math.hypot(x, z) * math.tan(math.radians(rng.uniform(12, 65)))
    kind = rng.choice(("physical", "physical", "even", "sun"))
    scene["background"] = 1.0
    if kind == "physical":
        scene["sky"] = {"to_sun": (x, high, z), "haze": rng.choice((0.0, 1.0, 4.0))}
    elif kind == "even":
        scene["background"] = rng.uniform(1, 8)
    else:
        scene["background"] = rng.uniform(.2, 2)
        scene["lights"].append({"kind": "sun", "direction": (-x, -high, -z),
                                "albedo_one": rng.uniform(2, 12)})


def room(rng):
    half_x, half_z, high = rng.uniform(1.6, 4), rng.uniform(1.6, 4), rng.uniform(2.3, 3.6)
    windows = rng.choice((0, 1, 1, 2))
    scene = {"lights": [], "background": 0.0, "materials": materials(*DIFFUSE)}
    portals = rng.random() < .4
    holes = []
    for k in range(windows):
        wide = 2 * half_x / windows
        left = -half_x + k * wide + wide * rng.uniform(.1, .4)
        holes.append((left, left + wide * rng.uniform(.2, .5), rng.choice((0, .8)), high - rng.uniform(.2, .6)))
    for a, b, c, d in holes if portals else ():
        scene["lights"].append({"kind": "portal", "centre": ((a + b) / 2, (c + d) / 2, -half_z),
                                "across": (b - a, 0, 0), "up": (0, d - c, 0)})
    if windows:
        daylight(rng, scene, (0, -1))
    plates = []
    if not windows or rng.random() < .4:
        n, side = rng.randint(1, 3), rng.uniform(.15, .9)
        places = [((2 * i + 1 - n) * half_x / n, high - .02, (2 * j + 1 - n) * half_z / n)
                  for i in range(n) for j in range(n)]
        lamps, plates = ceiling_lamps(places, side, side * rng.uniform(.3, 1), 8 / (n * n * side * side))
        scene["lights"] += lamps
    if rng.random() < .25:
        scene["lights"].append({"kind": "spot", "centre": (0, high - .1, 0), "half_angle": rng.uniform(12, 40),
                                "direction": (rng.uniform(-1, 1), -1, rng.uniform(-1, 1)),
                                "intensity": rng.uniform(1, 6)})
    meshes = [box("floor", (-half_x, -.1, -half_z), (half_x, 0, half_z)),
              box("white", (-half_x, high, -half_z), (half_x, high + .1, half_z)),
              *wall_z("white", -half_x, half_x, high, -half_z, holes),
              *wall_z("white", -half_x, half_x, high, half_z - .1, []),
              *turned(wall_z("brick", -half_z, half_z, high, -half_x, [])),
              *turned(wall_z("white", -half_z, half_z, high, half_x - .1, []))]
    scene["materials"]["floor"] = surface(rng, ["diffuse", "diffuse", "plastic"])
    scene["materials"]["floor"].setdefault("diffuse", DIFFUSE["floor"])
    if half_x > 3 and half_z > 2 and rng.random() < .5:
        more, own = furniture(rng), {}
        meshes += [m for m in more if all(abs(v[2]) < half_z - .1 for v in m["vertices"])]
    else:
        own, more = objects(rng, half_x - .2, half_z - .2, .3 * min(half_x, half_z))
        meshes += more
    scene["materials"].update(own)
    side = rng.choice((-1, 1))
    view = camera((side * (half_x - .3), rng.uniform(1.2, 1.8), half_z - .3),
                  (-side * half_x * rng.uniform(.1, .6), rng.uniform(.6, 1.2), -half_z * rng.uniform(.3, .8)),
                  rng.uniform(1, 1.7))
    return {**scene, "meshes": meshes + plates, "camera": view}


def studio(rng):
    kinds, meshes = objects(rng, 2, 1.5, .5)
    kinds["floor"] = surface(rng, ["diffuse", "diffuse", "plastic", "metal"])
    meshes.append(quad("floor", (-6, 0, 6), (6, 0, 6), (6, 0, -6), (-6, 0, -6)))
    scene = {"lights": [], "background": rng.choice((0.0, .1, .5))}
    if rng.random() < .5:
        scene.update(probe=True, background=1.0)
    for _ in range(0 if "probe" in scene else rng.randint(1, 3)):
        side, x = rng.uniform(.3, 1.5), rng.uniform(-2.5, 2.5)
        scene["lights"].append({"kind": "area", "centre": (x, rng.uniform(2.5, 4), rng.uniform(-1, 2)),
                                "across": (side, 0, 0), "up": (0, 0, side), "radiance": 12 / side ** 2})
    view = camera((rng.uniform(-2, 2), rng.uniform(.8, 3), 5), (0, .4, 0), rng.uniform(.6, 1.1))
    if rng.random() < .3:
        view["lens"] = (rng.uniform(.01, .06), 5.0)
    return {**scene, "meshes": meshes, "materials": kinds, "camera": view}


def outdoors(rng):
    kinds, meshes = objects(rng, 14, 10, 2.2)
    kinds["ground"] = {"kind": "diffuse", "diffuse": colour(rng, .15, .5)}
    kinds["leaf"] = {"kind": "diffuse", "diffuse": (.12, .25, .06)}
    n, side, a, b = 300, 60.0, rng.uniform(.1, .9), rng.uniform(.1, .9)

    def height(x, z):
        return -.02 - .4 * (1 + math.sin(a * x) * math.cos(b * z)) * min(1, (abs(x) + abs(z)) / 30)
    vertices = [(x, height(x, z), z) for x, z in ((side * (i / n - .5), side * (.5 - j / n))
                                                  for j in range(n + 1) for i in range(n + 1))]
    faces = [(k, k + 1, k + n + 2, k + n + 1) for k in (j * (n + 1) + i for j in range(n) for i in range(n))]
    meshes.append({"material": "ground", "vertices": vertices, "faces": faces})
    for _ in range(rng.choice((0, 0, 3, 8))):
        x, z = rng.uniform(-14, 14), rng.uniform(-14, -11)
        found = leaves((x, rng.uniform(3, 5), z), (1.8, 2.2, 1.8), 12000, rng)
        meshes.append({"material": "leaf", "vertices": found,
                       "faces": [(k, k + 1, k + 2) for k in range(0, len(found), 3)]})
    scene = {"lights": [], "meshes": meshes, "materials": kinds}
    daylight(rng, scene, (rng.uniform(-1, 1), rng.uniform(-1, 1)))
    scene["camera"] = camera((rng.uniform(-8, 8), rng.uniform(1.5, 8), 20), (0, 1.5, 0), rng.uniform(.8, 1.4))
    return scene


def scene(number):
    rng = random.Random(number)
    drawn = rng.choice((room, room, room, studio, outdoors))(rng)
    if "sky" in drawn or any(lamp["kind"] in ("sun", "spot") for lamp in drawn["lights"]):
        # Cycles does not find caustics of a light without extent, and hardly those of the sun.
        for glass in (m for m in drawn["materials"].values() if m["kind"] == "glass"):
            glass["straight"] = True
    return drawn
