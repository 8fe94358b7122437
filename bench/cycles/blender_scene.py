# SPDX-License-Identifier: Apache-2.0
"""Renders a scene of catalogue.py with Cycles; to be run inside Blender:

    blender -b --factory-startup --python blender_scene.py -- SETTINGS.json

Prints one line of JSON: processor and wall-clock time of the picture, and of the start before it.
"""
import json
import math
import os
import sys
import time

import bpy
import mathutils

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import catalogue  # noqa: E402  beside this file
import scenes  # noqa: E402


LUMENS_PER_WATT = 177.83  # by which Cycles divides the candela of a profile (util/ies.cpp)


def up(v):
    """From y up to Blender's z up."""
    return mathutils.Vector((v[0], -v[2], v[1]))


def fresnel_of_both_sides(tree, node, ior):
    """The node inverts the index of a back side, so that it gets the inverse there."""
    face, index, fresnel = node("ShaderNodeNewGeometry"), node("ShaderNodeMath"), node("ShaderNodeFresnel")
    index.operation = "MULTIPLY_ADD"
    index.inputs[1].default_value, index.inputs[2].default_value = 1 / ior - ior, ior
    tree.links.new(face.outputs["Backfacing"], index.inputs[0])
    tree.links.new(index.outputs[0], fresnel.inputs["IOR"])
    return fresnel


def transparent_shadows(tree, node, glass, ior):
    """Glass that shadow rays, and all rays behind a diffuse bounce, pass without refraction."""
    path, either = node("ShaderNodeLightPath"), node("ShaderNodeMath")
    either.operation = "MAXIMUM"
    tree.links.new(path.outputs["Is Shadow Ray"], either.inputs[0])
    tree.links.new(path.outputs["Diffuse Depth"], either.inputs[1])
    thin, choice = node("ShaderNodeMixShader"), node("ShaderNodeMixShader")
    mirror = node("ShaderNodeBsdfGlossy", (1, 1, 1), Roughness=0)
    mirror.distribution = "SHARP"
    # Rays that were not bent meet both faces at the angle outside.
    tree.links.new(fresnel_of_both_sides(tree, node, ior).outputs[0], thin.inputs[0])
    tree.links.new(node("ShaderNodeBsdfTransparent", (1, 1, 1)).outputs[0], thin.inputs[1])
    tree.links.new(mirror.outputs[0], thin.inputs[2])
    tree.links.new(either.outputs[0], choice.inputs[0])
    tree.links.new(glass.outputs[0], choice.inputs[1])
    tree.links.new(thin.outputs[0], choice.inputs[2])
    return choice


def node_material(name, m, pictures):
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

    def link_picture(name, target):
        picture = node("ShaderNodeTexImage")
        picture.image = bpy.data.images.load(pictures[name])
        picture.image.colorspace_settings.name = "Raw"
        tree.links.new(picture.outputs["Color"], target)

    def diffuse():
        surface = node("ShaderNodeBsdfDiffuse", m["diffuse"])
        if "picture" in m:
            link_picture(m["picture"], surface.inputs["Color"])
        return surface
    if m["kind"] == "diffuse":
        surface = diffuse()
    elif m["kind"] == "metal":
        surface = node("ShaderNodeBsdfGlossy", m["colour"], Roughness=m["roughness"])
        surface.distribution = "MULTI_GGX"
    elif m["kind"] == "glass":
        surface = node("ShaderNodeBsdfGlass", (1, 1, 1), Roughness=0, IOR=m["ior"])
        surface.distribution = "SHARP"
        if m["straight"]:
            surface = transparent_shadows(tree, node, surface, m["ior"])
    elif m["kind"] == "frosted":
        surface = node("ShaderNodeBsdfGlass", (1, 1, 1), Roughness=m["roughness"], IOR=m["ior"])
        surface.distribution = "GGX"
    elif m["kind"] == "brushed":
        surface = node("ShaderNodeBsdfAnisotropic", m["colour"], Roughness=m["roughness"],
                       Anisotropy=1 - 1 / math.sqrt(m["ratio"]))
        surface.distribution = "MULTI_GGX"
    elif m["kind"] == "glow":
        surface = node("ShaderNodeEmission", m["radiance"], Strength=1)
    elif m["kind"] == "cloth":
        surface = node("ShaderNodeAddShader")
        tree.links.new(diffuse().outputs[0], surface.inputs[0])
        tree.links.new(node("ShaderNodeBsdfTranslucent", m["through"]).outputs[0], surface.inputs[1])
    elif m["kind"] == "mirror":
        surface = node("ShaderNodeBsdfGlossy", m["colour"], Roughness=0)
        surface.distribution = "SHARP"
    else:
        coat = node("ShaderNodeBsdfGlossy", (1, 1, 1), Roughness=m["roughness"])
        coat.distribution = "MULTI_GGX"
        surface = node("ShaderNodeMixShader")
        tree.links.new(fresnel_of_both_sides(tree, node, 1.5).outputs[0], surface.inputs[0])
        tree.links.new(diffuse().outputs[0], surface.inputs[1])
        tree.links.new(coat.outputs[0], surface.inputs[2])
    if "bump" in m:
        dents = node("ShaderNodeBump", Distance=m["bump"][1])
        link_picture(m["bump"][0], dents.inputs["Height"])
        for shaded in [n for n in tree.nodes if "Normal" in n.inputs and n != dents]:
            tree.links.new(dents.outputs["Normal"], shaded.inputs["Normal"])
    if "cut_out" in m:
        whole, surface = surface, node("ShaderNodeMixShader")
        link_picture(m["cut_out"], surface.inputs[0])
        tree.links.new(node("ShaderNodeBsdfTransparent", (1, 1, 1)).outputs[0], surface.inputs[1])
        tree.links.new(whole.outputs[0], surface.inputs[2])
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


def shining(name, light, direction, origin=(0, 0, 0)):
    z = -up(direction).normalized()
    x = z.orthogonal().normalized()
    add(name, light, axes(x, z.cross(x), z, up(origin)))


def divide_by_cosine(spot):
    """Cycles multiplies the intensity of a spot by the cosine to its axis; this undoes it."""
    spot.use_nodes = True
    tree = spot.node_tree
    normal, axes_of, size, inverse = (tree.nodes.new("ShaderNode" + kind) for kind in (
        "TexCoord", "SeparateXYZ", "Math", "Math"))
    size.operation, inverse.operation = "ABSOLUTE", "DIVIDE"
    inverse.inputs[0].default_value = 1
    tree.links.new(normal.outputs["Normal"], axes_of.inputs[0])
    tree.links.new(axes_of.outputs["Z"], size.inputs[0])
    tree.links.new(size.outputs[0], inverse.inputs[1])
    tree.links.new(inverse.outputs[0], tree.nodes["Emission"].inputs["Strength"])


def add_light(name, l, profile):
    """Lights of Cycles divide their power by 4 pi to get an intensity."""
    if l["kind"] == "sun":
        sun = bpy.data.lights.new(name, "SUN")
        sun.energy, sun.angle = math.pi * l["albedo_one"], 0
        shining(name, sun, l["direction"])
        return
    if l["kind"] == "spot":
        spot = bpy.data.lights.new(name, "SPOT")
        spot.spot_size, spot.spot_blend = 2 * math.radians(l["half_angle"]), 0
        spot.energy, spot.shadow_soft_size = 4 * math.pi * l["intensity"], 0
        divide_by_cosine(spot)
        shining(name, spot, l["direction"], l["centre"])
        return
    if l["kind"] == "profile":
        point = bpy.data.lights.new(name, "POINT")
        point.energy, point.shadow_soft_size, point.use_nodes = l["factor"] * LUMENS_PER_WATT, 0, True
        ies = point.node_tree.nodes.new("ShaderNodeTexIES")
        ies.mode, ies.filepath = "EXTERNAL", profile
        point.node_tree.links.new(ies.outputs[0], point.node_tree.nodes["Emission"].inputs["Strength"])
        add(name, point, mathutils.Matrix.Translation(up(l["centre"])))
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


def add_sun(colour, to_sun):
    """With the irradiance pi times `colour`, and the angle of src/sky/physical_sky.h."""
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy, sun.angle = math.pi * max(colour), 2 * .00465
    sun.color = [c / max(colour) for c in colour]
    shining("sun", sun, [-v for v in to_sun])


def add_fog(extinction):
    """In a box around everything, since Cycles has no light in a world with a volume."""
    material = bpy.data.materials.new("fog")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    scatter, out = (tree.nodes.new("ShaderNode" + k) for k in ("VolumeScatter", "OutputMaterial"))
    scatter.inputs["Color"].default_value = (1, 1, 1, 1)
    scatter.inputs["Density"].default_value = extinction
    tree.links.new(scatter.outputs[0], out.inputs["Volume"])
    material.cycles.homogeneous_volume = True
    data = bpy.data.meshes.new("fog")
    corners = [(x, y, z) for x in (-50, 50) for y in (-50, 50) for z in (-50, 50)]
    data.from_pydata(corners, [], [(0, 1, 3, 2), (6, 7, 5, 4), (4, 5, 1, 0), (2, 3, 7, 6),
                                   (0, 2, 6, 4), (5, 7, 3, 1)])
    data.materials.append(material)
    add("fog", data)


def move(placed, start, by, turn=0):
    """From the first frame, when the shutter opens, to the second, when it closes."""
    end = [a + b for a, b in zip(start, by)]
    for frame, place, degrees in ((1, start, 0), (2, end, turn)):
        placed.location = up(place)
        placed.keyframe_insert("location", frame=frame)
        if turn:
            placed.rotation_euler = (0, 0, math.radians(degrees))
            placed.keyframe_insert("rotation_euler", frame=frame)
    for curve in placed.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    placed.cycles.motion_steps = 5
    bpy.context.scene.frame_set(1)
    render = bpy.context.scene.render
    render.use_motion_blur, render.motion_blur_shutter = True, 1
    bpy.context.scene.cycles.motion_blur_position = "START"


def build(scene, probe, profile, sun_colour):
    world = bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (1, 1, 1, 1)
    background.inputs["Strength"].default_value = scene["background"]
    if "fog" in scene:
        add_fog(scene["fog"])
    if sun_colour:
        add_sun(sun_colour, scene["sky"]["to_sun"])
    if scene.get("probe") or scene.get("sky"):
        picture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
        picture.image = bpy.data.images.load(probe)
        world.node_tree.links.new(picture.outputs[0], background.inputs["Color"])
    materials = {n: node_material(n, m, scene.get("pictures")) for n, m in scene["materials"].items()}
    for i, m in enumerate(scene["meshes"]):
        data = bpy.data.meshes.new(f"mesh{i}")
        data.from_pydata([up(v) for v in m["vertices"]], [], m["faces"])
        data.materials.append(materials[m["material"]])
        if "uvs" in m:
            layer = data.uv_layers.new()
            for corner in data.loops:
                layer.data[corner.index].uv = m["uvs"][corner.vertex_index]
        if "normals" in m:
            data.polygons.foreach_set("use_smooth", [True] * len(m["faces"]))
        placed = add(f"mesh{i}", data)
        if "motion" in m:
            moves = m["motion"]
            move(placed, moves["centre"], moves.get("by", (0, 0, 0)), moves.get("turn", 0))
    for i, l in enumerate(scene["lights"]):
        add_light(f"light{i}", l, profile)
    c = scene["camera"]
    lens = bpy.data.cameras.new("camera")
    lens.sensor_fit, lens.clip_start, lens.clip_end = "HORIZONTAL", 1e-3, 1e4
    lens.angle_x = 2 * math.atan(c["width"] / 2)
    if "lens" in c:
        radius, lens.dof.focus_distance = c["lens"]
        lens.dof.use_dof = True
        lens.dof.aperture_fstop = lens.lens * 1e-3 / (2 * radius)
    z = (up(c["position"]) - up(c["target"])).normalized()
    x = mathutils.Vector((0, 0, 1)).cross(z).normalized()
    placed = add("camera", lens, axes(x, z.cross(x), z, up(c["position"])))
    bpy.context.scene.camera = placed
    if "by" in c:
        move(placed, c["position"], c["by"])


def settings(scene, samples, seed, threads, noise):
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
    cycles.use_denoising = False
    cycles.use_adaptive_sampling = noise > 0
    if noise > 0:
        cycles.adaptive_threshold = noise
    cycles.pixel_filter_type = "BOX"
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    bounces = scene.get("bounces", scenes.BOUNCES)
    cycles.volume_bounces = 64
    for kind in ("max", "diffuse", "glossy", "transmission", "transparent_max"):
        # Oriel's paths have no limit of diffuse bounces.
        setattr(cycles, kind + "_bounces", 64 if kind in ("max", "diffuse") else bounces)


def main():
    with open(sys.argv[sys.argv.index("--") + 1], encoding="utf-8") as f:
        a = json.load(f)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scenes.WIDTH, scenes.HEIGHT = a["size"]
    scene = catalogue.ALL[a["scene"]]()
    scene["pictures"] = a["pictures"]
    build(scene, a["probe"], a["profile"], a["sun"])
    settings(scene, 1, a["seed"], a["threads"], 0)
    # A first picture of one sample loads the scene, which stays for the second picture.
    result = {"start": -time.process_time()}
    bpy.ops.render.render()
    result["start"] += time.process_time()
    result["first"] = time.time() - a["begin"]
    settings(scene, a["samples"], a["seed"], a["threads"], a["noise"])
    bpy.context.scene.render.filepath = a["out"]
    begin, wall = time.process_time(), time.time()
    bpy.ops.render.render(write_still=True)
    result["seconds"], result["wall"] = time.process_time() - begin, time.time() - wall
    print(json.dumps({"result": result}))


main()
