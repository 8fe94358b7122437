#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Work of a still in parts, the model of its cost, and what the model says about larger clusters.

    bench/farm_model.py build/release/bin/oriel [SCENE] [WxH] [SAMPLES]

Rays and processor times are compared, not wall-clock times, so that other processes do not matter much. The sum of
the times of N parts is fitted to work + N * start from 1, 2 and 4 parts; the sum for 8 parts tests the model.
Maps and what paths learn are computed once, before the parts (--maps-only), and their time is not part of the sums.
"""
import json
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


def work_of(words):
    """Processor seconds and rays of a command."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    out = subprocess.run([str(w) for w in words], check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                         text=True).stdout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    events = [json.loads(line) for line in out.splitlines() if line.startswith("{")]
    rays = sum(e.get("rays", 0) for e in events if e["event"] == "done")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, rays


def fit(counts, sums):
    """work and start of sums = work + counts * start, least squares."""
    n, mean_x, mean_y = len(counts), sum(counts) / len(counts), sum(sums) / len(sums)
    slope = sum((x - mean_x) * (y - mean_y) for x, y in zip(counts, sums)) / sum((x - mean_x) ** 2 for x in counts)
    return mean_y - slope * mean_x, slope


def measure(program, scene, size, samples, folder):
    options = ["--size", size, "--samples", samples, "--even-samples", "--json",
               "--threads", 1]  # idle threads use processor time
    sums, rays, tails = {}, {}, {}
    maps = ["--maps", f"{folder}/maps"]
    maps_time, maps_rays = work_of([program, "render", scene, "-o", f"{folder}/0.exr", *options,
                                    "--maps-only", f"{folder}/maps"])
    bytes_of_maps = sum(f.stat().st_size for f in pathlib.Path(folder, "maps").iterdir())
    print(f"maps, once: {maps_time:.2f} s of processor time, {maps_rays} rays, {bytes_of_maps / 1e6:.1f} MB")
    for count in PARTS:
        name = f"{folder}/{count}"
        works = [work_of([program, "render", scene, "-o", f"{name}.exr", *options, *maps,
                          "--part", f"{k}/{count}"])
                 for k in range(1, count + 1)]
        sums[count] = sum(time for time, _ in works)
        own = [r - maps_rays for _, r in works]  # each counts those of the maps
        rays[count] = sum(own)
        tails[count] = max(own) * count / max(rays[count], 1)
        parts = [f"{name}.part-{k}-of-{count}" for k in range(1, count + 1)]
        bytes_of_parts = sum(os.path.getsize(p) for p in parts)
        merge, _ = work_of([program, "merge", *parts, "-o", f"{name}.exr", "-q"])
        print(f"{count} parts: {sums[count]:.2f} s of processor time, {rays[count]} rays, slowest part "
              f"{tails[count]:.3f} times the mean in rays; merge {merge:.2f} s for {bytes_of_parts / 1e6:.1f} MB")
    with open(f"{folder}/1.exr", "rb") as one, open(f"{folder}/8.exr", "rb") as eight:
        assert one.read() == eight.read(), "pictures differ"
    print(f"rays of 8 parts relative to one: {rays[8] / max(rays[1], 1):.6f}")
    return sums, maps_time, tails[8], bytes_of_parts / merge, bytes_of_parts


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    program = os.path.abspath(sys.argv[1])
    scene = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else ROOT / "scenes/interior/interior.mi")
    size = sys.argv[3] if len(sys.argv) > 3 else "480x320"
    samples = int(sys.argv[4]) if len(sys.argv) > 4 else 64
    with tempfile.TemporaryDirectory() as folder:
        sums, maps, tail, bandwidth, part_bytes = measure(program, scene, size, samples, folder)
    work, start = fit(PARTS[:3], [sums[n] for n in PARTS[:3]])
    predicted = work + 8 * start
    print(f"model: work {work:.2f} s, start {start:.2f} s for each part; 8 parts: predicted {predicted:.2f} s, "
          f"measured {sums[8]:.2f} s ({100 * (sums[8] / predicted - 1):+.1f} %)")
    print(f"useful share of the processor time at 8 parts: {work / (sums[8] + maps):.3f}")
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
    sys.stdout.reconfigure(line_buffering=True)
    main()
