#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Processor time of two builds of the program over the same scenes, run in turns.

    bench/compare_programs.py PROGRAM_A PROGRAM_B [--runs 7] [--cycles PROBE.hdr] [-- ARGUMENTS]

ARGUMENTS are those of `oriel render`. --cycles takes the six scenes of bench/cycles in place of the
project's own.

Prints for each scene the median of B / A over the pairs of runs, and the quartiles. Preparation is
included, as users wait for it as well.
"""
import argparse
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ("scenes/interior/interior.mi", "scenes/guide/room.mi", "scenes/round-corners.mi",
          "scenes/daylight.mi", "scenes/profile-bulbs.mi")


def seconds(program, scene, extra, out):
    before = os.times()
    subprocess.run([program, "render", scene, "-o", out, "-q", *extra], cwd=ROOT, check=True,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = os.times()
    return (after.children_user - before.children_user) + (
        after.children_system - before.children_system)


def cycles_scenes(probe, folder):
    """Writes the scenes of bench/cycles as .mi files and returns their paths."""
    sys.path.insert(0, str(ROOT / "bench" / "cycles"))
    import mi_scene  # pylint: disable=import-outside-toplevel,import-error
    import scenes  # pylint: disable=import-outside-toplevel,import-error
    paths = []
    for name, make in scenes.SCENES.items():
        path = os.path.join(folder, name + ".mi")
        mi_scene.write(make(), path, probe, os.path.join(folder, name + ".exr"))
        paths.append(path)
    return paths


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("a", type=pathlib.Path)
    parser.add_argument("b", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=7)
    parser.add_argument("--cycles", metavar="PROBE.hdr")
    own, _, extra = " ".join(sys.argv[1:]).partition(" -- ")
    options = parser.parse_args(own.split())
    extra = extra.split() or ["--size", "300x200", "--samples", "16", "--threads", "1"]
    a, b = options.a.resolve(), options.b.resolve()
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out.exr")
        print("| scene | A, s | B / A | quartiles |\n|---|---|---|---|")
        for scene in cycles_scenes(options.cycles, folder) if options.cycles else SCENES:
            times = [(seconds(a, scene, extra, out), seconds(b, scene, extra, out))
                     for _ in range(options.runs)]
            ratios = [second / first for first, second in times]
            low, middle, high = statistics.quantiles(ratios, n=4)
            print(f"| {os.path.basename(scene)} | {statistics.median(t[0] for t in times):.2f} | {middle:.3f} "
                  f"| {low:.3f} to {high:.3f} |", flush=True)


if __name__ == "__main__":
    main()
