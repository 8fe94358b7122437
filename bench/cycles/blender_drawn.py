# SPDX-License-Identifier: Apache-2.0
"""Draws scenes of Blender at random and renders them with Cycles and with Oriel's extension:

    ORIEL=build/release/bin/oriel blender -b --factory-startup --python bench/cycles/blender_drawn.py -- \\
        [--samples 64] [--pictures 2] [--folder FOLDER] SEED [SEED ...]

Materials are principled surfaces of all kinds, textures and mixtures; objects have modifiers and odd
scales; lights, worlds and cameras are drawn, too. One row for each scene: the errors of
differences.py, without its longer picture, processor seconds (those of Oriel include the export and
its start), the ratio of the times to equal error, and of the means.
"""
import argparse
import math
import os
import random
import resource
import sys
import tempfile

import bpy
import numpy
from mathutils import Vector

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "integrations", "blender")]
import drawn  # noqa: E402  beside this file
import measure  # noqa: E402
import oriel_blender  # noqa: E402


def colour(rng, darkest=.05, brightest=.9):
    return (*drawn.colour(rng, darkest, brightest), 1)


def texture(rng, tree, target):
    kind = rng.choice(("Checker", "Noise", "Voronoi", "Brick", "Wave", "Gradient", "Magic"))
    picture, place = tree.nodes.new("ShaderNodeTex" + kind), tree.nodes.new("ShaderNodeTexCoord")
    mapping, ramp = tree.nodes.new("ShaderNodeMapping"), tree.nodes.new("ShaderNodeValToRGB")
    mapping.inputs["Scale"].default_value = (rng.uniform(1, 6),) * 3
    mapping.inputs["Rotation"].default_value = (0, 0, rng.random())
    for element in ramp.color_ramp.elements:
        element.color = colour(rng)
    tree.links.new(place.outputs[rng.choice(("UV", "Object", "Generated"))], mapping.inputs[0])
    tree.links.new(mapping.outputs[0], picture.inputs[0])
    tree.links.new(picture.outputs[min(1, len(picture.outputs) - 1)], ramp.inputs[0])
    tree.links.new(ramp.outputs[0], target)


def mixture(rng, tree, principled):
    kind = rng.choice(("Diffuse", "Glossy", "Translucent", "Transparent", "Velvet"))
    other, mix = tree.nodes.new("ShaderNodeBsdf" + kind), tree.nodes.new("ShaderNodeMixShader")
    other.inputs["Color"].default_value = colour(rng)
    mix.inputs[0].default_value = rng.random()
    if rng.random() < .4:
        tree.links.new(tree.nodes.new("ShaderNodeLayerWeight").outputs[1], mix.inputs[0])
    tree.links.new(principled.outputs[0], mix.inputs[1])
    tree.links.new(other.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs[0])


def bump(tree, principled):
    noise, dents = tree.nodes.new("ShaderNodeTexNoise"), tree.nodes.new("ShaderNodeBump")
    noise.inputs["Scale"].default_value = 8
    dents.inputs["Distance"].default_value, dents.inputs["Strength"].default_value = .1, .6
    tree.links.new(noise.outputs[0], dents.inputs["Height"])
    tree.links.new(dents.outputs["Normal"], principled.inputs["Normal"])


def material(rng, name):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    principled = made.node_tree.nodes["Principled BSDF"]
    values = {"Base Color": colour(rng), "Roughness": rng.choice((0, .1, .3, .5, .8, 1, rng.random()))}
    kind = rng.choice(("plain", "plain", "plain", "metal", "glass", "coat", "sheen", "glow", "specular",
                       "texture", "mixture", "half", "alpha", "bump"))
    if kind == "metal":
        values["Metallic"] = rng.choice((1, 1, .5))
    elif kind == "glass":
        values.update(Transmission=1, IOR=rng.uniform(1.2, 1.8), Roughness=rng.choice((0, 0, .2)))
    elif kind == "coat":
        values.update({"Clearcoat": rng.random(), "Clearcoat Roughness": rng.choice((.03, .2))})
    elif kind == "sheen":
        values["Sheen"] = 1
    elif kind == "glow":
        values.update({"Emission": colour(rng, .4, 1), "Emission Strength": 10 ** rng.uniform(-.3, .8)})
    elif kind == "specular":
        values["Specular"] = rng.random()
    elif kind == "half":
        values["Transmission"] = .5
    elif kind == "alpha":
        values["Alpha"] = rng.uniform(.3, .9)
    for key, value in values.items():
        principled.inputs[key].default_value = value
    if kind == "texture":
        texture(rng, made.node_tree, principled.inputs["Base Color"])
    elif kind == "mixture":
        mixture(rng, made.node_tree, principled)
    elif kind == "bump":
        bump(made.node_tree, principled)
    return made


def shape(rng, place, size):
    """Adds an object; returns it, and whether it may be turned."""
    mesh = bpy.ops.mesh
    kind = rng.choice(("cube", "sphere", "monkey", "torus", "cone", "cylinder", "ico", "text", "curve", "plane"))
    if kind == "cube":
        mesh.primitive_cube_add(size=1.4 * size, location=place)
    elif kind == "sphere":
        mesh.primitive_uv_sphere_add(radius=size, location=place)
    elif kind == "monkey":
        mesh.primitive_monkey_add(size=2 * size, location=place)
    elif kind == "torus":
        mesh.primitive_torus_add(major_radius=.8 * size, minor_radius=.25 * size, location=place)
    elif kind == "cone":
        mesh.primitive_cone_add(radius1=size, depth=2 * size, location=place)
    elif kind == "cylinder":
        mesh.primitive_cylinder_add(radius=.6 * size, depth=2 * size, location=place)
    elif kind == "ico":
        mesh.primitive_ico_sphere_add(radius=size, subdivisions=2, location=place)
    elif kind == "plane":
        mesh.primitive_plane_add(size=2 * size, location=place, rotation=(1.2, 0, 3 * rng.random()))
    elif kind == "text":
        bpy.ops.object.text_add(location=place, rotation=(1.5, 0, rng.uniform(-.4, .4)))
        text = bpy.context.object.data
        text.body, text.extrude, text.size = "Örß", .1, 2 * size
    else:
        bpy.ops.curve.primitive_bezier_circle_add(radius=.8 * size, location=place)
        bpy.context.object.data.bevel_depth = .12 * size
    return bpy.context.object, kind not in ("text", "plane")


def modify(rng, made, size):
    if made.type != "MESH":
        return
    if rng.random() < .4:
        bpy.ops.object.shade_smooth()
    kind = rng.choice(("SUBSURF", "BEVEL", "WIREFRAME", "SOLIDIFY", *6 * (None,)))
    if not kind:
        return
    modifier = made.modifiers.new(kind, kind)
    if kind == "SUBSURF":
        modifier.render_levels = 2
    elif kind == "BEVEL":
        modifier.width = .1 * size
    else:
        modifier.thickness = .1 * size if kind == "WIREFRAME" else .05


def objects(rng):
    materials = [material(rng, f"own.{k} ä") for k in range(rng.randint(3, 7))]
    taken = []
    for _ in range(rng.randint(3, 9)):
        size, x, y = rng.uniform(.3, .9), rng.uniform(-2.5, 2.5), rng.uniform(-2, 2.5)
        if any(math.hypot(x - a, y - b) < 1.3 * (size + r) for a, b, r in taken):
            continue
        taken.append((x, y, size))
        made, turns = shape(rng, (x, y, size), size)
        if turns:
            made.rotation_euler = [rng.uniform(-.6, .6) for _ in range(3)]
        modify(rng, made, size)
        made.scale = rng.choice(((1, rng.uniform(.4, 1.5), rng.uniform(.5, 1)), (-1, 1, 1), *3 * ((1, 1, 1),)))
        made.data.materials.append(rng.choice(materials))


def plain(name, base, roughness):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    principled = made.node_tree.nodes["Principled BSDF"]
    principled.inputs["Base Color"].default_value = base
    principled.inputs["Roughness"].default_value = roughness
    return made


def surroundings(rng, indoors):
    bpy.ops.mesh.primitive_plane_add(size=8 if indoors else 60)
    bpy.context.object.data.materials.append(plain("ground", colour(rng, .2, .8), rng.choice((.3, .5, .9))))
    wall = plain("wall", (.75, .73, .7, 1), 1)
    for place, turn in (((0, 4, 2), (math.pi / 2, 0, 0)), ((-4, 0, 2), (math.pi / 2, 0, math.pi / 2)),
                        ((0, 0, 4), (math.pi, 0, 0))) if indoors else ():
        bpy.ops.mesh.primitive_plane_add(size=8, location=place, rotation=turn)
        bpy.context.object.data.materials.append(wall)


def placed(name, data, place, target):
    made = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(made)
    made.location = place
    made.rotation_euler = (Vector(target) - Vector(place)).to_track_quat("-Z", "Y").to_euler()
    return made


def lights(rng):
    for k in range(rng.randint(1, 3)):
        kind = rng.choice(("POINT", "SPOT", "SUN", "AREA", "AREA"))
        lamp = bpy.data.lights.new(f"lamp{k}", kind)
        lamp.color, lamp.energy = colour(rng, .7, 1)[:3], rng.uniform(60, 600)
        if kind == "SUN":
            lamp.energy, lamp.angle = rng.uniform(1, 5), math.radians(rng.choice((0, .53, 5)))
        elif kind == "AREA":
            lamp.shape = rng.choice(("SQUARE", "RECTANGLE", "DISK"))
            lamp.size, lamp.size_y = rng.uniform(.3, 1.5), rng.uniform(.3, 1.5)
        else:
            lamp.shadow_soft_size = rng.choice((.02, .1, .25))
        if kind == "SPOT":
            lamp.spot_size, lamp.spot_blend = rng.uniform(.6, 1.8), rng.random()
        placed(f"lamp{k}", lamp, (rng.uniform(-3, 3), rng.uniform(-3, 2), rng.uniform(2.5, 3.6)),
               (rng.uniform(-1, 1), rng.uniform(-1, 1), .4))


def world(rng):
    made = bpy.data.worlds.new("world")
    bpy.context.scene.world, made.use_nodes = made, True
    background = made.node_tree.nodes["Background"]
    background.inputs[0].default_value = colour(rng, .3, 1)
    background.inputs[1].default_value = rng.choice((0, .3, 1))
    if rng.random() > .4:
        return
    sky = made.node_tree.nodes.new("ShaderNodeTexSky")
    sky.sky_type = rng.choice(("NISHITA", "HOSEK_WILKIE", "PREETHAM"))
    sky.sun_disc, sky.sun_elevation, sky.sun_rotation = rng.random() < .5, rng.uniform(.2, 1.2), 6 * rng.random()
    background.inputs[1].default_value = .1 if sky.sky_type == "NISHITA" else .5
    made.node_tree.links.new(sky.outputs[0], background.inputs[0])


def camera(rng):
    lens = bpy.data.cameras.new("camera")
    lens.lens, lens.clip_start = rng.choice((24, 35, 50)), .01
    bpy.context.scene.camera = placed("camera", lens, (rng.uniform(-2, 4), -6, rng.uniform(1.2, 3.2)), (0, 0, .9))
    kind = rng.choice(("orthographic", "shifted", "depth of field", "vertical", *4 * ("plain",)))
    if kind == "orthographic":
        lens.type, lens.ortho_scale = "ORTHO", 7
    elif kind == "shifted":
        lens.shift_x, lens.shift_y = rng.uniform(-.2, .2), rng.uniform(-.2, .2)
    elif kind == "depth of field":
        lens.dof.use_dof, lens.dof.focus_distance, lens.dof.aperture_fstop = True, 6, .5
    elif kind == "vertical":
        lens.sensor_fit, lens.sensor_height = "VERTICAL", 24


def draw(seed):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    rng = random.Random(seed)
    objects(rng)
    surroundings(rng, rng.random() < .5)
    lights(rng)
    world(rng)
    camera(rng)
    render = bpy.context.scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = 160, 120, 100
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.threads_mode, render.threads = "FIXED", 1
    render.use_persistent_data = True


def seconds():
    own, children = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return own.ru_utime + own.ru_stime + children.ru_utime + children.ru_stime


def picture(engine, samples, seed, folder):
    """The picture, and the processor time that it took."""
    scene = bpy.context.scene
    scene.render.engine = engine
    if engine == "CYCLES":
        cycles = scene.cycles
        cycles.samples, cycles.seed = samples, seed
        cycles.use_denoising = cycles.use_adaptive_sampling = False
        cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
        # Oriel's paths have no limit of diffuse bounces; the extension limits the others to 16 in all.
        cycles.max_bounces = cycles.diffuse_bounces = 64
        cycles.glossy_bounces = cycles.transmission_bounces = cycles.transparent_max_bounces = 16
    else:
        scene.oriel.samples, scene.oriel.seed, scene.oriel.threads = samples, seed, 1
    scene.render.filepath = os.path.join(folder, f"{engine}-{seed}.exr")
    begin = seconds()
    bpy.ops.render.render(write_still=True)
    return measure.picture(scene.render.filepath), seconds() - begin


def compare(seed, args, folder):
    draw(seed)
    cost, means, cells = [], [], []
    for engine in ("ORIEL", "CYCLES"):
        if engine == "CYCLES":
            picture(engine, 1, 0, folder)  # loads the scene, which stays
        runs = [picture(engine, args.samples, 1 + k, folder) for k in range(args.pictures)]
        level = sum(p for p, _ in runs) / len(runs)
        error = measure.noise([p for p, _ in runs], level)
        time_of = numpy.mean([t for _, t in runs])
        cost.append(error * time_of)
        means.append(level.mean())
        cells.append(f"{error:.5f} in {time_of:.2f} s")
    return f"| {seed} | {cells[0]} | {cells[1]} | {cost[1] / cost[0]:.2f} | {means[0] / means[1]:.4f} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--pictures", type=int, default=2)
    parser.add_argument("--folder", help="where pictures and scenes stay")
    parser.add_argument("seeds", type=int, nargs="+", metavar="SEED")
    args = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
    oriel_blender.register()
    rows = ["| scene | Oriel: error, seconds | Cycles | time to equal error, Cycles / Oriel | means |", "|---|---|---|---|---|"]
    for seed in args.seeds:
        with tempfile.TemporaryDirectory() as temporary:
            folder = os.path.join(args.folder, str(seed)) if args.folder else temporary
            os.makedirs(folder, exist_ok=True)
            rows.append(compare(seed, args, folder))
            if args.folder:
                bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "scene.blend"))
    print("\n".join(rows), flush=True)


main()
