#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Compares noise targets of the picture with noise targets of blocks, which parts could decide alone.

    bench/local_noise.py build/release/bin/oriel [--size WxH] [--across N] [SCENE TARGET]...

Requires Debian's python3-numpy and python3-openimageio. Each scene is rendered with --noise, and again in N x N blocks
by --crop, whose targets are scaled by the brightness of the picture: each block samples until its own noise is that of
the target. A block decides by its own pixels only; a border would add samples. Both pictures are compared with a
reference, see adaptive_noise.py.

Columns: mean samples and true error / target of the picture, of the blocks; product of samples and squared error of
the blocks relative to the picture (above 1: blocks need more samples for the same error); passes of the picture that
look at its noise (rounds of parts).
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

import numpy

import adaptive_noise as noise

FIRST_JUDGED = 16  # samples, kMinJudgedSamples in progressive.h


def brightness(picture):
    return numpy.sqrt(picture.clip(0)).mean() ** 2


def rounds(program, scene, size, target, folder):
    """Passes of a render after the first judged number of samples: each is a round of parts."""
    words = [program, "render", f"{noise.ROOT}/scenes/{scene}", "-I", f"{noise.ROOT}/scenes", "-o", f"{folder}/r.exr",
             "--size", size, "--noise", str(target), "--seed", "1", "--json"]
    lines = subprocess.run(words, check=True, capture_output=True, text=True).stdout.splitlines()
    events = [json.loads(line) for line in lines]
    return len({e["pass"] for e in events if e.get("samples", 0) >= FIRST_JUDGED and "pass" in e})


def measure(program, scene, target, size, across, folder):
    width, height = (int(n) for n in size.split("x"))
    whole, counts, _, _ = noise.render(program, scene, size, f"{folder}/a.exr", "--noise", str(target), "--seed", "1")
    samples = counts.mean()
    reference, most = noise.reference_of(program, scene, size, max(256, round(noise.REFERENCE * samples)), folder)
    joined, joined_counts = numpy.zeros_like(whole), numpy.zeros_like(counts)
    for row in range(across):
        for column in range(across):
            x0, x1 = width * column // across, width * (column + 1) // across
            y0, y1 = height * row // across, height * (row + 1) // across
            inside = numpy.s_[height - y1:height - y0, x0:x1]
            local = target * (brightness(whole) / brightness(reference[inside])) ** .5
            block, of_block, _, _ = noise.render(program, scene, size, f"{folder}/b.exr", "--noise", str(local),
                                                 "--seed", "1", "--crop", f"{x0},{y0},{x1 - 1},{y1 - 1}")
            joined[inside], joined_counts[inside] = block, of_block
    errors = [noise.error2(picture, reference) for picture in (whole, joined)]
    blocks = joined_counts.mean()
    print(f"{scene:32} {target:.3f} | {samples:7.1f} {errors[0] ** .5 / target:5.2f} | {blocks:7.1f} "
          f"{errors[1] ** .5 / target:5.2f} | {blocks * errors[1] / (samples * errors[0]):5.2f} | "
          f"{rounds(program, scene, size, target, folder)}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--size", default="192x128")
    parser.add_argument("--across", type=int, default=4)
    parser.add_argument("scenes", nargs="*", metavar="SCENE TARGET")
    a = parser.parse_intermixed_args()
    words = a.scenes or ["interior/interior.mi", "0.1", "guide/room.mi", "0.05"]
    with tempfile.TemporaryDirectory() as folder:
        for scene, target in zip(words[::2], words[1::2]):
            measure(os.path.abspath(a.program), scene, float(target), a.size, a.across, folder)


if __name__ == "__main__":
    sys.exit(main())
