#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Packed scenes in a root folder that has the program, the system's libraries and nothing else.

    tests/farm/empty_root_test.py ORIEL

Exit code 77: this user may not make such a root (unshare, mount).

acceptance: F5
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
ORIEL = ""
LIBRARIES = ("usr", "lib", "lib32", "lib64")
OPTIONS = ("--size", "24x16", "--samples", "1", "-q")


def in_root(root, *words):
    """Runs a program with `root` as the root folder; read-only system libraries are mounted into it."""
    script = ["set -e"]
    for name in LIBRARIES:
        path = pathlib.Path("/", name)
        target = root / name
        if path.is_symlink() and not target.is_symlink():
            target.symlink_to(os.readlink(path))
        elif path.is_dir() and not path.is_symlink():
            target.mkdir(exist_ok=True)
            script.append(f"mount --rbind /{name} '{target}'")
    for name in ("proc", "dev", "tmp", "etc"):
        (root / name).mkdir(exist_ok=True)
    script += [f"mount --rbind /{name} '{root}/{name}'" for name in ("proc", "dev")]
    for name in ("ld.so.cache", "ld.so.conf"):
        if os.path.exists(f"/etc/{name}"):
            shutil.copy(f"/etc/{name}", root / "etc" / name)
    # Debian's libraries of linear algebra are found through links there.
    if os.path.isdir("/etc/alternatives"):
        shutil.copytree("/etc/alternatives", root / "etc/alternatives", symlinks=True, dirs_exist_ok=True)
    script.append(f"exec chroot '{root}' \"$@\"")
    return subprocess.run(["unshare", "--map-root-user", "--mount", "sh", "-c", "\n".join(script), "sh", *words],
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)


class EmptyRoot(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="oriel-empty-root-"))
        self.addCleanup(shutil.rmtree, self.folder, True)
        self.root = self.folder / "root"
        self.root.mkdir()
        for file in [pathlib.Path(ORIEL), *pathlib.Path(ORIEL).parent.glob("liboriel_*.so")]:
            shutil.copy(file, self.root)

    def oriel(self, *words):
        subprocess.run([ORIEL, *map(str, words)], check=True, stdout=subprocess.DEVNULL)

    def expect_same_bytes(self, scene, *search):
        name = scene.name if scene.suffix == ".mi" else scene.stem + ".mi"
        self.oriel("pack", scene, "-o", self.root / "packed", "-q", *search)
        result = in_root(self.root, "/oriel", "render", f"/packed/{name}", "-o", "/after.exr", *OPTIONS)
        self.assertEqual((0, ""), (result.returncode, result.stderr))
        self.oriel("render", scene, "-o", self.folder / "before.exr", *OPTIONS, *search)
        self.assertEqual((self.folder / "before.exr").read_bytes(), (self.root / "after.exr").read_bytes())

    def test_nothing_else_is_there(self):
        self.assertNotEqual(0, in_root(self.root, "/oriel", "check", str(ROOT / "scenes/freeform.mi")).returncode)

    def test_profiles(self):
        self.expect_same_bytes(ROOT / "scenes/profile-bulbs.mi")

    def test_includes_and_textures(self):
        self.expect_same_bytes(ROOT / "scenes/manual/details/bump.mi", "-I", str(ROOT / "scenes"))

    def test_templates_with_textures_of_the_program(self):
        self.expect_same_bytes(ROOT / "scenes/templates/sheet.mi")

    def test_the_interior(self):
        self.expect_same_bytes(ROOT / "scenes/interior/interior.mi")


def main():
    global ORIEL
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    ORIEL = os.path.abspath(sys.argv.pop(1))
    with tempfile.TemporaryDirectory() as folder:
        trial = in_root(pathlib.Path(folder), "/usr/bin/true")
    if trial.returncode != 0:
        print("a root folder cannot be made here:", trial.stderr)
        sys.exit(77)
    unittest.main(verbosity=2)


if __name__ == "__main__":
    main()
