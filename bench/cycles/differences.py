#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Compares Oriel with Blender's Cycles without converged pictures.

    bench/cycles/differences.py --oriel build/release/bin/oriel --probe STUDIO.hdr [SCENE ...]

The error of a program is half of the mean squared difference of its pictures with other seeds,
relative to the mean of these and of a picture with LONGER times as many samples, without .2 % of the
pixels. It is the noise without a bias, so that dots of a converged picture do not matter; agreement
of the programs is measured by compare.py. Times are those of compare.py.
"""
import os
import sys
import tempfile

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import compare  # noqa: E402  beside this file
import measure  # noqa: E402

LONGER = 8


def noise(pictures, longer):
    """Mean over the pairs of pictures. Relative to themselves, the error of noisy ones is bounded."""
    level = (sum(pictures) + LONGER * longer) / (len(pictures) + LONGER)
    return measure.noise(pictures, level)


def main():
    parser = compare.parser_of(__doc__)
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--pictures", type=int, default=3, help="of each program")
    args = compare.parsed(parser)
    args.adaptive = 0
    print("| scene | Oriel: error, seconds | Cycles | time to equal error, Cycles / Oriel |\n|---|---|---|---|")
    for name in args.scenes:
        with tempfile.TemporaryDirectory() as folder:
            oriel = compare.Oriel(args, name, folder)
            cost, cells = [], []
            for renderer in (oriel, compare.Cycles(args, name, folder, oriel)):
                runs = [renderer.render(args.samples, 500 + k) for k in range(args.pictures)]
                longer = renderer.render(LONGER * args.samples, 400, threads=0, adaptive=False)
                error = noise([r["picture"] for r in runs], longer["picture"])
                seconds = numpy.median([r["seconds"] for r in runs])
                cost.append(error * seconds)
                cells.append(f"{error:.4f} in {seconds:.2f} s")
            print(f"| {name} | {cells[0]} | {cells[1]} | {cost[1] / cost[0]:.2f} |", flush=True)


if __name__ == "__main__":
    main()
