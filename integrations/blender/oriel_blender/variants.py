# SPDX-License-Identifier: Apache-2.0
"""Values of objects that materials read: a material is written once for each set of them."""
import numpy

TEXTURES_BY_GENERATED = {"TEX_NOISE", "TEX_VORONOI", "TEX_MUSGRAVE", "TEX_WAVE", "TEX_MAGIC",
                         "TEX_BRICK", "TEX_CHECKER", "TEX_GRADIENT", "TEX_WHITE_NOISE"}
RANDOM_STEPS = 256  # of random numbers of objects, so that thousands of instances share materials
INFORMATION = {"Location", "Color", "Object Index", "Random", "Alpha"}


def needs(tree, seen=None):
    """Names of the values of objects that the nodes of a tree read; attributes as tuples."""
    seen = set() if seen is None else seen
    found = set()
    if tree is None or tree.name_full in seen:
        return found
    seen.add(tree.name_full)
    for node in tree.nodes:
        if node.type == "OBJECT_INFO":
            found |= {o.name for o in node.outputs if o.is_linked and o.name in INFORMATION}
        elif node.type == "ATTRIBUTE" and getattr(node, "attribute_type", "") in {"OBJECT",
                                                                                 "INSTANCER"}:
            found.add(("attribute", node.attribute_name))
        elif node.type == "TEX_COORD" and any(o.is_linked for o in node.outputs
                                              if o.identifier == "Generated"):
            found.add("Generated")
        elif node.type in TEXTURES_BY_GENERATED and "Vector" in node.inputs and \
                not node.inputs["Vector"].is_linked:
            found.add("Generated")
        elif node.type == "GROUP":
            found |= needs(node.node_tree, seen)
    return found


def attribute(ob, name):
    """A custom property or property of an object or of its data, as a number or three numbers."""
    for owner in (ob, ob.data):
        if owner is None:
            continue
        value = owner.get(name)
        if value is None:
            value = getattr(owner, name, None)
        if isinstance(value, (bool, int, float)):
            return float(value)
        try:
            numbers = [float(v) for v in value]
        except (TypeError, ValueError):
            continue
        if len(numbers) >= 3:
            return tuple(numbers[:3])
    return 0.0


def texture_space(ob):
    """Corner and size of the box in which generated coordinates are 0 to 1."""
    data = ob.data
    if hasattr(data, "texspace_location"):
        centre, half = numpy.array(data.texspace_location), numpy.array(data.texspace_size)
    else:
        corners = numpy.array([tuple(c) for c in ob.bound_box])
        low, high = corners.min(axis=0), corners.max(axis=0)
        centre, half = (low + high) / 2, (high - low) / 2
    half = numpy.where(half > 0, half, 1.0)
    return tuple(float(x) for x in centre - half), tuple(float(x) for x in 2 * half)


def random_of(name, instance_id):
    """The number of 0 to 1 that Cycles has for an object, or for the number of an instance."""
    if instance_id is not None:
        return (instance_id & 0xFFFFFFFF) / 0xFFFFFFFF
    key = 0
    for byte in name.encode():
        key = (key * 37 + byte) & 0xFFFFFFFF
    return mixed(key, 0) / 0xFFFFFFFF


def mixed(first, second):
    """A hash of two numbers (Jenkins, lookup3, final)."""
    def turned(x, k):
        return (x << k | x >> (32 - k)) & 0xFFFFFFFF
    start = (0xdeadbeef + (2 << 2) + 13) & 0xFFFFFFFF
    v = [(start + first) & 0xFFFFFFFF, (start + second) & 0xFFFFFFFF, start]
    for into, source, k in ((2, 1, 14), (0, 2, 11), (1, 0, 25), (2, 1, 16), (0, 2, 4), (1, 0, 14),
                            (2, 1, 24)):
        v[into] = ((v[into] ^ v[source]) - turned(v[source], k)) & 0xFFFFFFFF
    return v[2]


def values_of(wanted, ob, placed):
    """The values of an instance by the names of needs()."""
    result = {}
    for name in wanted:
        if isinstance(name, tuple):
            result[name] = attribute(ob, name[1])
        elif name == "Random":
            number = random_of(ob.name, placed.random_id if placed.is_instance else None)
            result[name] = (min(int(number * RANDOM_STEPS), RANDOM_STEPS - 1) + .5) / RANDOM_STEPS
        elif name == "Color":
            result[name] = tuple(ob.color)[:3]
        elif name == "Alpha":
            result[name] = float(ob.color[3])
        elif name == "Location":
            result[name] = tuple(float(x) for x in placed.matrix[:3, 3])
        elif name == "Object Index":
            result[name] = float(ob.pass_index)
        elif name == "Generated":
            result[name] = texture_space(ob)
    return result
