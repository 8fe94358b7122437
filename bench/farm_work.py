#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Work of parts and of MPI ranks, by counts and processor time, which do not depend on the load.

    bench/farm_work.py SCENE [--oriel PROGRAM] [--parts N] [--ranks 1,2,4,8] [-- RENDER OPTIONS]

Parts: rays of the costliest part, relative to the mean of all parts; with --even-samples, of all samples.
Ranks: processor time, its share of samples and of the start of the ranks (scene, MPI, maps), and the work of one
process relative to it; memory of the ranks.
"""
import argparse
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile


def run(command):
    environment = dict(os.environ, OMPI_MCA_btl_vader_single_copy_mechanism="none",
                       OMPI_MCA_mpi_yield_when_idle="1")
    result = subprocess.run(command, stdout=subprocess.PIPE, text=True, env=environment, check=True)
    return [json.loads(line) for line in result.stdout.splitlines() if line.startswith("{")]


def event(lines, name):
    return next(line for line in lines if line.get("event") == name)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--oriel", default="build/release/bin/oriel")
    parser.add_argument("--parts", type=int, default=7)
    parser.add_argument("--ranks", default="1,2,4,8")
    end = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    a, options = parser.parse_args(sys.argv[1:end]), sys.argv[end + 1:]
    with tempfile.TemporaryDirectory() as folder:
        render = [a.oriel, "render", str(a.scene), "-o", folder + "/a.exr", "--json", *options]
        if a.parts > 0:
            rays = [event(run([*render, "--part", f"{k}/{a.parts}"]), "done")["rays"]
                    for k in range(1, a.parts + 1)]
            print(f"{a.parts} parts: the costliest has {max(rays) * a.parts / sum(rays):.4f} "
                  f"of the mean rays, the cheapest {min(rays) * a.parts / sum(rays):.4f}", flush=True)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        run([*render, "--threads", "1"])
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        alone = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        print(f"1 process: {alone:.1f} s of processor time, {after.ru_maxrss / 1e3:.0f} MB", flush=True)
        for ranks in [int(r) for r in a.ranks.split(",") if r]:
            if ranks == 1:
                continue
            lines = run(["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", str(ranks),
                         *render, "--threads", "1"])
            work = event(lines, "ranks")
            total, start = work["cpu_seconds"], work["start_cpu_seconds"]
            memory = [m / 1e6 for m in work["memory"]]
            print(f"{ranks} ranks: {total:.1f} s of processor time, {work['useful_cpu_seconds'] / total:.4f} of it "
                  f"for samples, {start / total:.4f} to start; efficiency {alone / total:.4f}; {memory[0]:.0f} MB in "
                  f"rank 0, {min(memory[1:]):.0f} to {max(memory[1:]):.0f} MB in the others", flush=True)


if __name__ == "__main__":
    main()
