# SPDX-License-Identifier: Apache-2.0
"""Values of node sockets: constants, or shaders of the base library that compute them."""
import numpy

from . import arithmetic, image_nodes, mi, textures, vectors, world as links

CONSTANT = object()


class Graph:
    """Translates the node trees of one material. Unsupported nodes are reported once each."""

    def __init__(self, out, images, material, report, spaces, values=None):
        self.out = out
        self.images = images
        self.material = material
        self.report = report
        self.spaces = spaces    # of the whole scene: ("uv", layer) or ("colour", attribute)
        self.displacement = None  # node of a displacement that is rendered as bump
        self.nested = 0         # depth inside of mixed and added surfaces
        self.used = 0           # number of texture spaces that the mesh must have
        self.values = values or {}  # of the object, by the names of variants.needs()
        self.signed = set()     # connections whose values can be negative
        self._cache = {}
        self._groups = []       # group nodes around the current tree

    def unsupported(self, node, what="is unsupported and replaced by its default"):
        self.report(f'material "{self.material}": node "{node.name}" ({node.bl_label}) {what}')

    def space(self, kind, name):
        """Index of a texture space, added if new."""
        key = kind, name
        if key not in self.spaces:
            self.spaces.append(key)
        index = self.spaces.index(key)
        self.used = max(self.used, index + 1)
        return index

    # Links ------------------------------------------------------------------------------------
    def origin(self, socket):
        """The output socket that feeds an input, and its node, through groups; None if unlinked."""
        while socket is not None and socket.is_linked:
            link = socket.links[0]
            node, output = link.from_node, link.from_socket
            if node.type == "REROUTE":
                socket = node.inputs[0]
            elif node.mute:
                inner = [l for l in node.internal_links if l.to_socket == output]
                socket = inner[0].from_socket if inner else None
            elif node.type == "GROUP" and node.node_tree:
                inner = links.output_node(node.node_tree, "GROUP_OUTPUT")
                inside = next((s for s in inner.inputs if s.identifier == output.identifier), None) \
                    if inner else None
                if inside is None:
                    return None
                self._groups.append(node)
                if not inside.is_linked:
                    return CONSTANT, inside
                socket = inside
            elif node.type == "GROUP_INPUT" and self._groups:
                group = self._groups.pop()
                socket = next((s for s in group.inputs if s.identifier == output.identifier), None)
                if socket is not None and not socket.is_linked:
                    return CONSTANT, socket
            else:
                return node, output
        return None

    def baked(self, socket):
        """The image that bake.py made for a linked input, as origin()."""
        from . import bake
        node = bake.find(socket) if socket is not None and socket.is_linked else None
        return (node, node.outputs["Color"]) if node is not None and node.image else None

    def constant(self, socket):
        if not hasattr(socket, "default_value"):
            return 0.0
        value = socket.default_value
        if isinstance(value, (int, float, bool)):
            return float(value)
        if isinstance(value, str):
            return 0.0
        return tuple(value)[:3]

    def value(self, socket):
        """A number, a tuple of three numbers, or a connection."""
        groups = list(self._groups)
        try:
            found = self.baked(socket) or self.origin(socket)
            if found is None:
                return self.constant(socket)
            node, output = found
            if node is CONSTANT:
                return self.constant(output)
            key = tuple(g.as_pointer() for g in self._groups), node.as_pointer(), output.identifier
            if key not in self._cache:
                self._cache[key] = self.constant(socket)  # ends cycles
                self._cache[key] = self.translate(node, output, socket)
            if socket.type != "VALUE" or output.type != "RGBA":
                return self._cache[key]
            if ("grey", key) not in self._cache:
                self._cache["grey", key] = arithmetic.luminance(self, self._cache[key])
            return self._cache["grey", key]
        finally:
            self._groups = groups

    def translate(self, node, output, socket):
        method = TRANSLATORS.get(node.type)
        if method is None and node.bl_idname.startswith("OrielNode_"):
            from . import native
            return native.call_of_node(self, node)
        result = method(self, node, output) if method else None
        if result is None:
            self.unsupported(node)
            return self.constant(socket)
        return result

    # Helpers ----------------------------------------------------------------------------------
    def add(self, suffix, shader, **parameters):
        return self.out.shader_of(f"{self.material}.{suffix}", shader, parameters)

    def colour(self, value):
        """A colour as a parameter."""
        if isinstance(value, mi.Connection):
            return value
        if isinstance(value, tuple):
            return value
        return (value,) * 3

    def scalar(self, value):
        if isinstance(value, tuple):
            return 0.2126 * value[0] + 0.7152 * value[1] + 0.0722 * value[2]
        return value

    def affine(self, value, low, high):
        """low + (high - low) x for a value x in 0 to 1."""
        if isinstance(value, mi.Connection):
            return self.add("range", "mib_color_interpolate", input=value, num=2,
                            color_0=(low,) * 3, color_1=(high,) * 3)
        return low + (high - low) * value

    def curve(self, value, function, count=8):
        """function(x) of a value in 0 to 1, as a table of at most eight entries."""
        if not isinstance(value, mi.Connection):
            return function(value)
        steps = [i / (count - 1) for i in range(count)]
        table = {"input": value, "num": count}
        table.update({f"weight_{i}": steps[i] for i in range(1, count - 1)})
        table.update({f"color_{i}": (function(x),) * 3 for i, x in enumerate(steps)})
        return self.out.shader_of(f"{self.material}.curve", "mib_color_interpolate", table)

    def product(self, a, b):
        """a times b, for numbers, colours and connections."""
        if not isinstance(a, mi.Connection) and not isinstance(b, mi.Connection):
            if isinstance(a, tuple) or isinstance(b, tuple):
                return tuple(x * y for x, y in zip(self.colour(a), self.colour(b)))
            return a * b
        if b == 1.0 or b == (1.0, 1.0, 1.0):
            return a
        if a == 1.0 or a == (1.0, 1.0, 1.0):
            return b
        return self.mix("product", 4, 1.0, a, b)

    def mix(self, suffix, mode, weight, below, above):
        return self.add(suffix, "mib_color_mix", num=1, mode_0=mode, weight_0=weight,
                        color_0=self.colour(above), color_base=self.colour(below))

    def channel(self, value, index):
        """One channel of a colour."""
        if isinstance(value, tuple):
            return value[index]
        if not isinstance(value, mi.Connection):
            return value
        mask = tuple(1.0 if i == index else 0.0 for i in range(3))
        masked = self.mix("channel", 4, 1.0, value, mask)
        return self.add("channel", "mib_color_average", input=masked, factor=3.0)

    def blend(self, factor, a, b):
        """a (1 - factor) + b factor."""
        if not isinstance(factor, mi.Connection):
            if factor <= 0:
                return a
            if factor >= 1:
                return b
            if not any(isinstance(v, (mi.Connection, tuple)) for v in (a, b)):
                return a + (b - a) * factor
            if not isinstance(a, mi.Connection) and not isinstance(b, mi.Connection):
                return tuple(x + (y - x) * factor for x, y in zip(self.colour(a), self.colour(b)))
        return self.mix("mix", 1, factor, a, b)

    # Nodes ------------------------------------------------------------------------------------
    def coordinate(self, socket, generated="uv"):
        """A texture coordinate: a connection to a vector.

        generated: what an unlinked socket has, "uv" or "generated".
        """
        found = self.origin(socket)
        if found is None or found[0] is CONSTANT:
            if generated == "uv":
                return self.uv("")
            return self.generated()
        node, output = found
        groups = list(self._groups)
        try:
            return self.coordinate_of(node, output)
        finally:
            self._groups = groups

    def uv(self, name):
        return self.add("uv", "mib_texture_vector", select=self.space("uv", name), selspace=1)

    def generated(self):
        """Coordinates that are 0 to 1 in the box of the object."""
        point = self.add("point", "mib_texture_vector", select=-1, selspace=1)
        if "Generated" not in self.values:
            return point
        corner, size = self.values["Generated"]
        matrix = numpy.diag([*(1 / s for s in size), 1.0])
        matrix[:3, 3] = [-c / s for c, s in zip(corner, size)]
        return self.remapped("generated", point, matrix)

    def remapped(self, suffix, coordinate, matrix):
        return self.add(suffix, "mib_texture_remap", input=coordinate,
                        transform=tuple(numpy.asarray(matrix).T.ravel()))

    def coordinate_of(self, node, output):
        if node.type == "UVMAP":
            return self.uv(node.uv_map)
        if node.type == "TEX_COORD":
            return self.texture_coordinate(node, output.identifier)
        if node.type == "NEW_GEOMETRY":
            return self.geometry(node, output)
        if node.type == "MAPPING":
            return self.mapping(node)
        method = TRANSLATORS.get(node.type)
        result = method(self, node, output) if method else None
        if result is None:
            self.unsupported(node, "is unsupported as a coordinate and replaced by UV")
            return self.uv("")
        if isinstance(result, mi.Connection):
            return result
        return self.add("constant", "oriel_math", operation=0, input1=self.colour(result),
                        input2=(0.0,) * 3)

    def texture_coordinate(self, node, name):
        if name == "UV":
            return self.uv("")
        if name == "Generated":
            return self.generated()
        if name == "Normal":
            return self.add("normal", "mib_texture_vector", select=-2, selspace=1)
        if name == "Window":
            return self.add("window", "mib_texture_vector", select=-1, selspace=4)
        if name == "Object" and node.object is not None:
            inverse = numpy.linalg.inv(numpy.array(node.object.matrix_world, numpy.float64))
            world = self.add("world_point", "mib_texture_vector", select=-1, selspace=2)
            return self.remapped("object_point", world, inverse)
        if name in {"Camera", "Reflection"}:
            self.unsupported(node, f"has {name.lower()} coordinates, which are read as object "
                                   "coordinates")
        return self.add("point", "mib_texture_vector", select=-1, selspace=1)

    def geometry(self, node, output):
        name = output.identifier
        if name == "Backfacing":
            return self.add("facing", "oriel_facing", mode=4)
        if name == "Incoming":
            ray = self.add("ray", "mib_texture_vector", select=-10, selspace=2)
            return self.remapped("incoming", ray, numpy.diag([-1.0, -1.0, -1.0, 1.0]))
        if name not in {"Position", "Normal", "True Normal"}:
            return None
        return self.add("world_point", "mib_texture_vector", select=-2 if "ormal" in name else -1,
                        selspace=2)

    def object_info(self, node, output):
        return self.values.get(output.name)

    def light_path(self, node, output):
        """1 for the rays of an output, else 0."""
        kinds = {"Is Camera Ray": ("eye", "transparent"), "Is Shadow Ray": ("shadow",),
                 "Is Diffuse Ray": ("finalgather",), "Is Glossy Ray": ("reflection",),
                 "Is Reflection Ray": ("reflection", "finalgather"),
                 "Is Transmission Ray": ("refraction",)}.get(output.identifier)
        if kinds is None:
            return None
        return self.add("rays", "mip_rayswitch", **{kind: (1.0,) * 3 for kind in kinds})

    def mapping(self, node):
        inner = self.coordinate(node.inputs["Vector"])
        values = {n: self.vector(self.value(node.inputs[n]))
                  for n in ("Location", "Rotation", "Scale") if n in node.inputs}
        matrix = mapping_matrix(node, values)
        if matrix is not None:
            return self.add("mapping", "mib_texture_remap", input=inner,
                            transform=tuple(matrix.T.ravel()))
        if isinstance(values["Rotation"], mi.Connection) or node.vector_type == "NORMAL":
            self.unsupported(node, "has linked or singular values, which are ignored")
            return inner
        return self.mapped_by_links(node.vector_type, inner, values)

    def vector(self, value):
        """A number as a vector of equal components."""
        return (value,) * 3 if isinstance(value, (int, float)) else value

    def mapped_by_links(self, kind, inner, values):
        """A mapping whose location or scale is computed by nodes."""
        matrix = numpy.eye(4)
        matrix[:3, :3] = rotation_matrix(values["Rotation"])
        place = values.get("Location", (0.0,) * 3)
        if kind == "TEXTURE":
            moved = arithmetic.operate(self, "SUBTRACT", inner, place)
            turned = self.remapped("turned", moved, matrix.T)
            return arithmetic.operate(self, "DIVIDE", turned, values["Scale"])
        scaled = arithmetic.operate(self, "MULTIPLY", inner, values["Scale"])
        turned = self.remapped("turned", scaled, matrix)
        return turned if kind == "VECTOR" else arithmetic.operate(self, "ADD", turned, place)

    def checker(self, node, output):
        half = arithmetic.operate(self, "MULTIPLY", self.scalar(self.value(node.inputs["Scale"])), .5)
        point = self.coordinate(node.inputs["Vector"], "generated")
        scaled = arithmetic.operate(self, "MULTIPLY", point, half)
        wrapped = self.add("checks", "mib_texture_remap", input=scaled, torus_x=True, torus_y=True,
                           torus_z=True)
        if output.identifier == "Fac":
            a, b = (1.0,) * 3, (0.0,) * 3
        else:
            a, b = (self.colour(self.value(node.inputs[k])) for k in ("Color1", "Color2"))
        boxes = {f"color{x}{y}{z}": a if (x + y + z) % 2 == 1 else b
                 for x in (0, 1) for y in (0, 1) for z in (0, 1)}
        return self.add("checker", "mib_texture_checkerboard", coord=wrapped, xsize=0.5, ysize=0.5,
                        zsize=0.5, **boxes)

    def vertex_colour(self, node, output):
        name = getattr(node, "layer_name", "") or getattr(node, "attribute_name", "")
        if output.identifier == "Alpha":
            return None
        if ("attribute", name) in self.values:
            value = self.values["attribute", name]
            return value if output.identifier != "Fac" or not isinstance(value, tuple) else \
                sum(value) / 3
        colour = self.add("vertex_colour", "oriel_vertex_color", color=(1.0, 1.0, 1.0),
                          space=self.space("colour", name))
        if output.identifier == "Fac":
            return self.add("mean", "mib_color_average", input=colour, factor=1.0)
        return colour

    def occlusion(self, node, output):
        """The share of the hemisphere that is free of objects within the distance."""
        if node.inside or node.only_local or node.inputs["Normal"].is_linked:
            self.unsupported(node, "is read as occlusion outside, by all objects and the normal of the "
                                   "surface")
        distance = self.scalar(self.value(node.inputs["Distance"]))
        if isinstance(distance, mi.Connection):
            return None
        share = self.add("occlusion", "mib_amb_occlusion", samples=node.samples, bright=(1.0,) * 3,
                         dark=(0.0,) * 3, spread=1.0, max_distance=distance, falloff=0.0)
        return share if output.identifier == "AO" else \
            self.product(share, self.colour(self.value(node.inputs["Color"])))

    def rgb_constant(self, node, output):
        return self.constant(node.outputs[0])

    def blackbody_constant(self, node, output):
        from . import lights
        kelvin = self.value(node.inputs[0])
        return None if isinstance(kelvin, mi.Connection) else lights.blackbody(kelvin)


def rotation_matrix(angles):
    from mathutils import Euler
    return numpy.array(Euler(angles, "XYZ").to_matrix(), numpy.float64)


def mapping_matrix(node, get):
    """The 4x4 matrix of a Mapping node for column vectors; None if its values are linked or singular.

    get: location, rotation and scale.
    """
    if any(isinstance(value, mi.Connection) for value in get.values()):
        return None
    rotation = rotation_matrix(get["Rotation"])
    scale = numpy.diag(get["Scale"])
    matrix = numpy.eye(4)
    kind = node.vector_type
    matrix[:3, :3] = rotation @ scale
    if kind in {"POINT", "TEXTURE"}:
        matrix[:3, 3] = get.get("Location", (0, 0, 0))
    if kind == "NORMAL":
        matrix[:3, :3] = rotation @ numpy.linalg.inv(scale) if numpy.all(numpy.diag(scale)) else \
            rotation
    if kind == "TEXTURE":
        if abs(numpy.linalg.det(matrix)) < 1e-30:
            return None
        matrix = numpy.linalg.inv(matrix)
    return matrix


TRANSLATORS = {
    **arithmetic.TRANSLATORS, **textures.TRANSLATORS, **image_nodes.TRANSLATORS,
    **vectors.TRANSLATORS, "AMBIENT_OCCLUSION": Graph.occlusion,
    "TEX_CHECKER": Graph.checker,
    "VERTEX_COLOR": Graph.vertex_colour, "ATTRIBUTE": Graph.vertex_colour,
    "OBJECT_INFO": Graph.object_info, "LIGHT_PATH": Graph.light_path,
    "TEX_COORD": Graph.coordinate_of, "UVMAP": Graph.coordinate_of,
    "MAPPING": Graph.coordinate_of, "NEW_GEOMETRY": Graph.coordinate_of,
    "RGB": Graph.rgb_constant, "VALUE": Graph.rgb_constant, "BLACKBODY": Graph.blackbody_constant,
}
