# SPDX-License-Identifier: Apache-2.0
"""Worlds, textures and depth of field: pictures of Cycles and Oriel agree."""
# acceptance: Y2
import math
import pathlib
import sys

import bpy
import mathutils
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402
from oriel_blender import world_bake  # noqa: E402


def same(label, limit, samples=64, size=8):
    """Compares the means of blocks of the picture."""
    ours = support.render("ORIEL", samples, label)
    theirs = support.render("CYCLES", samples, label)
    a, b = support.block_means(ours, size), support.block_means(theirs, size)
    error = numpy.abs(a - b).mean() / max(b.mean(), 1e-6)
    if error > limit:
        support.save_png(numpy.concatenate([ours, theirs], axis=1), support.FOLDER / "failed.png")
    support.check(error <= limit, f"{label}: mean difference {error:.2%}")
    return ours, theirs


def panorama():
    """A picture whose colours show direction: red grows with u, green with v, a blue stripe."""
    height, width = 64, 128
    v, u = numpy.mgrid[0:height, 0:width]
    pixels = numpy.ones((height, width, 4), numpy.float32)
    pixels[..., 0] = .1 + .8 * u / width
    pixels[..., 1] = .1 + .8 * v / height
    pixels[..., 2] = (abs(u - 40) < 8) * .9
    image = bpy.data.images.new("Panorama", width, height, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(pixels.ravel())
    return image


def pictures():
    scene = support.empty_scene(64, 64)
    tree = use_nodes(scene.world)
    node = tree.nodes.new("ShaderNodeTexEnvironment")
    node.image = panorama()
    tree.links.new(node.outputs[0], tree.nodes["Background"].inputs["Color"])
    tree.nodes["Background"].inputs["Strength"].default_value = 1.3
    camera = support.add_camera((0, 0, 0), lens=18.0)
    for name, angles in (("+y", (90, 0, 0)), ("+x", (90, 0, -90)), ("-x", (90, 0, 90)),
                         ("tilted", (60, 10, 30))):
        camera.rotation_euler = [math.radians(a) for a in angles]
        same(f"environment {name}", .02, 16)
    mapping, coordinate = tree.nodes.new("ShaderNodeMapping"), tree.nodes.new("ShaderNodeTexCoord")
    tree.links.new(coordinate.outputs["Generated"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs[0], node.inputs["Vector"])
    mapping.inputs["Rotation"].default_value = (.3, -.2, 1.1)
    same("environment rotated", .02, 16)
    support.add_sphere(1.0, support.diffuse_material(), segments=32)
    camera.location = camera.matrix_world.to_3x3() @ mathutils.Vector((0, 0, 3))
    same("ball in the environment", .02, 128)


def use_nodes(owner):
    owner.use_nodes = True
    return owner.node_tree


def plane_with(build):
    """A white lit plane whose base colour is built from nodes."""
    scene = support.empty_scene(64, 64)
    scene.world.color = (1, 1, 1)
    material, tree, _ = support.node_material("Textured")
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    tree.links.new(build(tree), diffuse.inputs["Color"])
    tree.links.new(diffuse.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    support.add_plane(2.0, material)
    support.add_camera((0, 0, 5), type="ORTHO", ortho_scale=1.9)


def picture(tree, mapping=None):
    image = bpy.data.images.new("Corners", 4, 4)
    pixels = numpy.ones((4, 4, 4), numpy.float32)
    pixels[..., 0], pixels[..., 1] = numpy.mgrid[0:4, 0:4] / 4 + .1
    pixels[0, 0, :3] = (.9, .1, .1)
    image.pixels.foreach_set(pixels.ravel())
    image.colorspace_settings.name = "Non-Color"
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    if mapping:
        source = tree.nodes.new("ShaderNodeMapping")
        uv = tree.nodes.new("ShaderNodeTexCoord")
        tree.links.new(uv.outputs["UV"], source.inputs["Vector"])
        tree.links.new(source.outputs[0], node.inputs["Vector"])
        for name, value in mapping.items():
            source.inputs[name].default_value = value
    return node.outputs[0]


def mapped(tree):
    return picture(tree, {"Location": (.2, .3, 0), "Rotation": (0, 0, .5), "Scale": (1.5, 2.5, 1)})


def ramp(tree):
    node = tree.nodes.new("ShaderNodeValToRGB")
    node.color_ramp.elements[0].position, node.color_ramp.elements[1].position = .2, .8
    node.color_ramp.elements[0].color = (1, .1, 0, 1)
    tree.links.new(picture(tree), node.inputs[0])
    return node.outputs[0]


def mix(blend):
    def build(tree):
        node = tree.nodes.new("ShaderNodeMixRGB")
        node.blend_type, node.inputs[0].default_value = blend, .4
        node.inputs[2].default_value = (.2, .5, .9, 1)
        tree.links.new(picture(tree), node.inputs[1])
        return node.outputs[0]
    return build


def checker(tree):
    node = tree.nodes.new("ShaderNodeTexChecker")
    uv = tree.nodes.new("ShaderNodeTexCoord")
    tree.links.new(uv.outputs["UV"], node.inputs["Vector"])
    node.inputs["Color1"].default_value = (.9, .1, .1, 1)
    node.inputs["Color2"].default_value = (.1, .2, .9, 1)
    node.inputs["Scale"].default_value = 4.0
    return node.outputs[0]


def inverted(tree):
    node = tree.nodes.new("ShaderNodeInvert")
    tree.links.new(picture(tree), node.inputs["Color"])
    return node.outputs[0]


def group(tree):
    inner = bpy.data.node_groups.new("Group", "ShaderNodeTree")
    inner.inputs.new("NodeSocketColor", "In")
    inner.outputs.new("NodeSocketColor", "Out")
    begin, end = inner.nodes.new("NodeGroupInput"), inner.nodes.new("NodeGroupOutput")
    node = inner.nodes.new("ShaderNodeMixRGB")
    node.inputs[0].default_value, node.inputs[2].default_value = .5, (0, 0, 1, 1)
    inner.links.new(begin.outputs[0], node.inputs[1])
    inner.links.new(node.outputs[0], end.inputs[0])
    outer = tree.nodes.new("ShaderNodeGroup")
    outer.node_tree = inner
    tree.links.new(picture(tree), outer.inputs[0])
    return outer.outputs[0]


def vertex_colour(tree):
    node = tree.nodes.new("ShaderNodeVertexColor")
    node.layer_name = "Col"
    return node.outputs[0]


def textures():
    for name, build in (("image", picture), ("mapping", mapped), ("ramp", ramp),
                        ("mix", mix("MIX")), ("multiply", mix("MULTIPLY")), ("add", mix("ADD")),
                        ("checker", checker), ("invert", inverted), ("group", group)):
        plane_with(build)
        same(name, .03, 64)
    plane_with(vertex_colour)
    mesh = bpy.data.objects["Plane"].data
    colours = mesh.color_attributes.new("Col", "FLOAT_COLOR", "CORNER")
    colours.data.foreach_set("color", [1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 1, 1, 1])
    same("vertex colour", .02, 64)


def depth_of_field():
    scene = support.empty_scene(64, 64)
    emitter, tree, _ = support.node_material("Emitter")
    node = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    for x, y in ((-.5, 2), (0, 5), (.8, 9)):
        support.add_plane(.3, emitter).location = (x * y / 5, x, -y)
    camera = support.add_camera((0, 0, 0), lens=50.0)
    camera.data.dof.use_dof = True
    camera.data.dof.focus_distance, camera.data.dof.aperture_fstop = 5.0, .15
    same("depth of field", .04, 128, 4)
    camera.data.dof.focus_distance = 2.0
    same("depth of field, near", .04, 128, 4)


def transparent_film():
    scene = support.empty_scene(64, 64)
    scene.world.color = (.5, .6, .7)
    scene.render.film_transparent = True
    square = support.add_plane(1.0, support.diffuse_material())
    square.rotation_euler.z = .3
    support.add_camera((0, 0, 5), lens=50.0)
    ours, theirs = same("transparent film", .02, 64)
    error = numpy.abs(ours[..., 3] - theirs[..., 3])
    support.check(error.mean() < .005 and error.max() < .2,
                  f"alpha: mean difference {error.mean():.4f}, largest {error.max():.3f}")
    support.check(ours[2, 2, 3] == 0 and (ours[2, 2, :3] < 1e-4).all(), "the background is empty")


def sky():
    """Sky and sun are those of Cycles; the physical sky of the program is another one."""
    scene = support.empty_scene(32, 32)
    tree = use_nodes(scene.world)
    node = tree.nodes.new("ShaderNodeTexSky")
    tree.links.new(node.outputs[0], tree.nodes["Background"].inputs["Color"])
    tree.nodes["Background"].inputs["Strength"].default_value = .02
    node.sun_elevation, node.sun_rotation, node.dust_density = math.radians(35), math.radians(70), 2
    support.add_plane(40.0, support.diffuse_material((.5, .5, .5)))
    pole = support.add_plane(.5, support.diffuse_material(), z=1.0)
    pole.visible_camera = False
    camera = support.add_camera((0, 0, 10), type="ORTHO", ortho_scale=4.0)
    ours, _ = same("sun and sky from above", .01, 256)
    scene.world.oriel.sky_model = "PHYSICAL"
    other = support.render("ORIEL", 64, "sky")
    dark = [numpy.argwhere(p[..., 0] < p[..., 0].mean() * .6).mean(axis=0) for p in (ours, other)]
    support.check(numpy.abs(dark[0] - dark[1]).max() <= 1, f"shadows of both skies: {dark}")
    total = 50 * 2 * other[..., 1].max() * math.pi
    support.check(30 < total < 200, f"irradiance of the physical sky {total:.1f} W/m2")
    scene.world.oriel.sky_model = "CYCLES"
    node.sun_size = math.radians(8)  # fills pixels
    camera.data.type, camera.data.lens, camera.location.z = "PERSP", 30, .5
    camera.rotation_euler = math.radians(35 + 90), 0, math.radians(-70)
    ours, theirs = same("sun in the sky", .03, 64, 4)
    support.check(ours.max() > 100 * numpy.median(ours), "the camera sees the disc")


def failed_sky():
    """If the picture of a sky cannot be rendered, the sky of the program is used."""
    scene = support.empty_scene(8, 8)
    tree = use_nodes(scene.world)
    node = tree.nodes.new("ShaderNodeTexSky")
    tree.links.new(node.outputs[0], tree.nodes["Background"].inputs["Color"])
    support.add_plane(4.0, support.diffuse_material())
    support.add_camera((0, 0, 5))
    job, world_bake.JOB = world_bake.JOB, "/missing.py"
    ours = support.render("ORIEL", 4, "sky")
    world_bake.JOB = job
    support.check(1 < ours[4, 4, 1] < 100, f"radiance {ours[4, 4, :3]}")


def any_world():
    """Worlds of nodes without shaders in the program: a picture by Cycles, without a copy left."""
    scene = support.empty_scene(48, 32)
    tree = use_nodes(scene.world)
    place, split, first, second, mix, bands = (tree.nodes.new("ShaderNode" + kind) for kind in (
        "TexCoord", "SeparateXYZ", "Background", "Background", "MixShader", "TexMagic"))
    first.inputs[0].default_value, second.inputs[1].default_value = (.9, .5, .2, 1), .6
    for source, target in ((place.outputs["Generated"], split.inputs[0]),
                           (place.outputs["Generated"], bands.inputs["Vector"]),
                           (bands.outputs["Color"], second.inputs["Color"]),
                           (split.outputs["Z"], mix.inputs[0]), (first.outputs[0], mix.inputs[1]),
                           (second.outputs[0], mix.inputs[2]),
                           (mix.outputs[0], tree.nodes["World Output"].inputs["Surface"])):
        tree.links.new(source, target)
    support.add_sphere(1.0, support.diffuse_material((.7, .7, .7)), segments=32)
    support.add_camera((0, -4, 1), (math.radians(80), 0, 0), lens=24.0)
    same("a world of nodes", .015, 128)


def baked():
    """Nodes without an equivalent, after baking, look as in Cycles; before, a message names them."""
    def spectrum(tree):
        gradient, length, colour = (tree.nodes.new("ShaderNode" + kind) for kind in (
            "TexGradient", "Math", "Wavelength"))
        place = tree.nodes.new("ShaderNodeTexCoord")
        length.operation, length.inputs[1].default_value = "MULTIPLY_ADD", 300
        length.inputs[2].default_value = 400
        for source, target in ((place.outputs["UV"], gradient.inputs[0]),
                               (gradient.outputs["Fac"], length.inputs[0]),
                               (length.outputs[0], colour.inputs[0])):
            tree.links.new(source, target)
        return colour.outputs["Color"]
    plane_with(spectrum)
    tree = bpy.data.materials["Textured"].node_tree
    ob = next(o for o in bpy.data.objects if o.type == "MESH")
    for other in bpy.context.selected_objects:
        other.select_set(False)
    ob.select_set(True)
    bpy.context.view_layer.objects.active = ob
    count = len(tree.nodes), len(bpy.data.objects), len(bpy.data.meshes)
    support.check(bpy.ops.object.oriel_bake(size=256) == {"FINISHED"}, "it is baked")
    after = len(tree.nodes) - 1, len(bpy.data.objects), len(bpy.data.meshes)
    support.check(count == after, f"only the image is added: {count}, {after}")
    kinds = {link.to_node.type for node in tree.nodes if node.type == "WAVELENGTH"
             for link in node.outputs["Color"].links}
    support.check(kinds == {"BSDF_DIFFUSE"}, f"the nodes stay: {kinds}")
    same("baked spectrum", .03, 64)


def place():
    """The sun of Berlin on 21 June: at true noon it is 90 - 52.5 + 23.4 degrees high, in the south."""
    scene = support.empty_scene(8, 8)
    scene.render.engine = "ORIEL"
    bpy.ops.world.oriel_add_sky()
    node = next(n for n in scene.world.node_tree.nodes if n.type == "TEX_SKY")
    settings = scene.world.oriel
    settings.latitude, settings.longitude, settings.zone = 52.5, 13.4, 2.0
    settings.year, settings.month, settings.day = 2026, 6, 21
    # 15 degrees of longitude are an hour; the equation of time is -1.8 minutes on that day.
    settings.hour = 12 + 2 - 13.4 / 15 + 1.8 / 60
    settings.use_place = True
    height, turn = math.degrees(node.sun_elevation), math.degrees(node.sun_rotation)
    support.check(abs(height - (90 - 52.5 + 23.44)) < .1, f"elevation {height:.2f}")
    support.check(abs(turn - 180) < .5, f"azimuth {turn:.2f}")
    settings.north = 30.0
    turned = math.degrees(node.sun_rotation)
    support.check(abs(turned - turn - 30) < .01, f"north turns the sun clockwise: {turned:.2f}")
    settings.hour = 8.0
    support.check(60 < math.degrees(node.sun_rotation) - 30 < 100, "the sun is in the east at 8")
    settings.month, settings.day = 2, 31
    support.check("clockwise" in settings.shown, f"the last day of February: {settings.shown}")


if __name__ == "__main__":
    support.run((place, baked, pictures, textures, depth_of_field, transparent_film, sky, failed_sky,
                 any_world))
