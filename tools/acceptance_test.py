#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/acceptance reads the document's rows and the rows that tests name."""
import importlib.machinery
import importlib.util
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent


def load(name):
    loader = importlib.machinery.SourceFileLoader(name, str(HERE / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


acceptance = load("acceptance")


class Rows(unittest.TestCase):
    def test_rows_are_read_and_headings_are_not(self):
        text = "| id | promise | shown by |\n|---|---|---|\n| E1 | never above 1 | furnace |\n"
        self.assertEqual({"E1": "never above 1"}, acceptance.rows(text))

    def test_the_document_has_every_group(self):
        text = (HERE.parent / "docs/acceptance.md").read_text(encoding="utf-8")
        groups = {row[0] for row in acceptance.rows(text)}
        self.assertEqual(set("EDRTAOPBUSLXKCVGIHMZQWYF"), groups)


class Names(unittest.TestCase):
    def test_one_row_and_several(self):
        self.assertEqual({"R3"}, acceptance.named("// acceptance: R3\nTEST(A, B) {}"))
        self.assertEqual({"R3", "S10"}, acceptance.named("// acceptance: R3, S10 and more words"))

    def test_prose_names_nothing(self):
        self.assertEqual(set(), acceptance.named("// the acceptance rows R3 and S1"))

    def test_only_tests_count(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for path, row in (("src/a/x_test.cpp", "E1"), ("src/a/x.cpp", "E2"),
                              ("tests/b/y_test.cpp", "E3"), ("tests/b/probe.c", "E4")):
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(f"// acceptance: {row}\n", encoding="utf-8")
            self.assertEqual({"E1", "E3", "E4"}, set(acceptance.tests_by_row(root)))


if __name__ == "__main__":
    unittest.main()
