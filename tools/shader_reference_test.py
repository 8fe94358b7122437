#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/reference has a page for every shader, as the program declares it."""
import re
import subprocess
import sys
import unittest

from shader_tables import declared
from testing import HERE, ProgramTest, load

reference = load("shader-reference")


class Reference(ProgramTest):
    def test_pages_are_those_of_the_program(self):
        run = subprocess.run([sys.executable, str(HERE / "shader-reference"), "--check", "--oriel",
                              str(self.oriel)], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_the_index_has_every_shader_once(self):
        text = (reference.PAGES / "README.md").read_text(encoding="utf-8")
        named = re.findall(r"\| \[(\w+)\]\(\1\.md\)", text)
        self.assertEqual(sorted(named), sorted(declared(self.oriel)))

    def test_a_page_has_every_parameter_and_the_declaration(self):
        text = (reference.PAGES / "mia_portal_light.md").read_text(encoding="utf-8")
        for parameter in declared(self.oriel)["mia_portal_light"]["parameters"]:
            self.assertIn(f"| `{parameter['name']}` |", text)
            self.assertIn(f'"{parameter["name"]}"', text)
        self.assertIn('declare shader color "mia_portal_light" (', text)
        self.assertIn("apply light, emitter", text)


class Sources(unittest.TestCase):
    def test_every_ready_material_is_seen_at_a_shader(self):
        text = reference.TEMPLATES.read_text(encoding="utf-8")
        used = {name for names in reference.templates().values() for name in names}
        self.assertEqual(used, set(re.findall(r'^material "(\w+)"', text, re.M)))


if __name__ == "__main__":
    unittest.main()
