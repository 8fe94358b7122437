# SPDX-License-Identifier: Apache-2.0
"""Procedural textures of Blender as shaders of the program that compute the same values."""
from . import arithmetic

# Types of oriel_noise. FBM is a sum that is not normalized.
NOISE_TYPES = {"FBM": 0, "MULTIFRACTAL": 1, "HYBRID_MULTIFRACTAL": 2, "RIDGED_MULTIFRACTAL": 3,
               "HETERO_TERRAIN": 4}
WHITE_NOISE = 5
FEATURES = {"F1": 0, "F2": 1, "SMOOTH_F1": 2, "DISTANCE_TO_EDGE": 3, "N_SPHERE_RADIUS": 4}
METRICS = {"EUCLIDEAN": 0, "MANHATTAN": 1, "CHEBYCHEV": 2, "MINKOWSKI": 3}
AXES = {"X": 0, "Y": 1, "Z": 2, "DIAGONAL": 3, "SPHERICAL": 3}
PROFILES = {"SIN": 0, "SAW": 1, "TRI": 2}


def number(graph, node, name, default=0.0):
    """The value of an input; the default if the node of this version has none."""
    socket = node.inputs.get(name)
    return default if socket is None else graph.scalar(graph.value(socket))


def point(graph, node):
    return graph.coordinate(node.inputs["Vector"], "generated")


def octaves_of_detail(graph, detail):
    """Noise of detail 0 has one octave."""
    return arithmetic.operate(graph, "ADD", arithmetic.operate(
        graph, "MAXIMUM", detail, 0.0), 1.0)


def dimensions(node):
    return {"1D": 1, "2D": 2, "3D": 3, "4D": 4}[getattr(node, "noise_dimensions",
                                                       getattr(node, "musgrave_dimensions", "3D"))]


def noise(graph, node, output):
    kind = getattr(node, "noise_type", "FBM")  # from 4.1
    normal = bool(getattr(node, "normalize", True))  # from 4.0
    values = dict(coord=point(graph, node), w=number(graph, node, "W"),
                  scale=number(graph, node, "Scale", 5.0), dimensions=dimensions(node),
                  octaves=octaves_of_detail(graph, number(graph, node, "Detail", 2.0)),
                  roughness=number(graph, node, "Roughness", 0.5),
                  lacunarity=number(graph, node, "Lacunarity", 2.0),
                  distortion=number(graph, node, "Distortion"))
    if kind != "FBM":
        values.update(type=NOISE_TYPES[kind], offset=number(graph, node, "Offset"),
                      gain=number(graph, node, "Gain", 1.0))
    elif not normal:
        values["normalize"] = False
    return added(graph, values, output.identifier == "Color", kind != "FBM" or not normal)


def added(graph, values, coloured, is_signed):
    """The shader of a noise. is_signed: it can be negative."""
    result = graph.add("noise", "oriel_noise", **values, **({"color": True} if coloured else {}))
    if is_signed:
        graph.signed.add(result)
    return result


def musgrave(graph, node, output):
    """The texture of Blender until 4.0; its octaves lose lacunarity^-dimension of the amplitude."""
    lacunarity = arithmetic.operate(graph, "MAXIMUM", number(graph, node, "Lacunarity", 2.0), 1e-5)
    falling = arithmetic.operate(graph, "MAXIMUM", number(graph, node, "Dimension", 2.0), 1e-5)
    roughness = arithmetic.operate(graph, "DIVIDE", 1.0,
                                   arithmetic.operate(graph, "POWER", lacunarity, falling))
    values = dict(coord=point(graph, node), w=number(graph, node, "W"),
                  scale=number(graph, node, "Scale", 5.0), dimensions=dimensions(node),
                  octaves=number(graph, node, "Detail", 2.0), roughness=roughness,
                  lacunarity=lacunarity, offset=number(graph, node, "Offset"),
                  gain=number(graph, node, "Gain", 1.0), type=NOISE_TYPES[node.musgrave_type],
                  normalize=False)
    return added(graph, values, False, True)


def has_equivalent(node):
    """Whether the program has the texture of a node with its settings; true for other nodes."""
    if node.type == "TEX_VORONOI":
        detail = node.inputs.get("Detail")  # from 4.0
        return not getattr(node, "normalize", False) and \
            (detail is None or not detail.is_linked and detail.default_value <= 0)
    if node.type == "TEX_BRICK":
        return node.offset_frequency > 0 and node.squash_frequency > 0
    return True


def voronoi(graph, node, output):
    if not has_equivalent(node):
        return None
    result = {"Distance": 0, "Radius": 0, "Color": 1, "Position": 2, "W": 3}.get(output.identifier)
    if result is None:
        return None
    return graph.add("voronoi", "oriel_voronoi", coord=point(graph, node), w=number(graph, node, "W"),
                     scale=number(graph, node, "Scale", 5.0),
                     randomness=number(graph, node, "Randomness", 1.0),
                     smoothness=number(graph, node, "Smoothness", 1.0),
                     exponent=number(graph, node, "Exponent", 0.5), feature=FEATURES[node.feature],
                     metric=METRICS[node.distance],
                     dimensions=int(node.voronoi_dimensions[0]), output=result)


def wave(graph, node, output):
    rings = node.wave_type == "RINGS"
    direction = node.rings_direction if rings else node.bands_direction
    return graph.add("wave", "oriel_wave", coord=point(graph, node),
                     scale=number(graph, node, "Scale", 5.0),
                     distortion=number(graph, node, "Distortion"),
                     octaves=octaves_of_detail(graph, number(graph, node, "Detail", 2.0)),
                     noise_scale=number(graph, node, "Detail Scale", 1.0),
                     roughness=number(graph, node, "Detail Roughness", 0.5),
                     phase=number(graph, node, "Phase Offset"), shape=int(rings),
                     direction=AXES[direction], profile=PROFILES[node.wave_profile])


def magic(graph, node, output):
    result = graph.add("magic", "oriel_magic", coord=point(graph, node),
                       scale=number(graph, node, "Scale", 5.0),
                       distortion=number(graph, node, "Distortion", 1.0),
                       depth=node.turbulence_depth)
    if output.identifier == "Fac":
        return graph.add("mean", "mib_color_average", input=result, factor=1.0)
    return result


def brick(graph, node, output):
    if not has_equivalent(node):
        return None
    colours = {}
    factor = output.identifier == "Fac"
    if not factor:
        colours = {key: graph.colour(graph.value(node.inputs[name]))
                   for key, name in (("color1", "Color1"), ("color2", "Color2"),
                                     ("mortar", "Mortar"))}
    return graph.add("brick", "oriel_brick", coord=point(graph, node), **colours,
                     scale=number(graph, node, "Scale", 5.0),
                     mortar_size=number(graph, node, "Mortar Size", .02),
                     mortar_smooth=number(graph, node, "Mortar Smooth", .1),
                     bias=number(graph, node, "Bias"),
                     width=number(graph, node, "Brick Width", .5),
                     height=number(graph, node, "Row Height", .25), offset=node.offset,
                     squash=node.squash, offset_rows=node.offset_frequency,
                     squash_rows=node.squash_frequency, factor=factor)


def white_noise(graph, node, output):
    """A random number, or colour, of each place."""
    return graph.add("white_noise", "oriel_noise", coord=point(graph, node),
                     w=number(graph, node, "W"), scale=1.0, type=WHITE_NOISE,
                     dimensions=dimensions(node), color=output.identifier == "Color")


TRANSLATORS = {
    "TEX_WHITE_NOISE": white_noise, "TEX_NOISE": noise, "TEX_MUSGRAVE": musgrave, "TEX_VORONOI": voronoi, "TEX_WAVE": wave,
    "TEX_MAGIC": magic, "TEX_BRICK": brick,
}
