#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The commands of docs/guide run as written, with small pictures.

All ```sh blocks of a page run in one shell, in a folder of their own that has the project's scenes
and examples. What a ```text same block shows is what the commands before it on the page printed,
line by line; a line of three dots stands for any others. Links of all pages have existing targets.
"""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from testing import HERE, ProgramTest

ROOT = HERE.parent
GUIDE = ROOT / "docs/guide"
BLOCK = re.compile(r"^```(sh|text same)\n(.*?)^```$", re.M | re.S)
# Stands before the program: what takes long is made small.
WRAPPER = """#!/bin/bash
case $1 in
render) small=(--size 24x16 --samples 2 --threads 2); skip='--size --samples --noise --time' ;;
quick) small=(--size 24x16 --samples 2); skip='--size --samples' ;;
measure) small=(--precision 50% --max-samples 64); skip='--precision --max-samples --time' ;;
explain) small=(--samples 4); skip=--samples ;;
*) exec "$ORIEL" "$@" ;;
esac
words=()
while (($#)); do
  if [[ " $skip " == *" $1 "* ]]; then shift 2; else words+=("$1"); shift; fi
done
exec "$ORIEL" "${words[@]}" "${small[@]}"
"""


def run_page(page, oriel, folder):
    """(kind, text) of each block, and the shell's run."""
    folder = pathlib.Path(folder)
    (folder / "bin").mkdir()
    wrapper = folder / "bin/oriel"
    wrapper.write_text(WRAPPER, encoding="utf-8")
    wrapper.chmod(0o755)
    work = folder / "work"
    work.mkdir()
    for name in ("scenes", "examples", "docs"):
        (work / name).symlink_to(ROOT / name)
    blocks = BLOCK.findall(page.read_text(encoding="utf-8"))
    script = "set -e\nexec 2>&1\n"
    for index, (kind, text) in enumerate(blocks):
        if kind == "sh":
            script += f"{text}\necho '@@{index}'\n"
    environment = dict(os.environ, ORIEL=str(oriel), PATH=f"{wrapper.parent}:{os.environ['PATH']}")
    run = subprocess.run(["bash", "-c", script], cwd=work, env=environment, capture_output=True,
                         text=True, check=False, timeout=600)
    return blocks, run


def appears(wanted, printed):
    """The first line of `wanted` that is not in `printed`, in order; else None."""
    lines = iter(line.rstrip() for line in printed.splitlines())
    for line in wanted.splitlines():
        if line.strip() != "..." and line.rstrip() not in lines:
            return line
    return None


class Guide(ProgramTest):
    def test_commands_run_and_print_what_the_page_shows(self):
        for page in sorted(GUIDE.glob("*.md")):
            with self.subTest(page=page.name), tempfile.TemporaryDirectory() as folder:
                blocks, run = run_page(page, self.oriel, folder)
                self.assertEqual(run.returncode, 0, run.stdout[-3000:])
                done = run.stdout
                for kind, text in blocks:
                    if kind != "sh":
                        self.assertIsNone(appears(text, done), done[-3000:])


class Links(unittest.TestCase):
    def test_the_index_lists_every_page(self):
        text = (GUIDE / "README.md").read_text(encoding="utf-8")
        listed = set(re.findall(r"^\| \[.*?\]\(([\w-]+\.md)\)", text, re.M))
        self.assertEqual(listed, {p.name for p in GUIDE.glob("*.md")} - {"README.md"})

    def test_links_lead_to_files_that_are_there(self):
        pages = [ROOT / "README.md", *(ROOT / "docs").glob("*.md"), *GUIDE.glob("*.md")]
        for page in pages:
            text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
            for link in re.findall(r"\]\(([^)#:\s]+)(?:#[\w-]*)?\)", text):
                target = page.parent / link
                if "manual" in target.parts and not (ROOT / "docs/manual").exists():
                    continue
                self.assertTrue(target.exists(), f"{page.name}: {link}")


if __name__ == "__main__":
    unittest.main()
