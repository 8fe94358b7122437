#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How long a pass takes on many ranks, by the order in which rank 0 hands out tiles: a simulation.

    bench/farm_tiles.py build/release/bin/oriel [SCENE]

The cost of a tile is its rays in a picture of 240 x 160 pixels, which is rendered in as many parts as it has tiles. A
picture of 3840 x 2160 pixels has their costs in the order of the parts, interpolated, times a random factor. Printed is
the work of the pass divided by duration times processors; messages take 1 % of the mean time of a tile.
"""
import heapq
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
MEASURED = (240, 160, 150)  # pixels, tiles
TILES = 3840 * 2160 // 256
MESSAGE = 0.01
LARGEST = 256
# ranks, threads of each, tiles
CASES = ((8, 1, 600), (8, 32, TILES), (32, 32, TILES), (100, 32, TILES), (300, 32, TILES), (1000, 32, TILES))


def rays_of_tiles(program, scene):
    width, height, tiles = MEASURED
    with tempfile.TemporaryDirectory() as folder:
        render = [program, "render", scene, "-o", f"{folder}/a.exr", "--size", f"{width}x{height}", "--samples", "16",
                  "--json"]
        subprocess.run([*render, "--maps-only", folder], check=True, stdout=subprocess.DEVNULL)
        rays = []
        for k in range(1, tiles + 1):
            out = subprocess.run([*render, "--maps", folder, "--part", f"{k}/{tiles}"], check=True, text=True,
                                 stdout=subprocess.PIPE).stdout
            done = next(e for e in map(json.loads, out.splitlines()) if e["event"] == "done")
            rays.append(done["rays"] - done["rays_before"])
    return rays


def costs_of(rays, count):
    """Costs of `count` tiles with mean 1, in the order of the measured ones."""
    costs = []
    for i in range(count):
        at = min(max((i + 0.5) * len(rays) / count - 0.5, 0), len(rays) - 1.001)
        k, share = int(at), at % 1
        costs.append((rays[k] * (1 - share) + rays[k + 1] * share) * random.lognormvariate(0, 0.2))
    mean = sum(costs) / count
    return [c / mean for c in costs]


def simulate(costs, speeds, threads, divisor=8, overlap=True, by_cost=False, duplicates=False):
    """Efficiency of a pass. divisor: a portion is this share of the tiles that are left for each rank; overlap: threads
    go on with the next portion while others finish one; by_cost: costly tiles first, by the pass before; duplicates:
    ranks without tiles render those of others again, and the first answer counts."""
    ranks = len(speeds)
    queue = list(costs)
    if by_cost:
        queue.sort(key=lambda c: c * random.lognormvariate(0, 0.05))
    else:
        queue.reverse()
    free = [[0.0] * threads for _ in speeds]  # heaps: when each thread is free
    away, events, ends = [0] * ranks, [], []

    def give(rank, now):
        if not queue:
            return
        size = min(max(len(queue) // (divisor * ranks), min(threads, LARGEST)), LARGEST, len(queue))
        begin = now + MESSAGE if overlap else max(now + MESSAGE, *free[rank])
        free[rank] = [max(t, begin) for t in free[rank]]
        heapq.heapify(free[rank])
        last = 0
        for cost in [queue.pop() for _ in range(size)]:
            end = heapq.heappop(free[rank]) + cost / speeds[rank]
            heapq.heappush(free[rank], end)
            ends.append((end, cost))
            last = max(last, end)
        away[rank] += 1
        heapq.heappush(events, (last, rank))

    for most in (1, 2):
        for rank in range(ranks):
            if away[rank] < most:
                give(rank, 0)
    while events:
        now, rank = heapq.heappop(events)
        away[rank] -= 1
        while away[rank] < 2 and queue:
            give(rank, now)
    if duplicates:
        ends = with_duplicates(ends, free, speeds)
    return sum(costs) / (sum(speeds) * threads) / max(end for end, _ in ends)


def with_duplicates(ends, free, speeds):
    """The threads that are free first render the tiles that end last."""
    idle = [(time, rank) for rank, threads in enumerate(free) for time in threads]
    heapq.heapify(idle)
    result = sorted(ends)
    for i in range(len(result) - 1, -1, -1):
        end, cost = result[i]
        time, rank = heapq.heappop(idle)
        if time + MESSAGE >= end:
            break
        again = time + MESSAGE + cost / speeds[rank]
        heapq.heappush(idle, (again, rank))
        result[i] = (min(end, again), cost)
    return result


VARIANTS = {"halves, one portion after the other": {"divisor": 2, "overlap": False}, "eighths": {"overlap": False},
            "eighths, overlapping": {}, "and by cost": {"by_cost": True}, "and duplicates": {"duplicates": True},
            "both": {"by_cost": True, "duplicates": True}}


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    scene = sys.argv[2] if len(sys.argv) > 2 else ROOT / "scenes/interior/interior.mi"
    rays = rays_of_tiles(os.path.abspath(sys.argv[1]), os.path.abspath(scene))
    print(f"{len(rays)} tiles: the costliest has {max(rays) * len(rays) / sum(rays):.2f} of the mean rays")
    for note, slow in (("speeds differ by 10 %", 1), ("and one rank of 50 has half of its speed", 0.5)):
        print(f"\n{note}\nranks x threads, tiles  " + "  ".join(VARIANTS))
        for ranks, threads, tiles in CASES:
            random.seed(1)
            costs = costs_of(rays, tiles)
            speeds = [random.uniform(0.9, 1.1) * (slow if k % 50 == 0 else 1) for k in range(ranks)]
            values = [simulate(costs, speeds, threads, **v) for v in VARIANTS.values()]
            print(f"{ranks} x {threads}, {tiles}".ljust(24)
                  + "  ".join(f"{v:.3f}".rjust(len(name)) for v, name in zip(values, VARIANTS)))


if __name__ == "__main__":
    sys.stdout.reconfigure(line_buffering=True)
    main()
