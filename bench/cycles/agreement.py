#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Agreement of Oriel with Blender's Cycles in small pictures, without converged pictures.

    bench/cycles/agreement.py --oriel build/release/bin/oriel --probe STUDIO.hdr [SCENE ...]

Each program renders pictures with other seeds for a number of minutes. Small pictures have many
samples in each block of 8 x 8 pixels, so that scenes with much noise can be compared too.

Columns: ratio of the means, Oriel / Cycles, and its standard error; root mean square of the
difference of blocks, relative to the mean, without noise; the noise of a block that was subtracted,
in the same measure; numbers of pictures.
"""
import os
import sys
import tempfile
import time

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import compare  # noqa: E402  beside this file
import measure  # noqa: E402
import scenes  # noqa: E402

AT_LEAST = 4  # pictures of each program


def pictures_of(renderer, args):
    end, pictures = time.time() + 60 * args.minutes, []
    while len(pictures) < AT_LEAST or time.time() < end:
        pictures.append(renderer.render(args.samples, 900 + len(pictures))["picture"])
    return numpy.array(pictures)


def halves(pictures):
    return [measure.blocks(pictures[k::2].mean(axis=0)) for k in (0, 1)]


def row(name, ours, theirs):
    level = theirs.mean()
    means = [p.mean(axis=(1, 2, 3)) for p in (ours, theirs)]
    error = numpy.sqrt(sum(m.var(ddof=1) / len(m) / m.mean() ** 2 for m in means))
    # The product of the differences of independent halves has the square of the bias as its mean.
    a, b = halves(ours), halves(theirs)
    squared = ((a[0] - b[0]) * (a[1] - b[1])).mean()
    noise = numpy.sqrt(sum(((h[0] - h[1]) ** 2).mean() / 4 for h in (a, b)))
    return (f"| {name} | {means[0].mean() / means[1].mean():.4f} | {error:.4f} | "
            f"{numpy.sqrt(max(squared, 0)) / level:.4f} | {noise / level:.4f} | "
            f"{len(ours)}, {len(theirs)} |")


def main():
    parser = compare.parser_of(__doc__)
    parser.add_argument("--samples", type=int, default=256, help="of one picture")
    parser.add_argument("--minutes", type=float, default=3, help="of each program")
    parser.add_argument("--width", type=int, default=80, help="of the pictures, in pixels")
    args = compare.parsed(parser)
    args.adaptive = 0
    scenes.WIDTH, scenes.HEIGHT = args.width, args.width * scenes.HEIGHT // scenes.WIDTH
    print("| scene | means | +- | blocks | noise of blocks | pictures |\n|---|---|---|---|---|---|")
    for name in args.scenes:
        with tempfile.TemporaryDirectory() as folder:
            oriel = compare.Oriel(args, name, folder)
            cycles = compare.Cycles(args, name, folder, oriel)
            print(row(name, *(pictures_of(r, args) for r in (oriel, cycles))), flush=True)


if __name__ == "__main__":
    main()
