# SPDX-License-Identifier: Apache-2.0
"""A furnished room with what people use in Blender: pictures of Cycles and Oriel agree."""
# acceptance: Y2
import math
import pathlib
import sys

import bpy
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402

LIMIT = .035


def compare(label, samples=96, size=8, limit=LIMIT):
    """Compares the means of blocks of the picture."""
    ours = support.render("ORIEL", samples, label)
    theirs = support.render("CYCLES", samples, label)
    a, b = support.block_means(ours, size), support.block_means(theirs, size)
    error = numpy.abs(a - b).mean() / b.mean()
    support.save_png(numpy.concatenate([ours, theirs], axis=1),
                     support.FOLDER / f"room_{label.replace(' ', '_')}.png")
    support.check(error <= limit, f"{label}: mean difference {error:.2%}, "
                                  f"mean {a.mean() / b.mean() - 1:+.2%}")


def box(name, size, location, material=None, parent=None):
    x, y, z = (s / 2 for s in size)
    corners = [(a, b, c) for a in (-x, x) for b in (-y, y) for c in (-z, z)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    ob = support.add_mesh(name, corners, faces, material)
    ob.location, ob.parent = location, parent
    return ob


def walls():
    """A room of 5 x 4 x 2.6 with a window in the wall at +x and an open side towards the camera."""
    paint = support.principled("Paint", (.7, .7, .68), Specular=0.0)
    box("Ground", (5, 4, .1), (0, 0, -.05), support.principled("Boards", (.4, .25, .15), Roughness=.4))
    box("Ceiling", (5, 4, .1), (0, 0, 2.65), paint)
    box("Back", (5, .1, 2.6), (0, 2.05, 1.3), support.principled("Blue", (.2, .3, .5), Specular=0.0))
    box("Left", (.1, 4, 2.6), (-2.55, 0, 1.3), paint)
    box("Sill", (.1, 4, .8), (2.55, 0, .4), paint)
    box("Lintel", (.1, 4, .4), (2.55, 0, 2.4), paint)
    for y in (-1.4, 1.4):
        box("Pier", (.1, 1.2, 1.4), (2.55, y, 1.5), paint)


def table():
    """A bevelled top on mirrored legs, as a collection that is placed twice."""
    wood = support.principled("Wood", (.5, .3, .15), Roughness=.35)
    collection = bpy.data.collections.new("Table")
    top = box("Top", (1.2, .7, .06), (0, 0, .72), wood)
    bevel = top.modifiers.new("Bevel", "BEVEL")
    bevel.width, bevel.segments = .02, 3
    leg = box("Leg", (.06, .06, .7), (.5, .28, .35), wood)
    mirror = leg.modifiers.new("Mirror", "MIRROR")
    mirror.use_axis[0] = mirror.use_axis[1] = True
    mirror.mirror_object = top
    for ob in (top, leg):
        bpy.context.scene.collection.objects.unlink(ob)
        collection.objects.link(ob)
    for location, turn, scale in (((-.9, .6, 0), .3, (1, 1, 1)), ((1.2, 1.2, 0), 1.2, (-.8, .8, .7))):
        empty = support.add("Placed", None, location, (0, 0, turn))
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
        empty.scale = scale


def furniture():
    table()
    # A shelf of five boards, each 3 cm thick by a modifier.
    board = support.add_mesh("Shelf", [(-.5, -.15, 0), (.5, -.15, 0), (.5, .15, 0), (-.5, .15, 0)],
                             [(0, 1, 2, 3)], support.principled("White", (.8, .8, .8)))
    board.location = (-1.6, 1.8, .3)
    board.modifiers.new("Solidify", "SOLIDIFY").thickness = .03
    array = board.modifiers.new("Array", "ARRAY")
    array.count, array.use_relative_offset, array.use_constant_offset = 5, False, True
    array.constant_offset_displace = (0, 0, .4)
    # A cushion: a subdivided box, child of a scaled and mirrored parent.
    parent = support.add("Parent", None, (.2, -.4, .25), (0, 0, .5))
    parent.scale = (-1.5, 1, .8)
    cushion = box("Cushion", (.5, .5, .4), (.3, .1, 0), support.principled("Red", (.6, .1, .08)), parent)
    cushion.modifiers.new("Subdivision", "SUBSURF").render_levels = 2
    for polygon in cushion.data.polygons:
        polygon.use_smooth = True
    ball = support.add_sphere(.25, support.principled("Chrome", (.9, .9, .9), Metallic=1.0, Roughness=.2),
                              (-.9, .6, 1.0))
    ball.scale = (1, 1, -1)


def room():
    scene = support.empty_scene(80, 48)
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = scene.cycles.glossy_bounces = 16
    scene.cycles.sample_clamp_indirect = scene.cycles.blur_glossy = 0
    scene.oriel.depth = 16
    walls()
    furniture()
    support.add_camera((0, -5.5, 1.4), (math.radians(88), 0, 0), lens=28.0)
    return scene


def sky(scene, rotation=(0, 0, 0)):
    """A world whose picture has a bright side."""
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    height, width = 32, 64
    v, u = numpy.mgrid[0:height, 0:width]
    pixels = numpy.ones((height, width, 4), numpy.float32)
    bright = numpy.exp(-((u - 32) / 6.0) ** 2 - ((v - 20) / 5.0) ** 2)
    for channel, (low, high) in enumerate(((.3, 9), (.5, 8), (.8, 6))):
        pixels[..., channel] = low + high * bright
    image = bpy.data.images.new("Sky", width, height, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(pixels.ravel())
    node = tree.nodes.new("ShaderNodeTexEnvironment")
    node.image = image
    mapping, source = tree.nodes.new("ShaderNodeMapping"), tree.nodes.new("ShaderNodeTexCoord")
    tree.links.new(source.outputs["Generated"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs[0], node.inputs["Vector"])
    tree.links.new(node.outputs[0], tree.nodes["Background"].inputs["Color"])
    mapping.inputs["Rotation"].default_value = rotation


def lamps():
    """Light of lamps of all kinds, without a world."""
    room()
    panel = bpy.data.lights.new("Panel", "AREA")
    panel.shape, panel.size, panel.size_y, panel.energy = "RECTANGLE", 1.5, .4, 60.0
    support.add("Panel", panel, (0, 0, 2.5))
    spot = bpy.data.lights.new("Spot", "SPOT")
    spot.energy, spot.spot_size, spot.spot_blend, spot.shadow_soft_size = 80.0, 1.0, .4, .05
    support.add("Spot", spot, (-1.8, -.5, 2.4), (.7, .2, 0))
    bulb = bpy.data.lights.new("Bulb", "POINT")
    bulb.energy, bulb.color, bulb.shadow_soft_size = 20.0, (1, .7, .4), 0.0
    support.add("Bulb", bulb, (1.4, 1.3, 1.0))
    compare("lamps")


def daylight():
    """A rotated environment through a window with a portal."""
    scene = room()
    sky(scene, (0, .1, .4))
    portal = bpy.data.lights.new("Portal", "AREA")
    portal.shape, portal.size, portal.size_y = "RECTANGLE", 1.6, 1.4
    portal.cycles.is_portal = True
    support.add("Portal", portal, (2.5, 0, 1.5), (math.pi / 2, 0, math.pi / 2))
    compare("daylight", 192)


def lenses():
    """Depth of field, an orthographic view, and a scene in centimetres."""
    scene = room()
    scene.world.color = (.8, .8, .8)
    camera = scene.camera.data
    camera.dof.use_dof, camera.dof.focus_distance, camera.dof.aperture_fstop = True, 6.0, .15
    compare("depth of field")
    camera.dof.use_dof = False
    camera.type, camera.ortho_scale, camera.shift_x = "ORTHO", 6.0, .05
    compare("orthographic")
    camera.type, camera.shift_x = "PERSP", 0.0
    scene.unit_settings.scale_length = .01
    for ob in bpy.context.scene.objects:
        if ob.parent is None:
            ob.scale = [100 * s for s in ob.scale]
            ob.location = [100 * c for c in ob.location]
    camera.clip_end = 1e5
    compare("centimetres")


support.run([lamps, daylight, lenses])
