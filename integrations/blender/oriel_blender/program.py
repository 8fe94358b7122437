# SPDX-License-Identifier: Apache-2.0
"""The installed program: where it is, and the declarations of its shaders."""
import functools
import json
import os
import pathlib
import shutil
import subprocess

import bpy

PLACES = ("/usr/local/bin/oriel", "/usr/bin/oriel", "/opt/oriel/bin/oriel", "~/.local/bin/oriel")


class ProgramMissing(RuntimeError):
    pass


def preference():
    addon = bpy.context.preferences.addons.get(__package__)
    return addon.preferences.program if addon and addon.preferences else ""


def find():
    """The path of the program: of the preferences, of ORIEL, of PATH, or of usual folders."""
    for wish in (preference(), os.environ.get("ORIEL", "")):
        path = pathlib.Path(bpy.path.abspath(wish)).expanduser() if wish else None
        if path and path.is_file() and os.access(path, os.X_OK):
            return str(path.resolve())
    found = shutil.which("oriel")
    for place in [found] if found else PLACES:
        path = pathlib.Path(place).expanduser()
        if path.is_file() and os.access(path, os.X_OK):
            return str(path.resolve())
    raise ProgramMissing("Oriel is not installed: set the path of the program 'oriel' in the "
                         "preferences of the add-on")


_found = None


def find_cached(refresh=False):
    """The path of the last find(), for threads, which cannot read the preferences."""
    global _found
    if refresh or _found is None:
        _found = find()
    return _found


def declarations():
    """Declarations of all shaders: a list of dictionaries as of `oriel shaders --json`."""
    path = find()
    return _declarations(path, os.stat(path).st_mtime_ns)


@functools.lru_cache(maxsize=2)
def _declarations(path, _changed):
    run = subprocess.run([path, "shaders", "--json"], capture_output=True, text=True, timeout=30,
                         check=True)
    return [json.loads(line) for line in run.stdout.splitlines() if line.startswith("{")]
