#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A glass with a liquid in it and its three kinds of surface. Writes the SVG of its argument."""
import sys

from diagram import arrow, line, save, text

BLUE, GREEN, RED = "#2a62c8", "#2d9a4b", "#cc3328"
outside = [(236, 40), (222, 110), (222, 190), (250, 262), (316, 300), (316, 396), (240, 418),
           (240, 430), (440, 430), (440, 418), (364, 396), (364, 300), (430, 262), (458, 190),
           (458, 110), (444, 40)]
inside_left = [(248, 40), (236, 110)]
wet = [(235, 140), (235, 188), (262, 252), (300, 276), (340, 282), (380, 276), (418, 252),
       (445, 188), (445, 140)]
body = " ".join(f"{x},{y}" for x, y in wet)
parts = [f'<polygon points="{body}" fill="#f6dfe0"/>',
         line([(236, 40), (248, 40), (236, 110), (235, 140)], BLUE, 4),
         line([(444, 40), (432, 40), (444, 110), (445, 140)], BLUE, 4),
         line(outside, BLUE, 4), line(wet, RED, 4), line([(235, 140), (445, 140)], GREEN, 4),
         arrow((222, 170), (186, 170), BLUE), arrow((241, 84), (277, 84), BLUE),
         arrow((340, 140), (340, 104), GREEN), arrow((340, 282), (340, 318), RED),
         arrow((435, 214), (474, 232), RED),
         text(340, 215, "liquid"), text(340, 70, "air"), text(130, 290, "air"),
         text(500, 60, "air - glass", 17, "start", BLUE),
         text(500, 82, "refr_ior 1.5 / 1 = 1.5", 14, "start", BLUE),
         text(500, 140, "air - liquid", 17, "start", GREEN),
         text(500, 162, "refr_ior 1.33 / 1 = 1.33", 14, "start", GREEN),
         text(500, 232, "glass - liquid", 17, "start", RED),
         text(500, 254, "refr_ior 1.33 / 1.5 = 0.89", 14, "start", RED),
         text(500, 340, "arrows: normals, out of the", 14, "start"),
         text(500, 360, "glass and out of the liquid", 14, "start")]
save(sys.argv[1], 730, 450, parts)
