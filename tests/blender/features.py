# SPDX-License-Identifier: Apache-2.0
"""Final renders: passes, mattes, instances, hair, motion blur, files, errors and native nodes."""
# acceptance: Y1, Y3
import math
import pathlib
import sys
import time

import bpy
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402
from oriel_blender import engine, exr, export, mattes, meshes, native, program  # noqa: E402


def lit_scene(width=48, height=48):
    scene = support.empty_scene(width, height)
    scene.world.color = (.5, .5, .5)
    support.add_camera((0, 0, 6), lens=50.0)
    return scene


def layers(samples=16):
    """Renders into a multilayer file; returns its channels by name."""
    scene = bpy.context.scene
    scene.render.engine, scene.oriel.samples = "ORIEL", samples
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.exr_codec = "NONE"
    scene.render.filepath = str(support.FOLDER / "layers.exr")
    bpy.ops.render.render(write_still=True)
    return exr.read(scene.render.filepath)


def passes():
    scene = lit_scene()
    material, _tree, node = support.node_material("Paint")
    node.inputs["Base Color"].default_value = (.8, .4, .2, 1)
    support.add_plane(2.0, material)
    light = bpy.data.lights.new("Lamp", "POINT")
    light.energy = 100
    support.add("Lamp", light, (0, 0, 3))
    layer = bpy.context.view_layer
    for name in ("z", "position", "normal", "vector", "diffuse_direct", "diffuse_indirect",
                 "diffuse_color", "glossy_direct", "glossy_indirect", "glossy_color",
                 "transmission_indirect", "transmission_color", "emit", "cryptomatte_object",
                 "cryptomatte_material"):
        setattr(layer, f"use_pass_{name}", True)
    layer.oriel.use_albedo = layer.oriel.use_noise = True
    bpy.ops.scene.view_layer_add_lightgroup(name="key")
    bpy.data.objects["Lamp"].lightgroup = "key"
    picture = layers()
    get = lambda *names: picture.stack(["ViewLayer." + n for n in names])
    middle = 24 * 48 + 24
    depth = get("Depth.Z")
    support.check(depth is not None and abs(depth[middle, 0] - 6) < .02, "depth is the distance")
    support.check(depth[0, 0] > 1e9, "depth of the background is 1e10")
    normal = get("Normal.X", "Normal.Y", "Normal.Z")[middle]
    support.check(numpy.allclose(normal, (0, 0, 1), atol=1e-5), f"normal {normal}")
    position = get("Position.X", "Position.Y", "Position.Z")[middle]
    support.check(abs(position[2]) < 1e-5 and abs(position[0]) < .1, f"position {position}")
    rgb = lambda name: get(f"{name}.R", f"{name}.G", f"{name}.B")
    total = (rgb("DiffDir") + rgb("DiffInd")) * rgb("DiffCol") + \
        (rgb("GlossDir") + rgb("GlossInd")) * rgb("GlossCol") + \
        rgb("TransInd") * rgb("TransCol") + rgb("Emit")
    beauty = rgb("Combined")
    error = numpy.abs(total[middle] - beauty[middle]).max() / beauty[middle].max()
    support.check(error < .01, f"passes sum to the picture, difference {error:.3%}")
    key = rgb("Combined_key")
    support.check(key is not None and 0 < key[middle, 0] < beauty[middle, 0],
                  "the light group has a part of the light")
    support.check(get("Noise.X") is not None, "noise pass")
    matte(picture, middle)


def matte(picture, middle):
    """The id of the first rank is the hash of the object's name, as Cycles writes it."""
    ids = picture.channels["ViewLayer.CryptoObject00.R"].ravel()
    cover = picture.channels["ViewLayer.CryptoObject00.G"].ravel()
    bits = ids[middle].view(numpy.uint32)
    expected = mattes.murmur3("Plane")
    exponent = expected >> 23 & 255
    if exponent in (0, 255):
        expected ^= 1 << 23
    support.check(int(bits) == expected, f"matte id {int(bits):08x} is that of Plane")
    support.check(abs(cover[middle] - 1) < 1e-5, "the matte covers the pixel")
    names = [v for k, v in picture.attributes.items()
             if k.startswith("cryptomatte/") and k.endswith("/name")]
    support.check("ViewLayer.CryptoObject" in names, f"matte metadata {names}")


def geometry():
    """Instances, collections, slots per face, custom normals, modifiers, curves."""
    scene = lit_scene()
    red, green = (support.diffuse_material(c, n) for c, n in (((1, 0, 0), "Red"),
                                                              ((0, 1, 0), "Green")))
    two = support.add_mesh("Two", [(-1, 0, 0), (0, 0, 0), (1, 0, 0), (-1, 1, 0), (0, 1, 0),
                                   (1, 1, 0)], [(0, 1, 4, 3), (1, 2, 5, 4)], red)
    two.data.materials.append(green)
    two.data.polygons[1].material_index = 1
    pixels = support.render("ORIEL", 16, "slots")
    support.check(pixels[28, 18, 0] > .1 > pixels[28, 18, 1], "left face is red")
    support.check(pixels[28, 30, 1] > .1 > pixels[28, 30, 0], "right face is green")
    linked = support.add("Linked", two.data, (0, -1.2, 0))
    linked.material_slots[0].link = "OBJECT"
    linked.material_slots[0].material = green
    pixels = support.render("ORIEL", 16, "linked")
    support.check(pixels[19, 18, 1] > .1 > pixels[19, 18, 0], "slot of the object is green")
    support.check(count_meshes() == 1, "objects that share a mesh share its file")
    collection = bpy.data.collections.new("Group")
    collection.objects.link(two)
    empty = support.add("Empty", None, (0, .9, 0))
    empty.instance_type, empty.instance_collection = "COLLECTION", collection
    pixels = support.render("ORIEL", 16, "collection")
    support.check(pixels[36, 18, 0] > .1, "the instance of the collection is there")
    modifier = two.modifiers.new("Array", "ARRAY")
    modifier.relative_offset_displace = (0, 0, 0)
    modifier.use_constant_offset, modifier.constant_offset_displace = True, (0, .5, 0)
    modifier.count = 2
    pixels = support.render("ORIEL", 16, "modifier")
    support.check(pixels[43, 18, 0] > .1, "the modifier is applied")


def denoised():
    """Denoising changes Combined, lowers its noise, and keeps the noisy picture."""
    scene = lit_scene()
    support.add_plane(2.0, support.diffuse_material())
    scene.world.color = (0, 0, 0)
    light = bpy.data.lights.new("Lamp", "AREA")
    light.size, light.energy = 4.0, 100
    support.add("Lamp", light, (2, 0, 3), (0, math.radians(30), 0))
    scene.oriel.denoise = bpy.context.view_layer.oriel.use_noisy = True
    picture = layers(4)
    get = lambda name: picture.channels[f"ViewLayer.{name}"][18:30, 18:30]
    clean, noisy = get("Combined.R"), get("Noisy Image.R")
    before, after = (numpy.diff(p, axis=1).std() for p in (noisy, clean))
    support.check(after < .5 * before, f"difference of neighbours {before:.4f} to {after:.4f}")
    support.check(abs(clean.mean() / noisy.mean() - 1) < .02, "the mean is kept")


def portal():
    """A portal in the window of a room does not change the light, and lowers the noise."""
    scene = lit_scene()
    scene.world.color = (4, 4, 4)
    h, material = 2.0, support.diffuse_material((.5, .5, .5))
    corners = [(x, y, z) for x in (-h, h) for y in (-h, h) for z in (-h, h)]
    faces = [(0, 1, 3, 2), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    support.add_mesh("Room", corners, faces, material)  # open towards +x
    blind = [(h, -h, -h), (h, h, -h), (h, h, h), (h, -h, h), (h, -1, -1), (h, 1, -1), (h, 1, 1),
             (h, -1, 1)]
    support.add_mesh("Wall", blind, [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
                     material)
    support.add_camera((1.5, 0, 0), (math.radians(90), 0, math.radians(90)), lens=20.0)
    without = support.render("ORIEL", 256, "room")[..., :3]
    light = bpy.data.lights.new("Portal", "AREA")
    light.shape, light.size, light.cycles.is_portal = "SQUARE", 2.0, True
    support.add("Portal", light, (h, 0, 0), (0, math.radians(90), 0))
    pixels = support.render("ORIEL", 256, "portal")[..., :3]
    support.check(abs(pixels.mean() / without.mean() - 1) < .03 and without.mean() > .05,
                  f"mean {without.mean():.4f} without, {pixels.mean():.4f} with a portal")


def views():
    """View layers show their own objects; views of a stereo camera differ by the parallax."""
    scene = lit_scene()
    scene.world.color = (1, 1, 1)
    squares = [support.add_plane(1.0, support.diffuse_material(c, n)) for c, n in (
        ((1, 0, 0), "Red"), ((0, 1, 0), "Green"))]
    second = scene.view_layers.new("Second")
    for x, square, layer in ((-1, squares[0], second), (1, squares[1], scene.view_layers[0])):
        square.location.x = x
        collection = bpy.data.collections.new(square.name)
        scene.collection.children.link(collection)
        scene.collection.objects.unlink(square)
        collection.objects.link(square)
        layer.layer_collection.children[collection.name].exclude = True
    picture = layers()
    get = lambda layer, channel, x: picture.channels[f"{layer}.Combined.{channel}"][24, x]
    support.check(get("ViewLayer", "G", 12) == 0 and get("ViewLayer", "G", 36) > .9,
                  "the first view layer has the red square only")
    support.check(get("Second", "R", 36) == 0 and get("Second", "R", 12) > .9,
                  "the second view layer has the green square only")
    scene.view_layers.remove(second)
    scene.render.use_multiview = True
    scene.render.image_settings.views_format = "INDIVIDUAL"
    stereo = scene.camera.data.stereo
    stereo.convergence_distance, stereo.interocular_distance = 3.0, .5
    layers()
    centres = []
    for name in ("_L", "_R"):
        picture = exr.read(str(support.FOLDER / f"layers{name}.exr"))
        dark = 1 - picture.channels["ViewLayer.Combined.G"][24]
        centres.append((dark * numpy.arange(48)).sum() / dark.sum())
    # 50 / 36 * 48 pixels at distance 1: the film shift of .5 / 3 less the parallax of .5 / 6.
    expected = 50 / 36 * 48 * .5 * (1 / 3 - 1 / 6)
    support.check(abs(centres[1] - centres[0] - expected) < .1,
                  f"parallax {centres[1] - centres[0]:.2f} of {expected:.2f} pixels")


def count_meshes():
    folder = pathlib.Path(engine.session_folder()) / "meshes"
    return len(list(folder.glob("mesh-*.mi")))


def normals():
    """Custom normals: of a plane whose normals lean, the light of a sun is that of the lean."""
    scene = lit_scene()
    scene.world.color = (0, 0, 0)
    plane = support.add_plane(4.0, support.diffuse_material())
    lean = numpy.array([math.sin(math.radians(60)), 0, math.cos(math.radians(60))])
    from oriel_blender import versions
    versions.set_corner_normals(plane.data, [tuple(lean)] * 4)
    sun = bpy.data.lights.new("Sun", "SUN")
    sun.energy, sun.angle = math.pi, 0
    support.add("Sun", sun, (0, 0, 5))
    pixels = support.render("ORIEL", 16, "normals")
    support.check(abs(pixels[24, 24, 0] - .5) < .01, f"custom normals: {pixels[24, 24, 0]:.4f}")


def hair():
    scene = lit_scene()
    curves = bpy.data.hair_curves.new("Hair")
    ob = support.add("Hair", curves)
    if not hasattr(curves, "add_curves"):  # until 3.5 curves are made by operators only
        bpy.data.objects.remove(ob)
        particles()
        return
    curves.add_curves([2, 3])
    support.render("ORIEL", 16, "hair")


def particles():
    plane = support.add_plane(.01, support.diffuse_material((1, .5, .2)))
    plane.modifiers.new("Hair", "PARTICLE_SYSTEM")
    settings = plane.particle_systems[0].settings
    settings.type, settings.count, settings.hair_length = "HAIR", 1, 2.0
    settings.root_radius = settings.tip_radius = 1.0
    settings.radius_scale = .2
    camera = bpy.context.scene.camera
    camera.location, camera.rotation_euler = (0, -6, 1), (math.radians(90), 0, 0)
    pixels = support.render("ORIEL", 16, "hair")
    colour = pixels[24, 24]
    support.check(colour[0] > 1.5 * colour[2] > 0, f"hair is seen: {colour}")


def motion():
    """A square that moves by its width during the shutter is smeared."""
    scene = lit_scene()
    scene.world.color = (0, 0, 0)
    material, tree, _ = support.node_material("Emitter")
    node = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    square = support.add_plane(1.0, material)
    for frame, x in ((0, -2.0), (2, 2.0)):
        square.location.x = x
        square.keyframe_insert("location", frame=frame)
    for curve in square.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    scene.frame_set(1)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, .5
    ours = support.render("ORIEL", 256, "motion")[24, :, 0]
    theirs = support.render("CYCLES", 256, "motion")[24, :, 0]
    error = numpy.abs(ours - theirs).max()
    support.check(.3 < ours.max() < 1.05 and (ours > .02).sum() > 16, "the square is smeared")
    support.check(error < .06, f"transform blur as in Cycles, largest difference {error:.3f}")
    support.check(scene.frame_current == 1, "the frame is restored")
    square.animation_data_clear()
    square.location.x = 0
    square.shape_key_add(name="Basis")
    key = square.shape_key_add(name="Moved")
    for point in key.data:
        point.co.x += 2
    for frame, value in ((0, 0.0), (2, 1.0)):
        key.value = value
        key.keyframe_insert("value", frame=frame)
    for curve in square.data.shape_keys.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    scene.frame_set(1)
    ours = support.render("ORIEL", 256, "deform")[24, :, 0]
    theirs = support.render("CYCLES", 256, "deform")[24, :, 0]
    error = numpy.abs(ours - theirs).max()
    support.check(error < .06 and ours.max() > .5,
                  f"deformation blur as in Cycles, largest difference {error:.3f}")


def turning():
    """A bar that turns by 90 degrees during the shutter, by its transform and by its points, sweeps
    the arc that it sweeps in Cycles."""
    scene = lit_scene()
    scene.world.color = (0, 0, 0)
    material, tree, _ = support.node_material("Emitter")
    node = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    bar = support.add_mesh("Bar", [(.6, -.15, 0), (1.2, -.15, 0), (1.2, .15, 0), (.6, .15, 0)],
                           [(0, 1, 2, 3)], material)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.0
    bar.rotation_euler.z = -math.pi / 4
    for frame, angle in ((0, -math.pi / 2), (2, math.pi / 2)):
        bar.rotation_euler.z = angle
        bar.keyframe_insert("rotation_euler", frame=frame)
    for curve in bar.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    scene.frame_set(1)
    for label in ("transform", "points"):
        if label == "points":  # a child that its armature-like modifier moves
            bar.animation_data_clear()
            bar.rotation_euler.z = 0
            empty = support.add("Hook", None)
            for frame, angle in ((0, -math.pi / 2), (2, math.pi / 2)):
                empty.rotation_euler.z = angle
                empty.keyframe_insert("rotation_euler", frame=frame)
            for curve in empty.animation_data.action.fcurves:
                for key in curve.keyframe_points:
                    key.interpolation = "LINEAR"
            empty.rotation_euler.z = 0
            hook = bar.modifiers.new("Hook", "HOOK")
            hook.object = empty
            hook.vertex_indices_set([0, 1, 2, 3])
            scene.frame_set(1)
        ours = support.render("ORIEL", 256, "turning")[..., 0]
        theirs = support.render("CYCLES", 256, "turning")[..., 0]
        def blocks(p):
            return p.reshape(12, 4, 12, 4).mean(axis=(1, 3))
        error = numpy.abs(blocks(ours) - blocks(theirs)).max()
        support.check(error < .06 and ours.max() > .1,
                      f"blur of turning {label} as in Cycles, largest difference {error:.3f}")


def frames():
    """An animation writes unchanged meshes once, although normals that many threads add up differ in
    the last bits."""
    scene = lit_scene()
    support.add_plane(1.0, support.diffuse_material())
    moved = support.add_sphere(.3, support.diffuse_material(), segments=128)
    moved.modifiers.new("Subdivision", "SUBSURF").render_levels = 1
    for frame in (1, 3):
        moved.location.x = frame
        moved.keyframe_insert("location", frame=frame)
    scene.frame_start, scene.frame_end = 1, 3
    scene.render.engine, scene.oriel.samples = "ORIEL", 1
    scene.render.filepath = str(support.FOLDER / "frame_")
    written = []
    add = meshes.MeshFolder.add_mesh
    def count(self, *arguments):
        before = self.written
        path = add(self, *arguments)
        written.append(self.written - before)
        return path
    meshes.MeshFolder.add_mesh = count
    try:
        bpy.ops.render.render(animation=True)
    finally:
        meshes.MeshFolder.add_mesh = add
    support.check(len(written) == 6 and sum(written) <= 2, f"new files per mesh: {written}")
    for frame in (1, 2, 3):
        support.check((support.FOLDER / f"frame_{frame:04d}.exr").exists(), f"frame {frame}")


def failures():
    """A missing program, a crash and a missing camera are errors, not crashes."""
    scene = lit_scene()
    scene.render.engine = "ORIEL"
    found = program.find
    false = support.FOLDER / "broken"
    false.write_text("#!/bin/sh\nkill -SEGV $$\n")
    false.chmod(0o755)
    for label, path in (("crash", str(false)),):
        program.find = lambda: path
        try:
            bpy.ops.render.render()
            support.check(False, f"{label}: reported")
        except RuntimeError as error:
            support.check("Oriel" in str(error), f"{label}: {str(error).strip()}")
        finally:
            program.find = found
    scene.camera = None
    try:
        bpy.ops.render.render()
        support.check(False, "no camera: reported")
    except RuntimeError as error:
        support.check("camera" in str(error), f"no camera: {str(error).strip()}")


def cancelled():
    """A cancelled render ends its process at once."""
    scene = lit_scene()
    support.add_plane(2.0, support.diffuse_material())
    scene.render.engine, scene.oriel.samples = "ORIEL", 1000000
    scene.render.resolution_x = scene.render.resolution_y = 512
    runs, kept = [], engine.process.RenderProcess

    class Watched(kept):
        def __init__(self, *arguments):
            super().__init__(*arguments)
            runs.append(self)

    engine.process.RenderProcess = Watched
    cancel = engine.OrielEngine.cancelled
    engine.OrielEngine.cancelled = lambda self: True
    try:
        bpy.ops.render.render()
    finally:
        engine.process.RenderProcess = kept
        engine.OrielEngine.cancelled = cancel
    support.check(len(runs) == 1 and not runs[0].running(), "the process has ended")


def nodes():
    """Every shader of the program has a node with its parameters; a native material renders."""
    declarations = program.declarations()
    lit_scene()
    material, tree, _ = support.node_material("Native")
    for declaration in declarations:
        node = tree.nodes.new(native.PREFIX + declaration["name"])
        missing = {p["name"] for p in declaration["parameters"] if p["type"] in native.SOCKETS} - \
            {s.name for s in node.inputs}
        if missing or not node.outputs:
            support.check(False, f"sockets of {declaration['name']}: {missing} are missing")
        tree.nodes.remove(node)
    support.check(len(declarations) > 100, f"nodes of {len(declarations)} shaders")
    node = tree.nodes.new(native.PREFIX + "mia_material_x")
    names = {s.name for s in node.inputs}
    expected = {p["name"] for d in declarations if d["name"] == "mia_material_x"
                for p in d["parameters"] if p["type"] in native.SOCKETS}
    support.check(names == expected, "sockets of mia_material_x are its parameters")
    support.check(abs(node.inputs["refr_ior"].default_value - 1.4) < 1e-6, "defaults")
    node.inputs["diffuse"].default_value = (.9, .1, .1, 1)
    node.inputs["reflectivity"].default_value = 0
    tree.links.new(node.outputs["BSDF"], tree.nodes["Material Output"].inputs["Surface"])
    support.add_plane(4.0, material)
    pixels = support.render("ORIEL", 16, "native")
    support.check(numpy.allclose(pixels[24, 24, :3], (.45, .05, .05), atol=.01),
                  f"native material {pixels[24, 24, :3]}")


def speed():
    """A million triangles; the time is printed only."""
    scene = lit_scene()
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=708, y_subdivisions=708, size=4)
    bpy.context.object.data.materials.append(support.diffuse_material())
    depsgraph = bpy.context.evaluated_depsgraph_get()
    folder = meshes.MeshFolder(support.FOLDER / "speed")
    for path in folder.folder.glob("*.mi"):
        path.unlink()
    started = time.time()
    exporter = export.Exporter(depsgraph, str(support.FOLDER), folder, print)
    exporter.write(str(support.FOLDER / "speed.mi"), (48, 48))
    print(f"exported {len(bpy.context.object.data.loop_triangles)} triangles in "
          f"{time.time() - started:.2f} s")
    bpy.context.object.location.z = -.5
    pixels = support.render("ORIEL", 4, "speed")
    support.check(abs(pixels[24, 24, 0] - .5) < .05, "a million triangles render")


def registration():
    """The add-on is enabled and disabled without leftovers."""
    import oriel_blender
    before = set(dir(bpy.types))
    for _ in range(2):
        oriel_blender.unregister()
        left = [n for n in dir(bpy.types) if "oriel" in n.lower()]
        support.check(not left and not hasattr(bpy.types.Scene, "oriel"), f"unregistered: {left}")
        oriel_blender.register()
    support.check(set(dir(bpy.types)) == before, "registered again")


support.run((passes, denoised, portal, views, geometry, normals, hair, motion, turning, frames, failures,
             cancelled, nodes, speed, registration))
