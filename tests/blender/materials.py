# SPDX-License-Identifier: Apache-2.0
"""Principled materials on a ball: pictures of Cycles and Oriel differ by at most 3 %."""
# acceptance: Y2
import math
import pathlib
import sys

import bpy
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402

LIMIT = .03
# Light passes solid glass straight: an even shadow in place of the caustic that Cycles shows.
LIMIT_OF_GLASS = .045
GLASS = ("glass", "rough glass", "absorption")
SAMPLES = 144
SIZE = 80


def stage():
    scene = support.empty_scene(SIZE, SIZE)
    scene.world.color = (.25, .3, .4)
    scene.cycles.max_bounces = scene.cycles.transparent_max_bounces = 24
    scene.cycles.glossy_bounces = scene.cycles.transmission_bounces = 24
    scene.cycles.diffuse_bounces = 24
    scene.cycles.sample_clamp_indirect = 0
    scene.cycles.blur_glossy = 0
    scene.oriel.depth = 24
    floor = support.add_plane(12.0, support.diffuse_material((.5, .35, .2), "Floor"), z=-1.0)
    floor.name = "Floor"
    light = bpy.data.lights.new("Key", "AREA")
    light.energy, light.size = 300.0, 2.0
    support.add("Key", light, (2.5, -2.5, 4), (math.radians(40), 0, math.radians(45)))
    support.add_camera((0, -6, 1.2), (math.radians(80), 0, 0), lens=60.0)
    return scene


def image(name, function, space="sRGB"):
    """A picture of 64 x 64 pixels; function maps u and v to colours."""
    size = 64
    v, u = (numpy.mgrid[0:size, 0:size] + .5) / size
    picture = bpy.data.images.new(name, size, size)
    picture.colorspace_settings.name = space
    pixels = numpy.ones((size, size, 4), numpy.float32)
    pixels[..., :3] = numpy.stack(function(u, v), axis=-1)
    picture.pixels.foreach_set(pixels.ravel())
    picture.update()
    return picture


def image_node(tree, picture):
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = picture
    return node


def principled(**values):
    def make():
        material, tree, node = support.node_material()
        for name, value in values.items():
            socket = node.inputs[name.replace("_", " ")]
            alpha = (1,) if socket.type == "RGBA" else ()
            socket.default_value = (*value, *alpha) if isinstance(value, tuple) else value
        return material
    return make


def textured():
    material, tree, node = support.node_material()
    picture = image("Stripes", lambda u, v: (.2 + .6 * (numpy.floor(u * 8) % 2),
                                             .3 + .4 * (numpy.floor(v * 4) % 2), .3 + 0 * u))
    tree.links.new(image_node(tree, picture).outputs[0], node.inputs["Base Color"])
    node.inputs["Specular"].default_value = 0
    return material


def normal_map():
    material, tree, node = support.node_material()
    def bumps(u, v):
        x, y = .35 * numpy.sin(u * 16 * math.pi), .35 * numpy.sin(v * 8 * math.pi)
        return x / 2 + .5, y / 2 + .5, numpy.sqrt(1 - x * x - y * y) / 2 + .5
    source = image_node(tree, image("Bumps", bumps, "Non-Color"))
    convert = tree.nodes.new("ShaderNodeNormalMap")
    tree.links.new(source.outputs[0], convert.inputs["Color"])
    tree.links.new(convert.outputs[0], node.inputs["Normal"])
    node.inputs["Base Color"].default_value = (.7, .6, .5, 1)
    return material


def colour_of(node, **values):
    for name, value in values.items():
        socket = node.inputs[name.replace("_", " ")]
        socket.default_value = (*value, 1) if isinstance(value, tuple) else value
    return node


def absorbing_glass():
    """Glass with the volume absorption of a green liquid."""
    material, tree, node = support.node_material()
    colour_of(node, Base_Color=(1.0, 1.0, 1.0), Transmission=1.0, Roughness=0.0, IOR=1.3)
    volume = colour_of(tree.nodes.new("ShaderNodeVolumeAbsorption"), Color=(.2, .8, .5), Density=.7)
    tree.links.new(volume.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    return material


def fog():
    """A volume without a surface, with Cycles' default of scattering once."""
    material, tree, node = support.node_material()
    tree.nodes.remove(node)
    volume = colour_of(tree.nodes.new("ShaderNodeVolumeScatter"), Color=(.6, .7, .9), Density=.3,
                       Anisotropy=.3)
    tree.links.new(volume.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    return material


def tiled():
    """An image of two UDIM tiles."""
    folder = support.FOLDER / "tiles"
    folder.mkdir(exist_ok=True)
    for number, rgb in ((1001, (.8, .2, .1)), (1002, (.1, .3, .7))):
        picture = image(f"tile{number}", lambda u, v, c=rgb: tuple(x + 0 * u for x in c))
        picture.filepath_raw = str(folder / f"tile.{number}.png")
        picture.file_format = "PNG"
        picture.save()
    picture = bpy.data.images.load(str(folder / "tile.1001.png"), check_existing=False)
    picture.source = "TILED"
    picture.filepath = str(folder / "tile.<UDIM>.png")
    if len(picture.tiles) < 2:
        picture.tiles.new(1002)
    material, tree, node = support.node_material()
    node.inputs["Specular"].default_value = 0
    mapping = tree.nodes.new("ShaderNodeMapping")
    mapping.inputs["Scale"].default_value = (2, 1, 1)
    tree.links.new(tree.nodes.new("ShaderNodeUVMap").outputs[0], mapping.inputs["Vector"])
    source = image_node(tree, picture)
    tree.links.new(mapping.outputs[0], source.inputs["Vector"])
    tree.links.new(source.outputs[0], node.inputs["Base Color"])
    return material


def mixed():
    material, tree, node = support.node_material()
    transparent = tree.nodes.new("ShaderNodeBsdfTransparent")
    mix = tree.nodes.new("ShaderNodeMixShader")
    mix.inputs[0].default_value = .7
    tree.links.new(transparent.outputs[0], mix.inputs[1])
    tree.links.new(node.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    return material


CASES = {
    "diffuse": principled(Base_Color=(.8, .3, .1), Specular=0.0),
    "plastic": principled(Base_Color=(.1, .3, .7), Roughness=.3),
    "rough plastic": principled(Base_Color=(.1, .5, .2), Roughness=.6),
    "mirror": principled(Base_Color=(.95, .8, .5), Metallic=1.0, Roughness=0.0),
    "metal": principled(Base_Color=(.95, .8, .5), Metallic=1.0, Roughness=.3),
    "rough metal": principled(Base_Color=(.9, .9, .9), Metallic=1.0, Roughness=.5),
    "half metal": principled(Base_Color=(.8, .5, .3), Metallic=.5, Roughness=.4),
    "glass": principled(Base_Color=(1.0, 1.0, 1.0), Transmission=1.0, Roughness=0.0, IOR=1.45),
    "rough glass": principled(Base_Color=(.8, .95, .9), Transmission=1.0, Roughness=.3, IOR=1.45),
    "coat": principled(Base_Color=(.5, .05, .05), Specular=0.0, Clearcoat=1.0,
                       Clearcoat_Roughness=.1),
    "alpha": principled(Base_Color=(.7, .2, .2), Specular=0.0, Alpha=.5),
    "emission": principled(Base_Color=(0.0, 0.0, 0.0), Specular=0.0, Emission=(1.0, .4, .1),
                           Emission_Strength=2.0),
    "absorption": absorbing_glass, "fog": fog, "tiles": tiled,
    "sheen": principled(Base_Color=(.1, .1, .3), Specular=0.0, Sheen=1.0),
    "subsurface": principled(Base_Color=(.8, .6, .5), Specular=0.0, Subsurface=.3,
                             Subsurface_Color=(.8, .3, .2), Subsurface_Radius=(.3, .3, .3)),
    "texture": textured, "normal map": normal_map, "mix with transparent": mixed,
}


def difference(ours, theirs, block=8):
    """Mean absolute difference of blocks, relative to the mean; blocks remove the noise."""
    a, b = support.block_means(ours, block), support.block_means(theirs, block)
    return numpy.abs(a - b).mean() / b.mean()


def main():
    rows, failed = [], []
    chosen = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    for name in chosen or CASES:
        stage()
        support.add_sphere(1.0, CASES[name]())
        ours = support.render("ORIEL", SAMPLES, "material")
        theirs = support.render("CYCLES", SAMPLES, "material")
        error = difference(ours, theirs)
        whole = (ours[..., :3].mean() / theirs[..., :3].mean()) - 1
        print(f"{name:22s} mean difference {error:6.2%}, mean {whole:+6.2%}", flush=True)
        rows.append(numpy.concatenate([ours, theirs], axis=1))
        if error > (LIMIT_OF_GLASS if name in GLASS else LIMIT):
            failed.append(name)
    columns = 3
    rows += [numpy.zeros_like(rows[0])] * (-len(rows) % columns)
    sheet = [numpy.concatenate(rows[i:i + columns], axis=1) for i in range(0, len(rows), columns)]
    support.save_png(numpy.concatenate(sheet[::-1], axis=0), support.FOLDER / "materials.png")
    support.check(not failed, f"within {LIMIT:.0%}: all but {failed}")


main()
print("all tests passed")
