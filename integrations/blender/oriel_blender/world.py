# SPDX-License-Identifier: Apache-2.0
"""The world: colours, pictures, and sun and sky."""
import math

import numpy

from . import arithmetic, lights, mi, versions


def output_node(tree, kind):
    """The active output node of a node tree."""
    outputs = [n for n in tree.nodes if n.type == kind]
    active = [n for n in outputs if getattr(n, "is_active_output", False)]
    return (active or outputs or [None])[0]


def source_of(socket):
    """The node linked to a socket, through reroutes and muted nodes; None without a link."""
    while socket.is_linked:
        link = socket.links[0]
        node = link.from_node
        if node.type == "REROUTE":
            socket = node.inputs[0]
        elif node.mute and node.internal_links:
            inner = [l for l in node.internal_links if l.to_socket == link.from_socket]
            if not inner:
                return None
            socket = inner[0].from_socket
        else:
            return node
    return None


def direction_of_sky(rotation, elevation):
    return (math.sin(rotation) * math.cos(elevation), math.cos(rotation) * math.cos(elevation),
            math.sin(elevation))


# Kinds of rays that see the world, and those of mip_rayswitch.
VISIBILITY = {"camera": ("eye", "transparent"), "diffuse": ("finalgather",),
              "glossy": ("reflection",), "transmission": ("refraction",)}


class WorldWriter:
    """Writes the environment shader of a world and, for a sky, the sun."""

    def __init__(self, out, images, report, baker=None):
        """baker: renders worlds that the program has no shaders for (world_bake.Baker)."""
        self.out = out
        self.images = images
        self.report = report
        self.baker = baker
        self.shows_disc = False  # the camera sees the disc of the sun

    def constant(self, rgb):
        """A constant environment. Environments return pi times their radiance only in lux."""
        return self.out.shader("world", "mib_color_mix", num=0, color_base=tuple(rgb) + (1.0,))

    def write(self, world):
        """Returns the name of the environment shader, or None for black."""
        if world is None:
            return None
        name = self.shader_of(world)
        hidden = [kind for kind in VISIBILITY if not versions.world_is_visible(world, kind)]
        if not hidden or name is None:
            return name
        # The switch evaluates shaders that can be materials as surfaces, and oriel_math as a value.
        seen = self.out.shader("world.seen", "oriel_math", operation=0, input1=name,
                               input2=(0.0, 0.0, 0.0))
        return self.out.shader_of("world.visibility", "mip_rayswitch", {
            kind: (0.0, 0.0, 0.0, 1.0) if ray in hidden else seen
            for ray, kinds in VISIBILITY.items() for kind in kinds})

    def shader_of(self, world):
        if not world.use_nodes or world.node_tree is None:
            return self.constant(world.color)
        own = world.node_tree.nodes.get("Oriel Output")
        node = source_of(own.inputs["Surface"]) if own else None
        if node is not None and node.bl_idname.startswith("OrielNode_"):
            return self.native(world, node)
        output = output_node(world.node_tree, "OUTPUT_WORLD")
        node = source_of(output.inputs["Surface"]) if output else None
        if node is None:
            return None
        if node.type != "BACKGROUND" or node.inputs["Strength"].is_linked:
            return self.baked(world, None)
        strength = node.inputs["Strength"].default_value
        source = source_of(node.inputs["Color"])
        if source is None and not node.inputs["Color"].is_linked:
            rgb = node.inputs["Color"].default_value
            return self.constant([c * strength for c in rgb[:3]])
        if source is not None and source.type == "TEX_ENVIRONMENT" and self.is_turned(source) and \
                source.projection == "EQUIRECTANGULAR":
            return self.picture(world, source, strength)
        if source is not None and source.type == "TEX_SKY":
            return self.sky(world, source, strength)
        return self.baked(world, None)

    def native(self, world, node):
        """The environment of native nodes."""
        from . import native, nodes
        graph = nodes.Graph(self.out, self.images, world.name, self.report, [("uv", "")])
        return native.call_of_node(graph, node)

    @staticmethod
    def is_turned(node):
        """Whether the coordinates of a texture are directions that are only rotated."""
        mapping = source_of(node.inputs["Vector"])
        if mapping is None or mapping.type == "TEX_COORD":
            return True
        inner = source_of(mapping.inputs["Vector"]) if mapping.type == "MAPPING" else None
        return inner is not None and inner.type == "TEX_COORD" and not any(
            mapping.inputs[n].is_linked for n in ("Rotation", "Scale") if n in mapping.inputs) and \
            tuple(mapping.inputs["Scale"].default_value) == (1, 1, 1)

    def baked(self, world, sun, approximation=None):
        """A picture of the world by Cycles. sun: direction and angle of its disc.

        approximation: writes what is shown while the picture is not finished, or if it fails.
        """
        instead = approximation or (lambda: self.constant([0.0] * 3))
        try:
            found = self.baker.bake(world, sun) if self.baker else None
        except (RuntimeError, OSError, ValueError) as error:
            self.report(f'world "{world.name}": {error}; '
                        + ("another sky is used" if approximation else "it is black"))
            return instead()
        if found is None:
            return instead()
        if sun and found.sun and max(found.sun) > 0:
            self.disc(sun, found.sun)
        texture = self.out.names.unique("world.image")
        self.out.add(f"vector texture {mi.quoted(texture)} {mi.quoted(found.picture)}\n")
        return self.look(texture, numpy.eye(3))

    def disc(self, sun, irradiance):
        """The disc of the sun as a distant light that the camera sees."""
        self.shows_disc = True
        name = self.out.names.unique("sun.light")
        self.out.light(name, *lights.sun_disc(irradiance, sun["angle"] / 2, True))
        self.out.instance(self.out.names.unique("Sun"), name, facing(sun["direction"]))

    def rotation(self, world, node):
        """Rotation of the Mapping node in front of a texture, as a 3x3 matrix."""
        mapping = source_of(node.inputs["Vector"])
        if mapping is None or mapping.type == "TEX_COORD":
            return numpy.eye(3)
        if mapping.type != "MAPPING":
            self.report(f'world "{world.name}": node "{mapping.name}" is unsupported and ignored')
            return numpy.eye(3)
        from mathutils import Euler
        angles = mapping.inputs["Rotation"].default_value
        matrix = numpy.array(Euler(angles, "XYZ").to_matrix(), numpy.float64)
        return matrix.T if mapping.vector_type == "TEXTURE" else matrix

    def picture(self, world, node, strength):
        texture = self.images.texture(node.image, world.name, node.name,
                                      user=getattr(node, "image_user", None))
        if texture is None:
            return self.constant((1.0 * strength, 0.0, 1.0 * strength))
        look = self.look(texture, self.rotation(world, node))
        if self.images.is_encoded(node.image):
            look = self.out.shader("world.decoded", "oriel_math", input1=look,
                                   operation=arithmetic.OPERATIONS["SRGB_OF_GAMMA"])
        return self.scaled(look, strength)

    def look(self, texture, rotation):
        """A picture of all directions, turned by a 3x3 matrix."""
        # Look-ups turn about y; the centre of the picture is -z for them and +x in Blender.
        turn = numpy.array([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]])
        matrix = numpy.eye(4)
        matrix[:3, :3] = (turn @ rotation).T
        ray = self.out.shader("world.ray", "mib_texture_vector", select=-10, selspace=2)
        turned = self.out.shader("world.turned", "mib_texture_remap", input=ray,
                                 transform=tuple(matrix.ravel()))
        return self.out.shader("world.picture", "mib_lookup_spherical", dir=turned,
                               tex=mi.Words(mi.quoted(texture)))

    def scaled(self, look, strength):
        return self.out.shader("world", "mib_color_mix", num=1, mode_0=4, weight_0=1.0,
                               color_0=(strength, strength, strength, 1.0), color_base=look)

    def sky(self, world, node, strength):
        """A sky texture: its picture, or the physical sky of the program by a setting of the world."""
        if node.sky_type in {"PREETHAM", "HOSEK_WILKIE"}:
            direction = tuple(node.sun_direction)
            disc, size, intensity = False, math.radians(0.533), 1.0
            haze = max(node.turbidity - 2.0, 0.0)
        else:
            direction = direction_of_sky(node.sun_rotation, node.sun_elevation)
            disc, size, intensity = node.sun_disc, node.sun_size, node.sun_intensity
            haze = min(max(versions.sky_dust(node) - 1.0, 0.0) * 1.5, 15.0)
        direction = tuple(self.rotation(world, node).T @ numpy.array(direction))

        def physical():
            return sun_and_sky(self.out, direction, haze, strength / 683.0, disc, size, intensity)
        settings = getattr(world.original, "oriel", None)
        if settings is not None and settings.sky_model == "PHYSICAL":
            return physical()
        sun = {"direction": [float(c) for c in direction], "angle": size} if disc else None
        return self.baked(world, sun, physical)


def facing(direction):
    """The matrix of a light that shines from a direction."""
    z = numpy.array(direction, numpy.float64)
    z /= numpy.linalg.norm(z)
    x = numpy.cross((0.0, 0.0, 1.0), z)
    x = numpy.array((1.0, 0.0, 0.0)) if numpy.linalg.norm(x) < 1e-6 else x / numpy.linalg.norm(x)
    matrix = numpy.eye(4)
    matrix[:3, :3] = numpy.array([x, numpy.cross(z, x), z]).T
    return matrix


def sun_and_sky(out, direction, haze, per_lux, disc=True, size=math.radians(0.533), intensity=1.0):
    """Writes mia_physicalsky and mia_physicalsun; returns the name of the sky.

    per_lux: W/m2 of a lux (1/683 for a sky in Blender's units).
    """
    conversion = (per_lux / math.pi,) * 3
    common = {"rgb_unit_conversion": conversion, "haze": haze}
    matrix = facing(direction)
    if disc and intensity > 0:
        sun = out.names.unique("sun.light")
        instance = out.names.unique("Sun and sky")
        softness = size / math.radians(0.533)
        out.light(sun, mi.call_of("mia_physicalsun", {
            **common, "multiplier": intensity, "shadow_softness": softness, "samples": 8}),
            "  direction 0 0 -1\n")
        out.instance(instance, sun, matrix)
        link = {"sun": mi.Words(mi.quoted(instance))}
    else:
        link = {"sun_direction": tuple(matrix[:3, 2]), "sun_disk_intensity": 0.0, "sun_glow_intensity": 0.0}
    return out.shader_of("world", "mia_physicalsky", {**common, **link, "sun_disk_scale": 1.0})
