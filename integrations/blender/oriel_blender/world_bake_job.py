# SPDX-License-Identifier: Apache-2.0
"""Runs in a Blender of its own: renders worlds to pictures of all directions by Cycles.

    blender -b --factory-startup -P world_bake_job.py

Each line of the standard input is the path of a request. It has the file of the world, its name, values
of its nodes, the size of the picture and the sun: direction and angle of its disc, or null. Writes the
picture without the disc, and a result with the irradiance of the disc, or an error. Ends with the input,
or after some minutes without a request.
"""
import json
import math
import os
import select
import sys

import bpy
import mathutils
import numpy

DISC_PIXELS = 64
IDLE_SECONDS = 300


def stage(request):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    with bpy.data.libraries.load(request["blend"]) as (source, target):
        target.worlds = [name for name in source.worlds if name == request["world"]]
    scene.world = target.worlds[0]
    set_values(scene.world.node_tree, request["values"])
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples = "CPU", request["samples"]
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.cycles.max_bounces = 0
    # Skies are smooth: one sample in the middle of each pixel. Others are averaged.
    scene.cycles.pixel_filter_type = "BOX" if request["samples"] > 1 else "GAUSSIAN"
    scene.cycles.filter_width = 0.01
    # No surface samples the world, so that it needs no importance map; the second picture of a sky
    # shares the tables of the first one.
    scene.world.cycles.sampling_method = "NONE"
    scene.render.use_persistent_data = True
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.view_settings.view_transform = "Raw"
    camera = bpy.data.cameras.new("Camera")
    scene.camera = bpy.data.objects.new("Camera", camera)
    scene.collection.objects.link(scene.camera)
    return scene


def set_values(tree, values):
    """Sets the values that the nodes have in the frame."""
    tree.animation_data_clear()
    for name, inputs, settings in values:
        node = tree.nodes[name]
        for index, value in inputs:
            node.inputs[index].default_value = value
        for setting, value in settings:
            setattr(node, setting, value)


def set_discs(world, shown):
    for node in world.node_tree.nodes:
        if node.type == "TEX_SKY" and hasattr(node, "sun_disc"):
            node.sun_disc = shown


def render(scene, width, height, path):
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def panorama(scene, request):
    camera = scene.camera.data
    camera.type = "PANO"
    owner = camera if hasattr(camera, "panorama_type") else camera.cycles
    owner.panorama_type = "EQUIRECTANGULAR"
    # The centre of the picture is +x, as in environment textures.
    scene.camera.rotation_euler = math.pi / 2, 0, -math.pi / 2
    render(scene, request["width"], request["width"] // 2, request["picture"])


def pixels_of(path):
    image = bpy.data.images.load(path, check_existing=False)
    image.colorspace_settings.name = "Non-Color"
    pixels = numpy.empty(image.size[0] * image.size[1] * 4, numpy.float32)
    image.pixels.foreach_get(pixels)
    size = image.size[1], image.size[0]
    bpy.data.images.remove(image)
    return pixels.reshape(*size, 4)[..., :3].astype(numpy.float64)


def disc_irradiance(scene, request):
    """Irradiance of the disc on a plane towards it: the light around it is subtracted."""
    size = request["sun"]["angle"]
    camera = scene.camera.data
    camera.type, camera.lens_unit = "PERSP", "FOV"
    camera.angle = max(1.1 * size, math.radians(.37))
    direction = mathutils.Vector(request["sun"]["direction"])
    scene.camera.rotation_euler = (-direction).to_track_quat("Z", "Y").to_euler()
    set_discs(scene.world, True)
    path = request["picture"] + ".disc.exr"
    render(scene, DISC_PIXELS, DISC_PIXELS, path)
    pixels = pixels_of(path)
    os.remove(path)
    half = math.tan(camera.angle / 2)
    place = ((numpy.arange(DISC_PIXELS) + .5) / DISC_PIXELS * 2 - 1) * half
    squares = place[:, None] ** 2 + place[None, :] ** 2
    # The solid angle of a pixel at distance 1 is its area times the cosine cubed.
    weight = (1 + squares) ** -2 * (2 * half / DISC_PIXELS) ** 2
    around = squares > (math.tan(size / 2) + 2 * half / DISC_PIXELS) ** 2
    disc = pixels - pixels[around].mean(axis=0)
    disc[around] = 0
    return [float(v) for v in (disc * weight[..., None]).sum(axis=(0, 1))]


def bake(path):
    with open(path, encoding="utf-8") as file:
        request = json.load(file)
    try:
        scene = stage(request)
        set_discs(scene.world, False)
        panorama(scene, request)
        result = {"sun": disc_irradiance(scene, request) if request["sun"] else None}
    except Exception as error:  # pylint: disable=broad-except
        write(request["error"], str(error))
        return
    write(request["result"], json.dumps(result))


def write(path, text):
    with open(path + ".new", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".new", path)


def main():
    rest, source = b"", sys.stdin.fileno()
    while select.select([source], [], [], IDLE_SECONDS)[0]:
        data = os.read(source, 1 << 16)
        if not data:
            break
        *lines, rest = (rest + data).split(b"\n")
        for line in lines:
            bake(os.fsdecode(line))


main()
