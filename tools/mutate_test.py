#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/mutate: which changes it makes, and that it tells those that tests see from the others."""
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from testing import HERE, load

mutate = load("mutate")

SOURCE = """// a - b in a comment
#include <cstdio>
int larger(int a, int b) {
  if (a > b) return a;
  return b;  // a * b
}
int unused(int a) { return a + 1; }
int main() { return larger(1, 2) == 2 && larger(2, 1) == 2 ? 0 : 1; }
"""


def changed(line):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "a.cpp")
        path.write_text(line + "\n")
        return [c.new_line for c in mutate.changes_of(path)]


class Changes(unittest.TestCase):
    def test_operators_and_conditions(self):
        self.assertEqual(changed("x = a + b;"), ["x = a - b;"])
        self.assertEqual(changed("x = a < b;"), ["x = a <= b;", "x = a >= b;"])
        self.assertEqual(changed("if (f(x)) return;"),
                         ["if (true || (f(x))) return;", "if (false && (f(x))) return;"])
        self.assertEqual(changed("if (!empty) go();")[0], "if (empty) go();")

    def test_constants(self):
        self.assertEqual(changed("return clamp(x, 0, 7);"),
                         ["return clamp(x, 1, 7);", "return clamp(x, 0, 8);"])
        self.assertEqual(changed("y = 0.5f * x;")[-1], "y = 0.3f * x;")

    def test_what_is_no_code_is_left_alone(self):
        for line in ("// a + b", '#include "a - b"', 'say("a + b");',
                     "static_assert(a == b);", "std::vector<int> v;", "  v.reserve(a + b);"):
            self.assertEqual(changed(line), [], line)


@unittest.skipUnless(shutil.which("g++"), "no compiler")
class Trials(unittest.TestCase):
    def test_changes_without_a_test_survive_and_sources_are_restored(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "a.cpp")
            path.write_text(SOURCE)
            command = [str(HERE / "mutate"), "--count", "0", "--lines", "3-7",
                       "--build-folder", folder,
                       "--build", f"g++ -c {folder}/a.cpp -o {folder}/a.o && "
                                  f"g++ {folder}/a.o -o {folder}/a",
                       "--test", f"{folder}/a", str(path)]
            answer = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual(path.read_text(), SOURCE)
            self.assertEqual(answer.returncode, 1, answer.stdout + answer.stderr)
            said = answer.stdout
            # Of equal numbers it does not matter which is returned; nobody calls `unused`.
            for survivor in ("a >= b", "return a - 1", "return a + 0"):
                self.assertRegex(said, "not found: .*" + re.escape(survivor))
            for found in ("a <= b", "if (true ", "if (false "):
                self.assertRegex(said, "found +.*" + re.escape(found))
            self.assertIn("3 of 6 changes", said)

    def test_an_interrupted_run_continues_from_its_log(self):
        with tempfile.TemporaryDirectory() as folder:
            path, log = pathlib.Path(folder, "a.cpp"), pathlib.Path(folder, "log")
            path.write_text(SOURCE)
            change = next(str(c) for c in mutate.changes_of(path) if " <= " in c.new)
            log.write_text(f"survived\t\t{change}\n")  # the tests find it when it is tried
            command = [str(HERE / "mutate"), "--count", "0", "--lines", "4-4", "--log", str(log),
                       "--build-folder", folder,
                       "--build", f"g++ -c {folder}/a.cpp -o {folder}/a.o && "
                                  f"g++ {folder}/a.o -o {folder}/{{target}}",
                       "--test", f"{folder}/a", str(path)]
            answer = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertIn("not found: " + change, answer.stdout)
            self.assertIn("2 of 4 changes", answer.stdout)
            self.assertEqual(len(log.read_text().splitlines()), 4)
            self.assertIn(f"found\t{folder}/a\t", log.read_text())

    def test_a_test_that_takes_too_long_is_ended_with_what_it_started(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertFalse(mutate.run(f"sleep 60; touch {folder}/a", 0.1))
            running = subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True,
                                     check=True).stdout
            self.assertNotIn(f"touch {folder}/a", running)


if __name__ == "__main__":
    unittest.main()
