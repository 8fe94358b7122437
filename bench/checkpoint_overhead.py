#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what checkpoints cost: the time of one write, and the processor time of asking for it.

    bench/checkpoint_overhead.py build/release/bin/oriel [SCENE] [WxH]
"""

import json
import os
import resource
import subprocess
import sys
import tempfile

INTERVAL = 300  # the default of --checkpoint, seconds
ROUNDS = 5


def main():
    program = os.path.abspath(sys.argv[1])
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    scene = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else f"{root}/scenes/daylight.mi")
    size = sys.argv[3] if len(sys.argv) > 3 else "1920x1080"

    def render(folder, *options):
        words = [program, "render", scene, "-o", f"{folder}/a.exr", "--json", *options]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        out = subprocess.run(words, check=True, capture_output=True, text=True).stdout
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return [json.loads(line) for line in out.splitlines()], cpu

    with tempfile.TemporaryDirectory(dir=".") as folder:
        file = f"{folder}/a.chk"
        events, _ = render(folder, "--size", size, "--time", "15", "--checkpoint",
                           f"{file},every 2")
        writes = sorted(e["seconds"] for e in events if e["event"] == "checkpoint")
        size_mb = os.path.getsize(file) / 1e6
        os.remove(file)
        print(f"{size}: {size_mb:.0f} MB, written in {writes[len(writes) // 2]:.3f} s "
              f"(median of {len(writes)}, longest {writes[-1]:.3f} s): "
              f"{100 * writes[len(writes) // 2] / INTERVAL:.3f} % of {INTERVAL} s")
        small = ["--size", "240x160", "--samples", "64", "--threads", "1"]
        plain, asked = [], []
        for _ in range(ROUNDS):
            plain.append(render(folder, *small)[1])
            asked.append(render(folder, *small, "--checkpoint", file)[1])
        print(f"processor time without {min(plain):.2f} s, with {min(asked):.2f} s "
              f"(shortest of {ROUNDS}): {100 * (min(asked) / min(plain) - 1):+.2f} %")


if __name__ == "__main__":
    main()
