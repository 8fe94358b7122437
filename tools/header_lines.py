#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How many lines the compiler reads for each header of the project.

    tools/header_lines.py [ROOT]     the longest headers and the system headers that make them long

Each system header is preprocessed once; what a header of the project costs is the sum over all files
that it reaches, each counted once.
"""
import concurrent.futures
import pathlib
import re
import shutil
import subprocess
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^">]+)[">]', re.M)
MARKER = re.compile(r'^# \d+ "([^"]*)"')
FLAGS = ("-std=c++20", "-march=x86-64-v3", "-isystem", "/usr/include/Imath", "-isystem",
         "/usr/include/OpenEXR")


def files_behind(system_header):
    """Lines that are not blank of each file that a system header reads."""
    answer = subprocess.run(["g++", *FLAGS, "-x", "c++", "-E", "-"], text=True, check=False,
                            input=f"#include <{system_header}>\n", capture_output=True)
    lines, current = {}, ""
    for line in answer.stdout.splitlines():
        marker = MARKER.match(line)
        if marker:
            current = marker[1]
        elif line and current.startswith("/"):
            lines[current] = lines.get(current, 0) + 1
    return lines


class Headers:
    """The project's headers and what they reach."""

    def __init__(self, root):
        self.root = root
        self.paths = {str(p.relative_to(root)) for folder in ("src", "include", "apps")
                      for p in (root / folder).rglob("*.h")}
        self.texts = {p: (root / p).read_text() for p in self.paths}
        direct = {name for text in self.texts.values()
                  for kind, name in INCLUDE.findall(text) if kind == "<"}
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            self.system = dict(zip(sorted(direct), pool.map(files_behind, sorted(direct))))

    def find(self, path, name):
        beside = str(pathlib.PurePosixPath(path).parent / name)
        return next((p for p in (f"src/{name}", f"include/{name}", beside, f"apps/oriel/{name}")
                     if p in self.paths), None)

    def reached(self, path):
        """All headers that one reaches, itself included: the project's and the system's names."""
        own, system, todo = set(), set(), [path]
        while todo:
            current = todo.pop()
            if current in own:
                continue
            own.add(current)
            for kind, name in INCLUDE.findall(self.texts[current]):
                found = self.find(current, name)
                if found:
                    todo.append(found)
                elif kind == "<":
                    system.add(name)
        return own, system

    def lines(self, path):
        own, system = self.reached(path)
        files = {}
        for name in system:
            files.update(self.system.get(name, {}))
        return sum(files.values()) + sum(self.texts[p].count("\n") for p in own)


def measure(root):
    """Lines by header; nothing where there is no compiler."""
    if not shutil.which("g++"):
        return {}
    headers = Headers(pathlib.Path(root))
    return {path: headers.lines(path) for path in sorted(headers.paths)}


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else
                        pathlib.Path(__file__).resolve().parent.parent)
    headers = Headers(root)
    costs = sorted(((headers.lines(p), p) for p in headers.paths), reverse=True)
    for lines, path in costs[:40]:
        print(f"{lines:8} {path}")
    print("\nalone:")
    for name, files in sorted(headers.system.items(), key=lambda i: -sum(i[1].values()))[:25]:
        print(f"{sum(files.values()):8} <{name}>")


if __name__ == "__main__":
    main()
