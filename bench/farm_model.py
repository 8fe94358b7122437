#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Work of a still in parts, the model of its cost, and what the model says about larger clusters.

    bench/farm_model.py build/release/bin/oriel [SCENE] [WxH] [SAMPLES]

Processor times are compared, not wall-clock times, so that other processes do not matter much. The sum for N parts
is fitted to work + N * start from 1, 2 and 4 parts; the sum for 8 parts tests the model.
"""
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PARTS = (1, 2, 4, 8)

# Assumptions of the estimate, which this machine cannot measure.
CORES = 32  # of a node
LAUNCH = 5.0  # seconds from the release of an array to its last task, plus the merge job
SHARED_BANDWIDTH = 5e9  # bytes/s of the shared file system, all nodes together
NODE_SPREAD = 1.1  # slowest node relative to the mean
ESTIMATE_PIXELS = 3840 * 2160
ESTIMATE_SAMPLES = 4096
SCENE_BYTES = 2e9


def cpu_of(words):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(w) for w in words], check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def fit(counts, sums):
    """work and start of sums = work + counts * start, least squares."""
    n, mean_x, mean_y = len(counts), sum(counts) / len(counts), sum(sums) / len(sums)
    slope = sum((x - mean_x) * (y - mean_y) for x, y in zip(counts, sums)) / sum((x - mean_x) ** 2 for x in counts)
    return mean_y - slope * mean_x, slope


def measure(program, scene, size, samples, folder):
    options = ["--size", size, "--samples", samples, "-q"]
    sums, tails = {}, {}
    for count in PARTS:
        name = f"{folder}/{count}"
        times = [cpu_of([program, "render", scene, "-o", f"{name}.exr", *options, "--part", f"{k}/{count}"])
                 for k in range(1, count + 1)]
        sums[count] = sum(times)
        tails[count] = max(times) / (sum(times) / count)
        parts = [f"{name}.part-{k}-of-{count}" for k in range(1, count + 1)]
        size_of_parts = sum(os.path.getsize(p) for p in parts)
        merge = cpu_of([program, "merge", *parts, "-o", f"{name}.exr"])
        print(f"{count} parts: {sums[count]:.2f} s of processor time, slowest part {tails[count]:.2f} times the mean; "
              f"merge {merge:.2f} s for {size_of_parts / 1e6:.1f} MB")
    with open(f"{folder}/1.exr", "rb") as one, open(f"{folder}/8.exr", "rb") as eight:
        assert one.read() == eight.read(), "pictures differ"
    return sums, tails[8], size_of_parts / merge, size_of_parts


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    program = os.path.abspath(sys.argv[1])
    scene = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else ROOT / "scenes/interior/interior.mi")
    size = sys.argv[3] if len(sys.argv) > 3 else "480x320"
    samples = int(sys.argv[4]) if len(sys.argv) > 4 else 64
    with tempfile.TemporaryDirectory() as folder:
        sums, tail, bandwidth, part_bytes = measure(program, scene, size, samples, folder)
    work, start = fit(PARTS[:3], [sums[n] for n in PARTS[:3]])
    predicted = work + 8 * start
    print(f"model: work {work:.2f} s, start {start:.2f} s for each part; 8 parts: predicted {predicted:.2f} s, "
          f"measured {sums[8]:.2f} s ({100 * (sums[8] / predicted - 1):+.1f} %)")
    print(f"useful share of the processor time at 8 parts: {work / sums[8]:.3f}")
    width, height = (int(n) for n in size.split("x"))
    rate = width * height * samples / work
    print(f"{rate / 1e6:.3f} million samples/s for each core; merge {bandwidth / 1e6:.0f} MB/s")
    estimate(rate, start, tail, bandwidth, part_bytes / (width * height))


def estimate(rate, start, tail, bandwidth, bytes_per_pixel):
    whole = ESTIMATE_PIXELS * ESTIMATE_SAMPLES / (rate * CORES)
    merge = ESTIMATE_PIXELS * bytes_per_pixel / bandwidth
    print(f"\nestimate: {ESTIMATE_PIXELS} pixels, {ESTIMATE_SAMPLES} samples, {CORES} cores a node, "
          f"scene {SCENE_BYTES / 1e9:.0f} GB, launch {LAUNCH:.0f} s")
    print("nodes  load    render    merge   total     efficiency")
    for nodes in (1, 10, 100, 1000):
        load = start + nodes * SCENE_BYTES / SHARED_BANDWIDTH
        slowest = whole / nodes * (max(tail, NODE_SPREAD) if nodes > 1 else 1)
        total = LAUNCH + load + slowest + merge
        print(f"{nodes:5}  {load:6.1f}  {slowest:8.1f}  {merge:6.1f}  {total:8.1f}  {whole / (nodes * total):8.3f}")


if __name__ == "__main__":
    main()
