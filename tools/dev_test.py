#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/dev sets up the compiler cache for all worktrees and keeps what the user has set."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from testing import HERE


@unittest.skipUnless(shutil.which("ccache"), "ccache is not installed")
class CompilerCache(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.settings = pathlib.Path(folder.name) / "ccache.conf"
        self.environment = {key: value for key, value in os.environ.items()
                            if not key.startswith("CCACHE_")}
        self.environment |= {"CCACHE_CONFIGPATH": str(self.settings), "CCACHE_DIR": folder.name}

    def call(self, script):
        return subprocess.run(["bash", "-c", f"source tools/dev; {script}"], cwd=HERE.parent,
                              env=self.environment, capture_output=True, text=True, check=True).stdout

    def set_up(self, settings=""):
        """The settings after a run with two worktrees, when they were `settings` before."""
        self.settings.write_text(settings, encoding="utf-8")
        self.call("git() { printf 'worktree /code/oriel\\nHEAD 1\\n\\nworktree /code/other/fix\\n'; };"
                  "set_up_cache")
        lines = self.settings.read_text(encoding="utf-8").splitlines()
        return dict(line.split(" = ") for line in lines)

    def test_worktrees_share_the_cache(self):
        self.assertEqual(self.set_up(),
                         {"max_size": "10G", "base_dir": "/code", "hash_dir": "false"})

    def test_what_the_user_has_set_is_kept(self):
        self.assertEqual(self.set_up("max_size = 50G\nbase_dir = /home/me\n"),
                         {"max_size": "50G", "base_dir": "/home/me"})
        self.assertEqual(self.set_up("max_size = 900M\n")["max_size"], "10G")
        self.assertEqual(self.set_up("max_size = 0\n")["max_size"], "0")

    def test_common_folder(self):
        for paths, common in (("/a/b /a/c", "/a"), ("/a/b", "/a/b"), ("/a/b /a/bc", "/a"),
                              ("/a /a/b/c", "/a"), ("/a /b", "/")):
            self.assertEqual(self.call(f"common_folder {paths}").strip(), common, paths)


if __name__ == "__main__":
    unittest.main()
