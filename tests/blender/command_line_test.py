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


if __name__ == "__main__":
    unittest.main()
