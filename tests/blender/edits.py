# SPDX-License-Identifier: Apache-2.0
"""Edits in the viewport: the picture after each has the bytes of a scene that is read afresh."""
# acceptance: Y4
import math
import pathlib
import sys
import tempfile
import time

import bpy
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402
from oriel_blender import export, meshes, program, viewport, viewport_worker  # noqa: E402

SIZE = 160, 96
SECONDS = 60


class Region:
    width, height = SIZE


class View:
    """A view as of the camera, without a window."""
    view_perspective = "CAMERA"

    def __init__(self, scene, depsgraph):
        self.view_matrix = scene.camera.matrix_world.inverted()
        self.window_matrix = scene.camera.calc_matrix_camera(depsgraph, x=SIZE[0], y=SIZE[1])


def job(folder, mesh_folder, known):
    depsgraph = bpy.context.evaluated_depsgraph_get()
    exporter = export.Exporter(depsgraph, folder, mesh_folder, lambda text: None)
    exporter.known = known
    environment = exporter.body()
    scene = bpy.context.scene
    window = viewport.ViewWindow(Region, View(scene, depsgraph), scene)
    names = "view", "view.instance"
    ending = export.Exporter.ending([*exporter.out.members, names[1]], names[1])
    return viewport_worker.Job([*exporter.out.parts, *window.parts(environment, names)], ending,
                               {"samples": 4, "denoise": False, "region": None}, (), SIZE)


def finish(worker, state):
    worker.submit(state)
    end = time.time() + SECONDS
    while worker.finished != worker.submitted and time.time() < end and not worker.error:
        time.sleep(.01)
    support.check(worker.finished == worker.submitted, f"the picture is finished {worker.error}")
    return worker.picture.pixels


def stage():
    scene = support.empty_scene(*SIZE)
    scene.world.use_nodes = True
    sky = scene.world.node_tree.nodes.new("ShaderNodeTexSky")
    sky.name = "Sky"
    scene.world.oriel.sky_model = "PHYSICAL"
    scene.world.node_tree.links.new(sky.outputs[0],
                                    scene.world.node_tree.nodes["Background"].inputs["Color"])
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = .02
    glass, _tree, node = support.node_material("Glass.001")
    node.inputs["Transmission"].default_value, node.inputs["Roughness"].default_value = 1.0, 0.0
    paint, tree, node = support.node_material("Paint")
    node.inputs["Base Color"].default_value = (.6, .2, .1, 1)
    floor, tree, node = support.node_material("Floor")
    checker = tree.nodes.new("ShaderNodeTexChecker")
    checker.inputs["Scale"].default_value = 3.0
    tree.links.new(checker.outputs["Color"], node.inputs["Base Color"])
    support.add_plane(8.0, floor, z=-1.0)
    support.add_sphere(.8, paint, (-1, 0, 0), 24)
    support.add_sphere(.6, glass, (1, 0, 0), 24)
    lamp = bpy.data.lights.new("Lamp", "SPOT")
    lamp.energy, lamp.spot_size = 300, 1.2
    support.add("Lamp", lamp, (0, -1, 4))
    panel = bpy.data.lights.new("Panel", "AREA")
    panel.energy, panel.size = 60, 1.0
    support.add("Panel", panel, (-3, -2, 2), (math.radians(60), 0, math.radians(-50)))
    support.add_camera((0, -6, 1), (math.radians(82), 0, 0), lens=40.0)


def principled(name):
    tree = bpy.data.materials[name].node_tree
    return next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED").inputs


def set_value(owner, name, value):
    def change():
        setattr(owner(), name, value)
    return change


def objects(name):
    return lambda: bpy.data.objects[name]


def add_cube():
    support.add_mesh("Triangle", [(0, -2, 0), (1, -2, 0), (0, -2, 1)], [(0, 1, 2)])


def focus():
    dof = bpy.context.scene.camera.data.dof
    dof.use_dof, dof.focus_distance, dof.aperture_fstop = True, 4.0, .2


def sky():
    return bpy.context.scene.world.node_tree.nodes["Sky"]


# Name, change, and whether it is an edit of values.
EDITS = [
    ("colour", lambda: setattr(principled("Paint")["Base Color"], "default_value", (.1, .5, .2, 1)), True),
    ("roughness", lambda: setattr(principled("Paint")["Roughness"], "default_value", .2), True),
    ("metal", lambda: setattr(principled("Paint")["Metallic"], "default_value", .5), False),
    ("metallic", lambda: setattr(principled("Paint")["Metallic"], "default_value", .8), True),
    ("emission", lambda: setattr(principled("Paint")["Emission"], "default_value", (1, .5, 0, 1)), False),
    ("index of refraction", lambda: setattr(principled("Glass.001")["IOR"], "default_value", 1.7), True),
    ("alpha", lambda: setattr(principled("Glass.001")["Alpha"], "default_value", .5), False),
    ("move", set_value(objects("Sphere"), "location", (-.5, .3, .2)), True),
    ("turn and scale", lambda: (set_value(objects("Sphere.001"), "rotation_euler", (.3, .2, .9))(),
                                set_value(objects("Sphere.001"), "scale", (1, -.5, 2))()), True),
    ("light energy", set_value(lambda: bpy.data.lights["Lamp"], "energy", 90), True),
    ("light colour", set_value(lambda: bpy.data.lights["Panel"], "color", (.2, .4, 1)), True),
    ("light place", set_value(objects("Lamp"), "location", (1, -1, 3)), True),
    ("spot size", set_value(lambda: bpy.data.lights["Lamp"], "spot_size", .7), False),
    ("area size", set_value(lambda: bpy.data.lights["Panel"], "size", 2.0), False),
    ("sun", lambda: setattr(sky(), "sun_elevation", .3), True),
    ("sky of Cycles", lambda: setattr(bpy.context.scene.world.oriel, "sky_model", "CYCLES"), False),
    ("camera place", set_value(objects("Camera"), "location", (.5, -5, 1.2)), True),
    ("camera lens", set_value(lambda: bpy.context.scene.camera.data, "lens", 30), True),
    ("depth of field", focus, False),
    ("focus", set_value(lambda: bpy.context.scene.camera.data.dof, "focus_distance", 6.0), True),
    ("new object", add_cube, False),
    ("hidden object", set_value(objects("Sphere"), "hide_viewport", True), False),
    ("trace depth", set_value(lambda: bpy.context.scene.oriel, "depth", 1), False),
]


def main():
    program.find_cached(refresh=True)
    stage()
    folder = tempfile.mkdtemp(dir=support.FOLDER)
    mesh_folder, known = meshes.MeshFolder(pathlib.Path(folder) / "meshes"), {}
    live = viewport_worker.Worker(folder, lambda: None)
    before = finish(live, job(folder, mesh_folder, known))
    for name, change, is_edit in EDITS:
        change()
        bpy.context.scene.update_tag()
        bpy.context.view_layer.update()
        loads = live.reloads
        state = job(folder, mesh_folder, known)
        edited = finish(live, state)
        fresh = viewport_worker.Worker(folder, lambda: None)  # where includes may be read
        expected = finish(fresh, state)
        fresh.stop()
        error = numpy.abs(edited - expected).max()
        support.check(error == 0, f"{name}: the bytes of a fresh scene, difference {error:.1e}")
        support.check(not numpy.array_equal(edited, before), f"{name}: the picture changes")
        support.check((live.reloads == loads) == is_edit,
                      f"{name}: {'an edit' if is_edit else 'a new scene'}")
        before = edited
    loads = live.reloads
    finish(live, job(folder, mesh_folder, known))
    support.check(live.reloads == loads, "the same state again is finished at once")
    live.stop()
    support.check(viewport_worker.ordered(["b", "c", "a"], ["a", "x", "b"]) == ["a", "b", "c"],
                  "unchanged edits come first, in their order")


main()
print("all tests passed")
