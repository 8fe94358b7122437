#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Measures the true error where `--noise` ends a render, and the gain over uniform sampling.

    bench/adaptive_noise.py build/release/bin/oriel [--target T] [--size WxH] [--keep DIR] [SCENE ...]

Requires Debian's python3-numpy and python3-openimageio. Each scene is rendered with --noise, and with
the same mean number of samples in every pixel. Both pictures are compared with a reference of another
seed, with at least 8 times the samples in every pixel. The error has the definition of
picture_noise() in src/render/progressive.h: the root of the mean over pixels of
error^2 / (L M), each at most 1, where L is the brightness of the pixel (at least M / 100) and M the
square of the mean root of the brightness. The noise of the reference is subtracted from the squares.

Columns: true error / target, noise that the program printed / target, mean samples, largest share of
the samples in a tenth of the pixels, difference of the mean from that of the reference (in brackets
with uniform sampling) and its standard error, processor seconds, squared error of uniform sampling / squared error of adaptive sampling at
an equal number of samples.
"""
import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile

import numpy
import OpenImageIO as oiio

REFERENCE = 8  # samples of the reference, times the mean samples of the measured picture
DARKEST = .01  # kDarkestJudged in progressive.cpp
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

# The targets of scenes whose default target would end at the minimum number of samples or take
# minutes.
SCENES = {
    "guide/room.mi": .05,
    "interior/interior.mi": .1,
    "manual/exposure/evening.mi": .1,
    "manual/details/caustics.mi": .05,
    "manual/tips/wine.mi": .05,
    "manual/material/translucency.mi": .02,
    "profile-bulbs.mi": .02,
    "daylight.mi": .02,
    "round-corners.mi": .02,
}


def render(program, scene, size, out, *options):
    """Displayed brightness, samples of pixels, the last event, and processor seconds."""
    words = [program, "render", f"{ROOT}/scenes/{scene}", "-I", f"{ROOT}/scenes", "-o", out,
             "--size", size, "--exr", "float", "--layers", "samples", "--threads", "1", "--json",
             *options]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    text = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    done = [e for e in map(json.loads, text.splitlines()) if e["event"] == "done"][-1]
    values = oiio.ImageBuf(out)
    names = values.spec().channelnames
    pixels = values.get_pixels(oiio.FLOAT).astype(numpy.float64)
    return (pixels[..., [names.index(c) for c in "RGB"]].mean(axis=2),
            pixels[..., names.index("samples.X")], done, seconds)


def error2(picture, reference):
    """Mean over pixels of the squared relative error, as in picture_noise()."""
    mean = numpy.sqrt(reference.clip(0)).mean() ** 2
    squares = (picture - reference) ** 2 / (numpy.maximum(reference, DARKEST * mean) * mean)
    return numpy.minimum(squares, 1).mean()


def reference_of(program, scene, size, samples, folder):
    """The brightness of a converged picture, kept in the folder, and its number of samples."""
    name = f"{folder}/{scene.replace('/', '-')}_{size}"
    if os.path.exists(name + ".npy") and os.path.exists(name + ".txt"):
        with open(name + ".txt", encoding="utf-8") as f:
            kept = int(f.read())
        if kept >= samples:
            return numpy.load(name + ".npy"), kept
    image, *_ = render(program, scene, size, name + ".exr", "--samples", str(samples),
                       "--seed", "77")
    numpy.save(name + ".npy", image)
    with open(name + ".txt", "w", encoding="utf-8") as f:
        f.write(str(samples))
    return image, samples


def measure(args, program, scene, target, folder):
    size, seeds = args.size, args.seeds
    runs, plain, told, spent, concentration = [], [], [], [], []
    samples = 0
    for seed in range(1, seeds + 1):
        image, counts, done, seconds = render(program, scene, size, f"{folder}/a.exr", "--noise",
                                              str(target), "--seed", str(seed))
        samples += done["samples"] / seeds
        runs.append(image), told.append(done["noise"]), spent.append(seconds)
        ordered = numpy.sort(counts.ravel())[::-1]
        concentration.append(ordered[:len(ordered) // 10].sum() / ordered.sum())
    count = max(round(samples), 1)
    for seed in range(1, seeds + 1):
        plain.append(render(program, scene, size, f"{folder}/a.exr", "--samples", str(count),
                            "--even-samples", "--seed", str(seed))[0])
    converged, most = reference_of(program, scene, size, max(REFERENCE * count, 256),
                                   args.keep or folder)
    uniform2 = numpy.mean([error2(p, converged) for p in plain]) / (1 + count / most)
    adaptive2 = (numpy.mean([error2(p, converged) for p in runs]) - uniform2 * count / most)
    shift, plain_shift = (numpy.mean([p.mean() for p in pictures]) / converged.mean() - 1
                          for pictures in (runs, plain))
    off = numpy.mean([(p - converged).std() for p in runs])
    deviation = off / converged.mean() / numpy.sqrt(seeds * converged.size)
    ratio = adaptive2 ** .5 / target
    print(f"{scene:32} {target:.3f} | {ratio:5.2f} | {numpy.mean(told) / target:5.2f} | "
          f"{samples:7.1f} | {numpy.mean(concentration):.2f} | {100 * shift:+6.2f} "
          f"({100 * plain_shift:+.2f}) +- {100 * deviation:.2f} % | {numpy.mean(spent):5.1f} s | {uniform2 / adaptive2:5.2f}",
          flush=True)
    return ratio, uniform2 / adaptive2


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--target", type=float, help="for all scenes; default: that of the scene")
    parser.add_argument("--size", default="48x32")
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--keep", help="folder for converged pictures, which are used again")
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    args = parser.parse_intermixed_args()
    program = os.path.abspath(args.program)
    if args.keep:
        os.makedirs(args.keep, exist_ok=True)
    print("scene, target | error / target | told / target | samples | top tenth | mean | seconds | "
          "gain over uniform")
    with tempfile.TemporaryDirectory() as folder:
        results = [measure(args, program, s, args.target or SCENES.get(s, .05), folder)
                   for s in args.scenes or SCENES]
    ratios, gains = zip(*results)
    product = numpy.exp(numpy.mean(numpy.log(gains)))
    print(f"error / target {min(ratios):.2f} to {max(ratios):.2f}; geometric mean of gains "
          f"{product:.2f}")
    return 0 if all(.75 <= r <= 1.25 for r in ratios) else 1


if __name__ == "__main__":
    sys.exit(main())
