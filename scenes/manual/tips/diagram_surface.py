#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Light through glass coloured at its surfaces: two steps. Writes the SVG of its argument."""
import sys

from diagram import light_through_glass, text

light_through_glass(
    sys.argv[1], [(40, 1), (220, 1), (220, .6), (500, .6), (500, .36), (690, .36)],
    [text(232, 222, "× refr_color", anchor="start"),
     text(512, 290, "× refr_color", anchor="start")])
