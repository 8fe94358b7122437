#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
""".ci/run skips the sanitizers and clang-tidy when too little time is left; tools/tidy rejects --minutes 0."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from testing import HERE

ROOT = HERE.parent
# Replaces the steps that take long: each writes the file that .ci/run reads.
TEST = """#!/bin/bash
mkdir -p build/release build/asan/bin
echo '100% tests passed, 0 tests failed out of 7' > build/release/tests.log
for name in mi_test robustness_tests fuzz_replay_tests; do
  printf '#!/bin/bash\\necho "[  PASSED  ] 5 tests."\\nexit ${ASAN_EXIT:-0}\\n' > build/asan/bin/$name
  chmod +x build/asan/bin/$name
done
exit ${TEST_EXIT:-0}
"""
COMMON = """source tools/common_real.sh
build_preset() { echo "build $*"; }
"""
TIDY = """#!/bin/bash
echo "tidy was run: $*"
exit ${TIDY_EXIT:-0}
"""


class CiRun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name in ("tools", ".ci"):
            (self.root / name).mkdir()
        shutil.copy(ROOT / ".ci/run", self.root / ".ci/run")
        shutil.copy(ROOT / "tools/common.sh", self.root / "tools/common_real.sh")
        for name, text in (("test", TEST), ("common.sh", COMMON), ("tidy", TIDY)):
            path = self.root / "tools" / name
            path.write_text(text, encoding="utf-8")
            path.chmod(0o755)

    def run_after(self, minutes, **environment):
        """.ci/run, as if it had started `minutes` ago: bash counts on from SECONDS."""
        return subprocess.run(
            [self.root / ".ci/run"], capture_output=True, text=True, check=False,
            env=dict(os.environ, SECONDS=str(int(minutes * 60)), **environment))

    def test_clang_tidy_has_eight_minutes_when_there_is_time(self):
        run = self.run_after(5)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("--minutes 8\n", run.stdout)
        self.assertIn("clang-tidy: no findings", run.stdout)

    def test_clang_tidy_has_the_time_that_is_left(self):
        self.assertIn("--minutes 3\n", self.run_after(34.5).stdout)

    def test_clang_tidy_is_skipped_when_no_time_is_left(self):
        for minutes in (37.5, 38, 40, 55):
            run = self.run_after(minutes)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertNotIn("tidy was run", run.stdout)
            self.assertIn("clang-tidy: skipped for lack of time", run.stdout)

    def test_headers_are_compiled_alone_when_there_is_time(self):
        self.assertIn("build dev header_check\n", self.run_after(36.5).stdout)
        self.assertNotIn("build dev", self.run_after(37.5).stdout)

    def test_the_sanitizers_run_as_far_as_there_is_time(self):
        self.assertIn("sanitizers: 15 tests passed;", self.run_after(5).stdout)
        for minutes in (32.2, 32.8):
            run = self.run_after(minutes)
            self.assertIn("sanitizers: 10 tests passed;", run.stdout)
            self.assertIn("skipped fuzz_replay_tests", run.stdout)
        for minutes in (33.5, 40, 55):
            run = self.run_after(minutes)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertNotIn("build asan", run.stdout)
            self.assertIn("sanitizers: skipped for lack of time;", run.stdout)

    def test_the_sanitizers_fail_the_run(self):
        self.assertNotEqual(self.run_after(5, ASAN_EXIT="1").returncode, 0)

    def test_the_last_line_is_the_result_of_the_tests(self):
        for minutes in (5, 55):
            self.assertTrue(self.run_after(minutes).stdout.splitlines()[-1].startswith(
                "100% tests passed"))

    def test_it_fails_with_the_tests_and_with_findings(self):
        self.assertNotEqual(self.run_after(5, TEST_EXIT="8").returncode, 0)
        self.assertNotEqual(self.run_after(55, TEST_EXIT="8").returncode, 0)
        self.assertNotEqual(self.run_after(5, TIDY_EXIT="1").returncode, 0)


class Tidy(unittest.TestCase):
    def test_minutes_are_above_zero(self):
        for minutes in ("0", "-3", "nan"):
            run = subprocess.run([sys.executable, HERE / "tidy", "--minutes", minutes],
                                 capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 2)
            self.assertIn(f"--minutes: must be above 0, not {minutes}", run.stderr)


if __name__ == "__main__":
    unittest.main()
