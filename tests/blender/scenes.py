# SPDX-License-Identifier: Apache-2.0
"""What scenes of Blender's users have: pictures of Cycles and Oriel agree."""
# acceptance: Y2
import math
import pathlib
import sys

import bpy
import mathutils
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402


def stage(width, height):
    """An empty scene in which both programs follow paths as far."""
    scene = support.empty_scene(width, height)
    settings = scene.cycles
    settings.max_bounces = settings.diffuse_bounces = settings.glossy_bounces = 16
    settings.transmission_bounces = settings.transparent_max_bounces = 16
    settings.sample_clamp_indirect = settings.blur_glossy = 0
    scene.oriel.depth = 16
    return scene


def compare(label, limit, samples=64, size=8):
    """Compares the means of blocks of the pictures, and alpha."""
    ours, theirs = (support.render(e, samples, "scene") for e in ("ORIEL", "CYCLES"))
    a, b = support.block_means(ours, size), support.block_means(theirs, size)
    error = numpy.abs(a - b).mean() / max(b.mean(), 1e-6)
    alpha = numpy.abs(ours[..., 3] - theirs[..., 3]).mean()
    support.save_png(numpy.concatenate([ours, theirs], axis=1),
                     support.FOLDER / f"scene_{label.replace(' ', '_')}.png")
    support.check(error <= limit and alpha < .005,
                  f"{label}: mean difference {error:.2%}, of alpha {alpha:.4f}")


def look(location, target, **settings):
    camera = support.add_camera(location, **settings)
    way = mathutils.Vector(target) - mathutils.Vector(location)
    camera.rotation_euler = way.to_track_quat("-Z", "Y").to_euler()


def add_light(kind, energy, location, rotation=(0, 0, 0), **settings):
    light = bpy.data.lights.new(kind, kind)
    light.energy = energy
    for name, value in settings.items():
        setattr(light, name, value)
    return support.add(kind, light, location, rotation)


def floors():
    """Rough floors under low lamps, in the light of the sky, and at grazing views."""
    for specular in (0.0, .5):
        for roughness in (0.0, .4, .7, 1.0):
            if specular and not roughness:
                continue  # the mirror image of a lamp is brighter than everything else
            scene = stage(48, 24)
            scene.world.color = (.05, .05, .05)
            support.add_plane(200, support.principled("Floor", (.5, .4, .3), Specular=specular,
                                              Roughness=roughness))
            for x in (-3, 3):
                add_light("AREA", 60, (x, 2, 1.5), shape="DISK", size=.6)
            look((0, -4, 1.2), (0, 2, 0), lens=35.0)
            compare(f"floor, roughness {roughness}, specular {specular}", .03, 128)


def film():
    """Holdouts, a material override, and collections that only reflections see."""
    scene = stage(64, 48)
    scene.world.color, scene.render.film_transparent = (.5, .6, .8), True
    support.add_sphere(1, support.principled("Red", (.8, .3, .1)), (-1.2, 0, 1), 32)
    ball = support.add_sphere(.8, support.principled("Green", (.3, .8, .1)), (1, 0, .8), 32)
    support.add_plane(5.0, support.principled("Grey", (.5, .5, .5)))
    add_light("POINT", 200, (2, -3, 4), shadow_soft_size=.1)
    look((0, -7, 2), (0, 0, .8), lens=40.0)
    ball.is_holdout = True
    compare("holdout", .015)
    scene.render.film_transparent = False
    compare("holdout over the world", .015)
    ball.is_holdout = False
    bpy.context.view_layer.material_override = support.principled("Clay", (.6, .6, .6))
    compare("material override", .015)
    bpy.context.view_layer.material_override = None
    collection = bpy.data.collections.new("Apart")
    scene.collection.children.link(collection)
    ball.users_collection[0].objects.unlink(ball)
    collection.objects.link(ball)
    layer = bpy.context.view_layer.layer_collection.children["Apart"]
    layer.indirect_only = True
    compare("indirect only", .015)


def displacement():
    """Displacement of vertices, as bump, and both."""
    scene = stage(64, 48)
    scene.world.color = (.3, .3, .3)
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=60, y_subdivisions=60, size=3)
    bpy.ops.object.shade_smooth()
    material, tree, node = support.node_material("Waves")
    node.inputs["Specular"].default_value = 0
    v, u = (numpy.mgrid[0:128, 0:128] + .5) / 128 * 4 * math.pi
    pixels = numpy.ones((128, 128, 4), numpy.float32)
    pixels[..., :3] = (.5 + .5 * numpy.sin(u) * numpy.sin(v))[..., None]
    image = bpy.data.images.new("Waves", 128, 128, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(pixels.ravel())
    texture, waves = (tree.nodes.new("ShaderNode" + k) for k in ("TexImage", "Displacement"))
    texture.image, waves.inputs["Scale"].default_value = image, .3
    tree.links.new(texture.outputs[0], waves.inputs["Height"])
    tree.links.new(waves.outputs[0], tree.nodes["Material Output"].inputs["Displacement"])
    bpy.context.object.data.materials.append(material)
    add_light("SUN", 3, (0, 0, 3), (.7, .3, 0), angle=.05)
    look((0, -4, 2.2), (0, 0, 0), lens=40.0)
    for method, limit in (("DISPLACEMENT", .015), ("BOTH", .02), ("BUMP", .04)):
        material.cycles.displacement_method = method
        compare(f"displacement method {method}", limit)


def visibility():
    """Objects that some kinds of rays do not see."""
    scene = stage(80, 48)
    scene.world.color = (.4, .45, .5)
    support.add_plane(20, support.principled("Mirror", (.6, .6, .6), Roughness=.2, Metallic=1.0))
    for k, flag in enumerate(("visible_camera", "visible_diffuse", "visible_glossy",
                              "visible_transmission", "visible_shadow")):
        ball = support.add_sphere(.5, support.principled(flag, (.8, .2, .1)), (-3 + 1.5 * k, 0, .6), 24)
        setattr(ball, flag, False)
    wall = support.add_plane(10, support.diffuse_material((.7, .7, .7)))
    wall.rotation_euler.x, wall.location.y = math.pi / 2, 2
    pane = support.add_plane(8, support.principled("Glass", (1, 1, 1), Transmission=1.0, Roughness=0.0,
                                           IOR=1.0))
    pane.rotation_euler.x, pane.location, pane.scale.y = math.pi / 2, (0, -1.5, .6), .15
    add_light("AREA", 200, (0, -3, 4), (.6, 0, 0), size=2)
    look((0, -8, 2.5), (0, 0, .6), lens=35.0)
    compare("visibility by kinds of rays", .03, 128)


def lights_by_rays():
    """Lights that diffuse surfaces or reflections do not see."""
    scene = stage(72, 48)
    support.add_plane(20, support.principled("Floor", (.4, .4, .45), Roughness=.25, Specular=1.0))
    for k, (kind, flags, settings) in enumerate((
            ("AREA", ("visible_diffuse",), {"size": .6}),
            ("AREA", ("visible_glossy", "visible_transmission"), {"size": .6}),
            ("POINT", ("visible_diffuse",), {"shadow_soft_size": .2}),
            ("SPOT", ("visible_glossy", "visible_transmission"), {
                "shadow_soft_size": .1, "spot_size": 1.2}))):
        ob = add_light(kind, 60, (-3 + 2 * k, 1, 1.2), (.2, 0, 0), **settings)
        ob.data.color = [(1, .3, .2), (.2, 1, .3), (.3, .4, 1), (1, 1, .3)][k]
        for flag in flags:
            setattr(ob, flag, False)
    sun = add_light("SUN", .3, (0, 0, 5), (-.9, 0, 0), angle=.2)
    sun.visible_glossy = sun.visible_transmission = False
    look((0, -6, 2.5), (0, .5, 0), lens=30.0)
    compare("lights by kinds of rays", .03, 256)


def world_by_rays():
    """A world that some kinds of rays do not see."""
    scene = stage(64, 48)
    scene.world.color = (.5, .6, .8)
    support.add_plane(4, support.diffuse_material((.6, .5, .4)), z=-.6)
    for x, material in ((-1.2, support.principled("Mirror", (.9, .9, .9), Metallic=1.0, Roughness=.1)),
                        (0, support.diffuse_material((.7, .3, .2))),
                        (1.2, support.principled("Glass", (1, 1, 1), Transmission=1.0, Roughness=0.0))):
        support.add_sphere(.5, material, (x, 0, 0), 24)
    add_light("AREA", 100, (0, -2, 3), (.6, 0, 0), size=1)
    look((0, -4, 1), (0, 0, 0), lens=35.0)
    for kind in ("camera", "diffuse", "glossy", "transmission"):
        setattr(scene.world.cycles_visibility, kind, False)
        compare(f"a world without {kind} rays", .04, 128)
        setattr(scene.world.cycles_visibility, kind, True)


def hair():
    scene = stage(64, 64)
    scene.world.color = (.4, .4, .4)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1)
    ob = bpy.context.object
    for name, colour in (("Skin", (.5, .3, .2)), ("Fur", (.6, .3, .1))):
        ob.data.materials.append(support.principled(name, colour))
    ob.modifiers.new("Hair", "PARTICLE_SYSTEM")
    settings = ob.particle_systems[0].settings
    settings.type, settings.count, settings.hair_length, settings.material = "HAIR", 300, .5, 2
    settings.root_radius, settings.tip_radius, settings.radius_scale = 1, .2, .04
    add_light("AREA", 200, (2, -3, 4), (.6, .3, 0), size=1)
    look((0, -5, .5), (0, 0, 0), lens=40.0)
    compare("hair", .05)


def panoramas():
    """Panoramic cameras as in Cycles; others are refused."""
    scene = stage(64, 32)
    scene.world.color = (.3, .4, .6)
    support.add_plane(20, support.principled("Floor", (.5, .4, .3)), z=-1)
    for x, colour in ((-3, (.8, .1, .1)), (3, (.1, .7, .1))):
        support.add_sphere(1, support.principled("Ball", colour), (x, 2, 0), 24)
    support.add_camera((0, 0, .3), (math.radians(80), 0, .4), type="PANO")
    settings = scene.camera.data.cycles
    settings.panorama_type = "EQUIRECTANGULAR"
    compare("panorama", .02)
    settings.longitude_min, settings.longitude_max = -1.0, 2.0
    settings.latitude_min, settings.latitude_max = -.7, .7
    compare("part of a panorama", .02)
    scene.render.resolution_x = 32
    settings.panorama_type = "FISHEYE_EQUIDISTANT"
    compare_circle("equidistant fisheye")
    settings.panorama_type, settings.fisheye_fov = "FISHEYE_EQUISOLID", 2 * math.pi
    compare_circle("equisolid fisheye")
    settings.panorama_type = "MIRRORBALL"
    scene.render.engine = "ORIEL"
    try:
        bpy.ops.render.render()
        support.check(False, "a mirror ball is refused")
    except RuntimeError as error:
        support.check("MIRRORBALL" in str(error), f"refused: {str(error).strip()}")


def compare_circle(label):
    """Compares the pixels well inside of the image circle."""
    ours, theirs = (support.render(e, 64, "circle") for e in ("ORIEL", "CYCLES"))
    y, x = numpy.mgrid[0:32, 0:32] - 15.5
    inside = x * x + y * y < 13 * 13
    error = numpy.abs(ours - theirs)[inside][:, :3].mean() / theirs[inside][:, :3].mean()
    support.check(error < .04, f"{label}: mean difference {error:.2%}")


support.run([floors, film, displacement, visibility, lights_by_rays, world_by_rays, hair, panoramas])
