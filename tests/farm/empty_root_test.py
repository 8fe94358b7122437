#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Packed scenes in a root folder that has the program, the system's libraries and nothing else.

    tests/farm/empty_root_test.py ORIEL [--all]

--all: every scene of the repository.

Exit code 77: this user may not make such a root (unshare, mount).

acceptance: F5
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
ORIEL = ""
ALL = False
SCENES = ("profile-bulbs.mi", "manual/details/bump.mi", "templates/sheet.mi", "interior/interior.mi")
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

    def test_nothing_else_is_there(self):
        self.assertNotEqual(0, in_root(self.root, "/oriel", "check", str(ROOT / "scenes/freeform.mi")).returncode)

    def test_packed_scenes(self):
        """Profiles, includes by search folders, templates and textures of the program, the interior."""
        search = ("-I", str(ROOT / "scenes"))
        scenes = [ROOT / "scenes" / name for name in SCENES]
        if ALL:
            scenes = [s for s in sorted(ROOT.glob("scenes/**/*.mi")) if re.search("^render ", s.read_text(), re.M)]
        # Parts of scenes have errors, here and there.
        statuses = []
        for k, scene in enumerate(scenes):
            words = [ORIEL, "render", scene, "-o", self.folder / f"{k}.exr", *OPTIONS, *search]
            statuses.append(subprocess.run(list(map(str, words)), stderr=subprocess.DEVNULL, check=False).returncode)
            self.oriel("pack", scene, "-o", self.root / f"packed-{k}", "-q", *search)
        script = [f"./oriel render 'packed-{k}/{s.name}' -o {k}.exr {' '.join(OPTIONS)}; echo $?"
                  for k, s in enumerate(scenes)]
        result = in_root(self.root, "/usr/bin/sh", "-c", "cd /\n" + "\n".join(script))
        self.assertEqual(statuses, [int(n) for n in result.stdout.split()], result.stderr)
        if not ALL:
            self.assertEqual([0] * len(SCENES), statuses, result.stderr)
        for k, scene in enumerate(scenes):
            with self.subTest(scene=scene.relative_to(ROOT)):
                self.assertEqual((self.folder / f"{k}.exr").read_bytes(), (self.root / f"{k}.exr").read_bytes())


def main():
    global ORIEL, ALL
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    ORIEL = os.path.abspath(sys.argv.pop(1))
    ALL = "--all" in sys.argv
    sys.argv = [w for w in sys.argv if w != "--all"]
    with tempfile.TemporaryDirectory() as folder:
        trial = in_root(pathlib.Path(folder), "/usr/bin/true")
    if trial.returncode != 0:
        print("a root folder cannot be made here:", trial.stderr)
        sys.exit(77)
    unittest.main(verbosity=2)


if __name__ == "__main__":
    main()
