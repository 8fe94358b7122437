# SPDX-License-Identifier: Apache-2.0
"""Import of .mi: a round trip keeps geometry exactly, and pictures within tolerance."""
# acceptance: Y5
import math
import pathlib
import shutil
import sys

import bpy
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402
from oriel_blender import dump, engine, meshes  # noqa: E402


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


round_trip()
scenes()
damaged()
print("all tests passed")
