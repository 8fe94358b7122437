#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The build progress of tools/common.sh: few lines, the time left, every message of the compiler."""
import os
import pathlib
import pty
import subprocess
import tempfile
import unittest

from testing import HERE


def bash(script, **options):
    return subprocess.run(["bash", "-c", f"set -euo pipefail; source tools/common.sh; {script}"],
                          cwd=HERE.parent, text=True, check=False, **options)


def progress(ninja_output):
    return bash("build_progress", input=ninja_output, capture_output=True).stdout


class BuildProgress(unittest.TestCase):
    def test_a_long_build_is_a_few_lines(self):
        said = progress("".join(f"[{i}/1000 {i * 0.6:.3f}] Building a{i}.o\n"
                                for i in range(1001)))
        self.assertLess(len(said.splitlines()), 30)
        self.assertIn(" 25 %  250 of 1000 steps  2:30, about 7:30 left\n", said)
        self.assertTrue(said.endswith("built: 1000 of 1000 steps in 10:00\n"), said)

    def test_messages_of_the_compiler_pass(self):
        message = "a.cpp:3:1: error: no [1/2] such thing\n"
        said = progress("[1/2 0.100] Building a.o\nFAILED: a.o\n" + message)
        self.assertIn("FAILED: a.o\n" + message, said)
        self.assertNotIn("Building", said)

    def test_the_last_line_may_lack_its_end(self):
        self.assertIn("ninja: stopped", progress("[1/2 0.100] A\nninja: stopped"))

    def test_nothing_to_do_is_no_build(self):
        self.assertEqual(progress("ninja: no work to do.\n"), "ninja: no work to do.\n")

    def test_a_terminal_has_one_line_that_is_redrawn(self):
        reader, writer = pty.openpty()
        bash("build_progress", input="[1/4 2.000] A\n[2/4 4.000] B\n", stdout=writer)
        # The kernel passes the text on in pieces, and drops what is unread once the writer closes.
        said = ""
        while not said.endswith("\n"):
            said += os.read(reader, 10000).decode()
        os.close(writer)
        os.close(reader)
        self.assertIn("\r\x1b[K[############............]  50 %  2 of 4 steps  0:04, "
                      "about 0:04 left", said)
        self.assertEqual(said.count("\n"), 1)

    def test_a_failed_build_fails(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "build.ninja").write_text(
                "rule no\n  command = false\nbuild a: no\n", encoding="utf-8")
            run = bash(f"run_ninja {folder}; echo reached", capture_output=True)
        if "ninja: command not found" in run.stderr:
            self.skipTest("ninja is not installed")
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("FAILED: a", run.stdout)
        self.assertNotIn("reached", run.stdout)

    def test_durations(self):
        said = bash("clock 59; echo; clock 3599; echo; clock 3725", capture_output=True).stdout
        self.assertEqual(said.split(), ["0:59", "59:59", "1:02:05"])


if __name__ == "__main__":
    unittest.main()
