# SPDX-License-Identifier: Apache-2.0
"""Pieces of the diagrams of this folder: SVG text."""
import pathlib

INK, RAY, GLASS = "#333", "#e07b1f", "#cfe3f7"


def line(points, colour=INK, width=2, more=""):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return (f'<polyline points="{path}" fill="none" stroke="{colour}" '
            f'stroke-width="{width}" {more}/>')


def text(x, y, words, size=15, anchor="middle", colour=INK):
    return (f'<text x="{x}" y="{y}" font-family="DejaVu Sans, sans-serif" font-size="{size}" '
            f'text-anchor="{anchor}" fill="{colour}">{words}</text>')


def arrow(a, b, colour=INK, width=2):
    """A line with a head at b."""
    length = ((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) ** .5
    u, v = (b[0] - a[0]) / length, (b[1] - a[1]) / length
    wings = [(b[0] - 11 * u + s * 5 * v, b[1] - 11 * v - s * 5 * u) for s in (1, -1)]
    head = " ".join(f"{x:.1f},{y:.1f}" for x, y in (b, *wings))
    return (line([a, (b[0] - 8 * u, b[1] - 8 * v)], colour, width)
            + f'<polygon points="{head}" fill="{colour}"/>')


def save(path, width, height, parts):
    pathlib.Path(path).write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
        f'width="{width}" height="{height}">\n'
        f'<rect width="{width}" height="{height}" fill="white"/>\n'
        + "\n".join(parts) + "\n</svg>\n", encoding="utf-8")


def light_through_glass(path, levels, notes):
    """A block of glass with a ray above, and below it the light that is left along the way."""
    block = f'<rect x="220" y="40" width="280" height="130" fill="{GLASS}" stroke="#7d9dc0"/>'
    parts = [block, text(360, 62, "glass"), text(110, 62, "air"), text(610, 62, "air"),
             arrow((40, 84), (220, 104), RAY, 3), line([(220, 104), (500, 124)], RAY, 3),
             arrow((500, 124), (690, 145), RAY, 3),
             line([(40, 210), (40, 340), (690, 340)]), text(30, 225, "1", anchor="end"),
             text(30, 344, "0", anchor="end"), text(365, 385, "way of the light"),
             text(56, 204, "light that is left", anchor="start")]
    parts += [line([(x, 170), (x, 340)], "#9ab", 1, 'stroke-dasharray="4 4"') for x in (220, 500)]
    parts.append(line([(x, 340 - 120 * level) for x, level in levels], "#2a62b8", 3))
    save(path, 730, 400, parts + notes)
