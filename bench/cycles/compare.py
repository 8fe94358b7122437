#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Oriel and Blender's Cycles on the same scenes: are the pictures the same, who is sooner as good?

    bench/cycles/compare.py --oriel build/release/bin/oriel --probe STUDIO.hdr [SCENE ...]

Needs Debian's `blender` and `python3-openimageio`. Both path trace without denoiser, clamping or
adaptive sampling, on one thread, with the same film, bounces, lights and portals. Times are of the
processor, without what is prepared before the first sample: of Oriel the difference of two runs
with other numbers of samples. Each error is against the renderer's own converged picture, the mean
of (difference / (reference + a hundredth of its mean)) squared, without the thousandth of the pixels
where it is largest, whose luck would decide. Error times time stays the same with more samples; its
ratio tells how many times sooner one is as good as the other. The two converged pictures are
compared by means and by blocks of 8 x 8 pixels.
"""
import argparse
import os
import statistics
import subprocess
import sys
import tempfile

import numpy
import OpenImageIO as oiio

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import mi_scene  # noqa: E402  beside this file
import scenes  # noqa: E402

LEFT_OUT = .001  # of the pixels


def picture(path):
    return oiio.ImageBuf(path).get_pixels(oiio.FLOAT)[..., :3].astype(numpy.float64)


def error(image, reference):
    squares = ((image - reference) / (reference + .01 * reference.mean())) ** 2
    squares = numpy.sort(squares.mean(axis=2).ravel())
    return squares[:int(len(squares) * (1 - LEFT_OUT))].mean()


def blocks(image):
    h, w = (n // 8 * 8 for n in image.shape[:2])
    return image[:h, :w].reshape(h // 8, 8, w // 8, 8, 3).mean(axis=(1, 3))


def processor_time(command):
    before = os.times()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = os.times()
    return (after.children_user - before.children_user
            + after.children_system - before.children_system)


class Oriel:
    name = "Oriel"

    def __init__(self, args, scene_name, folder):
        self.program, self.folder = args.oriel, folder
        self.file = os.path.join(folder, scene_name + ".mi")
        mi_scene.write(scenes.SCENES[scene_name](), self.file, args.probe, "unused.exr")

    def render(self, samples, seed, threads=1):
        out = os.path.join(self.folder, "oriel.exr")
        command = [self.program, "render", self.file, "-q", "-o", out, "--seed", str(seed),
                   "--threads", str(threads), "--samples"]
        first = processor_time([*command, "1"]) if threads == 1 else 0
        seconds = processor_time([*command, str(samples)]) - first
        return seconds * samples / (samples - 1), picture(out)


class Cycles:
    name = "Cycles"

    def __init__(self, args, scene_name, folder):
        self.scene, self.probe, self.folder = scene_name, args.probe, folder

    def render(self, samples, seed, threads=1):
        out = os.path.join(self.folder, "cycles.exr")
        result = subprocess.run(
            ["blender", "-b", "--factory-startup", "--python",
             os.path.join(HERE, "blender_scene.py"), "--", self.scene, self.probe, str(samples),
             str(seed), str(threads), out], check=True, capture_output=True, text=True)
        seconds = [line for line in result.stdout.splitlines() if line.startswith("seconds ")]
        if not seconds:
            raise SystemExit(result.stdout[-2000:] + result.stderr[-2000:])
        return float(seconds[0].split()[1]), picture(out)


def compare(name, args, folder):
    both = [kind(args, name, folder) for kind in (Oriel, Cycles)]
    reference = [r.render(args.reference, 1, threads=0)[1] for r in both]
    costs, errors, times = ([[], []] for _ in range(3))
    for turn in range(args.turns):
        for i, renderer in enumerate(both):
            seconds, image = renderer.render(args.samples, 100 + turn)
            e = error(image, reference[i])
            costs[i].append(e * seconds)
            errors[i].append(e)
            times[i].append(seconds)
    means = [r.mean() for r in reference]
    small = [blocks(r) for r in reference]
    off = numpy.abs(small[0] - small[1]).mean() / small[1].mean()
    sooner = [c / o for o, c in zip(*costs)]
    print(f"{name:9} means {means[0] / means[1]:.4f}, blocks {off:.4f}; "
          + "; ".join(f"{r.name} error {statistics.median(errors[i]):.4f} in "
                      f"{statistics.median(times[i]):.2f} s" for i, r in enumerate(both))
          + f"; Oriel {statistics.median(sooner):.2f} times sooner "
          f"({min(sooner):.2f} to {max(sooner):.2f})", flush=True)
    if args.keep:
        for renderer, image in zip(both, reference):
            kept = oiio.ImageBuf(image.astype(numpy.float32))
            kept.write(os.path.join(args.keep, f"{name}_{renderer.name}.exr"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--oriel", required=True)
    parser.add_argument("--probe", required=True, help="a latitude-longitude picture")
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--reference", type=int, default=4096, help="samples of converged pictures")
    parser.add_argument("--turns", type=int, default=5)
    parser.add_argument("--keep", help="folder for the converged pictures")
    parser.add_argument("scenes", nargs="*", choices=[[], *scenes.SCENES], metavar="SCENE")
    args = parser.parse_args()
    args.oriel, args.probe = os.path.abspath(args.oriel), os.path.abspath(args.probe)
    with tempfile.TemporaryDirectory() as folder:
        for name in args.scenes or scenes.SCENES:
            compare(name, args, folder)


if __name__ == "__main__":
    main()
