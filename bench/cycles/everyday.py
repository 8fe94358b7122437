# SPDX-License-Identifier: Apache-2.0
"""Five scenes for the comparison that nothing was tuned for, as data in the form of scenes.py."""
import math
import random

from interiors import DIFFUSE, chair, furniture, materials, shell, table
from scenes import back_plate, box, camera, cylinder, quad, sphere


def ceiling_lamps(places, width, depth, radiance):
    """Rectangles that shine down, and their plates."""
    lamps = [{"kind": "area", "centre": p, "across": (width, 0, 0), "up": (0, 0, depth),
              "radiance": radiance} for p in places]
    return lamps, [dict(back_plate(lamp), material="dark") for lamp in lamps]


def scaled(scene, factor):
    """Everything `factor` times as large, with the same radiances."""
    def enlarged(v):
        return tuple(c * factor for c in v)
    for m in scene["meshes"]:
        m["vertices"] = [enlarged(v) for v in m["vertices"]]
    for part in (*scene["lights"], scene["camera"]):
        part.update({k: enlarged(v) for k, v in part.items()
                     if k in ("centre", "across", "up", "position", "target")})
    return scene


def ring(material, centre, radius, thickness, around=64, across=32):
    """A torus that lies flat, with smooth normals."""
    vertices, normals, faces = [], [], []
    for i in range(around):
        a = 2 * math.pi * i / around
        for j in range(across):
            b = 2 * math.pi * j / across
            n = (math.cos(b) * math.cos(a), math.sin(b), -math.cos(b) * math.sin(a))
            vertices.append((centre[0] + radius * math.cos(a) + thickness * n[0],
                             centre[1] + thickness * n[1],
                             centre[2] - radius * math.sin(a) + thickness * n[2]))
            normals.append(n)
            k, c = (i + 1) % around, (j + 1) % across
            faces.append((i * across + j, k * across + j, k * across + c, i * across + c))
    return {"material": material, "vertices": vertices, "faces": faces, "normals": normals}


def kitchen():
    """Three ceiling lamps, glossy fronts and steel; in centimetres."""
    rest = {"front": {"kind": "plastic", "diffuse": (.55, .5, .42), "roughness": .35},
            "steel": {"kind": "metal", "colour": (.8, .8, .82), "roughness": .5}}
    lamps, plates = ceiling_lamps([(x, 2.49, .2) for x in (-1.3, 0, 1.3)], .5, .3, 25.0)
    meshes = shell(2.2, 2.5, 1.8) + plates
    for k in range(5):
        x = -2.1 + .62 * k
        meshes += [box("front", (x, .1, -1.75), (x + .6, .9, -1.2)),
                   box("front", (x, 1.5, -1.78), (x + .6, 2.2, -1.45))]
    meshes += [box("white", (-2.1, .9, -1.78), (1.0, .94, -1.18)),
               box("steel", (1.1, 0, -1.75), (1.8, 1.9, -1.1)),
               sphere("steel", (-1.0, 1.06, -1.4), .12, 32), *table(.3, .4, .6, .4, .75, 12),
               *chair(.2, 1.0)]
    return scaled({"meshes": meshes, "materials": {**materials(*DIFFUSE), **rest}, "lights": lamps,
                   "background": 0.0, "camera": camera((2.0, 1.6, 1.7), (-.6, .95, -.9), 1.5)}, 100.0)


def product():
    """Rings of metal, a ball of glass and one of plastic on a glossy floor under the probe."""
    glossy = {"floor": {"kind": "plastic", "diffuse": (.6, .6, .6), "roughness": .4},
              "gold": {"kind": "metal", "colour": (.95, .7, .35), "roughness": .3},
              "steel": {"kind": "metal", "colour": (.7, .7, .72), "roughness": .6},
              "red": {"kind": "plastic", "diffuse": (.5, .04, .03), "roughness": .2},
              "glass": {"kind": "glass", "ior": 1.5, "straight": True}}
    meshes = [quad("floor", (-6, 0, 6), (6, 0, 6), (6, 0, -6), (-6, 0, -6)),
              ring("gold", (-1.2, .3, .3), .7, .3), ring("steel", (1.2, .25, .5), .6, .25),
              sphere("red", (0, .6, -1.0), .6), sphere("glass", (.1, .45, .9), .45, 64)]
    return {"meshes": meshes, "materials": glossy, "lights": [], "probe": True, "background": 1.0,
            "bounces": 12, "camera": camera((0, 2.4, 5), (0, .4, 0), .8)}


def places(centre, radius, count, rng):
    """Random points in an ellipsoid, each with two random vectors."""
    while count > 0:
        p = [rng.uniform(-1, 1) for _ in range(3)]
        if sum(c * c for c in p) >= 1:
            continue
        count -= 1
        yield ([c + r * q for c, r, q in zip(centre, radius, p)],
               *([rng.gauss(0, 1) for _ in range(3)] for _ in range(2)))


def of_length(length, v):
    return [length * c / math.sqrt(sum(q * q for q in v)) for c in v]


def leaves(centre, radius, count, rng):
    """Triangles of .1 m in an ellipsoid, as vertices."""
    found = []
    for middle, a, b in places(centre, radius, count, rng):
        a, b = of_length(.06, a), of_length(.06, b)
        found += [tuple(m - c for m, c in zip(middle, a)), tuple(m + c for m, c in zip(middle, a)),
                  tuple(m + c for m, c in zip(middle, b))]
    return found


def street():
    """Houses with glossy windows, and ten trees of 18,000 leaves, under sun and even sky."""
    rng = random.Random(5)
    rest = {"leaf": {"kind": "diffuse", "diffuse": (.12, .3, .06)},
            "pane": {"kind": "plastic", "diffuse": (.03, .03, .04), "roughness": .1},
            "ground": {"kind": "diffuse", "diffuse": (.3, .3, .3)}}
    meshes = [quad("ground", (-60, 0, 60), (60, 0, 60), (60, 0, -60), (-60, 0, -60))]
    for k in range(8):
        left, high = -36 + 9 * k, 5 + 4 * rng.random()
        meshes.append(box("white" if k % 2 else "brick", (left, 0, -14), (left + 8, high, -6)))
        for i in range(4):
            for j in range(int(high // 2.5)):
                x0, x1, y = left + .6 + 1.9 * i, left + 1.9 + 1.9 * i, .8 + 2.4 * j
                meshes.append(quad("pane", (x0, y, -5.98), (x1, y, -5.98), (x1, y + 1.5, -5.98),
                                   (x0, y + 1.5, -5.98)))
    crowns = []
    for k in range(10):
        x, z = -30 + 6.5 * k, 2 + 3 * rng.random()
        meshes.append(cylinder("floor", (x, 1.5, z), .15, 3, 16))
        crowns += leaves((x, 4, z), (1.9, 1.7, 1.9), 18000, rng)
    meshes.append({"material": "leaf", "vertices": crowns,
                   "faces": [(i, i + 1, i + 2) for i in range(0, len(crowns), 3)]})
    sun = {"kind": "sun", "direction": (.4, -.7, -.55), "albedo_one": 3.0}
    return {"meshes": meshes, "lights": [sun], "background": 1.0,
            "materials": {**materials(*DIFFUSE), **rest},
            "camera": camera((4, 2.2, 24), (-2, 4, 0), 1.2)}


def office():
    """A large room with 28 ceiling lamps and eight desks."""
    lamps, plates = ceiling_lamps([(-6 + 2.0 * i, 2.78, -3 + 2.0 * j) for i in range(7)
                                   for j in range(4)], .6, .6, 6.0)
    meshes = shell(7.0, 2.8, 4.0) + plates
    for i in range(4):
        for j in range(2):
            x, z = -4.5 + 3 * i, -1.6 + 3 * j
            meshes += [*table(x, z, .8, .4, .74), *chair(x, z + .6),
                       box("dark", (x - .3, .74, z - .2), (x + .3, 1.2, z - .17))]
    return {"meshes": meshes, "materials": materials(*DIFFUSE), "lights": lamps, "background": 0.0,
            "camera": camera((6.5, 1.6, 3.6), (-1, 1.0, -1), 1.4)}


def loft():
    """Sun and even sky through a portal on a glossy floor and furniture."""
    meshes = shell(3.0, 2.6, 2.0, (-1.8, .8, .8, 2.2)) + furniture(random.Random(3))
    meshes[0]["material"] = "parquet"
    rest = {"parquet": {"kind": "plastic", "diffuse": (.4, .28, .17), "roughness": .45}}
    sun = {"kind": "sun", "direction": (.35, -.62, .7), "albedo_one": 8.0}
    portal = {"kind": "portal", "centre": (-.5, 1.5, -2.0), "across": (2.6, 0, 0), "up": (0, 1.4, 0)}
    return {"meshes": meshes, "materials": {**materials(*DIFFUSE), **rest}, "lights": [sun, portal],
            "background": 2.0, "camera": camera((2.7, 1.5, 1.85), (-.9, .9, -.7), 1.5)}


def with_places(mesh):
    """Texture coordinates of a picture of 1 m on slanted planes."""
    mesh["uvs"] = [(x + .37 * y + .11 * z, z + .43 * y + .05 * x) for x, y, z in mesh["vertices"]]
    return mesh


def papered():
    """A furnished room in which every surface has a picture, under sun and sky."""
    meshes = shell(2.6, 2.6, 2.0, (-1.5, .8, .8, 2.2)) + furniture(random.Random(8))
    surfaces = materials(*DIFFUSE)
    surfaces["floor"] = {"kind": "plastic", "diffuse": DIFFUSE["floor"], "roughness": .4}
    for name, m in surfaces.items():
        m["picture"] = name + "_paper"
    sun = {"kind": "sun", "direction": (.35, -.6, .7), "albedo_one": 8.0}
    return {"meshes": [with_places(m) for m in meshes], "materials": surfaces, "lights": [sun],
            "pictures": {name + "_paper": DIFFUSE[name] for name in surfaces},
            "background": 2.0, "camera": camera((2.3, 1.5, 1.8), (-.9, .9, -.7), 1.5)}


def cards(centre, radius, count, rng):
    """Squares of .2 m in an ellipsoid, as vertices."""
    found = []
    for middle, a, b in places(centre, radius, count, rng):
        along = sum(x * y for x, y in zip(a, b)) / sum(x * x for x in a)
        b = [y - along * x for x, y in zip(a, b)]
        a, b = of_length(.1, a), of_length(.1, b)
        found += [tuple(m + i * p + j * q for m, p, q in zip(middle, a, b))
                  for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return found


def park():
    """Trees whose leaves are cut out of squares by a picture, under sun and even sky."""
    rng = random.Random(9)
    rest = {"leaf": {"kind": "diffuse", "diffuse": (.15, .35, .07), "cut_out": "leaf_shape"},
            "ground": {"kind": "diffuse", "diffuse": (.2, .3, .1)}}
    meshes = [quad("ground", (-60, 0, 60), (60, 0, 60), (60, 0, -60), (-60, 0, -60)),
              box("white", (-6, 0, -14), (6, 6, -8))]
    crowns = []
    for k in range(12):
        x, z = -16 + 3 * k, -4 + 9 * rng.random()
        meshes.append(cylinder("floor", (x, 1.2, z), .15, 2.4, 16))
        crowns += cards((x, 3.6, z), (1.8, 1.8, 1.8), 4000, rng)
    meshes.append({"material": "leaf", "vertices": crowns,
                   "uvs": [(0, 0), (1, 0), (1, 1), (0, 1)] * (len(crowns) // 4),
                   "faces": [tuple(range(i, i + 4)) for i in range(0, len(crowns), 4)]})
    sun = {"kind": "sun", "direction": (.4, -.7, -.55), "albedo_one": 3.0}
    return {"meshes": meshes, "lights": [sun], "background": 1.0, "pictures": {"leaf_shape": "leaf"},
            "materials": {**materials(*DIFFUSE), **rest},
            "camera": camera((4, 2.2, 18), (-1, 2.8, 0), 1.2)}
