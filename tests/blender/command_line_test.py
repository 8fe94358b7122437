#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Installs the extension from its zip file into an empty Blender, and renders by `-E ORIEL -f 1`."""
# acceptance: Y1
import importlib.machinery
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

import run

ROOT = run.HERE.parents[1]
PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else ""
INSTALL = """
import bpy
bpy.ops.preferences.addon_install(filepath={zip!r})
bpy.ops.preferences.addon_enable(module="oriel_blender")
bpy.context.scene.render.resolution_x = bpy.context.scene.render.resolution_y = 32
bpy.context.scene.oriel.samples = 4
bpy.ops.wm.save_userpref()
bpy.ops.wm.save_as_mainfile(filepath={blend!r})
"""

# Camera, colours of a material and of the world, and the energy of a light change over frames.
ANIMATED = """
import math, sys
sys.path.insert(0, {tests!r})
import support, bpy
scene = support.empty_scene(32, 32)
scene.world.use_nodes = True
background = scene.world.node_tree.nodes["Background"].inputs[0]
material = support.principled("Paint", (.8, .1, .1), Specular=0.0)
colour = material.node_tree.nodes["Principled BSDF"].inputs["Base Color"]
ball = support.add_sphere(.6, material, segments=24)
support.add_plane(8.0, support.diffuse_material((.5, .5, .5)), z=-1)
lamp = bpy.data.lights.new("Lamp", "POINT")
support.add("Lamp", lamp, (1, -2, 2))
camera = support.add_camera((0, -4, .5), (math.radians(85), 0, 0), lens=30.0)
for frame, x, rgb, sky, energy in ((1, 0, (.8, .1, .1, 1), (.1, .2, .4, 1), 50),
                                   (3, 1, (.1, .8, .2, 1), (.6, .3, .1, 1), 250)):
    camera.location.x, lamp.energy = x, energy
    colour.default_value, background.default_value = rgb, sky
    camera.keyframe_insert("location", frame=frame)
    lamp.keyframe_insert("energy", frame=frame)
    for socket in (colour, background):
        socket.keyframe_insert("default_value", frame=frame)
scene.frame_start, scene.frame_end = 1, 3
scene.render.use_motion_blur = True
scene.oriel.samples = scene.cycles.samples = 64
bpy.ops.wm.save_as_mainfile(filepath={blend!r})
"""
COMPARED = """
import sys
sys.path.insert(0, {tests!r})
import support, numpy
for frame in (1, 2, 3):
    a, b = (support.pixels_of(f"{folder}/{{e}}_{{frame:04d}}.exr") for e in ("ORIEL", "CYCLES"))
    a, b = support.block_means(a, 4), support.block_means(b, 4)
    error = numpy.abs(a - b).mean() / b.mean()
    support.check(error < .03, f"frame {{frame}}: mean difference {{error:.2%}}")
"""


def pack(target):
    loader = importlib.machinery.SourceFileLoader("packer", str(ROOT / "tools/blender-extension"))
    packer = importlib.util.module_from_spec(importlib.util.spec_from_loader("packer", loader))
    loader.exec_module(packer)
    packer.write(target)


class CommandLine(unittest.TestCase):
    def setUp(self):
        if not run.blender():
            self.skipTest("Blender is not installed")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "resources").mkdir()

    def blender(self, *words, program=PROGRAM):
        return subprocess.run([run.blender(), "-b", *map(str, words)], text=True,
                              env=run.environment(program, str(self.folder)),
                              capture_output=True, check=False)

    def test_the_installed_extension_renders_from_the_command_line(self):
        archive, blend = self.folder / "oriel-blender.zip", self.folder / "scene.blend"
        pack(archive)
        text = INSTALL.format(zip=str(archive), blend=str(blend))
        installed = self.blender("--python-exit-code", 3, "--python-expr", text)
        self.assertEqual(installed.returncode, 0, installed.stdout + installed.stderr)
        picture = self.folder / "picture_"
        render = self.blender(blend, "-E", "ORIEL", "-F", "PNG", "-o", picture, "-f", 1)
        written = self.folder / "picture_0001.png"
        self.assertEqual(render.returncode, 0, render.stdout + render.stderr)
        self.assertTrue(written.read_bytes().startswith(b"\x89PNG"), render.stdout)
        # Without the program the render fails, with a status that stops farms.
        missing = self.blender(blend, "-E", "ORIEL", "-F", "PNG", "-o", self.folder / "no_", "-f", 1,
                               program="/missing/oriel")
        self.assertEqual(missing.returncode, 1, missing.stdout)
        self.assertIn("Oriel is not installed", missing.stdout)
        self.assertFalse((self.folder / "no_0001.png").exists())

    def test_animations_have_the_values_of_their_frames(self):
        blend = self.folder / "animated.blend"
        places = {"tests": str(run.HERE), "blend": str(blend), "folder": str(self.folder)}
        made = self.blender("--factory-startup", "--python-exit-code", 3, "--python-expr",
                            ANIMATED.format(**places))
        self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
        for engine in ("ORIEL", "CYCLES"):
            # The extension of the checkout, which no preferences name.
            render = self.blender("--factory-startup", "--python-expr",
                                  f"import sys; sys.path.insert(0, {str(run.HERE)!r}); import support",
                                  blend, "-E", engine, "-o", self.folder / f"{engine}_", "-a")
            self.assertEqual(render.returncode, 0, render.stdout + render.stderr)
        compared = self.blender("--factory-startup", "--python-exit-code", 3, "--python-expr",
                                COMPARED.format(**places))
        self.assertEqual(compared.returncode, 0, compared.stdout + compared.stderr)


if __name__ == "__main__":
    unittest.main()
