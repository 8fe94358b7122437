# SPDX-License-Identifier: Apache-2.0
"""What the tests of this folder share: scripts as modules, and the program that was built."""
import importlib.machinery
import importlib.util
import os
import pathlib
import unittest

HERE = pathlib.Path(__file__).resolve().parent


def load(name):
    """A script of this folder as a module."""
    loader = importlib.machinery.SourceFileLoader(name.replace("-", "_"), str(HERE / name))
    module = importlib.util.module_from_spec(
        importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def program():
    """The program beside the folder that tests run in, or that of the release build; else None."""
    here = pathlib.Path.cwd()
    for path in (os.environ.get("ORIEL"), here / "bin/oriel", here.parent / "bin/oriel",
                 HERE.parent / "build/release/bin/oriel"):
        if path and os.access(path, os.X_OK):
            return pathlib.Path(path).resolve()
    return None


class ProgramTest(unittest.TestCase):
    """What needs the program: `self.oriel` is its path."""

    def setUp(self):
        self.oriel = program()
        if not self.oriel:
            self.skipTest("the program is not built")
