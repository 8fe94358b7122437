#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of blender-extension."""
import pathlib
import re
import tempfile
import unittest
import zipfile

import testing

extension = testing.load("blender-extension")


class Extension(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_the_same_sources_give_the_same_bytes(self):
        first, second = self.folder / "a.zip", self.folder / "b.zip"
        extension.write(first)
        extension.write(second)
        self.assertEqual(first.read_bytes(), second.read_bytes())

    def test_it_has_every_module_and_no_other_file(self):
        target = self.folder / "a.zip"
        extension.write(target)
        names = zipfile.ZipFile(target).namelist()
        modules = {f"oriel_blender/{p.name}" for p in extension.SOURCE.glob("*.py")}
        self.assertEqual(set(names), modules | {"oriel_blender/blender_manifest.toml"})

    def test_the_manifest_and_bl_info_have_one_version(self):
        manifest = (extension.SOURCE / "blender_manifest.toml").read_text()
        version = re.search(r'^version = "([\d.]+)"', manifest, re.M).group(1)
        source = (extension.SOURCE / "__init__.py").read_text()
        tuple_text = re.search(r'"version": \(([\d, ]+)\)', source).group(1)
        self.assertEqual(version, tuple_text.replace(", ", "."))

    def test_removed_functions_of_blender_are_called_in_one_module_only(self):
        # Removed in 4.0, 4.1 and 5.0 (release notes of Blender).
        removed = re.compile(r"\b(calc_normals_split|use_auto_smooth|calc_normals\(|import bgl|"
                             r"node_tree\.inputs|polygon_layers_int)")
        for path in extension.SOURCE.glob("*.py"):
            if path.name != "versions.py":
                self.assertIsNone(removed.search(path.read_text()), path.name)


if __name__ == "__main__":
    unittest.main()
