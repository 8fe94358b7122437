#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The pages of docs/shaders agree with what the program declares, and hold every shader."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import zlib

from testing import HERE, ProgramTest, load

PAGES = HERE.parent / "docs/shaders"
sheets = load("shader-sheets")


class Sheets(unittest.TestCase):
    def test_every_family_has_its_page_and_picture(self):
        families = {p.stem for p in sheets.SHEETS.glob("*.sheet")}
        self.assertEqual(families, {p.stem for p in PAGES.glob("*.md")} - {"README"})
        self.assertEqual(families, {p.stem for p in sheets.PICTURES.glob("*.png")})
        for family in families:
            _, tiles = sheets.read_sheet(family)
            self.assertTrue(tiles, family)

    def test_pictures_are_small(self):
        for path in sheets.PICTURES.glob("*.png"):
            self.assertLess(path.stat().st_size, 200_000, path.name)

    def test_claims_hold_in_the_figures(self):
        for page in PAGES.glob("*.md"):
            for wanted, got in re.findall(r"\| ([\d. ]+) \| ([\d. ]+) \|$", page.read_text(), re.M):
                for a, b in zip(wanted.split(), got.split()):
                    self.assertAlmostEqual(float(a), float(b), delta=.021, msg=page.name)


class Declared(ProgramTest):
    def test_tables_are_those_of_the_program(self):
        run = subprocess.run([sys.executable, str(HERE / "shader-sheets"), "--check", "--oriel",
                              str(self.oriel)], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_every_shader_has_its_place(self):
        text = "".join(p.read_text() for p in PAGES.glob("*.md"))
        for name in sheets.declared(self.oriel):
            self.assertTrue(f"<!-- table {name} " in text or f"| `{name}` |" in text, name)


class Tables(unittest.TestCase):
    def test_numbered_neighbours_share_a_row(self):
        row = {"type": "scalar", "default": "0", "support": "exact", "doc": "Weight."}
        spec = {"parameters": [dict(row, name=f"weight_{i}") for i in range(3)] +
                [dict(row, name="last", support="ignored", min=0, unit="rad")]}
        self.assertEqual(sheets.parameter_rows(spec),
                         ["| `weight_0` ... `weight_2` | scalar | 0 |  | Weight. |",
                          "| `last` | scalar | 0 | >= 0, rad | Weight. *Ignored.* |"])

    def test_what_stands_between_markers_is_made_anew(self):
        text = "a\n<!-- table x -->\nold\n<!-- end -->\nb\n"
        self.assertEqual(sheets.filled(text, "table", lambda name: [name, "new"]),
                         "a\n<!-- table x -->\nx\nnew\n<!-- end -->\nb\n")


class Pictures(unittest.TestCase):
    def test_a_written_picture_holds_its_rows(self):
        rows = [bytes((7 * x * x + 5 * y) % 256 for x in range(30)) for y in range(4)]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "x.png"
            sheets.write_png(path, rows)
            data = path.read_bytes()
        size = int.from_bytes(data[33:37], "big")
        raw, before = zlib.decompress(data[41:41 + size]), bytes(30)
        for y, row in enumerate(rows):
            kind, line = raw[31 * y], bytearray(raw[31 * y + 1:31 * y + 31])
            for x in range(30):
                left = line[x - 3] if x > 2 else 0
                line[x] = (line[x] + (left, before[x], (left + before[x]) // 2)[kind - 1]) & 255
            self.assertEqual(row, bytes(line))
            before = row

    def test_display_values_are_those_of_srgb(self):
        self.assertEqual([sheets.srgb(x) for x in (-1, 0, .18, .5, 1, 9, float("nan"))],
                         [0, 0, 118, 188, 255, 255, 0])


if __name__ == "__main__":
    unittest.main()
