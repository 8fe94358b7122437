# SPDX-License-Identifier: Apache-2.0
"""Renders a scene of scenes.py with Cycles; to be run inside Blender:

    blender -b --factory-startup --python blender_scene.py -- SCENE PROBE SAMPLES SEED THREADS OUT.exr

Prints the seconds of processor time the picture took, without what comes before it.
"""
import math
import os
import sys
import time

import bpy
import mathutils

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import scenes  # noqa: E402  beside this file


def up(v):
    """From y up to Blender's z up."""
    return mathutils.Vector((v[0], -v[2], v[1]))


def node_material(name, m):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    out = tree.nodes.new("ShaderNodeOutputMaterial")

    def node(kind, colour=None, **values):
        made = tree.nodes.new(kind)
        if colour:
            made.inputs["Color"].default_value = (*colour, 1)
        for key, value in values.items():
            made.inputs[key].default_value = value
        return made
    if m["kind"] == "diffuse":
        surface = node("ShaderNodeBsdfDiffuse", m["diffuse"])
    elif m["kind"] == "metal":
        surface = node("ShaderNodeBsdfGlossy", m["colour"], Roughness=m["roughness"])
        surface.distribution = "MULTI_GGX"
    elif m["kind"] == "glass":
        surface = node("ShaderNodeBsdfGlass", (1, 1, 1), Roughness=0, IOR=m["ior"])
        surface.distribution = "SHARP"
    else:
        coat = node("ShaderNodeBsdfGlossy", (1, 1, 1), Roughness=m["roughness"])
        coat.distribution = "MULTI_GGX"
        surface = node("ShaderNodeMixShader")
        fresnel = node("ShaderNodeFresnel", IOR=1.5)
        tree.links.new(fresnel.outputs[0], surface.inputs[0])
        tree.links.new(node("ShaderNodeBsdfDiffuse", m["diffuse"]).outputs[0], surface.inputs[1])
        tree.links.new(coat.outputs[0], surface.inputs[2])
    tree.links.new(surface.outputs[0], out.inputs["Surface"])
    return material


def add(name, data, matrix=None):
    placed = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(placed)
    if matrix:
        placed.matrix_world = matrix
    return placed


def axes(x, y, z, origin):
    rows = [[*v, 0] for v in (x, y, z)] + [[*origin, 1]]
    return mathutils.Matrix(rows).transposed()


def add_light(name, l):
    if l["kind"] == "sun":
        sun = bpy.data.lights.new(name, "SUN")
        sun.energy, sun.angle = math.pi * l["albedo_one"], 0
        z = -up(l["direction"]).normalized()
        x = z.orthogonal().normalized()
        add(name, sun, axes(x, z.cross(x), z, (0, 0, 0)))
        return
    lamp = bpy.data.lights.new(name, "AREA")
    lamp.shape = "RECTANGLE"
    across, high = up(l["across"]), up(l["up"])
    lamp.size, lamp.size_y = across.length, high.length
    if l["kind"] == "portal":
        lamp.cycles.is_portal = True
    else:  # its radiance is a quarter of power by area
        lamp.energy = 4 * l["radiance"] * lamp.size * lamp.size_y
    # It shines down its -z; scenes.py says along across x up.
    x, y = across.normalized(), high.normalized()
    place = add(name, lamp, axes(x, -y, -x.cross(y), up(l["centre"])))
    place.visible_camera = True


def build(scene, probe):
    world = bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (1, 1, 1, 1)
    background.inputs["Strength"].default_value = scene["background"]
    if scene.get("probe"):
        picture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
        picture.image = bpy.data.images.load(probe)
        world.node_tree.links.new(picture.outputs[0], background.inputs["Color"])
    materials = {n: node_material(n, m) for n, m in scene["materials"].items()}
    for i, m in enumerate(scene["meshes"]):
        data = bpy.data.meshes.new(f"mesh{i}")
        data.from_pydata([up(v) for v in m["vertices"]], [], m["faces"])
        data.materials.append(materials[m["material"]])
        if "normals" in m:
            data.polygons.foreach_set("use_smooth", [True] * len(m["faces"]))
        add(f"mesh{i}", data)
    for i, l in enumerate(scene["lights"]):
        add_light(f"light{i}", l)
    c = scene["camera"]
    lens = bpy.data.cameras.new("camera")
    lens.sensor_fit, lens.clip_start, lens.clip_end = "HORIZONTAL", 1e-3, 1e4
    lens.angle_x = 2 * math.atan(c["width"] / 2)
    z = (up(c["position"]) - up(c["target"])).normalized()
    x = mathutils.Vector((0, 0, 1)).cross(z).normalized()
    bpy.context.scene.camera = add("camera", lens, axes(x, z.cross(x), z, up(c["position"])))


def settings(scene, samples, seed, threads):
    render = bpy.context.scene.render
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = scenes.WIDTH, scenes.HEIGHT
    render.resolution_percentage = 100
    render.threads_mode = "FIXED" if threads else "AUTO"
    if threads:
        render.threads = threads
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode, render.image_settings.color_depth = "RGB", "32"
    render.use_persistent_data = True
    cycles = bpy.context.scene.cycles
    cycles.device = "CPU"
    cycles.samples, cycles.seed = samples, seed
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    bounces = scene.get("bounces", scenes.BOUNCES)
    for kind in ("max", "diffuse", "glossy", "transmission", "transparent_max"):
        setattr(cycles, kind + "_bounces", bounces)


def main():
    name, probe, samples, seed, threads, out = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = scenes.SCENES[name]()
    build(scene, probe)
    settings(scene, 1, int(seed), int(threads))
    # What is prepared once is not the question: a first picture leaves it there.
    bpy.ops.render.render()
    bpy.context.scene.cycles.samples = int(samples)
    bpy.context.scene.render.filepath = out
    begin = time.process_time()
    bpy.ops.render.render(write_still=True)
    print(f"seconds {time.process_time() - begin:.3f}")


main()
