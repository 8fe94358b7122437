# SPDX-License-Identifier: Apache-2.0
"""Materials: surface nodes of Blender as mia_material_x."""
import math

from . import (arithmetic, closures, layers, mi, microfacets, nodes, variants, versions,
               world as links)
from .surface import Surface, f0_of_ior, gloss_of_roughness, single_scattering

ROUNDED = 0.4  # share of the radius of Bevel that is rounded: the nearest to Cycles, on cubes


def retro_reflective(graph, colour, roughness):
    """The Lambertian colour with the directional albedo of the diffuse lobe of Principled until
    3.6."""
    def part(i):
        return graph.curve(roughness, lambda r: microfacets.diffuse_curve(round(r, 3))[i])
    edge = graph.add("edge", "oriel_facing", mode=3)
    albedo = arithmetic.operate(graph, "MULTIPLY_ADD", edge, part(1), part(0))
    return graph.product(colour, albedo)


class Principled:
    """Reads the sockets of a Principled BSDF under their names in all versions."""

    def __init__(self, graph, node):
        self.graph, self.node = graph, node

    def socket(self, *names):
        return next((self.node.inputs[n] for n in names if n in self.node.inputs), None)

    def get(self, *names, default=0.0):
        socket = self.socket(*names)
        return default if socket is None else self.graph.value(socket)

    def number(self, *names, default=0.0):
        """A constant; links are reported and ignored."""
        value = self.get(*names, default=default)
        if isinstance(value, mi.Connection):
            self.graph.unsupported(self.node, f'has a link to "{names[0]}", which is ignored')
            return self.graph.scalar(self.graph.constant(self.socket(*names)))
        return self.graph.scalar(value)


class MaterialWriter:
    """Writes materials, each once; collects the texture spaces that each of them needs."""

    def __init__(self, out, images, report):
        self.out = out
        self.images = images
        self.report = report
        self.spaces = [("uv", "")]
        self.sharpest = 1.0     # gloss of mirrors
        self.shaders = {}       # material -> its surface shader
        self._held_out = {}     # material -> that of its holdouts
        self._done = {}
        self._needs = {}        # material -> values of objects that it reads

    def gloss(self, roughness):
        return gloss_of_roughness(roughness, self.sharpest)

    def wide_enough(self, roughness):
        """The roughness, not below that of the sharpest lobe."""
        if self.sharpest >= 1:
            return roughness
        return max(roughness, math.sqrt(2 ** (-1.5 - 7 * self.sharpest)))

    def write(self, material, values_of=None):
        """Returns the name of the material and the number of texture spaces that it reads.

        values_of: function of the names of values of the object that the material needs.
        """
        pointer = material.as_pointer() if material else 0
        if pointer not in self._needs:
            tree = material.node_tree if material is not None and material.use_nodes else None
            self._needs[pointer] = variants.needs(tree)
        wanted = self._needs[pointer]
        values = values_of(wanted) if wanted and values_of is not None else {}
        key = pointer, tuple(sorted(values.items(), key=repr))
        if key not in self._done:
            self._done[key] = self.make(material, values)
        return self._done[key]

    def make(self, material, values):
        if material is None:
            name = self.out.names.unique("default")
            shader = self.out.shader_of("default", "mia_material_x", dict(
                diffuse=(.8, .8, .8), reflectivity=0.0, diffuse_weight=1.0))
            self.shaders[name] = shader
            self.finish(name, "= " + mi.quoted(shader), False)
            return name, 0
        name = self.out.names.unique(material.name)
        graph = nodes.Graph(self.out, self.images, material.name, self.report, self.spaces, values)
        volume = ""
        if not material.use_nodes or material.node_tree is None:
            surface = Surface(diffuse=tuple(material.diffuse_color)[:3], diffuse_weight=1.0,
                              reflectivity=0.0)
        else:
            output = self.output_of(material.node_tree)
            if output and output.inputs["Displacement"].is_linked:
                volume = layers.displacement(graph, output.inputs["Displacement"], material)
            surface = self.surface(graph, output.inputs["Surface"]) if output else Surface()
            if output and output.inputs["Volume"].is_linked:
                if not output.inputs["Surface"].is_linked:
                    surface.opacity = 0.0
                volume += layers.volume(graph, output.inputs["Volume"], surface)
        shader = self.shader_of(graph, surface)
        self.shaders[name] = shader
        self.finish(name, "= " + mi.quoted(shader),
                    surface.transmits or surface.opacity != 1.0, volume)
        return name, graph.used

    def held_out(self, name):
        """The name of a material that is black for the camera and as another one for other rays."""
        wanted = name + ".holdout"
        if wanted not in self._held_out:
            surface = self.shaders[name]
            switch = self.out.shader_of(wanted, "mip_rayswitch", {
                **{kind: surface for kind in ("reflection", "refraction", "finalgather", "shadow",
                                              "environment", "photon", "default")},
                "eye": (0.0, 0.0, 0.0), "transparent": (0.0, 0.0, 0.0)})
            self._held_out[wanted] = self.out.names.unique(wanted)
            self.finish(self._held_out[wanted], "= " + mi.quoted(switch), False)
        return self._held_out[wanted]

    @staticmethod
    def output_of(tree):
        native_output = tree.nodes.get("Oriel Output")
        if native_output is not None and native_output.type == "OUTPUT_MATERIAL":
            return native_output
        for target in ("CYCLES", "ALL"):
            node = tree.get_output_node(target)
            if node:
                return node
        return links.output_node(tree, "OUTPUT_MATERIAL")

    def finish(self, name, surface, transmits, volume=""):
        text = f"material {mi.quoted(name)}\n  {surface}\n{volume}"
        if transmits and surface.startswith("="):
            text += f"  shadow {surface}\n  photon {surface}\n"
        self.out.add(text + "end material\n")

    def shader_of(self, graph, surface):
        """The named shader of a surface."""
        if surface.shader is None and surface.scattered is None and surface.opacity != 1.0:
            surface.parameters["cutout_opacity"] = surface.opacity
            return self.opaque_shader(graph, surface)
        shader = self.opaque_shader(graph, surface)
        if surface.opacity == 1.0:
            return shader
        return graph.add("opacity", "mib_opacity", input=shader,
                         opacity=graph.colour(surface.opacity))

    def opaque_shader(self, graph, surface):
        """The named shader of a surface without its cut-outs."""
        if surface.shader:
            return surface.shader
        parameters = {"diffuse_weight": 1.0, "reflectivity": 0.0, **surface.parameters}
        shader = self.out.shader_of(graph.material + ".surface", "mia_material_x", parameters)
        return layers.add_scattered(graph, surface, shader)

    def surface(self, graph, socket):
        groups = list(graph._groups)
        try:
            found = graph.origin(socket)
            if found is None or found[0] is nodes.CONSTANT:
                return Surface(diffuse=(0.0, 0.0, 0.0), diffuse_weight=0.0)
            node = found[0]
            if node.bl_idname.startswith("OrielNode_"):
                from . import native
                surface = Surface()
                surface.shader = native.call_of_node(graph, node)
                surface.transmits = native.may_transmit(node)
                return surface
            method = SURFACES.get(node.type)
            if method is None:
                graph.unsupported(node, "is unsupported; the surface is grey")
                return Surface(diffuse=(.5, .5, .5))
            return method(self, graph, node)
        finally:
            graph._groups = groups

    # Closures ---------------------------------------------------------------------------------
    def bumped(self, graph, node, parameters, name="Normal"):
        socket = node.inputs.get(name)
        found = graph.origin(socket) if socket else None
        if found is None or found[0] is nodes.CONSTANT:
            if graph.displacement is not None:
                self.bump(graph, graph.displacement, parameters)
            return
        source = found[0]
        if graph.displacement is not None:
            graph.unsupported(graph.displacement, "is ignored beside another bump or a normal map")
        if source.type == "NORMAL_MAP":
            self.normal_map(graph, source, parameters)
        elif source.type == "BUMP":
            self.bump(graph, source, parameters)
        elif source.type == "BEVEL":
            self.bevel(graph, source, parameters)
        else:
            graph.unsupported(source, "is unsupported as a normal and ignored")

    def bevel(self, graph, node, parameters):
        """Rounded edges, of all materials, above the normal of the node."""
        below = {}
        if node.inputs["Normal"].is_linked:
            self.bumped(graph, node, below)
        radius = graph.product(graph.scalar(graph.value(node.inputs["Radius"])), ROUNDED)
        parameters["overall_bump"] = graph.add(
            "bevel", "mia_roundcorners", radius=radius, allow_different_materials=True, bump_mode=5,
            bump_vector=below.get("overall_bump", (0.0, 0.0, 0.0)))
        parameters["bump_mode"] = 5

    def normal_map(self, graph, node, parameters):
        if node.space != "TANGENT":
            graph.unsupported(node, "is read only in tangent space")
            return
        if not node.inputs["Color"].is_linked:
            return  # the default colour is the normal of the surface
        colour = graph.colour(graph.value(node.inputs["Color"]))
        strength = graph.scalar(graph.value(node.inputs["Strength"]))
        if isinstance(strength, mi.Connection) or strength < 1:
            # Weak maps also have less of the change along the normal.
            share = arithmetic.operate(graph, "MAXIMUM", strength, 0.0)
            share = arithmetic.operate(graph, "MINIMUM", share, 1.0)
            factor = arithmetic.operate(graph, "MULTIPLY_ADD", share, (0.0, 0.0, 1.0), (1.0, 1.0, 0.0))
            rest = arithmetic.operate(graph, "MULTIPLY_ADD", share, (0.0, 0.0, -1.0), (0.0, 0.0, 1.0))
            colour = arithmetic.operate(graph, "MULTIPLY_ADD", colour, factor, rest)
        parameters["overall_bump"] = graph.add(
            "normal", "oriel_normal_map", color=colour, factor=strength, bump_mode=5,
            space=graph.space("uv", node.uv_map))
        parameters["bump_mode"] = 5

    def bump(self, graph, node, parameters):
        """Bump of a Bump or Displacement node; heights are in scene units along the surface."""
        displaces = node.type == "DISPLACEMENT"
        height = graph.scalar(graph.value(node.inputs["Height"]))
        below = {}
        if not displaces and node.inputs["Normal"].is_linked:
            self.bumped(graph, node, below)
        if not isinstance(height, mi.Connection):
            parameters.update(below)
            return
        strength = 1.0 if displaces else graph.scalar(graph.value(node.inputs["Strength"]))
        distance = graph.scalar(graph.value(node.inputs["Scale" if displaces else "Distance"]))
        if isinstance(distance, mi.Connection) and getattr(node, "invert", False):
            distance = arithmetic.operate(graph, "MULTIPLY", distance, -1.0)
        if not isinstance(distance, mi.Connection):
            distance *= -1.0 if getattr(node, "invert", False) else 1.0
        graph.space("uv", "")  # texture coordinates move by its derivatives
        parameters["overall_bump"] = graph.add(
            "bump", "oriel_bump", height=height, distance=distance, strength=strength,
            bump_mode=5, normal=below.get("overall_bump", (0.0, 0.0, 0.0)))
        parameters["bump_mode"] = 5

    def principled(self, graph, node):
        read = Principled(graph, node)
        base = arithmetic.not_negative(graph, graph.colour(read.get("Base Color")))
        metallic = graph.scalar(read.get("Metallic"))
        transmission = read.number("Transmission Weight", "Transmission")
        ior = read.number("IOR", default=1.45)
        layered = versions.principled_is_layered(node)
        level = read.number("Specular IOR Level", "Specular", default=.5)
        f0 = f0_of_ior(ior) * 2 * level if layered else .08 * level
        tint = self.tint(graph, read, base, layered)
        roughness = graph.scalar(read.get("Roughness", default=.5))
        p = {"brdf_fresnel": False, "brdf_curve": 5.0, "brdf_90_degree_refl": 1.0,
             "reflectivity": 1.0, "refr_ior": max(ior, 1.0),
             "refl_gloss": graph.curve(roughness, self.gloss)}
        p["diffuse"] = base if layered else retro_reflective(graph, base, roughness)
        p["diffuse_weight"] = graph.affine(metallic, 1.0, 0.0)
        self.reflection(graph, p, metallic, f0, tint, base)
        bent = ior if layered else (1 + math.sqrt(f0)) / (1 - math.sqrt(min(f0, .99)))
        self.reflectance(graph, p, roughness, metallic, f0, max(bent, 1.05),
                         getattr(node, "distribution", "") == "GGX")
        if f0 <= 0 and metallic == 0.0:
            p["reflectivity"] = 0.0
        metal = not isinstance(metallic, mi.Connection) and metallic >= 1
        if not layered and not transmission and not metal:
            p["brdf_conserve_energy"] = False  # Principled until 3.6 adds its lobes
        surface = Surface(**p)
        if transmission > 0 and not metal:
            self.add_transmission(graph, read, surface, base, transmission, ior, roughness)
        self.anisotropic(graph, read, p, surface)
        self.bumped(graph, node, surface.parameters)
        emission = graph.product(graph.colour(read.get("Emission Color", "Emission")),
                                 read.get("Emission Strength", default=1.0))
        if isinstance(emission, mi.Connection) or max(emission) > 0:
            surface.parameters["additional_color"] = emission
        surface.opacity = graph.scalar(read.get("Alpha", default=1.0))
        if metallic == 0.0 and not surface.transmits and "anisotropy" not in surface.parameters \
                and not read.number("Subsurface Weight", "Subsurface"):
            layers.plastic(graph, surface, base, graph.curve(roughness, self.wide_enough) if f0 > 0
                           else roughness, bent if f0 > 0 else 1.0, layered)
        else:
            layers.rough_reflection(graph, surface, roughness, layered)
        layers.subsurface(graph, read, surface, layered)
        self.coat(graph, read, surface, layered)
        layers.sheen(graph, read, base, surface, layered, self.opaque_shader)
        return surface

    @staticmethod
    def reflection(graph, p, metallic, f0, tint, base):
        """Reflectance at normal incidence: between that of the dielectric and the base colour."""
        if any(isinstance(v, mi.Connection) for v in (metallic, tint, base)):
            p["brdf_0_degree_refl"] = graph.affine(metallic, f0, 1.0)
            p["refl_color"] = graph.blend(metallic, tint, base)
            return
        facing = graph.blend(metallic, tuple(f0 * c for c in graph.colour(tint)),
                             graph.colour(base))
        peak = min(max(facing), 1.0)
        p["brdf_0_degree_refl"] = peak
        p["refl_color"] = tuple(c / peak for c in facing) if peak > 0 else (1.0, 1.0, 1.0)

    @staticmethod
    def reflectance(graph, p, roughness, metallic, f0, ior, single):
        """The curve of the reflectance; of linked values, tables and mixtures of curves."""
        def curve(facing, i):
            return graph.curve(roughness, lambda r: microfacets.reflectance_curve(
                round(max(r, 0.0) ** 2, 4), round(facing, 5), round(ior, 4), single)[i])
        names = ("brdf_0_degree_refl", "brdf_90_degree_refl", "brdf_curve")
        facing = p[names[0]]
        for i, name in enumerate(names):
            if not isinstance(facing, mi.Connection):
                p[name] = curve(facing, i)
            elif name == "brdf_curve":
                p[name] = curve(min(f0, 1.0), i)
            else:
                p[name] = graph.blend(metallic, curve(min(f0, 1.0), i), curve(1.0, i))

    @staticmethod
    def tint(graph, read, base, layered):
        if layered:
            return graph.colour(read.get("Specular Tint", default=(1.0, 1.0, 1.0)))
        amount = read.number("Specular Tint")
        return graph.blend(amount, (1.0, 1.0, 1.0), base) if amount > 0 else (1.0, 1.0, 1.0)

    @staticmethod
    def anisotropic(graph, read, p, surface):
        amount = read.number("Anisotropic")
        if amount <= 0 or isinstance(p["refl_gloss"], mi.Connection):
            return
        aspect = math.sqrt(1 - 0.9 * amount)
        # alpha along the tangent r^2 / aspect and across it r^2 aspect: their ratio is aspect^-2.
        surface.parameters["anisotropy"] = min(aspect ** -2, 10.0)
        surface.parameters["anisotropy_rotation"] = read.number("Anisotropic Rotation")
        surface.parameters["anisotropy_channel"] = -3
        closures.uv_tangent(graph, read.node)

    def add_transmission(self, graph, read, surface, base, transmission, ior, roughness):
        p = surface.parameters
        rough = read.number("Transmission Roughness")
        width = roughness if isinstance(roughness, mi.Connection) else max(roughness, rough)
        bending = math.sqrt(abs(1 - 1 / max(ior, 1.0001)) / 2)
        p["transparency"] = transmission
        p["thin_walled"] = False
        p["refr_color"] = base
        if read.node.distribution == "GGX" and not isinstance(base, mi.Connection):
            p["refr_color"] = graph.product(base, single_scattering(1.0, roughness, 1.0))
        p["refr_gloss"] = graph.curve(width, lambda r: self.gloss(r * math.sqrt(bending)))
        if transmission >= 1:
            p["diffuse_weight"] = 0.0
        p["brdf_fresnel"] = True
        p["skip_inside_refl"] = False
        p["refl_depth"] = p["refr_depth"] = 0
        surface.transmits = True

    def coat(self, graph, read, surface, layered):
        weight = read.get("Coat Weight", "Clearcoat")
        if not isinstance(weight, mi.Connection) and weight <= 0:
            return
        weight = read.number("Coat Weight", "Clearcoat")
        spread = read.number("Coat Roughness", "Clearcoat Roughness", default=.03) ** 2
        # The clear coat of Principled until 3.6 has a quarter of the reflectance and is added.
        strength = weight if layered else weight * 0.25
        ior = read.number("Coat IOR", default=1.5)
        base = self.opaque_shader(graph, surface)
        layer = dict(base_material=str(base), reflection_color=(1.0, 1.0, 1.0), edge_factor=5.0,
                     reflection_base_weight=f0_of_ior(ior) * strength,
                     reflection_edge_weight=strength, single_env_sample=False, u_spread=spread,
                     v_spread=spread)
        surface.shader = graph.add("coat", "mib_glossy_reflection", **layer)

    def parts(self, graph, node, inputs):
        """The surfaces of the inputs of a node that combines them."""
        graph.nested += 1
        try:
            return [self.surface(graph, node.inputs[i]) for i in inputs]
        finally:
            graph.nested -= 1

    def mix_shader(self, graph, node):
        factor = graph.scalar(graph.value(node.inputs[0]))
        first, second = self.parts(graph, node, (1, 2))
        if not isinstance(factor, mi.Connection) and factor <= 0.0:
            return first
        if not isinstance(factor, mi.Connection) and factor >= 1.0:
            return second
        # The rest of the surface is transparent; what is left is mixed by what there is of both.
        opacity = first.opacity if first.opacity == second.opacity else \
            graph.blend(factor, first.opacity, second.opacity)
        if self.is_nothing(first) or self.is_nothing(second):
            rest = second if self.is_nothing(first) else first
            rest.opacity = opacity
            return rest
        if first.opacity != second.opacity:
            share = arithmetic.operate(graph, "MULTIPLY", factor, second.opacity)
            factor = arithmetic.operate(graph, "DIVIDE", share, opacity)
        names = [self.opaque_shader(graph, s) for s in (first, second)]
        surface = Surface()
        surface.shader = graph.add("mix", "mib_color_mix", num=1, mode_0=1, weight_0=factor,
                                   color_base=names[0], color_0=names[1])
        surface.opacity = opacity
        surface.transmits = first.transmits or second.transmits
        return surface

    @staticmethod
    def is_nothing(surface):
        return surface.shader is None and not isinstance(surface.opacity, mi.Connection) and \
            surface.opacity == 0.0

    def add_shader(self, graph, node):
        first, second = self.parts(graph, node, (0, 1))
        names = [self.opaque_shader(graph, s) for s in (first, second)]
        surface = Surface()
        if self.is_nothing(first) or self.is_nothing(second):
            # Light beside a transparent surface.
            graph.unsupported(node, "adds light to a transparent surface, which hides what is "
                                    "behind it")
        surface.shader = graph.add("add", "mib_color_mix", num=1, mode_0=2, weight_0=1.0,
                                   color_base=names[0], color_0=names[1])
        surface.transmits = first.transmits or second.transmits
        return surface


SURFACES = {
    **closures.SURFACES, "BSDF_PRINCIPLED": MaterialWriter.principled,
    "MIX_SHADER": MaterialWriter.mix_shader, "ADD_SHADER": MaterialWriter.add_shader,
}
