#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs a script inside Blender with an empty configuration.

    run.py PROGRAM SCRIPT

Prints "Blender is not installed" where it or Xvfb is missing; CTest then skips the test.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
DONE = "all tests passed"
# Scripts that need a window.
WINDOW = {"viewport.py"}
XVFB = ["xvfb-run", "-a", "-s", "-screen 0 800x600x24"]


def blender():
    return os.environ.get("BLENDER") or shutil.which("blender")


def environment(program, folder):
    """Variables of a Blender that reads no configuration of the user.

    Debian's Blender takes its Python modules from the first python3 in PATH.
    """
    return {**os.environ, "TMPDIR": folder, "LIBGL_ALWAYS_SOFTWARE": "1", "PATH": "/usr/local/bin:/usr/bin:/bin", "ORIEL": program, "ORIEL_TEST_FOLDER": folder,
            "BLENDER_USER_RESOURCES": os.path.join(folder, "resources"),
            "BLENDER_USER_SCRIPTS": os.path.join(folder, "resources", "scripts"),
            "BLENDER_USER_CONFIG": os.path.join(folder, "resources", "config")}


def main():
    program, script = sys.argv[1:3]
    window = script in WINDOW
    if not blender() or (window and not shutil.which(XVFB[0])):
        print("Blender is not installed" if not blender() else
              "Blender is not installed with Xvfb")
        return 0
    start = [*XVFB, blender()] if window else [blender(), "-b"]
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run(
            [*start, "--factory-startup", "--python-exit-code", "3", "--python",
             str(HERE / script)], env=environment(program, folder), stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True, errors="replace", check=False)
    print(run.stdout)
    # Errors that a test provokes change the exit status, so the last line decides.
    return 0 if DONE in run.stdout.splitlines() else 1


if __name__ == "__main__":
    sys.exit(main())
