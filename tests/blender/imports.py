# SPDX-License-Identifier: Apache-2.0
"""Import of .mi: a round trip keeps geometry exactly, and pictures within tolerance."""
# acceptance: Y5
import math
import pathlib
import shutil
import subprocess
import sys

import bpy
import mathutils
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402
from oriel_blender import dump, engine, exr, importer, meshes, program, versions  # noqa: E402


def build():
    scene = support.empty_scene(64, 48)
    scene.world.color = (.3, .3, .35)
    material, _tree, node = support.node_material("Red Plastic")
    node.inputs["Base Color"].default_value = (.7, .1, .05, 1)
    node.inputs["Roughness"].default_value = .35
    ball = support.add_sphere(1.0, material, (.3, .2, .1), 24)
    ball.rotation_euler, ball.scale = (.2, .3, .4), (1, 1.2, .8)
    floor = support.diffuse_material((.4, .45, .3), "Floor")
    support.add_plane(9.0, floor, z=-1.0)
    area = bpy.data.lights.new("Area", "AREA")
    area.shape, area.size, area.size_y, area.energy = "RECTANGLE", 1.0, 2.0, 120
    support.add("Area", area, (2, -2, 3), (math.radians(40), 0, math.radians(40)))
    spot = bpy.data.lights.new("Spot", "SPOT")
    spot.energy, spot.shadow_soft_size, spot.spot_size = 200, .1, math.radians(60)
    spot.color = (1, .5, .2)
    support.add("Spot", spot, (-2, -2, 3), (math.radians(35), 0, math.radians(-45)))
    sun = bpy.data.lights.new("Sun", "SUN")
    sun.energy, sun.angle = 1.0, 0
    support.add("Sun", sun, (0, 0, 5), (math.radians(30), math.radians(20), 0))
    support.add_camera((0, -7, 2), (math.radians(78), 0, 0), lens=45.0, shift_x=.05, shift_y=-.04)
    return scene


def triangles_of(mesh):
    """Points of the triangles as sorted rows of bits, so that the order does not count."""
    mesh.calc_loop_triangles()
    corners = numpy.empty(len(mesh.loop_triangles) * 3, numpy.int32)
    mesh.loop_triangles.foreach_get("vertices", corners)
    rows = meshes.points_of(mesh)[corners].reshape(-1, 9).view(numpy.uint32)
    return rows[numpy.lexsort(rows.T)]


def save_scene():
    """The last exported scene, kept from the next render."""
    folder = support.FOLDER / "kept"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(engine.session_folder(), folder)
    text = (folder / "frame.mi").read_text().replace(engine.session_folder(), str(folder))
    (folder / "frame.mi").write_text(text)
    return folder / "frame.mi"


def round_trip():
    build()
    first = support.render("ORIEL", 256, "first")
    before = {ob.name: triangles_of(ob.data) for ob in bpy.data.objects if ob.type == "MESH"}
    path = save_scene()
    support.empty_scene(8, 8)
    bpy.ops.import_scene.oriel_mi(filepath=str(path))
    scene = bpy.context.scene
    after = {ob.name: triangles_of(ob.data) for ob in bpy.data.objects if ob.type == "MESH"}
    support.check(len(after) == len(before), f"objects {sorted(after)}")
    for name, rows in before.items():
        found = [v for k, v in after.items() if k.split("#")[0] == name.split("#")[0]]
        support.check(len(found) == 1 and numpy.array_equal(found[0], rows),
                      f"{name}: {len(rows)} triangles are equal in every bit")
    scene.view_settings.view_transform = "Raw"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.cycles.pixel_filter_type = "BOX"
    second = support.render("ORIEL", 256, "second")
    support.check(second.shape == first.shape, "the resolution is kept")
    error = numpy.abs(first - second)[..., :3].mean() / first[..., :3].mean()
    support.check(error < .03, f"the picture by native nodes differs by {error:.2%}")
    material = bpy.data.materials["Red Plastic"]
    node = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    support.check(numpy.allclose(node.inputs["Base Color"].default_value[:3], (.7, .1, .05),
                                 atol=1e-6), "base colour")
    support.check(abs(node.inputs["Roughness"].default_value - .35) < 1e-3, "roughness")
    for material in bpy.data.materials:  # without native nodes: the Principled materials
        output = material.node_tree.nodes.get("Oriel Output")
        if output:
            material.node_tree.nodes.remove(output)
    third = support.render("ORIEL", 256, "third")
    error = numpy.abs(first - third)[..., :3].mean() / first[..., :3].mean()
    support.check(error < .05, f"the picture by Principled materials differs by {error:.2%}")
    sheet = numpy.concatenate([first, second, third], axis=1)
    support.save_png(sheet, support.FOLDER / "round_trip.png")


def scenes():
    """Scenes of the repository import, with their cameras and materials."""
    for name, least in (("daylight.mi", 3), ("freeform.mi", 1), ("interior/interior.mi", 20),
                        ("nine-tiles/nine-tiles.mi", 1)):
        support.empty_scene(8, 8)
        result = bpy.ops.import_scene.oriel_mi(filepath=str(support.ROOT / "scenes" / name))
        count = sum(ob.type == "MESH" for ob in bpy.data.objects)
        support.check(result == {"FINISHED"} and count >= least and bpy.context.scene.camera,
                      f"{name}: {count} objects, {len(bpy.data.materials)} materials")


def many_files():
    """Files of the tests and every sixth scene: no exception, and reports that name what they mean."""
    found = sorted((support.ROOT / "tests").rglob("*.mi")) + \
        sorted((support.ROOT / "scenes").rglob("*.mi"))[::6]
    count, vague = 0, []
    for path in found:
        support.empty_scene(8, 8)
        try:
            source, _messages = dump.convert(str(path))
        except dump.DumpError:
            continue  # such as a file that another one includes
        collection = bpy.data.collections.new(path.name)
        bpy.context.scene.collection.children.link(collection)
        reader = importer.SceneReader(source, bpy.context, "AUTO")
        reader.run(collection)
        count += 1
        vague += [text for text in reader.reports if "material" in text and '"' not in text]
    support.check(count > 40 and not vague, f"{count} files are imported; {vague}")


MOVING = """
$include "base.mi"
options "o" object space end options
light "l" "mib_light_infinite" ("color" 1 1 1) direction 0 0 -1 end light
instance "sun" "l" end instance
object "square" visible on shadow on trace on group
  -1 -1 0 1 -1 0 1 1 0 -1 1 0 v 0 v 1 v 2 v 3 p 0 1 2 3 end group end object
instance "plate" "square" end instance
camera "c" focal 1 aperture 1 aspect 1.5 resolution 48 32 end camera
instance "view" "c" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -5 1 end instance
instgroup "root" "sun" "plate" "view" end instgroup
render "root" "view" "o"
incremental instance "plate" "square" transform 0 -1 0 0 1 0 0 0 0 0 1 0 -2 0 0 1 end instance
incremental instance "view" "c" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -6 1 end instance
render "root" "view" "o"
incremental instance "plate" "square" transform 1 0 0 0 0 1 0 0 0 0 2 0 0 -3 0 1 end instance
render "root" "view" "o"
"""


def imported(name, text):
    """The Blender scene of a file with that text."""
    support.empty_scene(8, 8)
    path = support.FOLDER / name
    path.write_text(text)
    support.check(bpy.ops.import_scene.oriel_mi(filepath=str(path), up="Z") == {"FINISHED"},
                  "it is imported")
    return bpy.context.scene


def frames():
    """The placements of all frames are key frames."""
    scene = imported("moving.mi", MOVING)
    support.check((scene.frame_start, scene.frame_end) == (1, 3), "the frame range")
    plate, view = bpy.data.objects["plate"], scene.camera
    # Transforms of the scene map world to local space, for row vectors.
    inverses = [numpy.eye(4), numpy.array([[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [-2, 0, 0, 1]]),
                numpy.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 2, 0], [0, -3, 0, 1]])]
    for frame, inverse in enumerate(inverses, 1):
        scene.frame_set(frame)
        expected = numpy.linalg.inv(inverse.astype(float)).T
        error = numpy.abs(numpy.array(plate.matrix_world) - expected).max()
        distance = view.matrix_world.translation.z
        support.check(error < 1e-5 and abs(distance - (5, 6, 6)[frame - 1]) < 1e-5,
                      f"frame {frame}: matrix differs by {error:.1e}, camera at {distance:.3f}")
    support.check(bpy.data.objects["sun"].animation_data is None, "what rests has no key frames")


CHANGING = """
$include "base.mi"
$include "architectural.mi"
$include "oriel.mi"
options "o" object space end options
light "lamp" "physical_light" ("color" 4 2 1) origin 0 0 3 direction 0 0 -1
  rectangle 1 0 0 0 2 0 end light
instance "lamp.i" "lamp" end instance
light "sun" "mia_physicalsun" () direction 0 0 -1 end light
instance "sun.i" "sun" transform 1 0 0 0 0 0 -1 0 0 1 0 0 0 0 0 1 end instance
shader "paint" "mia_material_x" ("diffuse" .8 .2 .1, "refl_gloss" 1)
material "red" = "paint" end material
material "still" "mia_material_x" ("diffuse" .1 .2 .3) end material
object "square" visible on group
  -1 -1 0 1 -1 0 1 1 0 -1 1 0 v 0 v 1 v 2 v 3 p 0 1 2 3 end group end object
instance "plate" "square" material ["red"] end instance
instance "second" "square" material ["still"] end instance
shader "sky" "mia_physicalsky" ("sun" "sun.i", "haze" 0)
camera "c" lens "mia_lens_bokeh" ("on" on, "plane" 4, "radius" .01)
  lens "mia_exposure_photographic" ("film_iso" 100, "f_number" 8, "camera_shutter" 100, "cm2_factor" 1)
  environment = "sky"
  focal 2 aperture 1 aspect 1.5 resolution 48 32 end camera
instance "view" "c" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -5 1 end instance
instance "other" "c" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -9 1 end instance
instgroup "root" "plate" "second" "lamp.i" "sun.i" "view" "other" end instgroup
render "root" "view" "o"
incremental light "lamp" "physical_light" ("color" 0 8 4) origin 0 0 3 direction 0 1 0
  rectangle 2 0 0 0 0 2 end light
render "root" "view" "o"
render "root" "view" "o"
incremental shader "paint" "mia_material_x" ("diffuse" .2 .6 .1, "refl_gloss" .5)
incremental instance "sun.i" "sun" transform 0 0 1 0 0 1 0 0 -1 0 0 0 0 0 0 1 end instance
incremental camera "c" lens "mia_lens_bokeh" ("on" on, "plane" 6, "radius" .02)
  lens "mia_exposure_photographic" ("film_iso" 400, "f_number" 8, "camera_shutter" 100, "cm2_factor" 1)
  environment = "sky"
  focal 1 aperture 1 aspect 1.5 resolution 48 32 offset 4.8 0 end camera
render "root" "other" "o"
"""


def values_over_frames():
    """Cameras, lights, materials, sky and exposure of all frames are key frames."""
    scene = imported("changing.mi", CHANGING)
    lamp = next(o for o in bpy.data.objects if o.type == "LIGHT" and o.data.type == "AREA")
    sky = next(n for n in scene.world.node_tree.nodes if n.type == "TEX_SKY")
    red = bpy.data.materials["red"].node_tree
    plastic = next(n for n in red.nodes if n.type == "BSDF_PRINCIPLED")
    native = next(n for n in red.nodes if n.bl_idname == "OrielNode_mia_material_x")
    camera = next(o for o in bpy.data.objects if o.name == "view").data

    def state():
        down = lamp.matrix_world.to_3x3() @ mathutils.Vector((0, 0, -1))
        return [lamp.data.energy, *lamp.data.color, lamp.data.size, lamp.data.size_y, *down,
                *plastic.inputs["Base Color"].default_value[:3],
                *native.inputs["diffuse"].default_value[:3],
                native.inputs["refl_gloss"].default_value, camera.lens,
                camera.dof.focus_distance, camera.dof.aperture_fstop, camera.shift_x,
                math.degrees(sky.sun_elevation), 2 ** scene.view_settings.exposure]
    # An exposure is proportional to the film speed; the f-number to the focal length by the radius.
    lit = 1 / (1.2 * 64 * 100)
    lamps = ([4, 1, .5, .25, 1, 2, 0, 0, -1], [8, 0, 1, .5, 2, 2, 0, 1, 0])
    paints = ([.8, .2, .1] * 2 + [1], [.2, .6, .1] * 2 + [.5])
    views = ([72, 4, .072 / .02, 0], [36, 6, .036 / .04, .1])
    expected = [lamps[0] + paints[0] + views[0] + [0, lit], lamps[1] + paints[0] + views[0] + [0, lit],
                lamps[1] + paints[0] + views[0] + [0, lit],
                lamps[1] + paints[1] + views[1] + [0, 4 * lit]]
    suns = []
    for frame, wanted in enumerate(expected, 1):
        scene.frame_set(frame)
        have = state()
        suns.append((round(math.degrees(sky.sun_elevation)), round(math.degrees(sky.sun_rotation))))
        wanted[-2] = have[-2]
        error = numpy.abs(numpy.array(have) - wanted)
        support.check(error.max() < 2e-4, f"frame {frame}: value {error.argmax()} is "
                      f"{have[error.argmax()]:.5f} of {wanted[error.argmax()]:.5f}")
        support.check(scene.camera.name == ("view", "view", "view", "other")[frame - 1],
                      f"camera {scene.camera.name}")
    support.check(len(set(suns[:3])) == 1 and suns[3] != suns[0], f"the sun moves: {suns}")
    support.check(bpy.data.materials["still"].node_tree.animation_data is None,
                  "what does not change has no key frames")


TEXTURED = """
$include "base.mi"
$include "architectural.mi"
options "o" object space samples 0 2 filter box 1 1 trace on shadow segments "indirect" "path"
end options
color texture "picture" "picture.png"
shader "place" "mib_texture_vector" ("select" 0)
shader "second" "mib_texture_vector" ("select" 1)
shader "smaller" "mib_texture_remap" ("input" = "place",
  "transform" 2 0 0 0 0 3 0 0 0 0 1 0 .25 0 0 1, "torus_x" on, "torus_y" on)
shader "colours" "mib_texture_lookup" ("tex" "picture", "coord" = "smaller")
shader "others" "mib_texture_lookup" ("tex" "picture", "coord" = "second")
shader "whole" "mib_texture_lookup" ("tex" "picture", "coord" = "place")
shader "alpha" "mib_color_alpha" ("input" = "whole", "factor" 1)
material "a" "mia_material_x" ("diffuse" = "colours", "reflectivity" 0) end material
material "b" "mia_material_x" ("diffuse" = "others", "reflectivity" 0) end material
shader "leaf" "mia_material_x" ("diffuse" .8 .4 .2, "reflectivity" 0, "cutout_opacity" = "alpha")
material "c" = "leaf" shadow = "leaf" end material
object "square" visible on shadow on trace on tagged on group
  -1 -1 0 1 -1 0 1 1 0 -1 1 0  0 0 0 1 0 0 1 1 0 0 1 0  0 0 0 0 1 0 1 1 0 1 0 0
  v 0 t 4 t 8 v 1 t 5 t 9 v 2 t 6 t 10 v 3 t 7 t 11 p 0 0 1 2 3 end group end object
light "sun" "mib_light_infinite" ("color" 1 1 1, "shadow" on) direction 0 0 -1 end light
instance "sun_i" "sun" end instance
instance "a_i" "square" material ["a"] transform 1 0 0 0 0 1 0 0 0 0 1 0 2.1 0 0 1 end instance
instance "b_i" "square" material ["b"] end instance
instance "c_i" "square" material ["c"] transform 1 0 0 0 0 1 0 0 0 0 1 0 -2.1 0 0 1 end instance
instance "above" "square" material ["a"] visible off shadow 4
  transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -1 1 end instance
camera "cam" focal infinity aperture 6.4 aspect 3 resolution 96 32 end camera
instance "view" "cam" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -5 1 end instance
instgroup "root" "sun_i" "a_i" "b_i" "c_i" "above" "view" end instgroup
render "root" "view" "o"
"""


def textured():
    """Textures by native nodes: maps by number, transforms, alpha, and objects that rays do not see."""
    support.empty_scene(8, 8)
    v, u = (numpy.mgrid[0:32, 0:32] + .5) / 32
    pixels = numpy.stack([u, v, .3 + 0 * u, (u > .5) * 1.0], axis=-1).astype(numpy.float32)
    image = bpy.data.images.new("picture", 32, 32, alpha=True)
    image.pixels.foreach_set(pixels.ravel())
    image.filepath_raw, image.file_format = str(support.FOLDER / "picture.png"), "PNG"
    image.save()
    scene = imported("textured.mi", TEXTURED)
    scene.cycles.pixel_filter_type, scene.view_settings.view_transform = "BOX", "Raw"
    scene.render.image_settings.file_format = "OPEN_EXR"
    ours, theirs = (support.render(e, 64, "textured")[..., :3] for e in ("ORIEL", "CYCLES"))
    target = support.FOLDER / "direct.exr"
    subprocess.run([program.find(), "render", str(support.FOLDER / "textured.mi"), "-o", str(target),
                    "--samples", "64", "--linear", "--exr", "float,none", "-q"], check=True)
    direct = exr.read(target).stack(list("RGB")).reshape(ours.shape)
    support.save_png(numpy.concatenate([ours, theirs, direct], axis=0)[..., [0, 1, 2, 2]],
                     support.FOLDER / "textured.png")
    error = numpy.abs(ours - direct).mean() / direct.mean()
    support.check(error < .01 and direct.mean() > .05, f"native nodes differ by {error:.2%}")
    error = numpy.abs(theirs - direct).mean() / direct.mean()
    support.check(error < .03, f"Principled materials in Cycles differ by {error:.2%}")


def includes():
    """Missing includes are searched in the folders above the scene."""
    folder = support.FOLDER / "project" / "shots"
    folder.mkdir(parents=True, exist_ok=True)
    (folder.parent / "parts").mkdir(exist_ok=True)
    (folder.parent / "parts" / "all.mi").write_text(MOVING)
    (folder / "shot.mi").write_text('$include "parts/all.mi"\n')
    support.empty_scene(8, 8)
    bpy.ops.import_scene.oriel_mi(filepath=str(folder / "shot.mi"), up="Z")
    support.check("plate" in bpy.data.objects, f"objects {[o.name for o in bpy.data.objects]}")


def gltf():
    """Blender's own importer reads the glTF file of a scene: geometry, camera and lights are equal."""
    import addon_utils
    scene = build()
    # glTF has no photometric profiles, by which spots of Blender 3.4 are written.
    with_cosine, versions.spots_have_cosine = versions.spots_have_cosine, lambda: False
    support.render("ORIEL", 1, "gltf")
    versions.spots_have_cosine = with_cosine
    points = {ob.name.split("#")[0]: numpy.array([ob.matrix_world @ v.co for v in ob.data.vertices])
              for ob in bpy.data.objects if ob.type == "MESH"}
    lights = {ob.name: (ob.data.type, ob.data.energy, tuple(ob.data.color))
              for ob in bpy.data.objects if ob.type == "LIGHT" and ob.data.type != "AREA"}
    camera = numpy.array(scene.camera.matrix_world)
    angle = scene.camera.data.angle_y if scene.camera.data.sensor_fit == "VERTICAL" else \
        2 * math.atan(math.tan(scene.camera.data.angle / 2) * 48 / 64)
    path = save_scene()
    target = support.FOLDER / "scene.glb"
    subprocess.run([program.find(), "convert", str(path), str(target), "--up", "z"], check=True)
    support.empty_scene(8, 8)
    addon_utils.enable("io_scene_gltf2")
    numpy.bool = bool  # Debian's importer uses the name that NumPy 1.24 removed
    bpy.ops.import_scene.gltf(filepath=str(target))
    found = {ob.name.split("#")[0]: ob for ob in bpy.data.objects if ob.type == "MESH"}
    for name, wanted in points.items():
        ob = next((o for k, o in found.items() if k.startswith(name)), None)
        support.check(ob is not None, f"{name} is there")
        have = numpy.array([ob.matrix_world @ v.co for v in ob.data.vertices])
        gap = max(numpy.abs(have - p).sum(axis=1).min() for p in wanted)
        support.check(gap < 1e-4, f"{name}: points differ by {gap:.1e}")
    ob = next(o for o in bpy.data.objects if o.type == "CAMERA")
    error = numpy.abs(numpy.array(ob.matrix_world) - camera).max()
    support.check(error < 1e-4, f"camera matrix differs by {error:.1e}")
    have = ob.data.angle_y if ob.data.sensor_fit == "VERTICAL" else ob.data.angle
    wanted = angle if ob.data.sensor_fit == "VERTICAL" else scene_angle(angle)
    support.check(abs(have - wanted) < 1e-3, f"angle of view {have:.4f} of {wanted:.4f}")
    for name, (kind, energy, colour) in lights.items():
        ob = next((o for o in bpy.data.objects if o.type == "LIGHT" and o.name.startswith(name)), None)
        support.check(ob is not None and ob.data.type == kind, f"{name} is a {kind} light")
        peak = max(colour)
        power = ob.data.energy * max(ob.data.color)
        # A pixel unit is 1 cd/m2 in the file, and W/(m2 sr) here; the importer divides by 683 lm/W.
        support.check(abs(683 * power / (energy * peak) - 1) < 1e-3,
                      f"{name}: {power:.6f} W of {energy * peak:.1f} W / 683")


def scene_angle(angle):
    """The horizontal angle of a picture of 64 x 48 pixels."""
    return 2 * math.atan(math.tan(angle / 2) * 64 / 48)


def damaged():
    """Arrays outside of the file and unknown versions are refused."""
    base = {"format": "oriel-scene", "version": 1}
    source = dump.Dump(base, b"\0" * 8)
    for place in ({"offset": 0, "count": 3}, {"offset": -4, "count": 1}, {"offset": 8, "count": 1}):
        try:
            source.integers(place)
            support.check(False, f"{place} is refused")
        except dump.DumpError:
            support.check(True, f"{place} is refused")
    for root in ({"format": "x"}, {**base, "version": 2}, []):
        try:
            dump.Dump(root, b"")
            support.check(False, f"{root} is refused")
        except dump.DumpError:
            support.check(True, f"{root} is refused")


support.run([round_trip, scenes, many_files, frames, values_over_frames, textured, includes,
             gltf, damaged])
