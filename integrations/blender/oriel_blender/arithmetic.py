# SPDX-License-Identifier: Apache-2.0
"""Nodes that compute with numbers and colours, as oriel_math, oriel_blend and tables."""
import math

from . import mi, versions

LUMINANCE = (0.2126, 0.7152, 0.0722)
RAMP_SAMPLES = 31    # of ramps that are not linear
CURVE_SAMPLES = 17   # of curve nodes
STEP_WIDTH = 1e-4    # of constant ramps
INTERVALS = 5        # of one table beside what precedes and follows it

# Operations of the Math node by their number in oriel_math.
OPERATIONS = {name: number for number, name in enumerate((
    "ADD", "SUBTRACT", "MULTIPLY", "DIVIDE", "MULTIPLY_ADD", "POWER", "LOGARITHM", "SQRT",
    "INVERSE_SQRT", "ABSOLUTE", "EXPONENT", "MINIMUM", "MAXIMUM", "LESS_THAN", "GREATER_THAN",
    "SIGN", "COMPARE", "SMOOTH_MIN", "SMOOTH_MAX", "ROUND", "FLOOR", "CEIL", "TRUNC", "FRACT",
    "MODULO", "FLOORED_MODULO", "WRAP", "SNAP", "PINGPONG", "SINE", "COSINE", "TANGENT", "ARCSINE",
    "ARCCOSINE", "ARCTANGENT", "ARCTAN2", "RADIANS", "DEGREES", "SRGB_OF_GAMMA"))}
BLENDS = {name: number for number, name in enumerate((
    "MIX", "ADD", "MULTIPLY", "SUBTRACT", "SCREEN", "DIVIDE", "DIFFERENCE", "EXCLUSION", "DARKEN",
    "LIGHTEN", "OVERLAY", "SOFT_LIGHT", "LINEAR_LIGHT", "DODGE", "BURN", "HUE", "SATURATION",
    "COLOR", "VALUE"))}
# Operations and modes whose results can be negative.
SIGNED = {"SUBTRACT", "MULTIPLY_ADD", "SINE", "COSINE", "TANGENT", "LOGARITHM", "WRAP", "FLOOR",
          "MODULO", "SMOOTH_MIN", "LINEAR_LIGHT"}


def wrapped(a, b, c):
    return a - (b - c) * math.floor((a - c) / (b - c)) if b != c else c


def smooth_minimum(a, b, c):
    h = max(c - abs(a - b), 0) / c if c else 0
    return min(a, b) - h ** 3 * c / 6


def ping_pong(a, b):
    x = (a - b) / (2 * b) if b else 0
    return abs((x - math.floor(x)) * 2 * b - b)


# Operations on constants, so that parameters that cannot be connected get their values.
CONSTANTS = {
    "ADD": lambda a, b, c: a + b, "SUBTRACT": lambda a, b, c: a - b,
    "MULTIPLY": lambda a, b, c: a * b, "DIVIDE": lambda a, b, c: a / b if b else 0,
    "MULTIPLY_ADD": lambda a, b, c: a * b + c,
    "POWER": lambda a, b, c: a ** b if a >= 0 or b == math.floor(b) else 0,
    "LOGARITHM": lambda a, b, c: math.log(a) / math.log(b) if a > 0 < b != 1 else 0,
    "SQRT": lambda a, b, c: math.sqrt(max(a, 0)),
    "INVERSE_SQRT": lambda a, b, c: 1 / math.sqrt(a) if a > 0 else 0,
    "ABSOLUTE": lambda a, b, c: abs(a), "EXPONENT": lambda a, b, c: math.exp(a),
    "MINIMUM": lambda a, b, c: min(a, b), "MAXIMUM": lambda a, b, c: max(a, b),
    "LESS_THAN": lambda a, b, c: float(a < b), "GREATER_THAN": lambda a, b, c: float(a > b),
    "SIGN": lambda a, b, c: (a > 0) - (a < 0),
    "COMPARE": lambda a, b, c: float(abs(a - b) <= max(c, 1e-5)),
    "SMOOTH_MIN": smooth_minimum, "SMOOTH_MAX": lambda a, b, c: -smooth_minimum(-a, -b, c),
    "ROUND": lambda a, b, c: math.floor(a + .5), "FLOOR": lambda a, b, c: math.floor(a),
    "CEIL": lambda a, b, c: math.ceil(a), "TRUNC": lambda a, b, c: math.trunc(a),
    "FRACT": lambda a, b, c: a - math.floor(a),
    "MODULO": lambda a, b, c: math.fmod(a, b) if b else 0,
    "FLOORED_MODULO": lambda a, b, c: a - b * math.floor(a / b) if b else 0, "WRAP": wrapped,
    "SNAP": lambda a, b, c: math.floor(a / b) * b if b else 0,
    "PINGPONG": lambda a, b, c: ping_pong(a, b), "SINE": lambda a, b, c: math.sin(a),
    "COSINE": lambda a, b, c: math.cos(a), "TANGENT": lambda a, b, c: math.tan(a),
    "ARCSINE": lambda a, b, c: math.asin(a) if abs(a) <= 1 else 0,
    "ARCCOSINE": lambda a, b, c: math.acos(a) if abs(a) <= 1 else 0,
    "ARCTANGENT": lambda a, b, c: math.atan(a), "ARCTAN2": lambda a, b, c: math.atan2(a, b),
    "RADIANS": lambda a, b, c: math.radians(a), "DEGREES": lambda a, b, c: math.degrees(a),
}


def computed(operation, values, clamp):
    """The result of an operation on constants; a number for numbers."""
    def one(*operands):
        try:
            result = float(CONSTANTS[operation](*operands))
        except (OverflowError, ZeroDivisionError):
            result = 0.0
        return min(max(result, 0.0), 1.0) if clamp else result
    if not any(isinstance(v, tuple) for v in values):
        return one(*values)
    channels = [v if isinstance(v, tuple) else (v,) * 3 for v in values]
    return tuple(one(*operands) for operands in zip(*channels))


def operate(graph, operation, a, b=0.0, c=0.0, clamp=False):
    """The result of an operation on each channel."""
    if not any(isinstance(v, mi.Connection) for v in (a, b, c)):
        return computed(operation, (a, b, c), clamp)
    values = {"clamp": True} if clamp else {}
    result = graph.add("math", "oriel_math", operation=OPERATIONS[operation],
                       input1=graph.colour(a), input2=graph.colour(b), input3=graph.colour(c),
                       **values)
    if operation in SIGNED and not clamp:
        graph.signed.add(result)
    return result


def not_negative(graph, value):
    """A colour of a surface; Cycles reflects nothing of negative colours."""
    if value in graph.signed:
        return operate(graph, "MAXIMUM", value, 0.0)
    return value


def luminance(graph, value):
    """A colour as a number, as Blender converts it."""
    if isinstance(value, mi.Connection):
        weighed = operate(graph, "MULTIPLY", value, LUMINANCE)
        return graph.add("grey", "mib_color_average", input=weighed, factor=3.0)
    return graph.scalar(value)


def table(graph, value, positions, colours):
    """Linear interpolation of colours at ascending positions in 0 to 1, by sums of tables.

    A table of mib_color_interpolate has its first colour at 0 and its last one at 1.
    """
    if positions[0] > 0:
        positions, colours = [0.0, *positions], [colours[0], *colours]
    if positions[-1] < 1:
        positions, colours = [*positions, 1.0], [*colours, colours[-1]]
    if len(positions) <= 8:
        return one_table(graph, value, positions, colours)
    total = None
    for first in range(0, len(positions) - 1, INTERVALS):
        last = min(first + INTERVALS, len(positions) - 1)
        zero = colours[first] if total is not None else (0.0,) * 3
        part = [tuple(x - y for x, y in zip(c, zero)) for c in colours[first:last + 1]]
        places = list(positions[first:last + 1])
        if places[0] > 0:
            places, part = [0.0, *places], [part[0], *part]
        if places[-1] < 1:
            places, part = [*places, 1.0], [*part, part[-1]]
        found = one_table(graph, value, places, part)
        total = found if total is None else operate(graph, "ADD", total, found)
    return total


def one_table(graph, value, positions, colours):
    parameters = {"input": value, "num": len(positions)}
    for i, (x, colour) in enumerate(zip(positions, colours)):
        if 0 < i < len(positions) - 1:
            parameters[f"weight_{i}"] = x
        parameters[f"color_{i}"] = tuple(colour)
    return graph.add("table", "mib_color_interpolate", **parameters)


def mix(graph, node, output):
    """Mix of both generations: MixRGB until 3.3, Mix from 3.4."""
    clamp, blend = getattr(node, "use_clamp", False), node.blend_type
    if node.type == "MIX":
        kind = node.data_type
        name = {"FLOAT": "Float", "VECTOR": "Vector", "RGBA": "Color"}[kind]
        inputs = {s.identifier: s for s in node.inputs}
        uniform = kind != "VECTOR" or node.factor_mode == "UNIFORM"
        factor = graph.value(inputs["Factor_Float" if uniform else "Factor_Vector"])
        a, b = (graph.value(inputs[f"{side}_{name}"]) for side in "AB")
        clamp, blend = kind == "RGBA" and node.clamp_result, blend if kind == "RGBA" else "MIX"
        if not uniform:
            difference = operate(graph, "SUBTRACT", b, a)
            return operate(graph, "MULTIPLY_ADD", difference, factor, a)
        if not node.clamp_factor and not isinstance(factor, mi.Connection) and \
                not 0 <= graph.scalar(factor) <= 1:
            return operate(graph, "MULTIPLY_ADD", operate(graph, "SUBTRACT", b, a), factor, a)
    else:
        factor = graph.value(versions.input_of(node, "Fac"))
        a, b = graph.value(node.inputs["Color1"]), graph.value(node.inputs["Color2"])
    return blended(graph, node, blend, graph.scalar(factor), a, b, clamp)


def blended(graph, node, blend, factor, a, b, clamp=False):
    if blend not in BLENDS:
        graph.unsupported(node, f"has the blending mode {blend}, which is replaced by mix")
        blend = "MIX"
    if blend == "MIX" and not clamp:
        return graph.blend(factor, a, b)
    if blend == "MULTIPLY" and not clamp and not any(isinstance(v, mi.Connection)
                                                     for v in (factor, a, b)):
        return graph.blend(min(max(factor, 0.0), 1.0), a, graph.product(a, b))
    values = {"clamp": True} if clamp else {}
    result = graph.add("blend", "oriel_blend", mode=BLENDS[blend], factor=factor,
                       below=graph.colour(a), above=graph.colour(b), **values)
    if blend in SIGNED and not clamp:
        graph.signed.add(result)
    return result


def ramp(graph, node, output):
    value = graph.scalar(graph.value(versions.input_of(node, "Fac")))
    band, alpha = node.color_ramp, output.identifier == "Alpha"
    if not isinstance(value, mi.Connection):
        rgba = band.evaluate(value)
        return rgba[3] if alpha else tuple(rgba)[:3]
    elements = sorted((e.position, tuple(e.color)) for e in band.elements)
    if band.interpolation == "LINEAR" and band.color_mode == "RGB" or len(elements) == 1:
        positions, colours = zip(*elements)
    elif band.interpolation == "CONSTANT":
        positions, colours = steps(elements)
    else:
        positions = [i / (RAMP_SAMPLES - 1) for i in range(RAMP_SAMPLES)]
        positions = sorted({*positions, *(p for p, _ in elements)})
        colours = [tuple(band.evaluate(x)) for x in positions]
    colours = [(c[3],) * 3 if alpha else c[:3] for c in colours]
    return table(graph, value, list(positions), colours)


def steps(elements):
    """Positions and colours of a ramp that is constant between its elements."""
    positions, colours = [0.0], [elements[0][1]]
    for position, colour in elements[1:]:
        before = max(position - STEP_WIDTH, positions[-1])
        positions += [before, max(position, before)]
        colours += [colours[-1], colour]
    return positions, colours


def invert(graph, node, output):
    value, factor = graph.value(node.inputs["Color"]), graph.value(versions.input_of(node, "Fac"))
    if isinstance(value, mi.Connection):
        inverse = operate(graph, "SUBTRACT", 1.0, value)
    else:
        inverse = tuple(1 - c for c in graph.colour(value))
    return graph.blend(graph.scalar(factor), value, inverse)


def math_node(graph, node, output):
    values = [graph.scalar(graph.value(s)) for s in node.inputs[:3]]
    if node.operation not in OPERATIONS:
        return None
    return operate(graph, node.operation, *values[:3], clamp=node.use_clamp)


def gamma(graph, node, output):
    value, power = graph.value(node.inputs["Color"]), graph.value(node.inputs["Gamma"])
    if isinstance(value, mi.Connection) or isinstance(power, mi.Connection):
        return operate(graph, "POWER", value, power)
    return tuple(max(c, 0.0) ** power for c in graph.colour(value))


def bright_contrast(graph, node, output):
    value, bright, contrast = (graph.value(node.inputs[k]) for k in ("Color", "Bright", "Contrast"))
    if any(isinstance(v, mi.Connection) for v in (bright, contrast)):
        return None
    slope = operate(graph, "MULTIPLY_ADD", value, 1 + contrast, bright - contrast / 2)
    return operate(graph, "MAXIMUM", slope, 0.0)


def hue_saturation(graph, node, output):
    names = {"hue": "Hue", "saturation": "Saturation", "value": "Value", "factor": "Fac"}
    values = {k: graph.scalar(graph.value(versions.input_of(node, n)))
              for k, n in names.items()}
    return graph.add("hue", "oriel_hue_saturation",
                     input=graph.colour(graph.value(node.inputs["Color"])), **values)


def clamp(graph, node, output):
    value, low, high = (graph.scalar(graph.value(s)) for s in node.inputs[:3])
    if not isinstance(low, mi.Connection) and not isinstance(high, mi.Connection) and \
            node.clamp_type == "RANGE" and low > high:
        low, high = high, low
    return operate(graph, "MINIMUM", operate(graph, "MAXIMUM", value, low), high)


def curves(graph, node, output):
    """RGB curves in 0 to 1: the curve of all channels, then that of each."""
    value, factor = graph.value(node.inputs["Color"]), graph.scalar(graph.value(versions.input_of(node, "Fac")))
    mapping = node.mapping
    mapping.initialize()
    def curved(x, channel):
        return mapping.evaluate(mapping.curves[channel], mapping.evaluate(mapping.curves[3], x))
    if not isinstance(value, mi.Connection):
        result = tuple(curved(c, i) for i, c in enumerate(graph.colour(value)))
        return graph.blend(factor, value, result)
    positions = [i / (CURVE_SAMPLES - 1) for i in range(CURVE_SAMPLES)]
    total = None
    for i in range(3):
        unit = tuple(float(k == i) for k in range(3))
        colours = [tuple(curved(x, i) * u for u in unit) for x in positions]
        part = table(graph, graph.channel(value, i), positions, colours)
        total = part if total is None else operate(graph, "ADD", total, part)
    return graph.blend(factor, value, total)


def float_curve(graph, node, output):
    value = graph.scalar(graph.value(node.inputs["Value"]))
    factor = graph.scalar(graph.value(versions.input_of(node, "Factor")))
    node.mapping.initialize()
    positions = [i / (CURVE_SAMPLES - 1) for i in range(CURVE_SAMPLES)]
    results = [(node.mapping.evaluate(node.mapping.curves[0], x),) * 3 for x in positions]
    if not isinstance(value, mi.Connection):
        result = node.mapping.evaluate(node.mapping.curves[0], value)
    else:
        result = table(graph, value, positions, results)
    return graph.blend(factor, value, result)


def combine(graph, node, output):
    """Three numbers as a colour or vector."""
    if getattr(node, "mode", "RGB") != "RGB":
        return None
    values = [graph.scalar(graph.value(s)) for s in node.inputs[:3]]
    if not any(isinstance(v, mi.Connection) for v in values):
        return tuple(values)
    total = None
    for i, value in enumerate(values):
        unit = tuple(float(k == i) for k in range(3))
        part = operate(graph, "MULTIPLY", value, unit)
        total = part if total is None else operate(graph, "ADD", total, part)
    return total


def separate(graph, node, output):
    value = graph.value(node.inputs[0])
    names = {"R": 0, "G": 1, "B": 2, "X": 0, "Y": 1, "Z": 2, "Red": 0, "Green": 1, "Blue": 2}
    if getattr(node, "mode", "RGB") != "RGB" or output.identifier not in names:
        return None
    return graph.channel(value, names[output.identifier])


def grey(graph, node, output):
    return luminance(graph, graph.value(node.inputs[0]))


def facing(graph, node, mode, **values):
    """A weight by the angle between normal and view."""
    normal = node.inputs.get("Normal")
    if normal is not None and normal.is_linked:
        graph.unsupported(node, "has a linked normal, which is ignored")
    return graph.add("facing", "oriel_facing", mode=mode, **values)


def fresnel(graph, node, output):
    return facing(graph, node, 1, ior=graph.scalar(graph.value(node.inputs["IOR"])))


def layer_weight(graph, node, output):
    blend = graph.scalar(graph.value(node.inputs["Blend"]))
    if output.identifier == "Facing":
        return facing(graph, node, 2, blend=blend)
    if isinstance(blend, mi.Connection):
        return None
    return facing(graph, node, 1, ior=1 / max(1 - blend, 1e-5))


def gradient(graph, node, output):
    point = graph.coordinate(node.inputs["Vector"], "generated")
    x = graph.channel(point, 0)
    if node.gradient_type == "LINEAR":
        return operate(graph, "ADD", x, 0.0, clamp=True)
    if node.gradient_type == "QUADRATIC":
        return operate(graph, "POWER", operate(graph, "MAXIMUM", x, 0.0), 2.0, clamp=True)
    if node.gradient_type == "EASING":
        return table(graph, x, [i / 16 for i in range(17)],
                     [((i / 16) ** 2 * (3 - i / 8),) * 3 for i in range(17)])
    if node.gradient_type == "DIAGONAL":
        half = operate(graph, "ADD", x, graph.channel(point, 1))
        return operate(graph, "MULTIPLY", half, 0.5, clamp=True)
    if node.gradient_type == "RADIAL":
        angle = operate(graph, "ARCTAN2", graph.channel(point, 1), x)
        return operate(graph, "MULTIPLY_ADD", angle, 0.5 / math.pi, 0.5, clamp=True)
    squares = graph.add("sum", "mib_color_average", factor=3.0,
                        input=operate(graph, "MULTIPLY", point, point))
    ball = operate(graph, "SUBTRACT", 0.999999, operate(graph, "SQRT", squares))
    ball = operate(graph, "MAXIMUM", ball, 0.0)
    return ball if node.gradient_type == "SPHERICAL" else operate(graph, "MULTIPLY", ball, ball)


TRANSLATORS = {
    "MIX_RGB": mix, "MIX": mix, "VALTORGB": ramp, "INVERT": invert, "MATH": math_node,
    "GAMMA": gamma, "BRIGHTCONTRAST": bright_contrast,
    "HUE_SAT": hue_saturation, "CLAMP": clamp, "CURVE_RGB": curves,
    "CURVE_FLOAT": float_curve, "COMBRGB": combine, "COMBINE_COLOR": combine, "COMBXYZ": combine,
    "SEPRGB": separate, "SEPARATE_COLOR": separate, "SEPXYZ": separate, "RGBTOBW": grey,
    "FRESNEL": fresnel, "LAYER_WEIGHT": layer_weight, "TEX_GRADIENT": gradient,
}
