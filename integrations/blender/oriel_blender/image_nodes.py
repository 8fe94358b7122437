# SPDX-License-Identifier: Apache-2.0
"""Image textures: extension, tiles and projections."""
import math

import numpy

from . import arithmetic, mi
from .vectors import length, permuted


def image(graph, node, output):
    # Without the alpha Cycles reads colours that are multiplied by it.
    alpha = any(o.is_linked for o in node.outputs if o.identifier == "Alpha")
    tiles = [(tile, graph.images.texture(node.image, graph.material, node.name, tile=tile,
                                         coloured=alpha, user=getattr(node, "image_user", None)))
             for tile in graph.images.tiles(node.image)]
    tiles = [(tile, texture) for tile, texture in tiles if texture is not None]
    if not tiles:
        return (1.0, 0.0, 1.0)
    projection = getattr(node, "projection", "FLAT")
    coordinate = graph.coordinate(node.inputs["Vector"])
    if tiles[0][0] is not None:
        return tiled(graph, node, output, tiles, coordinate)
    if projection == "BOX":
        return box(graph, node, output, tiles[0][1], coordinate)
    if projection in PROJECTIONS:
        coordinate = PROJECTIONS[projection](graph, coordinate)
    return look(graph, node, output, tiles[0][1], extended(graph, node, coordinate))


def extended(graph, node, coordinate):
    """The coordinate in the square of the picture."""
    if node.extension == "REPEAT":
        return graph.add("repeat", "mib_texture_remap", input=coordinate, torus_x=True, torus_y=True)
    if node.extension == "EXTEND":
        half = tuple(.5 / max(n, 1) for n in node.image.size) + (0.0,)
        low = arithmetic.operate(graph, "MAXIMUM", coordinate, half)
        return arithmetic.operate(graph, "MINIMUM", low, tuple(1 - h for h in half))
    if node.extension == "MIRROR":
        return arithmetic.operate(graph, "PINGPONG", coordinate, 1.0)
    if node.extension != "CLIP":
        graph.unsupported(node, f"has the extension {node.extension}, which is read as clip")
    return coordinate


def look(graph, node, output, texture, coordinate):
    found = graph.add(node.name, "mib_texture_lookup", tex=mi.Words(mi.quoted(texture)),
                      coord=coordinate)
    if output.identifier == "Alpha":
        return graph.add("alpha", "mib_color_alpha", input=found, factor=1.0)
    if graph.images.is_encoded(node.image):
        return arithmetic.operate(graph, "SRGB_OF_GAMMA", found)
    return found


def tiled(graph, node, output, tiles, coordinate):
    """The sum of the tiles; each is black outside of its square."""
    total = None
    for tile, texture in tiles:
        matrix = numpy.eye(4)
        matrix[:2, 3] = -((tile - 1001) % 10), -((tile - 1001) // 10)
        moved = graph.remapped("tile", coordinate, matrix)
        found = look(graph, node, output, texture, moved)
        total = found if total is None else graph.mix("tiles", 2, 1.0, total, found)
    return total


# Projections -----------------------------------------------------------------------------------
def box_weights(graph, normal, blend):
    """Weights of the projections along x, y and z.

    Of two projections a has the share clamp((a / (a + b) - 1/2) / blend + 1/2) by the components of the
    normal; a weight is the product of the shares against both others, normalized.
    """
    size = arithmetic.operate(graph, "ABSOLUTE", normal)
    following = permuted(graph, size, (1, 2, 0))
    if blend > 0:
        share = arithmetic.operate(graph, "DIVIDE", size,
                                   arithmetic.operate(graph, "ADD", size, following))
        first = arithmetic.operate(graph, "MULTIPLY_ADD", share, 1 / blend, .5 - .5 / blend,
                                   clamp=True)
    else:
        first = arithmetic.operate(graph, "GREATER_THAN", size, following)
    second = permuted(graph, arithmetic.operate(graph, "SUBTRACT", 1.0, first), (2, 0, 1))
    product = arithmetic.operate(graph, "MULTIPLY", first, second)
    total = graph.add("sum", "mib_color_average", input=product, factor=3.0)
    return arithmetic.operate(graph, "DIVIDE", product, total)


# Components of the coordinate that are u and v of each side, and the side that is mirrored.
BOX_SIDES = (((1, 2, None), 1.0), ((0, 2, None), -1.0), ((1, 0, None), -1.0))


def box(graph, node, output, texture, coordinate):
    """The picture from six sides, by the normal in object space."""
    normal = graph.add("normal", "mib_texture_vector", select=-2, selspace=1)
    weights = box_weights(graph, normal, node.projection_blend)
    signs = arithmetic.operate(graph, "SIGN", normal)
    centred = arithmetic.operate(graph, "SUBTRACT", coordinate, .5)
    total = None
    for side, (order, mirror) in enumerate(BOX_SIDES):
        facing = permuted(graph, signs, (side, None, None))
        factor = arithmetic.operate(graph, "MULTIPLY_ADD", facing, (mirror, 0.0, 0.0), (0.0, 1.0, 1.0))
        place = arithmetic.operate(graph, "MULTIPLY_ADD", permuted(graph, centred, order), factor, .5)
        found = look(graph, node, output, texture, extended(graph, node, place))
        part = arithmetic.operate(graph, "MULTIPLY", found, graph.channel(weights, side))
        total = part if total is None else arithmetic.operate(graph, "ADD", total, part)
    return total


def around(graph, point):
    """The longitude as 0 to 1, of a point that is centred at 0."""
    angle = arithmetic.operate(graph, "ARCTAN2", graph.channel(point, 0), graph.channel(point, 1))
    return arithmetic.operate(graph, "MULTIPLY_ADD", angle, -.5 / math.pi, .5)


def joined(graph, u, v):
    low = arithmetic.operate(graph, "MULTIPLY", u, (1.0, 0.0, 0.0))
    return arithmetic.operate(graph, "MULTIPLY_ADD", v, (0.0, 1.0, 0.0), low)


def sphere(graph, coordinate):
    """Longitude and latitude about the middle of the unit cube."""
    point = arithmetic.operate(graph, "MULTIPLY_ADD", coordinate, 2.0, -1.0)
    height = arithmetic.operate(graph, "DIVIDE", graph.channel(point, 2), length(graph, point))
    polar = arithmetic.operate(graph, "ARCCOSINE", height)
    return joined(graph, around(graph, point),
                  arithmetic.operate(graph, "MULTIPLY_ADD", polar, -1 / math.pi, 1.0))


def tube(graph, coordinate):
    """Longitude and height about the middle of the unit cube."""
    point = arithmetic.operate(graph, "MULTIPLY_ADD", coordinate, 2.0, -1.0)
    return joined(graph, around(graph, point), graph.channel(coordinate, 2))


PROJECTIONS = {"SPHERE": sphere, "TUBE": tube}
TRANSLATORS = {"TEX_IMAGE": image}
