#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The manual page names every command and option, and completion offers them."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from testing import HERE, ProgramTest, load

man_page = load("man-page")
COMPLETION = HERE.parent / "packaging/completion"


def complete(oriel, folder, *words):
    """What bash offers for the last of the words of a command line."""
    script = f"""source {COMPLETION}/oriel.bash
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
_oriel "$1" "${{@: -1}}" "${{@: -2:1}}"
printf '%s\\n' "${{COMPREPLY[@]}}" """
    run = subprocess.run(["bash", "-c", script, "bash", str(oriel), *words], cwd=folder,
                         capture_output=True, text=True, check=True)
    return run.stdout.split()


class ManualPage(ProgramTest):
    def test_it_is_that_of_the_program(self):
        run = subprocess.run([sys.executable, str(HERE / "man-page"), "--check", "--oriel",
                              str(self.oriel)], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_every_command_and_option_is_named(self):
        text = man_page.PAGE.read_text(encoding="utf-8").replace("\\-", "-")
        top = man_page.help_of(self.oriel, "--help")
        commands = [head for section, head, _ in man_page.entries(top) if section == "Subcommands"]
        self.assertGreater(len(commands), 10)
        for command in commands:
            part = re.search(rf"^\.SS oriel {command}$(.*?)^\.S[SH]", text, re.M | re.S)
            self.assertTrue(part, command)
            flag = "-help" if command == "ray" else "--help"
            said = man_page.help_of(self.oriel, command, flag)
            for option in re.findall(r"^  (-[\w-]+(?:,--[\w-]+)?)", said, re.M):
                if option != "-h,--help":
                    self.assertIn(option, part[1], command)

    @unittest.skipUnless(shutil.which("groff"), "groff is not here")
    def test_it_is_well_formed(self):
        run = subprocess.run(["groff", "-mandoc", "-ww", "-Tutf8", str(man_page.PAGE)],
                             capture_output=True, text=True, check=True)
        self.assertEqual(run.stderr, "")


class Completion(ProgramTest):
    def setUp(self):
        super().setUp()
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        for name in ("a.mi", "a b.mi", "a.exr", "lamp.ies"):
            (pathlib.Path(self.folder.name) / name).write_text("")

    def offered(self, *words):
        return complete(self.oriel, self.folder.name, *words)

    def test_commands(self):
        self.assertEqual(self.offered("rec"), ["recombine"])
        self.assertIn("--version", self.offered("--"))

    def test_options_are_those_of_the_command(self):
        self.assertEqual(self.offered("render", "a.mi", "--sk"), ["--skip-existing"])
        self.assertEqual(self.offered("tonemap", "--sk"), [])
        self.assertIn("-finalgather", self.offered("ray", "-final"))
        self.assertIn("--cryptomatte", self.offered("render", "--"))

    def test_values(self):
        self.assertEqual(self.offered("render", "a.mi", "--gi", "fg"), ["fg", "fg+photons"])
        self.assertEqual(self.offered("shaders", "--templates", "gol"), ["gold"])

    def test_shaders(self):
        self.assertIn("mia_material_x", self.offered("shaders", "mia_mat"))

    def test_files_that_the_command_reads(self):
        self.assertEqual(self.offered("render", "a."), ["a.mi"])
        self.assertEqual(self.offered("tonemap", ""), ["a.exr"])
        self.assertEqual(self.offered("profile", ""), ["lamp.ies"])

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not here")
    def test_zsh_reads_its_file(self):
        subprocess.run(["zsh", "-n", str(COMPLETION / "_oriel")], check=True)

    @unittest.skipUnless(shutil.which("fish"), "fish is not here")
    def test_fish_reads_its_file(self):
        subprocess.run(["fish", "-n", str(COMPLETION / "oriel.fish")], check=True)


if __name__ == "__main__":
    unittest.main()
