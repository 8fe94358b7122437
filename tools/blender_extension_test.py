#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of blender-extension."""
import ast
import pathlib
import re
import tempfile
import unittest
import zipfile

import testing

extension = testing.load("blender-extension")


# Members that versions of Blender removed, renamed or made read-only, by its release notes.
CHANGED = {
    "calc_normals": "removed in 4.0", "calc_normals_split": "removed in 4.1",
    "create_normals_split": "removed in 4.1", "free_normals_split": "removed in 4.1",
    "use_auto_smooth": "removed in 4.1", "auto_smooth_angle": "removed in 4.1",
    "corner_normals": "from 4.1", "normals_domain": "from 4.1",
    "loop_triangle_polygons": "from 3.6", "polygon_index": "replaced in 3.6",
    "loop_total": "read-only from 3.6", "face_maps": "removed in 4.0",
    "polygon_layers_int": "removed in 4.0", "vertex_layers_float": "removed in 4.0",
    "sculpt_vertex_colors": "removed in 4.0", "vertex_colors": "replaced in 3.2",
    "bone_groups": "removed in 4.0", "interface": "from 4.0",
    "blend_method": "replaced in 4.2", "shadow_method": "removed in 4.2",
    "use_screen_refraction": "replaced in 4.2", "surface_render_method": "from 4.2",
    "use_contact_shadow": "removed in 4.2", "cast_shadow": "replaced in 4.2",
    "use_shadow": "from 4.2 in Cycles", "use_bloom": "removed in 4.2", "use_gtao": "removed in 4.2",
    "use_ssr": "removed in 4.2", "influence_distance": "changed in 4.1",
    "grid_resolution_x": "renamed in 4.1", "fcurves": "moved in 4.4, removed in 5.0",
    "displacement_method": "moved in 4.1", "use_temperature": "from 4.5",
    "temperature_color": "from 4.5", "child_nbr": "renamed in 4.0", "asset_file_handle": "removed in 4.0",
    "motion_blur_position": "moved in 4.2", "dust_density": "renamed in 5.0",
    "aerosol_density": "from 5.0", "edge_creases": "moved in 4.0", "crease": "moved in 4.0",
    "bevel_weight": "moved in 4.0", "action_slot": "from 4.4",
    "compositing_node_group": "from 5.0",
}
# Names of sockets that later versions show under another name; identifiers stay.
SHOWN_DIFFERENTLY = {"Fac", "Factor"}
# Sockets of Principled BSDF until 3.6 that have other names from 4.0.
RENAMED = {"Subsurface", "Subsurface Color", "Specular", "Sheen", "Clearcoat",
           "Clearcoat Roughness", "Clearcoat Normal", "Transmission", "Transmission Roughness",
           "Emission"}
# They exist until 3.6 only, and are read after a test for the version.
RENAMED -= {"Subsurface Color", "Transmission Roughness"}


def modules():
    return [(path, ast.parse(path.read_text())) for path in sorted(extension.SOURCE.glob("*.py"))]


def is_bulk_access(node):
    """Whether a call reads or writes an array by the name of a member."""
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and \
        node.func.attr in {"foreach_get", "foreach_set"} and node.args and \
        isinstance(node.args[0], ast.Constant)


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

    def test_changed_members_of_blender_are_used_in_one_module_only(self):
        found = []
        for path, tree in modules():
            for node in ast.walk(tree):
                name = node.attr if isinstance(node, ast.Attribute) else None
                if is_bulk_access(node):
                    name = node.args[0].value
                if name in CHANGED and path.name != "versions.py":
                    found.append(f"{path.name}:{node.lineno}: {name}: {CHANGED[name]}")
        self.assertEqual(found, [])

    def test_guards_of_changed_members_name_them(self):
        # Each changed member that versions.py uses is behind hasattr or getattr.
        text = (extension.SOURCE / "versions.py").read_text()
        used = {name for name in CHANGED if re.search(rf"\b{name}\b", text)}
        self.assertIn("use_auto_smooth", used)
        for name in used & {"use_auto_smooth", "corner_normals", "loop_triangle_polygons"}:
            self.assertRegex(text, rf'(hasattr|getattr)\(\w+, "{name}"', name)

    def test_modules_that_were_removed_are_not_imported(self):
        for path, tree in modules():
            for node in ast.walk(tree):
                names = [a.name for a in node.names] if isinstance(node, ast.Import) else \
                    [node.module or ""] if isinstance(node, ast.ImportFrom) else []
                for name in names:
                    self.assertNotIn(name.split(".")[0], {"bgl", "blf_legacy"}, path.name)

    def test_versions_are_compared_in_one_module_only(self):
        for path, tree in modules():
            if path.name == "versions.py":
                continue
            for node in ast.walk(tree):
                is_version = isinstance(node, ast.Attribute) and node.attr == "version" and \
                    isinstance(node.value, ast.Attribute) and node.value.attr == "app"
                self.assertFalse(is_version, f"{path.name}:{getattr(node, 'lineno', 0)}")

    def test_old_names_of_sockets_follow_new_ones(self):
        # read.get("Coat Weight", "Clearcoat"): the first name is that of 4.0 and later.
        found = []
        for path, tree in modules():
            for node in ast.walk(tree):
                if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and \
                        node.func.attr in {"get", "number", "socket"} and node.args and \
                        isinstance(node.args[0], ast.Constant) and node.args[0].value in RENAMED:
                    found.append(f"{path.name}:{node.lineno}: {node.args[0].value}")
                if isinstance(node, ast.Subscript) and isinstance(node.value, ast.Attribute) and \
                        node.value.attr == "inputs" and isinstance(node.slice, ast.Constant) and \
                        node.slice.value in RENAMED:
                    found.append(f"{path.name}:{node.lineno}: {node.slice.value}")
        self.assertEqual(found, [])

    def test_sockets_with_new_names_are_found_by_identifier(self):
        found = [f"{path.name}:{node.lineno}: {node.slice.value}"
                 for path, tree in modules() for node in ast.walk(tree)
                 if isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Constant) and
                 isinstance(node.value, ast.Attribute) and node.value.attr == "inputs" and
                 node.slice.value in SHOWN_DIFFERENTLY]
        self.assertEqual(found, [])

    def test_engines_pass_their_arguments_on(self):
        # From 4.4 subclasses of Blender's types with __init__ get arguments.
        for path, tree in modules():
            for node in ast.walk(tree):
                if not isinstance(node, ast.ClassDef) or not any("bpy" in ast.unparse(b)
                                                                 for b in node.bases):
                    continue
                for method in node.body:
                    if isinstance(method, ast.FunctionDef) and method.name == "__init__":
                        self.assertTrue(method.args.vararg and method.args.kwarg, path.name)
                        self.assertIn("super().__init__(*args, **kwargs)", ast.unparse(method))

    def test_operators_get_no_context_as_dictionary(self):
        # bpy.ops.x.y({...}) was removed in 4.0; temp_override replaces it.
        for path, tree in modules():
            for node in ast.walk(tree):
                if isinstance(node, ast.Call) and ast.unparse(node.func).startswith("bpy.ops."):
                    self.assertFalse(node.args and not isinstance(node.args[0], ast.Constant),
                                     f"{path.name}:{node.lineno}")


if __name__ == "__main__":
    unittest.main()
