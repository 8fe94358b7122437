#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cost of decoding textures in confined processes: a floor of 200 pictures, with and without.

    bench/isolated_readers.py build/release/bin/oriel [ROUNDS]

Prints the ratio of wall-clock and processor times of whole renders of one sample per pixel, in
which every picture is read, and of a program that reads no picture, for its start. Requires
oiiotool (Debian's openimageio-tools).
"""

import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time

COUNT, SIDE = 200, 1024


def write_scene(folder):
    """One square per picture; the camera sees all of them."""
    for i in range(COUNT):
        # A gradient with noise of another seed, as JPEG files of photographs have.
        subprocess.run(["oiiotool", "--pattern",
                        f"fill:topleft=.{i % 9 + 1},.2,.3:bottomright=.5,.{i % 7 + 2},.8",
                        f"{SIDE}x{SIDE}", "3", "--noise:type=gaussian:stddev=.05:"
                        f"seed={i}", "-d", "uint8", "-o", f"{folder}/{i}.jpg"], check=True)
    lines = ["verbose on", "$include <base.mi>", "$include <architectural.mi>",
             'options "opt" samples 0 0 trace depth 2 2 2 end options']
    members = []
    for i in range(COUNT):
        x, z = i % 20, i // 20
        lines += [f'color texture "t{i}" "{i}.jpg"',
                  f'shader "uv{i}" "mib_texture_vector" ( "select" 0, "selspace" 0 )',
                  f'shader "look{i}" "mib_texture_lookup" ( "tex" "t{i}", "coord" = "uv{i}" )',
                  f'material "m{i}" opaque "mib_illum_lambert" ( "ambience" 1 1 1, '
                  f'"ambient" = "look{i}" ) end material',
                  f'object "o{i}" visible tag {i + 1} group',
                  f'{x} {-z} 0 {x + 1} {-z} 0 {x + 1} {1 - z} 0 {x} {1 - z} 0',
                  '0 0 0 1 0 0 1 1 0 0 1 0',
                  'v 0 t 4 v 1 t 5 v 2 t 6 v 3 t 7', f'p "m{i}" 0 1 2 3 end group end object',
                  f'instance "i{i}" "o{i}" material "m{i}" end instance']
        members.append(f'"i{i}"')
    lines += ['camera "cam" output "rgb" "exr" "out.exr" focal 1 aperture 1 aspect 2',
              'resolution 640 320 end camera',
              'instance "ci" "cam" transform 1 0 0 0 0 1 0 0 0 0 1 0 -10 4 -21 1 end instance',
              f'instgroup "root" "ci" {" ".join(members)} end instgroup', 'render "root" "ci" "opt"']
    with open(f"{folder}/scene.mi", "w", encoding="ascii") as f:
        f.write("\n".join(lines) + "\n")


def timed(command):
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    wall = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    program = os.path.abspath(sys.argv[1])
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 7
    with tempfile.TemporaryDirectory() as folder:
        write_scene(folder)
        plain = [program, "render", f"{folder}/scene.mi", "-q", "-o", f"{folder}/a.exr",
                 "--samples", "1"]
        apart = [*plain[:-3], f"{folder}/b.exr", "--samples", "1", "--isolate-readers"]
        timed(plain)
        times = [(timed(plain), timed(apart)) for _ in range(rounds)]
        same = open(f"{folder}/a.exr", "rb").read() == open(f"{folder}/b.exr", "rb").read()
    for k, what in enumerate(("wall-clock", "processor")):
        ratios = sorted(b[k] / a[k] for a, b in times)
        print(f"{what}: without {statistics.median(a[k] for a, b in times):.2f} s, "
              f"ratio {statistics.median(ratios):.3f} ({ratios[0]:.3f} to {ratios[-1]:.3f})")
    print("same bytes" if same else "the pictures differ")


if __name__ == "__main__":
    main()
