# SPDX-License-Identifier: Apache-2.0
"""The camera: centres of small bright squares agree with Cycles to 0.1 pixels."""
# acceptance: Y2
import math
import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402

CASES = {
    "landscape": ((96, 64), {}),
    "portrait": ((64, 96), {}),
    "shift": ((96, 64), {"shift_x": .12, "shift_y": -.2}),
    "portrait shift": ((64, 96), {"shift_x": -.1, "shift_y": .15}),
    "vertical fit": ((96, 64), {"sensor_fit": "VERTICAL", "sensor_height": 24, "shift_y": .1}),
    "horizontal fit": ((64, 96), {"sensor_fit": "HORIZONTAL", "sensor_width": 32}),
    "orthographic": ((96, 64), {"type": "ORTHO", "ortho_scale": 9.0, "shift_x": .1}),
    "wide": ((96, 64), {"lens": 18.0}),
}


def centres(pixels, lights):
    """Centroids of the three colours; each square has a pure colour."""
    height, width = pixels.shape[:2]
    y, x = numpy.mgrid[0:height, 0:width] + .5
    result = []
    for k in range(lights):
        weight = numpy.clip(pixels[..., k], 0, 1)
        if weight.sum() < .5:
            result.append((-1, -1))
            continue
        result.append(((x * weight).sum() / weight.sum(), (y * weight).sum() / weight.sum()))
    return numpy.array(result)


def scene_for(size, settings, aspect=1.0):
    scene = support.empty_scene(*size)
    scene.render.pixel_aspect_y = aspect
    for k, (x, y) in enumerate(((-2.2, .6), (1.7, -1.1), (.4, 1.3))):
        material, tree, _ = support.node_material(f"Light {k}")
        node = tree.nodes.new("ShaderNodeEmission")
        node.inputs["Color"].default_value = [float(i == k) for i in range(3)] + [1]
        tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
        square = support.add_plane(.25, material)
        square.location = (x, y, .3 * k)
    support.add_camera((.4, -1.5, 9.0), (math.radians(10), math.radians(4), math.radians(7)),
                       **{"lens": 40.0, **settings})
    return scene


def main():
    cases = [(name, *case, 1.0) for name, case in CASES.items()]
    cases.append(("pixel aspect", (96, 64), {"shift_x": .05}, 1.5))
    for name, size, settings, aspect in cases:
        scene_for(size, settings, aspect)
        ours = centres(support.render("ORIEL", 256, "camera"), 3)
        theirs = centres(support.render("CYCLES", 256, "camera"), 3)
        error = numpy.abs(ours - theirs).max()
        support.check((theirs >= 0).any(), f"{name}: the squares are in view")
        support.check(error <= .1, f"{name}: largest difference {error:.3f} pixels")
    border()


def border():
    """A border renders the same pixels as the whole picture."""
    scene = scene_for((96, 64), {})
    whole = support.render("ORIEL", 16, "whole")
    render = scene.render
    render.use_border = True
    render.border_min_x, render.border_max_x = .25, .75
    render.border_min_y, render.border_max_y = .25, .75
    for crop in (True, False):
        render.use_crop_to_border = crop
        part = support.render("ORIEL", 16, "border")
        part = part if crop else part[16:48, 24:72]
        support.check(part.shape[:2] == (32, 48), f"crop {crop}: size {part.shape}")
        support.check(numpy.array_equal(part, whole[16:48, 24:72]), f"crop {crop}: equal pixels")


main()
print("all tests passed")
