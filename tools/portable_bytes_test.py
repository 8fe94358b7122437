#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The same scene gives the same bytes on every x86-64-v3 processor: acceptance row Z9.

Four scenes are rendered on this processor, with features hidden from the C library (which then
takes its functions for older processors), and on processors of two makers as QEMU emulates them.
QEMU's emulation computes exact values where real processors estimate (RCPPS, RSQRTPS), so a result
that depends on such an estimate differs.
"""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from testing import HERE, ProgramTest

ROOT = HERE.parent
QEMU = shutil.which("qemu-x86_64")
PROCESSORS = ("Haswell-v4", "EPYC")
HIDDEN = "glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX2,-FMA,-AVX512F,-ERMS,-BMI2"

# scenes/nine-tiles with 200 photons of each kind: sending the usual number took two thirds of the
# time of this whole test, and other scenes trace more rays in less.
FEW_PHOTONS = "few photons"

# Geometry that meets rays at its edges, glass, textures, coincident faces; paths, photons and final
# gathering. QEMU estimates alike for all processors, so the two scenes that take minutes there are
# rendered on one of them each.
SCENES = {
    "interior": (["scenes/interior/interior.mi", "--size", "24x16", "--samples", "2"],
                 PROCESSORS[:1]),
    "nine tiles": ([FEW_PHOTONS, "--size", "60x40", "--samples", "2"], PROCESSORS),
    "round corners": (["scenes/round-corners.mi", "--size", "90x60", "--samples", "2"],
                      PROCESSORS),
    "final gathering": (["scenes/guide/room.mi", "--size", "12x8", "--samples", "1", "--gi", "fg"],
                        PROCESSORS[1:]),
}


class PortableBytes(ProgramTest):
    def setUp(self):
        super().setUp()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def few_photons(self):
        """The path of the copy of nine-tiles.mi."""
        text = (ROOT / "scenes/nine-tiles/nine-tiles.mi").read_text(encoding="utf-8")
        text, changed = re.subn("^end light", "caustic photons 200 globillum photons 200\nend light",
                                text, flags=re.M)
        self.assertEqual(changed, 1)
        path = self.folder / "nine-tiles.mi"
        path.write_text(text, encoding="utf-8")
        return path

    def render(self, arguments, name, before=(), **environment):
        """The bytes of the picture."""
        out = self.folder / f"{name}.exr"
        arguments = [self.few_photons() if a == FEW_PHOTONS else a for a in arguments]
        run = subprocess.run([*before, self.oriel, "render", *arguments, "--threads", "1", "-o", out,
                             "-q"], cwd=ROOT,
                             env=dict(os.environ, **environment), capture_output=True, text=True,
                             check=False, timeout=280)
        self.assertEqual(run.returncode, 0, f"{name}: {run.stderr[-2000:]}")
        return out.read_bytes()

    # acceptance: Z9
    def test_pictures_have_the_same_bytes_on_other_processors(self):
        for scene, (arguments, processors) in SCENES.items():
            with self.subTest(scene):
                here = self.render(arguments, "here")
                hidden = self.render(arguments, "hidden", GLIBC_TUNABLES=HIDDEN)
                self.assertTrue(here == hidden, f"{scene}: with another choice of the C library")
                for processor in processors if QEMU else ():
                    there = self.render(arguments, processor, (QEMU, "-cpu", processor))
                    self.assertTrue(here == there, f"{scene}: on {processor}")

    def test_the_emulator_is_installed(self):
        self.assertTrue(QEMU, "install qemu-user (tools/install)")


if __name__ == "__main__":
    unittest.main()
