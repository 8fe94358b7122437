# SPDX-License-Identifier: Apache-2.0
"""Nodes that compute with vectors, and ranges of values."""
import math

import numpy

from . import mi
from .arithmetic import operate

# Operations of the Vector Math node that work on each component.
COMPONENTS = {"ADD", "SUBTRACT", "MULTIPLY", "DIVIDE", "MULTIPLY_ADD", "ABSOLUTE", "MINIMUM",
              "MAXIMUM", "FLOOR", "CEIL", "FRACTION", "MODULO", "WRAP", "SNAP", "SINE", "COSINE",
              "TANGENT"}


def permuted(graph, vector, order):
    """The components of a vector in another order; None is zero."""
    if isinstance(vector, tuple):
        return tuple(0.0 if i is None else vector[i] for i in order)
    matrix = numpy.zeros((4, 4))
    matrix[3, 3] = 1
    for row, column in enumerate(order):
        if column is not None:
            matrix[row, column] = 1
    return graph.remapped("permuted", vector, matrix)


def dot(graph, a, b):
    product = operate(graph, "MULTIPLY", a, b)
    if isinstance(product, mi.Connection):
        return graph.add("sum", "mib_color_average", factor=3.0, input=product)
    return sum(graph.vector(product))


def length(graph, a):
    return operate(graph, "SQRT", dot(graph, a, a))


def normalized(graph, a):
    return operate(graph, "DIVIDE", a, length(graph, a))


def cross(graph, a, b):
    forward, back = (1, 2, 0), (2, 0, 1)
    first = operate(graph, "MULTIPLY", permuted(graph, a, forward), permuted(graph, b, back))
    second = operate(graph, "MULTIPLY", permuted(graph, a, back), permuted(graph, b, forward))
    return operate(graph, "SUBTRACT", first, second)


def reflected(graph, a, b):
    """a mirrored at the plane with the normal b."""
    normal = normalized(graph, b)
    twice = operate(graph, "MULTIPLY", dot(graph, a, normal), -2.0)
    return operate(graph, "MULTIPLY_ADD", normal, twice, a)


def projected(graph, a, b):
    share = operate(graph, "DIVIDE", dot(graph, a, b), dot(graph, b, b))
    return operate(graph, "MULTIPLY", b, share)


def vector_math(graph, node, output):
    values = [graph.vector(graph.value(s)) for s in node.inputs if s.type == "VECTOR"]
    values += [(0.0,) * 3] * (3 - len(values))
    a, b = values[:2]
    operation = {"FRACTION": "FRACT"}.get(node.operation, node.operation)
    if node.operation in COMPONENTS:
        return operate(graph, operation, *values[:3])
    if node.operation == "SCALE":
        return operate(graph, "MULTIPLY", a, graph.value(node.inputs["Scale"]))
    if node.operation == "DISTANCE":
        return length(graph, operate(graph, "SUBTRACT", a, b))
    functions = {"DOT_PRODUCT": dot, "CROSS_PRODUCT": cross, "REFLECT": reflected,
                 "PROJECT": projected}
    if node.operation in functions:
        return functions[node.operation](graph, a, b)
    if node.operation in {"LENGTH", "NORMALIZE"}:
        return (length if node.operation == "LENGTH" else normalized)(graph, a)
    return None


def turn_about(axis, angle):
    """The matrix of a rotation about an axis (Rodrigues' formula)."""
    x, y, z = numpy.array(axis) / max(numpy.linalg.norm(axis), 1e-30)
    skew = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + math.sin(angle) * skew + (1 - math.cos(angle)) * skew @ skew


def vector_rotate(graph, node, output):
    """A rotation by constants about a centre."""
    get = {s.name: graph.vector(graph.value(s)) for s in node.inputs if s.name != "Vector"}
    if any(isinstance(value, mi.Connection) for value in get.values()):
        return None
    if node.rotation_type == "EULER_XYZ":
        from .nodes import rotation_matrix
        turn = rotation_matrix(get["Rotation"])
    else:
        axes = {"X_AXIS": (1, 0, 0), "Y_AXIS": (0, 1, 0), "Z_AXIS": (0, 0, 1)}
        turn = turn_about(axes.get(node.rotation_type, get["Axis"]), get["Angle"][0])
    if node.invert:
        turn = turn.T
    matrix, centre = numpy.eye(4), numpy.array(get["Center"])
    matrix[:3, :3], matrix[:3, 3] = turn, centre - turn @ centre
    return graph.remapped("rotated", graph.coordinate(node.inputs["Vector"]), matrix)


def normal(graph, node, output):
    """The constant direction of a Normal node, or its cosine to a vector."""
    direction = tuple(node.outputs["Normal"].default_value)
    if output.identifier == "Normal":
        return direction
    size = math.sqrt(sum(x * x for x in direction)) or 1.0
    given = normalized(graph, graph.vector(graph.value(node.inputs["Normal"])))
    return dot(graph, given, tuple(x / size for x in direction))


def map_range(graph, node, output):
    """Values of one range in another one; of vectors each component."""
    vectors = getattr(node, "data_type", "FLOAT") == "FLOAT_VECTOR"
    sockets = [s for s in node.inputs if (s.type == "VECTOR") == vectors]
    read = graph.vector if vectors else graph.scalar
    value, low, high, to_low, to_high, *steps = (read(graph.value(s)) for s in sockets)
    kind = node.interpolation_type
    share = operate(graph, "DIVIDE", operate(graph, "SUBTRACT", value, low),
                    operate(graph, "SUBTRACT", high, low))
    if kind == "STEPPED":
        whole = operate(graph, "FLOOR", operate(graph, "MULTIPLY", share,
                                                operate(graph, "ADD", steps[0], 1.0)))
        share = operate(graph, "DIVIDE", whole, steps[0])
    if kind in {"SMOOTHSTEP", "SMOOTHERSTEP"}:
        share = smooth(graph, kind, share)
    result = operate(graph, "MULTIPLY_ADD", share, operate(graph, "SUBTRACT", to_high, to_low),
                     to_low)
    if not node.clamp or kind.startswith("SMOOTH"):
        return result
    ends = [operate(graph, name, to_low, to_high) for name in ("MINIMUM", "MAXIMUM")]
    return operate(graph, "MINIMUM", operate(graph, "MAXIMUM", result, ends[0]), ends[1])


def smooth(graph, kind, share):
    """Hermite's polynomial with zero slopes at 0 and 1, or Perlin's of the fifth degree."""
    x = operate(graph, "ADD", share, 0.0, clamp=True)
    square = operate(graph, "MULTIPLY", x, x)
    if kind == "SMOOTHSTEP":
        return operate(graph, "MULTIPLY", square, operate(graph, "MULTIPLY_ADD", x, -2.0, 3.0))
    inner = operate(graph, "MULTIPLY_ADD", x, operate(graph, "MULTIPLY_ADD", x, 6.0, -15.0), 10.0)
    return operate(graph, "MULTIPLY", operate(graph, "MULTIPLY", square, x), inner)


TRANSLATORS = {"VECT_MATH": vector_math, "VECTOR_ROTATE": vector_rotate, "NORMAL": normal,
               "MAP_RANGE": map_range}
