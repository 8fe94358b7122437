# SPDX-License-Identifier: Apache-2.0
"""Materials: surface nodes of Blender as mia_material_x."""
import math

from . import layers, mi, microfacets, nodes, versions, world as links

MIN_ALPHA = 1e-5


def gloss_of_roughness(roughness, sharpest=1.0):
    """refl_gloss whose lobe has the width alpha = roughness^2: alpha = 2^(-1.5 - 7 gloss).

    sharpest: the maximum; 1 is a mirror.
    """
    alpha = min(max(roughness, 0.0), 1.0) ** 2
    if alpha < MIN_ALPHA:
        return sharpest
    return min(max(-(math.log2(alpha) + 1.5) / 7, 0.0), sharpest)


def single_scattering(value, roughness, f0):
    """Factor of the reflection for Cycles' GGX without multiple scattering."""
    if isinstance(roughness, mi.Connection) or isinstance(f0, mi.Connection):
        return value
    lost = microfacets.lost_energy(round(max(roughness, 0.0) ** 2, 4))
    return value / (1 + f0 * lost / (1 - lost))


def f0_of_ior(ior):
    return ((ior - 1) / (ior + 1)) ** 2


def retro_reflective(graph, colour, roughness):
    """The Lambertian colour with the albedo of the diffuse lobe of Principled until 3.6."""
    if isinstance(colour, mi.Connection) or isinstance(roughness, mi.Connection):
        return colour
    albedo = microfacets.diffuse_albedo(roughness)
    return tuple(min(c * albedo, max(c, 1.0)) for c in graph.colour(colour))


class Surface:
    """The result of a surface node: parameters of mia_material_x, or a finished shader."""

    def __init__(self, **parameters):
        self.parameters = parameters
        self.shader = None      # connection to a shader that replaces the parameters
        self.opacity = 1.0      # cutout
        self.transmits = False
        self.scattered = None   # connection to a shader whose light is added


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
        self._done = {}

    def gloss(self, roughness):
        return gloss_of_roughness(roughness, self.sharpest)

    def write(self, material):
        """Returns the name of the material and the number of texture spaces that it reads."""
        key = material.as_pointer() if material else 0
        if key not in self._done:
            self._done[key] = self.make(material)
        return self._done[key]

    def make(self, material):
        if material is None:
            name = self.out.names.unique("default")
            self.finish(name, mi.call("mia_material_x", diffuse=(.8, .8, .8), reflectivity=0.0,
                                      diffuse_weight=1.0), False)
            return name, 0
        name = self.out.names.unique(material.name)
        graph = nodes.Graph(self.out, self.images, material.name, self.report, self.spaces)
        volume = ""
        if not material.use_nodes or material.node_tree is None:
            surface = Surface(diffuse=tuple(material.diffuse_color)[:3], diffuse_weight=1.0,
                              reflectivity=0.0)
        else:
            output = self.output_of(material.node_tree)
            surface = self.surface(graph, output.inputs["Surface"]) if output else Surface()
            if output and output.inputs["Displacement"].is_linked:
                layers.displacement(graph, output.inputs["Displacement"], material, surface,
                                    self.bump)
            if output and output.inputs["Volume"].is_linked:
                if not output.inputs["Surface"].is_linked:
                    surface.opacity = 0.0
                volume = layers.volume(graph, output.inputs["Volume"], surface)
        shader = self.shader_of(graph, surface)
        self.finish(name, "= " + mi.quoted(shader),
                    surface.transmits or surface.opacity != 1.0, volume)
        return name, graph.used

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
        if surface.shader:
            return surface.shader
        parameters = {"diffuse_weight": 1.0, "reflectivity": 0.0, **surface.parameters}
        if surface.opacity != 1.0:
            parameters["cutout_opacity"] = surface.opacity
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
            return
        source = found[0]
        if source.type == "NORMAL_MAP":
            self.normal_map(graph, source, parameters)
        elif source.type == "BUMP":
            self.bump(graph, source, parameters)
        else:
            graph.unsupported(source, "is unsupported as a normal and ignored")

    def normal_map(self, graph, node, parameters):
        found = graph.origin(node.inputs["Color"])
        if node.space != "TANGENT" or found is None or found[0] is nodes.CONSTANT or \
                found[0].type != "TEX_IMAGE":
            graph.unsupported(node, "is read only in tangent space with an image")
            return
        image = found[0]
        texture = graph.images.texture(image.image, graph.material, image.name, vector=True)
        strength = graph.value(node.inputs["Strength"])
        if texture is None:
            return
        # The tangents are those of the first texture space, the active UV map.
        graph.space("uv", "")
        parameters["overall_bump"] = graph.add(
            "normal", "oriel_normal_map", tex=mi.Words(mi.quoted(texture)),
            factor=1.0 if isinstance(strength, mi.Connection) else strength, bump_mode=5)
        parameters["bump_mode"] = 5

    def bump(self, graph, node, parameters):
        found = graph.origin(node.inputs["Height"])
        if found is None or found[0] is nodes.CONSTANT:
            return
        image = found[0]
        if image.type != "TEX_IMAGE":
            graph.unsupported(node, "is read only with an image and ignored")
            return
        texture = graph.images.texture(image.image, graph.material, image.name)
        displaces = node.type == "DISPLACEMENT"
        strength = 1.0 if displaces else graph.value(node.inputs["Strength"])
        distance = graph.value(node.inputs["Scale" if displaces else "Distance"])
        if texture is None or any(isinstance(v, mi.Connection) for v in (strength, distance)):
            return
        sign = -1.0 if getattr(node, "invert", False) else 1.0
        graph.space("uv", "")
        graph.unsupported(node, "is approximated: its distance is relative to the size of the image")
        parameters["bump"] = graph.add("bump", "mib_bump_map2", factor=sign * strength * distance,
                                       scale=1.0, tex=mi.Words(mi.quoted(texture)))
        parameters["bump_mode"] = 0

    def principled(self, graph, node):
        read = Principled(graph, node)
        base = graph.colour(read.get("Base Color"))
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
        if getattr(node, "distribution", "") == "GGX" and not layered:
            p["reflectivity"] = single_scattering(1.0, roughness, p["brdf_0_degree_refl"])
        if not any(isinstance(v, mi.Connection) for v in (roughness, p["brdf_0_degree_refl"])):
            single = getattr(node, "distribution", "") == "GGX"
            bent = ior if layered else (1 + math.sqrt(f0)) / (1 - math.sqrt(min(f0, .99)))
            p["brdf_0_degree_refl"], p["brdf_90_degree_refl"], p["brdf_curve"] = \
                microfacets.reflectance_curve(round(roughness ** 2, 4),
                                              round(p["brdf_0_degree_refl"], 5),
                                              round(max(bent, 1.05), 4), single)
            p["reflectivity"] = 1.0
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
        layers.subsurface(graph, read, surface, layered)
        self.coat(graph, read, surface, layered)
        layers.sheen(graph, read, base, surface, layered, self.shader_of)
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
        graph.space("uv", "")

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
        base = self.shader_of(graph, surface)
        layer = dict(base_material=str(base), reflection_color=(1.0, 1.0, 1.0), edge_factor=5.0,
                     reflection_base_weight=f0_of_ior(ior) * strength,
                     reflection_edge_weight=strength, single_env_sample=False, u_spread=spread,
                     v_spread=spread)
        surface.shader = graph.add("coat", "mib_glossy_reflection", **layer)

    def diffuse(self, graph, node):
        surface = Surface(diffuse=graph.colour(graph.value(node.inputs["Color"])))
        rough = graph.value(node.inputs["Roughness"])
        if rough:
            surface.parameters["diffuse_roughness"] = rough
        self.bumped(graph, node, surface.parameters)
        return surface

    def glossy(self, graph, node):
        rough = graph.scalar(graph.value(node.inputs["Roughness"]))
        if getattr(node, "distribution", "") == "SHARP":
            rough = 0.0
        single = getattr(node, "distribution", "") == "GGX"
        weight = single_scattering(1.0, rough, 1.0) if single else 1.0
        surface = Surface(diffuse_weight=0.0, reflectivity=weight, brdf_fresnel=False,
                          brdf_0_degree_refl=1.0, brdf_90_degree_refl=1.0, diffuse=(0.0, 0.0, 0.0),
                          refl_color=graph.colour(graph.value(node.inputs["Color"])),
                          refl_gloss=graph.curve(rough, self.gloss))
        self.bumped(graph, node, surface.parameters)
        return surface

    def glass(self, graph, node):
        rough = graph.scalar(graph.value(node.inputs["Roughness"]))
        if getattr(node, "distribution", "") == "SHARP":
            rough = 0.0
        ior = graph.scalar(graph.value(node.inputs["IOR"]))
        ior = 1.45 if isinstance(ior, mi.Connection) else ior
        colour = graph.colour(graph.value(node.inputs["Color"]))
        reflects = node.type == "BSDF_GLASS"
        bending = math.sqrt(abs(1 - 1 / max(ior, 1.0001)) / 2)
        surface = Surface(
            diffuse_weight=0.0, diffuse=(0.0, 0.0, 0.0), reflectivity=1.0 if reflects else 0.0,
            refl_color=colour, brdf_fresnel=True, refr_ior=ior, transparency=1.0, refr_color=colour,
            refl_gloss=graph.curve(rough, self.gloss), thin_walled=False,
            refr_gloss=graph.curve(rough, lambda r: self.gloss(r * math.sqrt(bending))),
            skip_inside_refl=False, refl_depth=0, refr_depth=0)
        surface.transmits = True
        self.bumped(graph, node, surface.parameters)
        return surface

    def transparent(self, graph, node):
        colour = graph.value(node.inputs["Color"])
        if colour == (1.0, 1.0, 1.0):
            surface = Surface(diffuse_weight=0.0)
            surface.opacity = 0.0
            return surface
        surface = Surface(diffuse_weight=0.0, reflectivity=0.0, transparency=1.0, thin_walled=True,
                          refr_color=graph.colour(colour), refr_ior=1.0)
        surface.transmits = True
        return surface

    def translucent(self, graph, node):
        surface = Surface(diffuse=(0.0, 0.0, 0.0), transparency=1.0, refr_translucency=True,
                          refr_trans_weight=1.0, thin_walled=True,
                          refr_trans_color=graph.colour(graph.value(node.inputs["Color"])))
        surface.transmits = True
        return surface

    def emission(self, graph, node):
        light = graph.product(graph.colour(graph.value(node.inputs["Color"])),
                              graph.scalar(graph.value(node.inputs["Strength"])))
        return Surface(diffuse_weight=0.0, diffuse=(0.0, 0.0, 0.0), additional_color=light)

    def mix_shader(self, graph, node):
        factor = graph.scalar(graph.value(node.inputs[0]))
        first, second = (self.surface(graph, node.inputs[i]) for i in (1, 2))
        for a, b, opacity in ((first, second, factor),
                              (second, first, graph.affine(factor, 1.0, 0.0))):
            if a.shader is None and a.opacity == 0.0:  # transparent: the other one with a cut-out
                if b.shader is None and b.opacity == 1.0:
                    b.opacity = opacity
                    return b
        if isinstance(factor, mi.Connection) and node.inputs[0].links[0].from_node.type in \
                {"FRESNEL", "LAYER_WEIGHT"}:
            graph.unsupported(node.inputs[0].links[0].from_node)
        if not isinstance(factor, mi.Connection) and factor in (0.0, 1.0):
            return second if factor else first
        names = [self.shader_of(graph, s) for s in (first, second)]
        surface = Surface()
        surface.shader = graph.add("mix", "mib_color_mix", num=1, mode_0=1, weight_0=factor,
                                   color_base=names[0], color_0=names[1])
        surface.transmits = any(s.transmits or s.opacity != 1.0 for s in (first, second))
        return surface

    def add_shader(self, graph, node):
        first, second = (self.surface(graph, node.inputs[i]) for i in (0, 1))
        names = [self.shader_of(graph, s) for s in (first, second)]
        surface = Surface()
        surface.shader = graph.add("add", "mib_color_mix", num=1, mode_0=2, weight_0=1.0,
                                   color_base=names[0], color_0=names[1])
        surface.transmits = first.transmits or second.transmits
        return surface


SURFACES = {
    "BSDF_PRINCIPLED": MaterialWriter.principled, "BSDF_DIFFUSE": MaterialWriter.diffuse,
    "BSDF_GLOSSY": MaterialWriter.glossy, "BSDF_GLASS": MaterialWriter.glass,
    "BSDF_REFRACTION": MaterialWriter.glass, "BSDF_TRANSPARENT": MaterialWriter.transparent,
    "BSDF_TRANSLUCENT": MaterialWriter.translucent, "EMISSION": MaterialWriter.emission,
    "MIX_SHADER": MaterialWriter.mix_shader, "ADD_SHADER": MaterialWriter.add_shader,
}
