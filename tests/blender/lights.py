# SPDX-License-Identifier: Apache-2.0
"""Lights of Cycles and Oriel on a white plane: each agrees with the closed form and with Cycles."""
# acceptance: Y2
import math
import pathlib
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402


def setting(kind, energy, height=2.0, **values):
    import bpy
    scene = support.empty_scene(33, 33)
    support.add_plane(40.0, support.diffuse_material())
    # A small window at the origin, from below the light.
    support.add_camera((0, 0, 1), type="ORTHO", ortho_scale=0.05)
    light = bpy.data.lights.new("Light", kind)
    light.energy = energy
    for name, value in values.items():
        setattr(light, name, value)
    support.add("Light", light, (0, 0, height))
    return scene


def compare(label, expected=None, samples=256, tolerance=.01):
    ours = support.render("ORIEL", samples, label)[..., :3].mean(axis=(0, 1))
    theirs = support.render("CYCLES", samples * 4, label)[..., :3].mean(axis=(0, 1))
    text = f"{label}: Oriel {ours.round(5)}, Cycles {theirs.round(5)}"
    error = numpy.abs(ours - theirs).max() / max(theirs.max(), 1e-9)
    support.check(error <= tolerance, f"{text}, difference {error:.2%}")
    if expected is not None:
        support.check(abs(ours.mean() / expected - 1) <= tolerance,
                      f"{label}: Oriel {ours.mean():.5f}, closed form {expected:.5f}")


IES = """IESNA:LM-63-1995
TILT=NONE
1 1000 1 3 1 1 2 0 0 0
1 1 10
0 45 180
0
100 60 20
"""


def profile():
    """A photometric profile, below the light and beside it."""
    import bpy
    path = support.FOLDER / "test.ies"
    path.write_text(IES)
    scene = setting("POINT", 10.0, shadow_soft_size=0.0)
    tree = use_nodes(bpy.data.lights["Light"])
    emission = next(n for n in tree.nodes if n.type == "EMISSION")
    node = tree.nodes.new("ShaderNodeTexIES")
    node.mode, node.filepath = "EXTERNAL", str(path)
    tree.links.new(node.outputs[0], emission.inputs["Strength"])
    compare("profile", 10 * 100 / 177.83 / 4 / math.pi)
    scene.camera.location.x = 2.0  # at 45 degrees
    compare("profile at 45 degrees", 10 * 60 / 177.83 / 4 / math.pi / 2 ** 1.5)
    node.mode, node.ies = "INTERNAL", bpy.data.texts.new("test.ies")
    node.ies.write(IES)
    compare("profile of a text", 10 * 60 / 177.83 / 4 / math.pi / 2 ** 1.5)


def spots_and_spread():
    """Light beside the axis of spots, and of areas with spread."""
    for angle in (120, 40):
        setting("AREA", 50.0, shape="SQUARE", size=.01, spread=math.radians(angle))
        compare(f"spread of {angle} degrees")
    import bpy
    setting("AREA", 50.0, shape="DISK", size=.3, spread=math.radians(60))
    bpy.data.objects["Camera"].location.x = .6
    compare("spread beside the axis")
    for blend, size, radius in ((0.0, 150, 0.0), (.5, 150, 0.0), (1.0, 100, .1), (.3, 180, .05)):
        setting("SPOT", 100.0, shadow_soft_size=radius, spot_size=math.radians(size),
                spot_blend=blend)
        bpy.data.objects["Camera"].location.x = 2.0
        compare(f"spot of {size} degrees, blend {blend}, at 45 degrees")


def use_nodes(light):
    light.use_nodes = True
    return light.node_tree


def main():
    # Irradiance / pi of a white plane below the light.
    setting("POINT", 100.0, shadow_soft_size=0.0)
    compare("point", 100 / (4 * math.pi) / 4 / math.pi)
    # Cycles until 3.x has discs that face the shading point: 1 + r^2 / d^2 darker than spheres.
    setting("POINT", 100.0, shadow_soft_size=0.15)
    compare("sphere", 100 / (4 * math.pi ** 2 * .0225) * .0225 / 4)
    setting("POINT", 100.0, shadow_soft_size=0.1, color=(1, .5, .25))
    compare("coloured point")
    setting("SPOT", 100.0, shadow_soft_size=0.0, spot_size=math.radians(45), spot_blend=0.0)
    compare("spot", 100 / (4 * math.pi) / 4 / math.pi)
    setting("SUN", 3.0, angle=0.0)
    compare("sharp sun", 3 / math.pi)
    setting("SUN", 3.0, angle=math.radians(5), color=(1, .6, .3))
    compare("soft sun")
    setting("AREA", 50.0, shape="SQUARE", size=1.0)
    compare("square")
    setting("AREA", 50.0, shape="RECTANGLE", size=1.0, size_y=.25)
    compare("rectangle")
    setting("AREA", 50.0, shape="DISK", size=1.0)
    radiance = 50 / (4 * math.pi * .25)
    compare("disc", radiance * .25 / (.25 + 4))
    spots_and_spread()
    import bpy
    setting("AREA", 50.0, shape="SQUARE", size=1.0)
    bpy.data.objects["Light"].scale = (2, .5, 1)
    compare("scaled square")
    scene = support.empty_scene(33, 33)
    support.add_plane(40.0, support.diffuse_material())
    support.add_camera((0, 0, 1), type="ORTHO", ortho_scale=0.05)
    scene.world.color = (.2, .4, .8)
    compare("world")
    emitter, tree, node = support.node_material("Emitter")
    emission = tree.nodes.new("ShaderNodeEmission")
    emission.inputs["Strength"].default_value = 5.0
    tree.links.new(emission.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    scene.world.color = (0, 0, 0)
    support.add_plane(1.0, emitter, z=2.0)
    bpy.data.objects["Camera"].data.clip_end = 1.5
    compare("emissive mesh")
    profile()


main()
print("all tests passed")
