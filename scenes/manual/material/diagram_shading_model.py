#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the parts of the shading model as SVG to the path given."""
import sys

ROWS = [("Direct light", "#e8b04a"), ("Indirect light", "#8fb4d9"), ("Traced rays", "#9aa5b1")]
PARTS = [("Diffuse", "diffuse, diffuse_roughness", "#d98a5b"),
         ("Reflection", "reflectivity, refl_gloss, anisotropy", "#6c8ebf"),
         ("Refraction", "transparency, refr_gloss, refr_ior", "#5aa68f")]
EFFECTS = [("diffuse light", 0, (0, 1)), ("highlights", 1, (0,)), ("mirrored things", 1, (2,)),
           ("translucency", 2, (0, 1)), ("clear view", 2, (2,))]
WIDE, HIGH = 760, 330


def box(x, y, wide, high, fill, title, note=""):
    words = (f'<rect x="{x}" y="{y}" width="{wide}" height="{high}" rx="7" fill="{fill}"/>'
             f'<text x="{x + wide / 2}" y="{y + high / 2 + (-3 if note else 5)}" font-size="15" '
             f'font-weight="600">{title}</text>')
    return words + (f'<text x="{x + wide / 2}" y="{y + high / 2 + 15}" font-size="11">{note}</text>'
                    if note else "")


def curve(x0, y0, x1, y1, colour):
    middle = (x0 + x1) / 2
    return (f'<path d="M{x0} {y0} C{middle} {y0} {middle} {y1} {x1} {y1}" fill="none" '
            f'stroke="{colour}" stroke-width="3" opacity=".75"/>')


def drawing():
    parts = []
    for name, part, sources in EFFECTS:
        y = 43 + 60 * EFFECTS.index((name, part, sources))
        parts += [curve(150, 65 + 100 * n, 290, y, ROWS[n][1]) for n in sources]
        parts.append(curve(450, y, 520, 65 + 100 * part, PARTS[part][2]))
        parts.append(box(290, y - 18, 160, 36, "#f2eee6", name))
    parts += [box(10, 40 + 100 * n, 140, 50, fill, name) for n, (name, fill) in enumerate(ROWS)]
    parts += [box(520, 35 + 100 * n, 230, 60, fill, name, note)
              for n, (name, note, fill) in enumerate(PARTS)]
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDE} {HIGH}" width="{WIDE}" '
            f'font-family="sans-serif" text-anchor="middle" fill="#2b2b2b">'
            f'<rect width="{WIDE}" height="{HIGH}" fill="#fff"/>' + "".join(parts) + "</svg>\n")


if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="utf-8") as out:
        out.write(drawing())
