#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Compares Oriel with Blender's Cycles on the scenes of catalogue.py.

    bench/cycles/compare.py --oriel build/release/bin/oriel --probe STUDIO.hdr [SCENE ...]

Requires Debian's `blender`, `python3-numpy` and `python3-openimageio`. Both programs render without
denoiser and clamping, with the same film, bounces, lights and portals.

Times are processor times of one thread from the start of rendering. They include passes before the
picture (photons, gather points, caches, guiding), and exclude reading, tables of lights and
acceleration structures. For Oriel, the excluded part is the time of one path in one pixel; for
Cycles, the time is that of the second picture of a process, whose scene stays loaded.

Errors are the mean of (difference / (reference + a hundredth of its mean)) squared, without the
thousandth of the pixels where it is largest. The reference of each program is its own converged
path-traced picture, for every method, so that bias counts. Path tracing reaches an error e after
seconds x error / e. For methods with bias, the error is split by two numbers of samples into a
constant part and a part that decreases with the samples; "never" means that the constant part
exceeds the error.

Lines of a scene: agreement of the two references; then for each method of Oriel, and for Cycles:
error, seconds, mean and block bias, seconds to the errors .01 and .001, the ratio of times to equal
error, wall-clock seconds with all threads, peak memory, wall-clock seconds from the start of the
program to its first picture (one sample per pixel), seconds before rendering.
"""
import argparse
import json
import os
import statistics
import sys
import tempfile
import time

import numpy
import OpenImageIO as oiio

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import catalogue  # noqa: E402  beside this file
import measure  # noqa: E402
import mi_scene  # noqa: E402
import scenes  # noqa: E402

TARGETS = (1e-2, 1e-3)


class Oriel:
    def __init__(self, args, name, folder, *more):
        self.program, self.noise, self.more = args.oriel, args.adaptive, more
        self.file, self.out = (os.path.join(folder, f) for f in (name + ".mi", "oriel.exr"))
        self.probe, self.profile, self.sun = args.probe, os.path.join(folder, "profile.ies"), None
        scene = catalogue.ALL[name]()
        scene["pictures"] = self.pictures = {n: self.paint(n, base, folder) for n, base in
                                             scene.get("pictures", {}).items()}
        if "profile" in scene:
            mi_scene.write_profile(self.profile, scene["profile"])
        if "sky" in scene:
            self.probe, self.sun = self.measure_sky(scene["sky"], folder)
        mi_scene.write(scene, self.file, self.probe, self.profile)

    @staticmethod
    def paint(name, base, folder):
        """A picture of 2048 x 2048 pixels with grain around the colour; of 256 x 256 with a leaf;
        of 2048 x 2048 with round dents."""
        path = os.path.join(folder, name + ".png")
        if base == "leaf":
            y, x = numpy.mgrid[-1:1:256j, -1:1:256j]
            values = (abs(y) < .9 * (1 - x * x)).astype(numpy.float32)[..., None].repeat(3, axis=2)
        elif base == "dents":
            y, x = numpy.mgrid[0:2048, 0:2048] * (2 * numpy.pi / 2048)
            values = (.5 + .25 * (numpy.sin(24 * x) + numpy.sin(24 * y)))[..., None].repeat(3, axis=2)
        else:
            grain = numpy.random.default_rng(len(name)).uniform(.5, 1.5, (2048, 2048, 1))
            values = (grain * base).clip(0, 1)
        oiio.ImageBuf(values.astype(numpy.float32)).write(path, oiio.UINT8)
        return path

    def measure_sky(self, sky, folder):
        """The physical sky as a picture for Cycles, and the colour that its sun gives to white."""
        pictures = []
        for name, write, samples in (("sky", mi_scene.write_sky, 16), ("sun", mi_scene.write_sunlit, 64)):
            path = os.path.join(folder, name)
            write(sky, path + ".mi")
            measure.run([self.program, "render", path + ".mi", "-q", "-o", path + ".exr",
                         "--exr", "float", "--samples", str(samples)])
            pictures.append(path + ".exr")
        return pictures[0], list(measure.picture(pictures[1]).mean(axis=(0, 1)))

    def command(self, samples, seed, threads, *more):
        return [self.program, "render", self.file, "--json", "-o", self.out, "--exr", "float",
                "--seed", str(seed), "--threads", str(threads), "--samples", str(samples),
                *self.more, *more]

    def start(self, threads):
        return measure.run(self.command(1, 1, threads, "--crop", "0,0,0,0", "--gi", "path"))

    def render(self, samples, seed, threads=1, method="path", adaptive=True):
        before = self.start(threads)
        noise = ["--noise", str(self.noise)] if self.noise and adaptive else []
        run = measure.run(self.command(samples, seed, threads, "--gi", method, *noise))
        first = [e["elapsed"] for e in run["events"]
                 if e["event"] == "progress" and e["stage"] == "picture" and e["samples"] >= 1]
        return {"seconds": run["seconds"] - before["seconds"], "wall": run["wall"] - before["wall"],
                "start": before["seconds"], "memory": run["memory"],
                "first": first[0] if first else run["wall"], "picture": measure.picture(self.out)}


class Cycles:
    def __init__(self, args, name, folder, oriel):
        self.noise, self.out = args.adaptive, os.path.join(folder, "cycles.exr")
        self.file = os.path.join(folder, "cycles.json")
        self.fixed = {"scene": name, "probe": oriel.probe, "profile": oriel.profile,
                      "sun": oriel.sun, "pictures": oriel.pictures, "out": self.out,
                      "size": [scenes.WIDTH, scenes.HEIGHT]}

    def render(self, samples, seed, threads=1, method="path", adaptive=True):
        del method
        noise = self.noise if adaptive and self.noise else 0
        with open(self.file, "w", encoding="utf-8") as f:
            json.dump({**self.fixed, "samples": samples, "seed": seed, "threads": threads,
                       "noise": noise, "begin": time.time()}, f)
        run = measure.run(["blender", "-b", "--factory-startup", "--python",
                           os.path.join(HERE, "blender_scene.py"), "--", self.file])
        result = [e["result"] for e in run["events"] if "result" in e]
        if not result:
            raise SystemExit(run["text"][-3000:])
        return {**result[0], "memory": run["memory"], "picture": measure.picture(self.out)}


def reference(renderer, args, name, program):
    """The converged picture; kept in a folder if there is one."""
    path = os.path.join(args.keep, f"{name}_{program}_{args.reference}.exr") if args.keep else None
    if path and os.path.exists(path):
        return measure.picture(path)
    image = renderer.render(args.reference, 1, threads=0, adaptive=False)["picture"]
    if path:
        measure.save(image, path)
    return image


def times_to(targets, low, high):
    """Seconds to the errors, from (seconds, error) of n and 4 n samples: error = bias + noise / n."""
    (t0, e0), (t1, e1) = low, high
    if (t1, e1) == (t0, e0):
        return [t0 * e0 / e for e in targets]
    noise = max(e0 - e1, 0) / .75
    bias, each = max(e0 - noise, 0), max(t1 - t0, 0) / 3
    passes = max(t0 - each, 0)
    return [passes + each * noise / (e - bias) if e > bias else None for e in targets]


def figures(renderer, args, image, method):
    """Medians of the turns of one method."""
    runs = [renderer.render(args.samples, 100 + k, method=method) for k in range(args.turns)]
    errors = [measure.error(r["picture"], image) for r in runs]
    median = {k: statistics.median(r[k] for r in runs) for k in ("seconds", "memory", "first", "start")}
    low = high = (median["seconds"], statistics.median(errors))
    if method != "path":
        more = renderer.render(4 * args.samples, 200, method=method, adaptive=False)
        high = (more["seconds"], measure.error(more["picture"], image))
    pictures = [r["picture"] for r in runs]
    mean = sum(p.mean() for p in pictures) / len(pictures) / image.mean() - 1
    blocks = measure.block_bias(pictures, image) if len(pictures) > 1 else float("nan")
    wall = renderer.render(args.samples, 300, threads=0, method=method)["wall"] if args.wall else 0
    return {**median, "error": low[1], "mean": mean, "blocks": blocks, "wall": wall,
            "to": times_to(TARGETS, low, high),
            "costs": [e * r["seconds"] for e, r in zip(errors, runs)]}


def text(f, ratio):
    to = [f"{t:.1f}" if t is not None else "never" for t in f["to"]]
    return (f"{f['error']:.4f} | {f['seconds']:.2f} | {100 * f['mean']:+.2f} % | "
            f"{100 * f['blocks']:.2f} % | {to[0]} | {to[1]} | {ratio} | {f['wall']:.2f} | "
            f"{f['memory']:.0f} | {f['first']:.2f} | {f['start']:.2f} |")


def compare(name, args, folder):
    oriel = Oriel(args, name, folder)
    cycles = Cycles(args, name, folder, oriel)
    images = [reference(oriel, args, name, "oriel"), reference(cycles, args, name, "cycles")]
    means, blocks = measure.difference(*images)
    print(f"{name}: Oriel / Cycles means {means:.4f}, blocks {blocks:.4f}", flush=True)
    if args.keep:
        measure.preview(images, os.path.join(args.keep, name + ".png"))
    if args.turns == 0:
        return
    theirs = figures(cycles, args, images[1], "path")
    print(f"| {name} | Cycles | " + text(theirs, "1"), flush=True)
    for method in args.methods.split(","):
        ours = figures(oriel, args, images[0], method)
        if method == "path":
            ratios = [c / o for c, o in zip(theirs["costs"], ours["costs"])]
            ratio = f"{statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})"
        else:
            pairs = zip(theirs["to"], ours["to"])
            ratio = ", ".join(f"{c / o:.2f}" if o else "none" for c, o in pairs)
        print(f"| {name} | {method} | " + text(ours, ratio), flush=True)


def parser_of(doc):
    """A parser with the arguments that the programs of this folder share."""
    parser = argparse.ArgumentParser(description=doc.splitlines()[0])
    parser.add_argument("--oriel", required=True)
    parser.add_argument("--probe", required=True, help="a latitude-longitude picture")
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    return parser


def parsed(parser):
    """Arguments with absolute paths and all scenes if none are given."""
    args = parser.parse_args()
    unknown = [s for s in args.scenes if s not in catalogue.ALL]
    if unknown:
        parser.error(f"unknown scenes {unknown}; there are {list(catalogue.SCENES)} and drawn_1 to drawn_999")
    args.oriel, args.probe = os.path.abspath(args.oriel), os.path.abspath(args.probe)
    args.scenes = args.scenes or list(catalogue.SCENES)
    return args


def main():
    parser = parser_of(__doc__)
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--reference", type=int, default=4096, help="samples of converged pictures")
    parser.add_argument("--turns", type=int, default=5, help="0: only the agreement")
    parser.add_argument("--methods", default="path", help="of Oriel, such as path,path+cache,fg")
    parser.add_argument("--adaptive", type=float, default=0,
                        help="noise threshold of adaptive sampling in both; --samples is the maximum")
    parser.add_argument("--wall", action="store_true", help="also time one run with all threads")
    parser.add_argument("--keep", help="folder for converged pictures, which are used again")
    args = parsed(parser)
    with tempfile.TemporaryDirectory() as folder:
        for name in args.scenes:
            compare(name, args, folder)


if __name__ == "__main__":
    main()
