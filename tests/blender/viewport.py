# SPDX-License-Identifier: Apache-2.0
"""The rendered viewport in a window (of Xvfb): it draws, follows edits and views, and survives
a crash of the program."""
# acceptance: Y4
import os
import pathlib
import signal
import sys

import bpy
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402
from oriel_blender import viewport  # noqa: E402

WAIT = 0.2
seen = {}


def view_area():
    window = bpy.context.window_manager.windows[0]
    return window, next(a for a in window.screen.areas if a.type == "VIEW_3D")


def session():
    return next(iter(viewport.SESSIONS), None)


def screenshot(name):
    path = str(support.FOLDER / f"{name}.png")
    window, area = view_area()
    with bpy.context.temp_override(window=window, area=area):
        bpy.ops.screen.screenshot_area(filepath=path)
    pixels = support.pixels_of(path)
    height, width = pixels.shape[:2]
    # The middle, away from the interface around it.
    return pixels[height // 4:3 * height // 4, width // 4:3 * width // 4, :3]


def outline(pixels):
    """Bounds of the pixels that differ from the corner."""
    rows, columns = numpy.nonzero(numpy.abs(pixels - pixels[5, 5]).max(axis=2) > .03)
    return numpy.array([columns.min(), columns.max(), rows.min(), rows.max()])


def submitted():
    return session().worker.submitted


def finished(before):
    """Whether a job after that number is done, and the last export is its scene."""
    current = session()
    if not current or current._submitted is None:
        return False
    parts = current._scene[0]
    return current._submitted.parts[:len(parts)] == parts and current.worker.submitted > before and \
        current.worker.finished == current.worker.submitted


def record_skies():
    """Notes the environment of each export. Both skies may follow each other between two polls."""
    export_scene = viewport.Session.scene_changed

    def changed(self, depsgraph):
        export_scene(self, depsgraph)
        text = "".join(self._scene[0])
        seen.setdefault("skies", []).extend(
            name for name in ("mia_physicalsky", "mib_lookup_spherical") if name in text)
    viewport.Session.scene_changed = changed


def prepare():
    _window, area = view_area()
    scene = bpy.context.scene
    scene.render.engine = "ORIEL"
    scene.oriel.preview_samples = 8
    scene.view_settings.view_transform = "Raw"
    scene.world.use_nodes = False
    scene.world.color = (.2, .3, .6)
    space = area.spaces.active
    space.region_3d.view_distance = 8.0
    space.overlay.show_overlays = False
    space.show_gizmo = False
    space.shading.type = "SOLID"
    yield lambda: True
    yield lambda: True
    seen["solid"] = screenshot("viewport_solid")
    space.shading.type = "RENDERED"
    yield lambda: finished(0)
    seen["start"] = screenshot("viewport_start")
    solid, ours = outline(seen["solid"]), outline(seen["start"])
    support.check(numpy.abs(solid - ours).max() <= 2, f"outline {ours}, of the solid view {solid}")
    world = (numpy.abs(seen["start"][5, 5] - (.2, .3, .6)) < .01).all()
    support.check(world, f"the world is behind the cube: {seen['start'][5, 5]}")
    reloads = session().worker.reloads
    # An edit of a material.
    before = submitted()
    material = bpy.data.materials["Material"]
    node = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    node.inputs["Base Color"].default_value = (.9, .1, .05, 1)
    yield lambda: finished(before)
    seen["material"] = screenshot("viewport_material")
    red = (seen["material"][..., 0] > seen["material"][..., 2] + .05).mean()
    support.check(red > .03, f"the edited material is red: {red:.2f} of the pixels")
    # An edit of an object.
    before = submitted()
    bpy.data.objects["Cube"].location.z += 1.5
    yield lambda: finished(before)
    seen["moved"] = screenshot("viewport_moved")
    support.check(numpy.abs(seen["moved"] - seen["material"]).mean() > .01, "the cube moved")
    # A new view.
    before = submitted()
    region = area.spaces.active.region_3d
    region.view_distance *= .6
    yield lambda: finished(before)
    seen["view"] = screenshot("viewport_view")
    support.check(numpy.abs(seen["view"] - seen["moved"]).mean() > .01, "the view changed")
    jobs = submitted()
    scene.view_settings.exposure = 1.0
    yield lambda: True
    yield lambda: True
    support.check(submitted() == jobs, "colour management restarts nothing")
    scene.view_settings.exposure = 0.0
    support.check(session().worker.reloads == reloads, "edits of values do not write the scene")
    # Another mesh is another scene.
    before = submitted()
    bpy.data.meshes["Cube"].vertices[0].co.z -= 2.0
    bpy.data.meshes["Cube"].update()
    yield lambda: finished(before)
    support.check(session().worker.reloads == reloads + 1, "changed geometry is read again")
    # Light of a lamp.
    before = submitted()
    bpy.data.lights["Light"].energy = 0
    yield lambda: finished(before)
    seen["dark"] = screenshot("viewport_dark")
    support.check(seen["dark"].mean() < seen["view"].mean() - .005, "the lamp is off")
    # The border of the view: the rest is not drawn.
    before = submitted()
    space.use_render_border = True
    space.render_border_min_x, space.render_border_max_x = .4, .6
    space.render_border_min_y, space.render_border_max_y = .4, .6
    area.tag_redraw()
    yield lambda: finished(before)
    picture = session().worker.picture
    width, height = session().worker._sent[2].size
    support.check(abs(picture.pixels.shape[1] - .2 * width) <= 1 and
                  abs(picture.pixels.shape[0] - .2 * height) <= 1,
                  f"the border has {picture.pixels.shape[1::-1]} of {width} x {height} pixels")
    seen["border"] = screenshot("viewport_border")
    drawn = numpy.abs(seen["border"] - seen["dark"]).max(axis=2) < .02
    inside, outside = drawn[drawn.shape[0] // 2, drawn.shape[1] // 2], drawn[5, 5]
    support.check(inside and not outside, "the border is drawn in its place")
    space.use_render_border = False
    # The camera: shift and depth of field.
    before = submitted()
    camera = scene.camera.data
    camera.shift_x = .1
    region.view_perspective = "CAMERA"
    yield lambda: finished(before)
    seen["camera"] = screenshot("viewport_camera")
    before, jobs = submitted(), session().worker.reloads
    camera.dof.use_dof, camera.dof.focus_distance, camera.dof.aperture_fstop = True, 2.0, .03
    yield lambda: finished(before)
    seen["blurred"] = screenshot("viewport_blurred")
    sharp, blurred = (numpy.abs(numpy.diff(seen[k], axis=1)).max() for k in ("camera", "blurred"))
    support.check(blurred < .7 * sharp, f"depth of field: steps of {sharp:.2f} to {blurred:.2f}")
    before, jobs = submitted(), session().worker.reloads
    camera.dof.focus_distance = 3.0
    yield lambda: finished(before)
    support.check(session().worker.reloads == jobs, "the focus is an edit")
    camera.dof.use_dof = False
    # Denoising.
    before = submitted()
    scene.oriel.preview_denoise = True
    yield lambda: finished(before)
    support.check(numpy.isfinite(session().worker.picture.pixels).all(), "the picture is denoised")
    scene.oriel.preview_denoise = False
    # A sky: that of the program is shown until Blender has rendered a picture of it.
    before = submitted()
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    sky = tree.nodes.new("ShaderNodeTexSky")
    tree.nodes["Background"].inputs["Strength"].default_value = .05
    tree.links.new(sky.outputs[0], tree.nodes["Background"].inputs["Color"])
    yield lambda: "mib_lookup_spherical" in seen.get("skies", ())
    yield lambda: finished(before)
    support.check(seen["skies"][0] == "mia_physicalsky", "the sky of the program is shown at first")
    seen["sky"] = screenshot("viewport_sky")
    support.check(session().worker.error == "" and seen["sky"].std() > .01, "then that of Cycles")
    before = submitted()
    scene.world.use_nodes = False
    yield lambda: finished(before)
    # A crash of the program is a message, which stays until the next edit.
    os.kill(session().worker.process.pid, signal.SIGSEGV)
    yield lambda: session().worker.error
    support.check("SIGSEGV" in session().worker.error, f"crash: {session().worker.error}")
    before = submitted()
    bpy.data.objects["Cube"].location.x += .5
    yield lambda: finished(before) and not session().worker.error
    support.check(True, "the next edit renders again")
    worker = session().worker
    print("latencies:", [round(t, 3) for t in worker.latencies], flush=True)
    space.shading.type = "SOLID"
    yield lambda: True
    yield lambda: not worker._thread.is_alive() or True
    print("all tests passed", flush=True)


bpy.context.preferences.view.show_splash = False  # it would cover the view
record_skies()
support.run_steps(prepare(), WAIT, 300)
