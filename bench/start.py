#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures the start of a render: time to the first complete pass, processor time and peak memory.

    bench/start.py build/release/bin/oriel [RUNS]

Scenes: the interior at 1/8 of its resolution, an empty scene (camera and options), and generated
scenes with textures, with displacement and with a model. Each runs once before it is measured, so
that the system has its files in memory. The table contains medians.
"""

import json
import os
import statistics
import struct
import subprocess
import sys
import tempfile
import time
import zlib

EMPTY = """
options "o"
  trace on
  samples 0 1
end options
camera "c"
  output "rgba_fp" "exr" "out.exr"
  focal 1
  aperture 1
  aspect 1.5
  resolution 150 100
end camera
instance "ci" "c"
  transform 1 0 0 0  0 1 0 0  0 0 1 0  0 0 -4 1
end instance
"""
LIGHT = """
light "l" "mib_light_point" ( "color" 1 1 1 )
  origin 0 0 3
end light
instance "li" "l" end instance
"""
FILES = 200  # textures
OBJECTS = 16  # displaced


def png(path, side, seed):
    """Writes noise, which does not compress."""
    rows, state = [], seed + 1
    for _ in range(side):
        row = bytearray(b"\0")
        for _ in range(3 * side):
            state = (state * 1103515245 + 12345) & 0x7FFFFFFF
            row.append(state >> 16 & 255)
        rows.append(bytes(row))

    def chunk(name, data):
        return (struct.pack(">I", len(data)) + name + data
                + struct.pack(">I", zlib.crc32(name + data)))

    with open(path, "wb") as f:
        f.write(b"\x89PNG\r\n\x1a\n"
                + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0))
                + chunk(b"IDAT", zlib.compress(b"".join(rows), 1)) + chunk(b"IEND", b""))


def square(name, material, x, y, half, displaced=False):
    approximate = "approximate displace parametric 6" if displaced else ""
    return f"""
object "{name}"
  visible trace shadow on
  group
    {-half} {-half} 0  {half} {-half} 0  {half} {half} 0  {-half} {half} 0
    0 0 0  1 0 0  1 1 0  0 1 0
    v 0 t 4  v 1 t 5  v 2 t 6  v 3 t 7
    p "{material}" 0 1 2 3
    {approximate}
  end group
end object
instance "{name}_i" "{name}"
  transform 1 0 0 0  0 1 0 0  0 0 1 0  {-x} {-y} 0 1
end instance
"""


def textures(folder):
    text, names = "", []
    side = 15
    for i in range(FILES):
        png(f"{folder}/t{i}.png", 128, i)
        text += f"""
color texture "t{i}" "t{i}.png"
shader "uv{i}" "mib_texture_vector" ( "select" 0 )
shader "look{i}" "mib_texture_lookup" ( "tex" "t{i}", "coord" = "uv{i}" )
material "m{i}" "mib_illum_lambert" ( "diffuse" = "look{i}" ) end material
"""
        text += square(f"s{i}", f"m{i}", (i % side - 7) * .28, (i // side - 6.5) * .2, .09)
        names.append(f'"s{i}_i"')
    return text, names


def displacement(folder):
    del folder
    text = """
shader "uv" "mib_texture_vector" ( "select" 0 )
material "m" "mib_illum_lambert" ( )
  displace "mib_texture_turbulence" ( "coord" = "uv" )
end material
"""
    names = []
    for i in range(OBJECTS):
        text += square(f"s{i}", "m", (i % 4 - 1.5), (i // 4 - 1.5) * .7, .3, displaced=True)
        names.append(f'"s{i}_i"')
    return text, names


def model(folder):
    """A glTF sheet of 20,000 triangles."""
    n = 101
    points = b"".join(struct.pack("<fff", 3 * x / (n - 1) - 1.5, 2 * y / (n - 1) - 1,
                                  .1 * ((x * y) % 7) / 7) for y in range(n) for x in range(n))
    corners = []
    for y in range(n - 1):
        for x in range(n - 1):
            a = y * n + x
            corners += [a, a + 1, a + n + 1, a, a + n + 1, a + n]
    indices = struct.pack(f"<{len(corners)}I", *corners)
    header = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
              "nodes": [{"mesh": 0}],
              "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
              "accessors": [
                  {"bufferView": 0, "componentType": 5126, "count": n * n, "type": "VEC3",
                   "min": [-1.5, -1, 0], "max": [1.5, 1, .1]},
                  {"bufferView": 1, "componentType": 5125, "count": len(corners),
                   "type": "SCALAR"}],
              "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(points)},
                              {"buffer": 0, "byteOffset": len(points),
                               "byteLength": len(indices)}],
              "buffers": [{"byteLength": len(points) + len(indices)}]}
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 4)
    body = points + indices
    with open(f"{folder}/model.glb", "wb") as f:
        f.write(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(body))
                + struct.pack("<II", len(text), 0x4E4F534A) + text
                + struct.pack("<II", len(body), 0x004E4942) + body)


def write(folder, name, text, names):
    path = f"{folder}/{name}.mi"
    light, lit = (LIGHT, '"li"') if names else ("", "")
    with open(path, "w", encoding="ascii") as f:
        f.write("$include <base.mi>\n" + EMPTY + light + text
                + f'\ninstgroup "w" "ci" {lit} {" ".join(names)} end instgroup\n'
                + 'render "w" "ci" "o"\n')
    return path


def run(command):
    """Seconds to the first pass and to the end, processor seconds, peak in MB."""
    start = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    first = None
    for line in process.stdout:
        event = json.loads(line)
        if first is None and event.get("event") == "progress" and event.get("pass", 0) >= 1:
            first = time.monotonic() - start
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0 or first is None:
        sys.exit(f"failed: {' '.join(command)}")
    # Linux: kB. The peak of a child begins with that of this process, about 10 MB.
    return (first, time.monotonic() - start, usage.ru_utime + usage.ru_stime,
            usage.ru_maxrss / 1000)


def main():
    program = os.path.abspath(sys.argv[1])
    runs = int(sys.argv[2]) if len(sys.argv) > 2 else 7
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    with tempfile.TemporaryDirectory() as folder:
        model(folder)
        subprocess.run([program, "convert", f"{folder}/model.glb", f"{folder}/converted.mi"],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        scenes = [("interior, 150 x 100", f"{root}/scenes/interior/interior.mi", ["--size", "150x100"]),
                  ("empty", write(folder, "empty", "", []), []),
                  (f"{FILES} textures", write(folder, "textures", *textures(folder)), []),
                  (f"{OBJECTS} displaced objects",
                   write(folder, "displacement", *displacement(folder)), []),
                  ("model", f"{folder}/model.glb", ["--size", "150x100"])]
        print("| scene | first pass | end | processor time | peak |\n|---|---|---|---|---|")
        for name, scene, options in scenes:
            command = [program, "render", scene, "--samples", "1", "--json",
                       "-o", f"{folder}/a.exr", *options]
            run(command)
            first, end, cpu, peak = (statistics.median(values)
                                     for values in zip(*(run(command) for _ in range(runs))))
            print(f"| {name} | {first:.3f} s | {end:.3f} s | {cpu:.3f} s | {peak:.0f} MB |",
                  flush=True)


if __name__ == "__main__":
    main()
