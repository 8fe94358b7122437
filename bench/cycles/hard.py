# SPDX-License-Identifier: Apache-2.0
"""Two scenes that are hard for paths, after descriptions in the literature, in the form of scenes.py.

`door_ajar`: a room that is lit only through the gap of a door (E. Veach, L. Guibas, "Metropolis Light
Transport", 1997). `pool`: waves focus a small sun on the bottom of a pool, which is seen through them
(T. Mueller, M. Gross, J. Novak, "Practical Path Guiding for Efficient Light-Transport Simulation", 2017).
"""
import math

from interiors import DIFFUSE, materials, shell, table
from scenes import back_plate, box, camera, quad, sphere


def door_ajar():
    width, height, depth, behind = 2.0, 2.6, 2.5, 5.0  # the second room ends at z = -behind
    degrees, hinge = 15.0, .45
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    x, z = hinge - .45 * c, -depth + .45 * s
    meshes = shell(width, height, depth, (-hinge, hinge, 0, 2.05))
    meshes += [quad("floor", (-width, 0, -depth), (width, 0, -depth), (width, 0, -behind), (-width, 0, -behind)),
               quad("white", (-width, height, -behind), (width, height, -behind), (width, height, -depth),
                    (-width, height, -depth)),
               quad("white", (-width, 0, -behind), (width, 0, -behind), (width, height, -behind),
                    (-width, height, -behind)),
               quad("white", (-width, 0, -depth), (-width, 0, -behind), (-width, height, -behind),
                    (-width, height, -depth)),
               quad("white", (width, 0, -behind), (width, 0, -depth), (width, height, -depth),
                    (width, height, -behind)),
               box("floor", (x - .45, .01, z - .02), (x + .45, 2.04, z + .02), degrees)]
    meshes += table(-.3, -.4, .9, .4, .7)
    meshes += [sphere("brick", (-.9, .86, -.4), .16, 32), sphere("metal", (-.3, .86, -.3), .16, 32),
               sphere("glass", (.3, .86, -.45), .16, 32)]
    lamp = {"kind": "area", "centre": (-1.2, height - .05, -4.0), "across": (.8, 0, 0), "up": (0, 0, .8),
            "radiance": 60.0}
    kinds = {"metal": {"kind": "metal", "colour": (.75, .75, .77), "roughness": .3},
             "glass": {"kind": "glass", "ior": 1.5, "straight": True},
             "black": {"kind": "diffuse", "diffuse": (0, 0, 0)}}
    return {"meshes": [*meshes, back_plate(lamp)], "materials": {**materials(*DIFFUSE), **kinds},
            "lights": [lamp], "background": 0.0, "bounces": 24,
            "camera": camera((1.2, 1.5, 2.3), (-.3, .9, -1.0), 1.4)}


def waves(material, half_x, half_z, level, steps=160):
    """A water surface of a few waves, with the normals of their heights."""
    trains = ((1.9, .7, .020), (-1.1, 2.3, .017), (3.1, -1.7, .010), (.6, 4.3, .007), (-4.7, -2.9, .004))
    vertices, normals, faces = [], [], []
    for j in range(steps + 1):
        for i in range(steps + 1):
            x, z = half_x * (2 * i / steps - 1), half_z * (2 * j / steps - 1)
            y, dx, dz = level, 0.0, 0.0
            for k, (a, b, size) in enumerate(trains):
                phase = 2 * (a * x + b * z) + 1.7 * k
                y += size * math.sin(phase)
                dx += 2 * a * size * math.cos(phase)
                dz += 2 * b * size * math.cos(phase)
            length = math.sqrt(1 + dx * dx + dz * dz)
            vertices.append((x, y, z))
            normals.append((-dx / length, 1 / length, -dz / length))
    for j in range(steps):
        for i in range(steps):
            a = j * (steps + 1) + i
            faces.append((a, a + steps + 1, a + steps + 2, a + 1))
    return {"material": material, "vertices": vertices, "faces": faces, "normals": normals}


def pool():
    x, z, bottom, wide = 2.0, 3.0, -1.4, 8.0
    meshes = [quad("tiles", (-x, bottom, z), (x, bottom, z), (x, bottom, -z), (-x, bottom, -z)),
              quad("tiles", (x, bottom, -z), (x, bottom, z), (x, 0, z), (x, 0, -z)),
              quad("tiles", (-x, bottom, z), (-x, bottom, -z), (-x, 0, -z), (-x, 0, z)),
              quad("tiles", (-x, bottom, -z), (x, bottom, -z), (x, 0, -z), (-x, 0, -z)),
              quad("tiles", (x, bottom, z), (-x, bottom, z), (-x, 0, z), (x, 0, z)),
              waves("water", x, z, -.12)]
    for x0, x1, z0, z1 in ((-wide, wide, z, wide), (-wide, wide, -wide, -z), (-wide, -x, -z, z), (x, wide, -z, z)):
        meshes.append(quad("white", (x0, 0, z1), (x1, 0, z1), (x1, 0, z0), (x0, 0, z0)))
    # The sun: a square of 2 degrees, 30 m away.
    to_sun = (.45, .80, -.40)
    length = math.sqrt(sum(v * v for v in to_sun))
    to_sun = tuple(v / length for v in to_sun)
    across = (to_sun[2], 0, -to_sun[0])
    scale = 1.05 / math.sqrt(across[0] ** 2 + across[2] ** 2)
    across = tuple(v * scale for v in across)
    up = (to_sun[1] * across[2] - to_sun[2] * across[1], to_sun[2] * across[0] - to_sun[0] * across[2],
          to_sun[0] * across[1] - to_sun[1] * across[0])
    facing = (across[1] * up[2] - across[2] * up[1], across[2] * up[0] - across[0] * up[2],
              across[0] * up[1] - across[1] * up[0])
    if sum(a * b for a, b in zip(facing, to_sun)) > 0:  # the light shines along across x up
        up = tuple(-v for v in up)
    sun = {"kind": "area", "centre": tuple(30 * v for v in to_sun), "across": across, "up": up, "radiance": 2500.0}
    kinds = {"tiles": {"kind": "diffuse", "diffuse": (.35, .6, .65)},
             "water": {"kind": "glass", "ior": 1.33, "straight": False}}
    return {"meshes": meshes, "materials": {**materials("white"), **kinds}, "lights": [sun], "background": .3,
            "bounces": 12, "camera": camera((-1.2, 2.6, 4.6), (.2, -.7, .2), 1.3)}
