# SPDX-License-Identifier: Apache-2.0
"""Scenes that two renderers are compared on, as data: geometry, materials, lights, camera.

Metres, y up. A mesh is vertices, faces (their corners counter-clockwise from outside) and a material.
A material has `diffuse` (albedo), or is `metal` or `plastic` with a GGX `roughness` (the root of
alpha), or `glass`. Radiances have no unit: a white wall under a background of 1 all around is 1.
"""
import math

WHITE = {"kind": "diffuse", "diffuse": (.7, .7, .7)}
RED = {"kind": "diffuse", "diffuse": (.6, .06, .06)}
GREEN = {"kind": "diffuse", "diffuse": (.1, .5, .1)}
WOOD = {"kind": "diffuse", "diffuse": (.45, .3, .18)}


def quad(material, *corners):
    return {"material": material, "vertices": list(corners), "faces": [(0, 1, 2, 3)]}


def box(material, low, high, degrees=0.0):
    """Turned about the vertical through its middle."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    cx, cz = (x0 + x1) / 2, (z0 + z1) / 2
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    vertices = []
    for y in (y0, y1):
        for x, z in ((x0, z0), (x1, z0), (x1, z1), (x0, z1)):
            dx, dz = x - cx, z - cz
            vertices.append((cx + c * dx + s * dz, y, cz - s * dx + c * dz))
    faces = [(0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]
    return {"material": material, "vertices": vertices, "faces": faces}


def sphere(material, centre, radius, rings=96):
    """With smooth normals."""
    vertices, faces, columns = [], [], 2 * rings
    for r in range(rings + 1):
        theta = math.pi * r / rings
        for c in range(columns):
            phi = 2 * math.pi * c / columns
            vertices.append((centre[0] + radius * math.sin(theta) * math.cos(phi),
                             centre[1] + radius * math.cos(theta),
                             centre[2] - radius * math.sin(theta) * math.sin(phi)))
    for r in range(rings):
        for c in range(columns):
            a, b = r * columns + c, r * columns + (c + 1) % columns
            corners = [a, a + columns, b + columns, b]
            if r == 0:
                corners = [a, a + columns, b + columns]
            elif r == rings - 1:
                corners = [a, a + columns, b]
            faces.append(tuple(corners))
    return {"material": material, "vertices": vertices, "faces": faces,
            "normals": [tuple((v[i] - centre[i]) / radius for i in range(3)) for v in vertices]}


def cylinder(material, centre, radius, height, columns=48):
    """An open upright tube with smooth normals."""
    vertices, normals, faces = [], [], []
    for c in range(columns):
        x, z = math.cos(2 * math.pi * c / columns), -math.sin(2 * math.pi * c / columns)
        for y in (-height / 2, height / 2):
            vertices.append((centre[0] + radius * x, centre[1] + y, centre[2] + radius * z))
            normals.append((x, 0.0, z))
        d = (c + 1) % columns
        faces.append((2 * c, 2 * d, 2 * d + 1, 2 * c + 1))
    return {"material": material, "vertices": vertices, "faces": faces, "normals": normals}


def back_plate(lamp):
    """A black plate 5 mm above a lamp of the ceiling: lights of Cycles are not opaque."""
    (x, y, z), w, d = lamp["centre"], lamp["across"][0] / 2, lamp["up"][2] / 2
    return quad("black", (x - w, y + .005, z - d), (x + w, y + .005, z - d),
                (x + w, y + .005, z + d), (x - w, y + .005, z + d))


def camera(position, target, width_over_distance):
    """Looks from `position` at `target`; the picture is that much wider than it is far."""
    return {"position": position, "target": target, "width": width_over_distance}


def room(open_front, window):
    """5 x 2.8 x 4, its floor at y = 0; a window 2 x 1.4 in the wall at x = -2.5, if there is one."""
    x, y, z = 2.5, 2.8, 2.0
    walls = [quad("wood", (-x, 0, z), (x, 0, z), (x, 0, -z), (-x, 0, -z)),
             quad("white", (-x, y, -z), (x, y, -z), (x, y, z), (-x, y, z)),
             quad("white", (-x, 0, -z), (x, 0, -z), (x, y, -z), (-x, y, -z)),
             quad("green", (x, 0, -z), (x, 0, z), (x, y, z), (x, y, -z))]
    if not open_front:
        walls.append(quad("white", (x, 0, z), (-x, 0, z), (-x, y, z), (x, y, z)))
    if window:
        lo, hi, w = .8, 2.2, 1.0
        for z0, z1, y0, y1 in ((-z, -w, 0, y), (w, z, 0, y), (-w, w, 0, lo), (-w, w, hi, y)):
            walls.append(quad("red", (-x, y0, z1), (-x, y0, z0), (-x, y1, z0), (-x, y1, z1)))
    else:
        walls.append(quad("red", (-x, 0, z), (-x, 0, -z), (-x, y, -z), (-x, y, z)))
    walls.append(box("white", (-1.4, 0, -1.3), (-.5, 1.7, -.4), 17))
    walls.append(box("white", (.3, 0, -.4), (1.2, .9, .5), -18))
    return walls


ROOM_MATERIALS = {"black": {"kind": "diffuse", "diffuse": (0, 0, 0)},
                  "white": WHITE, "red": RED, "green": GREEN, "wood": WOOD}
PORTAL = {"kind": "portal", "centre": (-2.5, 1.5, 0), "across": (0, 0, -2.0), "up": (0, 1.4, 0)}
ROOM_CAMERA = camera((1.9, 1.5, 1.9), (-.6, 1.1, -1.0), 1.6)


def cornell():
    lamp = {"kind": "area", "centre": (0, 2.79, 0), "across": (1.2, 0, 0), "up": (0, 0, 1.2),
            "radiance": 20.0}
    return {"meshes": [*room(True, False), back_plate(lamp)], "materials": ROOM_MATERIALS, "lights": [lamp],
            "background": 0.0, "camera": camera((0, 1.4, 6.2), (0, 1.4, 0), 1.35)}


def sky_room():
    return {"meshes": room(False, True), "materials": ROOM_MATERIALS, "lights": [PORTAL],
            "background": 6.0, "camera": ROOM_CAMERA}


def sun_room():
    sun = {"kind": "sun", "direction": (.8, -.55, -.25), "albedo_one": 12.0}
    return {"meshes": room(False, True), "materials": ROOM_MATERIALS, "lights": [sun, PORTAL],
            "background": 1.0, "camera": ROOM_CAMERA}


def glossy():
    materials = {"floor": {"kind": "diffuse", "diffuse": (.4, .4, .4)},
                 "metal": {"kind": "metal", "colour": (.9, .75, .5), "roughness": .45},
                 "plastic": {"kind": "plastic", "diffuse": (.3, .05, .05), "roughness": .3}}
    meshes = [quad("floor", (-6, 0, 6), (6, 0, 6), (6, 0, -6), (-6, 0, -6)),
              sphere("metal", (-1.1, 1, 0), 1), sphere("plastic", (1.1, 1, 0), 1)]
    return {"meshes": meshes, "materials": materials, "lights": [], "probe": True,
            "background": 1.0, "camera": camera((0, 2.2, 6), (0, .8, 0), 1.0)}


def glass(straight):
    """Balls of glass under a lamp: transparent shadows, or refracted light (caustics)."""
    materials = dict(ROOM_MATERIALS, glass={"kind": "glass", "ior": 1.5, "straight": straight})
    lamp = {"kind": "area", "centre": (0, 2.79, 0), "across": (2.4, 0, 0), "up": (0, 0, 2.4),
            "radiance": 8.0}
    meshes = room(True, False)[:-2] + [back_plate(lamp), sphere("glass", (-.8, .8, -.4), .7),
                                       sphere("glass", (.9, .5, .5), .45)]
    return {"meshes": meshes, "materials": materials, "lights": [lamp], "background": 0.0,
            "camera": camera((0, 1.4, 6.2), (0, 1.2, 0), 1.2), "bounces": 16}


def exterior():
    """1.28 million triangles of ground under sun and sky, with blocks on it."""
    n, size = 800, 80.0

    def height(x, z):
        return (1.5 * math.sin(.21 * x) * math.cos(.17 * z) + .35 * math.sin(1.3 * x + .4 * z)
                + .08 * math.sin(7.1 * x) * math.sin(6.3 * z))
    vertices = []
    for j in range(n + 1):
        for i in range(n + 1):
            x, z = size * (i / n - .5), size * (.5 - j / n)
            vertices.append((x, height(x, z), z))
    faces = []
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            faces.append((a, a + 1, a + n + 2, a + n + 1))
    meshes = [{"material": "ground", "vertices": vertices, "faces": faces}]
    for k in range(120):
        x, z = size * (((k * .618034) % 1) - .5) * .8, size * (((k * .754878) % 1) - .5) * .8
        w, h = .5 + 2 * ((k * .569840) % 1), 1 + 5 * ((k * .346) % 1)
        meshes.append(box("white", (x - w, height(x, z) - 2, z - w),
                          (x + w, height(x, z) + h, z + w), 360 * ((k * .21) % 1)))
    sun = {"kind": "sun", "direction": (.55, -.6, -.5), "albedo_one": 3.0}
    return {"meshes": meshes, "lights": [sun], "background": 1.0,
            "materials": {"ground": {"kind": "diffuse", "diffuse": (.35, .32, .2)}, "white": WHITE},
            "camera": camera((0, 9, 44), (0, 2, 0), 1.1)}


WIDTH, HEIGHT = 320, 240
BOUNCES = 8
