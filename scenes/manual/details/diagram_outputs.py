#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""How the outputs of the extended material make its result. Writes the SVG of its argument."""
import pathlib
import sys

FONT = 'font-family="DejaVu Sans, sans-serif"'
ROWS = [("diffuse", "#3f7fbf"), ("spec", "#c58b1b"), ("refl", "#7a4fb0"), ("refr", "#2b9a8b"),
        ("tran", "#4f9a3a")]


def box(x, y, words, colour, width=150):
    return (f'<rect x="{x}" y="{y}" width="{width}" height="32" rx="6" fill="{colour}" '
            f'fill-opacity=".16" stroke="{colour}"/>'
            f'<text x="{x + width / 2}" y="{y + 21}" {FONT} font-size="14" text-anchor="middle" '
            f'fill="#222">{words}</text>')


def sign(x, y, words):
    return (f'<text x="{x}" y="{y}" {FONT} font-size="20" text-anchor="middle" '
            f'fill="#222">{words}</text>')


def to_sum(y):
    return (f'<path d="M 650 {y + 16} H 690 V 255 H 712" fill="none" stroke="#888" '
            f'stroke-width="1.5"/>')


parts = []
for n, (name, colour) in enumerate(ROWS):
    y = 20 + 50 * n
    parts += [box(20, y, f"{name}_raw", colour), sign(195, y + 23, "×"),
              box(220, y, f"{name}_level", colour), sign(435, y + 23, "="),
              box(500, y, f"{name}_result", colour), to_sum(y)]
y, grey = 280, "#777777"
parts += [box(20, y, "indirect_raw", grey), sign(195, y + 23, "×"), box(220, y, "ao_raw", grey),
          sign(435, y + 23, "="), box(500, y, "indirect_post_ao", grey),
          box(20, y + 50, "indirect_post_ao", grey), sign(195, y + 73, "×"),
          box(220, y + 50, "diffuse_level", "#3f7fbf"), sign(435, y + 73, "="),
          box(500, y + 50, "indirect_result", grey), to_sum(y + 50),
          box(500, y + 100, "add_result", "#b04a4a"), to_sum(y + 100),
          box(20, y + 150, "opacity_raw", "#8a6d3b"), sign(195, y + 173, "×"),
          box(220, y + 150, "1 - opacity", "#8a6d3b"), sign(435, y + 173, "="),
          box(500, y + 150, "opacity_result", "#8a6d3b"), to_sum(y + 150),
          '<circle cx="726" cy="255" r="14" fill="white" stroke="#888"/>', sign(726, 262, "+"),
          '<path d="M 740 255 H 760" stroke="#888" stroke-width="1.5"/>',
          box(760, 239, "result", "#222222", 100)]
pathlib.Path(sys.argv[1]).write_text(
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 880 480" width="880" height="480">\n'
    '<rect width="880" height="480" fill="white"/>\n' + "\n".join(parts) + "\n</svg>\n",
    encoding="utf-8")
