#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The manual's scenes are read without a complaint; its pages, pictures and numbers fit together."""
import concurrent.futures
import pathlib
import subprocess
import tomllib
import unittest

from testing import HERE, program

ROOT = HERE.parent
SCENES = ROOT / "scenes"


def complaints(oriel, scene):
    """What the program has against a scene; nothing where it has nothing."""
    run = subprocess.run([str(oriel), "check", str(scene), "-I", str(SCENES)],
                         capture_output=True, text=True, check=False)
    lines = [line for line in run.stderr.splitlines() if ": warning:" in line or ": error:" in line]
    return lines or ([f"{scene}: exit code {run.returncode}"] if run.returncode else [])


class Manual(unittest.TestCase):
    maxDiff = None

    def test_pages_pictures_and_numbers_fit_together(self):
        build = ROOT / "docs/manual/build"
        python = pathlib.Path("/usr/bin/python3")  # Debian's, which has its OpenImageIO
        if not python.exists() or subprocess.run([python, "-c", "import OpenImageIO, numpy"],
                                                 capture_output=True, check=False).returncode:
            self.skipTest("Python's OpenImageIO is not installed")
        run = subprocess.run([python, str(build), "--check"], capture_output=True, text=True,
                             check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_every_scene_is_read_without_a_complaint(self):
        oriel = program()
        if not oriel:
            self.skipTest("the program is not built")
        scenes = sorted({path.parent / panel["scene"]
                         for path in (SCENES / "manual").glob("*/figures.toml")
                         for figure in tomllib.loads(path.read_text(encoding="utf-8"))["figure"]
                         for panel in figure.get("panel", [])})
        self.assertGreater(len(scenes), 60)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            found = [line for lines in pool.map(lambda s: complaints(oriel, s), scenes)
                     for line in lines]
        self.assertEqual(found, [])


if __name__ == "__main__":
    unittest.main()
