#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Light through glass whose colour is within: an exponential. Writes the SVG of its argument."""
import sys

from diagram import INK, arrow, light_through_glass, line, text

fall = [(220 + 280 * k / 40, .5 ** (2 * k / 40)) for k in range(41)]
light_through_glass(
    sys.argv[1], [(40, 1), *fall, (690, .25)],
    [line([(360, 340), (360, 280), (40, 280)], "#9ab", 1, 'stroke-dasharray="4 4"'),
     arrow((290, 358), (221, 358)), arrow((290, 358), (359, 358)),
     text(290, 354, "d"), text(372, 268, "after d: refr_falloff_color", anchor="start"),
     text(512, 302, "after 2 d: its square", anchor="start", colour=INK)])
