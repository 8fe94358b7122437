#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Time from a change in Blender's rendered viewport to its first picture.

    bench/blender_viewport.py PROGRAM [SCENE.mi] [CHANGES]

Imports the scene (the interior) into Debian's Blender under Xvfb and changes a colour, an object, the
view and the sun. Prints the median and the largest time in milliseconds. The time counts from the
moment at which the add-on has exported the change; the export has a column of its own.
"""
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "blender"))


def start():
    import run
    program = os.path.abspath(sys.argv[1])
    scene = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else
                            ROOT / "scenes" / "interior" / "interior.mi")
    changes = sys.argv[3] if len(sys.argv) > 3 else "10"
    with tempfile.TemporaryDirectory() as folder:
        blender = subprocess.run(
            [*run.XVFB, run.blender(), "--factory-startup", "--python", __file__, "--", scene, changes],
            env=run.environment(program, folder), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            text=True, errors="replace", check=False)
    lines = [line for line in blender.stdout.splitlines() if line.startswith("|")]
    print("\n".join(lines) or blender.stdout[-3000:])


def changes_of(bpy, space):
    """A function of the number of the change for each kind."""
    used = [s.material for ob in bpy.context.scene.objects for s in ob.material_slots if s.material]
    colours = [i for m in used for n in m.node_tree.nodes for i in n.inputs
               if n.bl_idname.startswith("OrielNode_mia_material") and i.type == "RGBA"
               and i.name.lower() == "diffuse" and not i.is_linked]
    meshes = [ob for ob in bpy.context.scene.objects if ob.type == "MESH"]
    smallest = min(meshes, key=lambda ob: max(ob.dimensions))
    suns = [ob for ob in bpy.context.scene.objects if ob.type == "LIGHT" and ob.data.type == "SUN"]

    def colour(i):
        colours[0].default_value = (.2 + .05 * i, .3, .4, 1)

    def move(i):
        smallest.location.x += .01

    def view(i):
        space.region_3d.view_distance *= 1.02

    def sun(i):
        suns[0].rotation_euler.z += .05

    return {"colour": colour, "object": move, "view": view, **({"sun": sun} if suns else {})}


def steps(bpy, scene, count):
    from oriel_blender import viewport
    area = next(a for a in bpy.context.window_manager.windows[0].screen.areas if a.type == "VIEW_3D")
    space = area.spaces.active
    for ob in list(bpy.context.scene.objects):
        bpy.data.objects.remove(ob)
    bpy.ops.import_scene.oriel_mi(filepath=scene)
    bpy.context.scene.render.engine = "ORIEL"
    bpy.context.scene.oriel.preview_samples = 64
    space.region_3d.view_perspective = "CAMERA"
    space.shading.type = "RENDERED"

    def shown(number):
        session = next(iter(viewport.SESSIONS), None)
        return session and len(session.worker.latencies) > number

    yield lambda: shown(0)
    worker = next(iter(viewport.SESSIONS)).worker
    print("| change | picture, median | largest | export, median |\n|---|---|---|---|", flush=True)
    for name, change in changes_of(bpy, space).items():
        exports, before = [], len(worker.latencies)
        if name == "view":
            space.region_3d.view_perspective = "PERSP"
            known = len(worker.latencies)
            yield lambda: len(worker.latencies) > known
            before = len(worker.latencies)
        for i in range(count):
            known, begin, jobs = len(worker.latencies), time.monotonic(), worker.submitted
            change(i)
            area.tag_redraw()
            yield lambda: worker.submitted > jobs
            exports.append(worker._job[1] - begin)
            yield lambda: len(worker.latencies) > known
            pause = time.monotonic() + .5
            yield lambda: time.monotonic() > pause
        times = [1e3 * t for t in worker.latencies[before:]]
        print(f"| {name} | {statistics.median(times):.0f} | {max(times):.0f} | "
              f"{1e3 * statistics.median(exports):.0f} |", flush=True)


def inside(bpy):
    import support  # enables the add-on
    scene, count = sys.argv[sys.argv.index("--") + 1:]
    bpy.context.preferences.view.show_splash = False
    support.run_steps(steps(bpy, scene, int(count)), .01, 200)


try:
    import bpy as blender_module
except ImportError:
    start()
else:
    inside(blender_module)
