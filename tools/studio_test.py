#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page of Oriel Studio: types, unit tests, and tests in headless Chromium.

Requires node, npm and chromium (tools/packages-of-tests.txt) and the npm packages of
tests/studio/package-lock.json, which are installed on first use. What is missing is named and its
tests are skipped; exit code 77 if all are skipped.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

from testing import HERE, program

FOLDER = HERE.parent / "tests/studio"
MODULES = FOLDER / "node_modules"
EXIT_SKIPPED = 77


def missing_packages():
    """Installs the npm packages of the lock file; returns why that failed, or None."""
    if not shutil.which("node") or not shutil.which("npm"):
        return "node and npm are not installed"
    stamp, lock = MODULES / ".package-lock.json", FOLDER / "package-lock.json"
    if stamp.exists() and stamp.stat().st_mtime >= lock.stat().st_mtime:
        return None
    try:
        subprocess.run(["npm", "ci", "--no-audit", "--no-fund", "--ignore-scripts"], cwd=FOLDER, check=True,
                       capture_output=True, timeout=180)
        stamp.touch()
    except (subprocess.SubprocessError, OSError) as error:
        return f"npm packages of tests/studio cannot be installed: {error}"
    return None


MISSING = missing_packages()


@unittest.skipIf(MISSING, MISSING or "")
class Studio(unittest.TestCase):
    def run_in_folder(self, *command):
        environment = dict(os.environ)
        oriel = program()
        if oriel:
            environment["ORIEL"] = str(oriel)
        done = subprocess.run(command, cwd=FOLDER, env=environment, capture_output=True, text=True, timeout=900)
        notes = [line.strip() for line in done.stdout.splitlines() if "# SKIP" in line]
        for note in notes:
            print(note, file=sys.stderr)
        self.assertEqual(done.returncode, 0, f"{done.stdout}\n{done.stderr}")

    def node_tests(self, folder):
        files = sorted(str(path.relative_to(FOLDER)) for path in (FOLDER / folder).glob("*.test.js"))
        self.assertTrue(files)
        self.run_in_folder("node", "--test", "--test-concurrency=2", "--test-reporter=tap", *files)

    def test_types(self):
        self.run_in_folder("node", "node_modules/typescript/bin/tsc", "-p", "tsconfig.json")

    def test_modules(self):
        self.node_tests("unit")

    def test_page_in_chromium(self):
        self.node_tests("browser")


if __name__ == "__main__":
    result = unittest.main(exit=False).result
    if result.wasSuccessful() and len(result.skipped) == result.testsRun:
        print(f"skipped: {MISSING}")
        sys.exit(EXIT_SKIPPED)
    sys.exit(not result.wasSuccessful())
