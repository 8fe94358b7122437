# SPDX-License-Identifier: Apache-2.0
"""Nodes of materials, each on a square of its own: colours of Cycles and Oriel agree within 3.5 %."""
# acceptance: Y2
import pathlib
import sys

import bpy
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402

LIMIT = .035
PIXELS, COLUMNS = 16, 12  # of a square, and of the sheet
CELLS = {}


def cell(build):
    """Adds a square: build(tree, surface) connects nodes to the Principled BSDF."""
    CELLS[build.__name__] = build
    return build


def picture(function=lambda u, v: (u, v, .5), space="sRGB", alpha=None, size=32, name="Picture"):
    v, u = (numpy.mgrid[0:size, 0:size] + .5) / size
    image = bpy.data.images.new(name, size, size, alpha=True)
    image.colorspace_settings.name = space
    pixels = numpy.ones((size, size, 4), numpy.float32)
    pixels[..., :3] = numpy.stack([c + 0 * u for c in function(u, v)], axis=-1)
    if alpha is not None:
        pixels[..., 3] = alpha(u, v)
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    return image


def loaded(image, name, kind="PNG", **settings):
    """The image as a file that is read again."""
    image.filepath_raw = str(support.FOLDER / name)
    image.file_format = kind
    image.save()
    found = bpy.data.images.load(image.filepath_raw, check_existing=False)
    for key, value in settings.items():
        setattr(found, key, value)
    return found


def add(tree, kind, inputs=(), **settings):
    """A node; inputs: by name or index, values or sockets."""
    node = tree.nodes.new("ShaderNode" + kind)
    for name, value in settings.items():
        setattr(node, name, value)
    for name, value in dict(inputs).items():
        put(tree, node.inputs[name], value)
    return node


def put(tree, socket, value):
    if isinstance(value, bpy.types.NodeSocket):
        tree.links.new(value, socket)
    else:
        socket.default_value = (*value, 1) if socket.type == "RGBA" else value


def image_of(tree, *arguments, vector=None, extension="REPEAT", **settings):
    node = add(tree, "TexImage", extension=extension)
    node.image = picture(*arguments, **settings)
    if vector:
        tree.links.new(vector, node.inputs[0])
    return node.outputs[0]


def grey(tree):
    return image_of(tree, lambda u, v: (u, u, u), "Non-Color")


def coordinate(tree, name="UV"):
    return add(tree, "TexCoord").outputs[name]


def into(name, make):
    """A square whose base colour is make(tree)."""
    def build(tree, surface):
        put(tree, surface.inputs["Base Color"], make(tree))
    build.__name__ = name
    cell(build)


def shown(name, make):
    """A square whose surface is make(tree, surface)."""
    def build(tree, surface):
        put(tree, tree.nodes["Material Output"].inputs["Surface"], make(tree, surface))
    build.__name__ = name
    cell(build)


def images():
    into("image", image_of)
    into("numbers of an image", lambda t: image_of(t, space="Non-Color"))

    def packed(tree):
        image = loaded(picture(), "packed.png")
        image.pack()
        pathlib.Path(image.filepath).unlink()
        return add(tree, "TexImage", image=image).outputs[0]
    into("packed image", packed)

    def grid(tree):
        bpy.ops.image.new(name="grid", width=64, height=64, generated_type="COLOR_GRID")
        return add(tree, "TexImage", image=bpy.data.images["grid"]).outputs[0]
    into("generated image", grid)
    for mode in ("STRAIGHT", "NONE", "CHANNEL_PACKED"):
        into(f"alpha mode {mode}", lambda t, m=mode: add(t, "TexImage", image=loaded(
            picture(alpha=lambda u, v: .2 + .8 * u), f"{m}.png", alpha_mode=m)).outputs[0])
    into("colour as factor", lambda t: add(t, "MixRGB", {
        0: image_of(t, lambda u, v: (u, 1 - u, 0), "Non-Color"), 1: (.9, .1, .1),
        2: (.1, .1, .9)}).outputs[0])
    for extension in ("EXTEND", "CLIP"):
        into(f"extension {extension}", lambda t, e=extension: image_of(
            t, extension=e, vector=add(t, "Mapping", {
                0: coordinate(t), "Scale": (2, 2, 1), "Location": (-.5, -.5, 0)}).outputs[0]))


def colours():
    for mode in ("MIX", "MULTIPLY", "ADD", "SUBTRACT", "DIFFERENCE", "DARKEN", "LIGHTEN", "SCREEN",
                 "OVERLAY", "DIVIDE", "DODGE", "BURN", "SOFT_LIGHT", "LINEAR_LIGHT", "HUE",
                 "SATURATION", "COLOR", "VALUE"):
        into(f"mix {mode}", lambda t, m=mode: add(t, "MixRGB", {
            0: .7, 1: image_of(t, space="Non-Color"), 2: (.6, .3, .8)}, blend_type=m).outputs[0])
    if hasattr(bpy.types, "ShaderNodeMix"):
        def new_mix(tree, mode="OVERLAY"):
            node = add(tree, "Mix", data_type="RGBA", blend_type=mode)
            inputs = {s.identifier: s for s in node.inputs}
            for name, value in (("Factor_Float", .7), ("B_Color", (.6, .3, .8)),
                                ("A_Color", image_of(tree, space="Non-Color"))):
                put(tree, inputs[name], value)
            return next(o for o in node.outputs if o.identifier == "Result_Color")
        into("mix of 3.4", new_mix)
    into("hue", lambda t: add(t, "HueSaturation", {
        "Color": image_of(t), "Hue": .6, "Saturation": 1.3, "Value": .8}).outputs[0])
    into("contrast", lambda t: add(t, "BrightContrast", {
        "Color": image_of(t), "Bright": .1, "Contrast": .3}).outputs[0])
    into("gamma", lambda t: add(t, "Gamma", {"Color": image_of(t), "Gamma": 2.2}).outputs[0])
    into("invert", lambda t: add(t, "Invert", {"Color": image_of(t), "Fac": .8}).outputs[0])
    into("grey", lambda t: add(t, "RGBToBW", {
        0: image_of(t, lambda u, v: (u, .1, 1 - u))}).outputs[0])

    def curves(tree):
        node = add(tree, "RGBCurve", {"Color": image_of(tree)})
        node.mapping.curves[3].points.new(.5, .3)
        node.mapping.update()
        return node.outputs[0]
    into("curves", curves)

    def channels(tree):
        parts = add(tree, "SeparateColor", {0: image_of(tree, space="Non-Color")}).outputs
        return add(tree, "CombineColor", {2: parts[0], 0: parts[1]}).outputs[0]
    into("channels", channels)


def numbers():
    for operation in ("ADD", "SUBTRACT", "MULTIPLY", "DIVIDE", "MULTIPLY_ADD", "POWER", "SQRT",
                      "INVERSE_SQRT", "MINIMUM", "LESS_THAN", "GREATER_THAN", "COMPARE", "FRACT",
                      "MODULO", "SNAP", "WRAP", "PINGPONG", "SINE", "COSINE", "SMOOTH_MIN",
                      "LOGARITHM", "EXPONENT"):
        into(f"math {operation}", lambda t, o=operation: add(
            t, "Math", {0: grey(t), 1: .4, 2: .15}, operation=o,
            use_clamp=o == "INVERSE_SQRT").outputs[0])
    for kind in ("LINEAR", "CONSTANT", "EASE"):
        def ramp(tree, kind=kind):
            node = add(tree, "ValToRGB", {0: grey(tree)})
            node.color_ramp.interpolation = kind
            elements = node.color_ramp.elements
            elements[0].color, elements[1].color = (.8, 0, 0, 1), (0, 0, .8, 1)
            elements[1].position = .8
            elements.new(.3).color = (0, .8, 0, 1)
            return node.outputs[0]
        into(f"ramp {kind}", ramp)
    into("range", lambda t: add(t, "MapRange", {
        "Value": grey(t), "From Min": .2, "From Max": .8, "To Min": .1, "To Max": .7}).outputs[0])
    for kind in ("STEPPED", "SMOOTHSTEP", "SMOOTHERSTEP"):
        into(f"range {kind}", lambda t, k=kind: add(t, "MapRange", {
            "Value": grey(t), "From Min": .2, "From Max": .8, "To Min": .1, "To Max": .7},
            interpolation_type=k).outputs[0])
    into("range of vectors", lambda t: add(t, "MapRange", {
        6: coordinate(t), 7: (.2, 0, 0), 8: (.7, 1, 1), 9: (0, .3, 0), 10: (1, .6, 1)},
        data_type="FLOAT_VECTOR").outputs[1])
    into("clamp", lambda t: add(t, "Clamp", {0: grey(t), "Min": .3, "Max": .6}).outputs[0])


def coordinates():
    into("mapping", lambda t: image_of(t, vector=add(t, "Mapping", {
        0: coordinate(t), "Rotation": (0, 0, .5), "Scale": (.5, .7, 1), "Location": (.1, .2, 0)},
        vector_type="TEXTURE").outputs[0]))
    for kind in ("POINT", "TEXTURE", "VECTOR"):
        into(f"mapping {kind} by links", lambda t, k=kind: image_of(t, vector=add(t, "Mapping", {
            0: coordinate(t), "Rotation": (0, 0, .3), "Scale": add(t, "Math", {0: 1.3, 1: .4}).outputs[0],
            "Location": add(t, "TexWave", {0: coordinate(t), "Scale": .3}).outputs[0]},
            vector_type=k).outputs[0]))

    def projected(tree, kind):
        node = add(tree, "TexImage", image=picture(), projection=kind, projection_blend=.3)
        put(tree, node.inputs[0], add(tree, "Mapping", {
            0: coordinate(tree), "Rotation": (.3, .5, .2), "Location": (.1, .2, .3)}).outputs[0])
        return node.outputs[0]
    for kind in ("BOX", "SPHERE", "TUBE"):
        into(f"projection {kind}", lambda t, k=kind: projected(t, k))
    into("image sequence", sequence)
    for name in ("Generated", "Object"):
        into(f"{name} coordinates", lambda t, n=name: image_of(t, vector=coordinate(t, n)))
    into("vector math", lambda t: image_of(t, vector=add(t, "VectorMath", {
        0: coordinate(t), 1: (.5, 1, 1)}, operation="MULTIPLY").outputs[0]))
    for operation in ("NORMALIZE", "CROSS_PRODUCT", "REFLECT", "PROJECT", "LENGTH"):
        into(f"vector {operation}", lambda t, o=operation: add(t, "VectorMath", {
            0: coordinate(t), 1: (-.3, .5, .9)}, operation=o).outputs[o == "LENGTH"])
    for kind in ("AXIS_ANGLE", "Z_AXIS", "EULER_XYZ"):
        into(f"rotated {kind}", lambda t, k=kind: image_of(t, vector=add(t, "VectorRotate", {
            "Vector": coordinate(t), "Center": (.4, .3, 0), "Axis": (.2, .1, .9), "Angle": .7,
            "Rotation": (.2, .1, .5)}, rotation_type=k, invert=k == "EULER_XYZ").outputs[0]))
    into("normal", lambda t: add(t, "Normal", {0: coordinate(t)}).outputs["Dot"])
    into("incoming", lambda t: add(t, "NewGeometry").outputs["Incoming"])
    into("occlusion", lambda t: add(t, "AmbientOcclusion", {"Color": (.2, .5, .8)}).outputs[0])
    into("coordinates as colour", coordinate)
    into("checker", lambda t: add(t, "TexChecker", {
        0: coordinate(t), "Color1": (.8, .2, .1)}).outputs[0])
    into("gradient", lambda t: add(t, "TexGradient", {0: coordinate(t)}).outputs[0])
    into("vertex colours", lambda t: add(t, "VertexColor", layer_name="Col").outputs[0])
    into("attribute", lambda t: add(t, "Attribute", attribute_name="weight").outputs["Fac"])
    into("property", lambda t: add(t, "Attribute", attribute_name="tone",
                                   attribute_type="OBJECT").outputs["Fac"])
    into("object colour", lambda t: add(t, "ObjectInfo").outputs["Color"])
    into("object random", lambda t: add(t, "ObjectInfo").outputs["Random"])
    into("fresnel", lambda t: add(t, "MixRGB", {
        0: add(t, "Fresnel", {"IOR": 1.8}).outputs[0], 1: (.1, .1, .9), 2: (.9, .1, .1)}).outputs[0])
    into("back sides", lambda t: add(t, "MixRGB", {
        0: add(t, "NewGeometry").outputs["Backfacing"], 1: (.1, .8, .1), 2: (.9, .1, .1)}).outputs[0])


def sequence(tree):
    """Files 1 to 4 from frame 0 on: frame 1 shows the second one, and an offset the next."""
    for k in range(1, 5):
        image = picture(lambda u, v, k=k: (k / 5, u, .1), name="Sequence")
        loaded(image, f"frame_{k:03d}.png")
    image = bpy.data.images.load(str(support.FOLDER / "frame_001.png"), check_existing=False)
    image.source = "SEQUENCE"
    node = add(tree, "TexImage", image=image)
    node.image_user.frame_start, node.image_user.frame_duration = 0, 3
    node.image_user.frame_offset, node.image_user.use_auto_refresh = 1, True
    return node.outputs[0]


def normal_maps():
    def mapped(tree, surface, uv="UVMap", scale=3.0, strength=1.0, flipped=False):
        place = add(tree, "Mapping", {0: add(tree, "UVMap", uv_map=uv).outputs[0],
                                      "Scale": (scale, scale, 1)}).outputs[0]
        colour = image_of(tree, lambda u, v: (.5 + .4 * numpy.sin(6.28 * u),
                                              .5 + .2 * numpy.cos(6.28 * v), .9), "Non-Color",
                          vector=place)
        if flipped:
            parts = add(tree, "SeparateColor", {0: colour}).outputs
            colour = add(tree, "CombineColor", {0: parts[0], 1: add(tree, "Invert", {
                "Color": parts[1]}).outputs[0], 2: parts[2]}).outputs[0]
        node = add(tree, "NormalMap", {"Color": colour, "Strength": strength}, uv_map=uv)
        put(tree, surface.inputs["Normal"], node.outputs[0])
        return surface.outputs[0]
    shown("normal map with a mapping", mapped)
    shown("weak normal map", lambda t, s: mapped(t, s, strength=.5))
    shown("normal map by another UV map", lambda t, s: mapped(t, s, "Turned", 1.0))
    shown("normal map with inverted green", lambda t, s: mapped(t, s, scale=1.0, flipped=True))


def surfaces():
    def mixed(tree, factor, first, second):
        return add(tree, "MixShader", {0: factor, 1: first, 2: second}).outputs[0]

    def transparent(tree):
        return add(tree, "BsdfTransparent").outputs[0]

    def by_alpha(tree, surface):
        node = add(tree, "TexImage", image=loaded(picture(alpha=lambda u, v: .2 + .8 * u), "mix.png"))
        put(tree, surface.inputs["Base Color"], node.outputs[0])
        return mixed(tree, node.outputs[1], transparent(tree), surface.outputs[0])
    shown("transparent by alpha", by_alpha)

    def green(tree):
        return add(tree, "BsdfDiffuse", {"Color": (.1, .7, .1)}).outputs[0]
    shown("nested transparent", lambda t, s: mixed(
        t, .4, mixed(t, .3, s.outputs[0], transparent(t)), green(t)))

    def half(tree, surface):
        surface.inputs["Alpha"].default_value = .5
        return mixed(tree, .4, surface.outputs[0], transparent(tree))
    shown("alpha and transparent", half)
    shown("light and surface", lambda t, s: add(t, "AddShader", {0: s.outputs[0], 1: add(
        t, "Emission", {"Color": (.1, .1, .8), "Strength": .5}).outputs[0]}).outputs[0])
    shown("camera rays", lambda t, s: mixed(
        t, add(t, "LightPath").outputs["Is Camera Ray"], s.outputs[0], add(
            t, "Emission", {"Strength": .5}).outputs[0]))
    shown("layer weight", lambda t, s: mixed(
        t, add(t, "LayerWeight").outputs["Facing"], s.outputs[0], green(t)))
    shown("translucent", lambda t, s: mixed(t, .5, green(t), add(
        t, "BsdfTranslucent", {"Color": (.8, .6, .3)}).outputs[0]))

    shown("background", lambda t, s: add(t, "Background", {"Color": (.3, .5, .2)}).outputs[0])

    def rough(tree, strength=.4, **settings):
        waves = add(tree, "TexWave", {0: coordinate(tree), "Scale": 1.0})
        return add(tree, "Bump", {"Strength": strength, "Distance": .1, "Height": waves.outputs["Fac"]},
                   **settings)

    def bumped(tree, surface, **settings):
        put(tree, surface.inputs["Normal"], rough(tree, **settings).outputs[0])
        return surface.outputs[0]
    shown("bump", lambda t, s: bumped(t, s, strength=1.0))
    shown("weak bump", lambda t, s: bumped(t, s, invert=True))

    def twice(tree, surface):
        upper = rough(tree)
        tree.links.new(coordinate(tree, "Object"), upper.inputs["Height"].links[0].from_node.inputs[0])
        put(tree, upper.inputs["Normal"], rough(tree, 1.0).outputs[0])
        put(tree, surface.inputs["Normal"], upper.outputs[0])
        return surface.outputs[0]
    shown("bump of a bump", twice)

    def flat(tree, surface):  # as FBX files have
        put(tree, surface.inputs["Normal"], add(tree, "NormalMap").outputs[0])
        return surface.outputs[0]
    shown("normal map without a picture", flat)

    def metal(tree, surface):
        put(tree, surface.inputs["Metallic"], image_of(
            tree, lambda u, v: (u > .5, u > .5, u > .5), "Non-Color"))
        surface.inputs["Specular"].default_value = .5
        return surface.outputs[0]
    shown("metal by an image", metal)


def group(tree, surface):
    """A group in a group, twice."""
    groups = []
    for name in ("Inner", "Outer"):
        made = bpy.data.node_groups.new(name, "ShaderNodeTree")
        made.inputs.new("NodeSocketColor", "Colour")
        made.outputs.new("NodeSocketColor", "Colour")
        source, target = made.nodes.new("NodeGroupInput"), made.nodes.new("NodeGroupOutput")
        last = source.outputs[0]
        for _ in range(2):
            if groups:
                node = add(made, "Group", node_tree=groups[0])
                put(made, node.inputs[0], last)
            else:
                node = add(made, "MixRGB", {0: 1.0, 1: last, 2: (.7, 1, .8)}, blend_type="MULTIPLY")
            last = node.outputs[0]
        put(made, target.inputs[0], last)
        groups.append(made)
    node = add(tree, "Group", node_tree=groups[1])
    put(tree, node.inputs[0], image_of(tree))
    put(tree, surface.inputs["Base Color"], node.outputs[0])


def sheet():
    rows = -(-len(CELLS) // COLUMNS)
    scene = support.empty_scene(COLUMNS * PIXELS, rows * PIXELS)
    scene.world.color = (.5, .5, .5)
    for k, (name, build) in enumerate(CELLS.items()):
        material, tree, surface = support.node_material(name)
        surface.inputs["Specular"].default_value = 0
        surface.inputs["Base Color"].default_value = (.8, .2, .2, 1)
        build(tree, surface)
        square = support.add_plane(1.0, material)
        square.name, square.color, square["tone"] = name, (.3, .6, .2, 1), .37
        square.location = k % COLUMNS + .5, -(k // COLUMNS) - .5, 0
        square.data.uv_layers.new(name="Turned").data.foreach_set("uv", [0, 0, 0, 2, 2, 2, 2, 0])
        square.data.uv_layers.active_index = 0
        colours_of = square.data.color_attributes.new("Col", "BYTE_COLOR", "CORNER")
        weights = square.data.attributes.new("weight", "FLOAT", "POINT")
        for i in range(4):
            colours_of.data[i].color = (.8 * (i == 0), .8 * (i == 1), .5 * (i > 1), 1)
            weights.data[i].value = i / 3
    support.add_plane(200, support.diffuse_material((.3, .35, .4), "Behind"), z=-1)
    sun = bpy.data.lights.new("Sun", "SUN")
    sun.energy, sun.angle = 1.5, .1
    support.add("Sun", sun, (0, 0, 5), (.3, .2, 0))
    support.add_camera((COLUMNS / 2, -rows / 2, 5), type="ORTHO", ortho_scale=max(COLUMNS, rows))
    return rows


def main():
    for list_of in (images, colours, numbers, coordinates, normal_maps, surfaces):
        list_of()
    cell(group)
    rows = sheet()
    ours, theirs = (support.render(e, 64, "nodes") for e in ("ORIEL", "CYCLES"))
    support.save_png(numpy.concatenate([ours, theirs], axis=0), support.FOLDER / "nodes.png")
    failed = []
    for k, name in enumerate(CELLS):
        x, y = k % COLUMNS * PIXELS, (rows - 1 - k // COLUMNS) * PIXELS
        a, b = (support.block_means(p[y + 2:y + PIXELS - 2, x + 2:x + PIXELS - 2], 4)
                for p in (ours, theirs))
        error = numpy.abs(a - b).mean() / max(b.mean(), 1e-6)
        print(f"{name:24s} mean difference {error:6.2%}", flush=True)
        if error > LIMIT:
            failed.append(f"{name}: {a.mean(axis=(0, 1))}, Cycles {b.mean(axis=(0, 1))}")
    support.check(not failed, f"{len(CELLS)} nodes within {LIMIT:.1%}: all but {failed}")


main()
print("all tests passed")
