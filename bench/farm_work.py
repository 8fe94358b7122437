#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Work of parts and of MPI ranks, by counts and processor time, which do not depend on the load.

    bench/farm_work.py SCENE [--oriel PROGRAM] [--parts N] [--ranks 1,2,4,8] [-- RENDER OPTIONS]

Parts: rays of the costliest part, relative to the mean of all parts.
Ranks: processor time of samples with one rank, and the share of all processor time that samples take.
"""
import argparse
import json
import os
import pathlib
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
        for ranks in [int(r) for r in a.ranks.split(",") if r]:
            if ranks == 1:
                continue
            lines = run(["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", str(ranks),
                         *render, "--threads", "1"])
            work = event(lines, "ranks")
            print(f"{ranks} ranks: {work['cpu_seconds']:.1f} s of processor time, "
                  f"{work['useful_cpu_seconds'] / work['cpu_seconds']:.4f} of it for samples, "
                  f"{max(work['memory']) / 1e6:.0f} MB in the largest rank", flush=True)


if __name__ == "__main__":
    main()
