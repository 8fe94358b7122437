# SPDX-License-Identifier: Apache-2.0
"""Reads the JSON and the arrays that `oriel convert SCENE.mi NAME.json` writes."""
import json
import os
import pathlib
import subprocess
import tempfile

import numpy

from . import program


MISSING_INCLUDE = "OR-MI-010"
FOLDERS_ABOVE = 4  # that are searched for missing includes


class DumpError(RuntimeError):
    pass


class Dump:
    """A scene: lists of elements, and arrays by their place."""

    def __init__(self, root, binary):
        if not isinstance(root, dict) or root.get("format") != "oriel-scene":
            raise DumpError("the file is not a scene of Oriel")
        if root.get("version") != 1:
            raise DumpError(f"version {root.get('version')} of the scene file is unsupported")
        self.root = root
        self._binary = binary

    def list(self, name):
        return self.root.get(name, [])

    def shader(self, name):
        """The last call of a named shader, or of NAME.RESULT; None if there is none."""
        shaders = self.root.get("shaders", {})
        for key in (name, name.rsplit(".", 1)[0], name.split(".")[0]):
            if shaders.get(key):
                return self.call(shaders[key][-1])
        return None

    def call(self, use):
        """The call behind a reference."""
        for _ in range(20):
            if use is None or "type" in use:
                return use
            calls = self.root.get("shaders", {}).get(use.get("reference", ""), [])
            use = calls[-1] if calls else None
        return None

    def floats(self, place, width=3):
        return self._array(place, "<f4").reshape(-1, width)

    def integers(self, place):
        return self._array(place, "<u4")

    def _array(self, place, kind):
        offset, count = int(place["offset"]), int(place["count"])
        if offset < 0 or count < 0 or offset + 4 * count > len(self._binary):
            raise DumpError("an array lies outside of the file")
        return numpy.frombuffer(self._binary, kind, count, offset)


def read(path):
    """Reads a dump from its JSON file."""
    try:
        with open(path, encoding="utf-8") as file:
            root = json.load(file)
        name = os.path.basename(root.get("binary", ""))
        with open(os.path.join(os.path.dirname(path), name), "rb") as file:
            return Dump(root, file.read())
    except (OSError, ValueError, AttributeError) as error:
        raise DumpError(f"the scene cannot be read: {error}") from error


def convert(path, includes=()):
    """Converts a .mi file; returns the dump and the messages of the program.

    includes: folders of include files. Missing ones are searched in the folders above the scene.
    """
    try:
        result = convert_with(path, includes)
    except DumpError:
        if not includes:
            raise
        result = None
    if result is not None and not any(MISSING_INCLUDE in line for line in result[1]):
        return result
    above = list(pathlib.Path(path).resolve().parents)[:FOLDERS_ABOVE]
    try:
        return convert_with(path, [*includes, *(f for f in above if f != f.parent)])
    except DumpError:
        if result is None:
            raise
        return result


def convert_with(path, includes):
    with tempfile.TemporaryDirectory() as folder:
        target = os.path.join(folder, "scene.json")
        words = [word for place in includes for word in ("-I", str(place))]
        run = subprocess.run([program.find(), "convert", path, target, *words], capture_output=True,
                             text=True, errors="replace", check=False)
        messages = [line for line in (run.stdout + run.stderr).splitlines() if line.strip()]
        if run.returncode != 0 or not os.path.exists(target):
            raise DumpError(messages[-1] if messages else "the scene cannot be converted")
        return read(target), messages
