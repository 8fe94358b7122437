# SPDX-License-Identifier: Apache-2.0
"""Materials of a dump: a Principled BSDF for other engines, and native nodes for Oriel."""
import os

import bpy

from . import import_coordinates, native, versions
from .materials import ROUNDED

NATIVE_OUTPUT = "Oriel Output"
MATERIALS = {"mia_material", "mia_material_x", "mia_material_x_passes"}
# Shaders between a parameter and its texture that are followed, and their inputs.
FOLLOWED = {"mib_color_mix": ("color_base", "color_0"), "mib_color_average": ("input",),
            "mib_color_interpolate": ("input",), "mib_color_intensity": ("input",),
            "mib_color_alpha": ("input",), "adsk_bitmap": ("tex",)}


def roughness_of(gloss):
    """The inverse of surface.gloss_of_roughness."""
    return 0.0 if gloss >= 1 else min(2.0 ** (-1.5 - 7 * max(gloss, 0.0)), 1.0) ** 0.5


class MaterialReader:
    def __init__(self, dump, report):
        self.dump = dump
        self.report = report
        self.textures = {t["name"]: t for t in dump.list("textures")}
        self.elements = {m["name"]: m for m in dump.list("materials")}
        self._done = {}
        self._images = {}

    def material(self, name):
        if name not in self._done:
            self._done[name] = self.make(name) if name in self.elements else None
        return self._done[name]

    def made(self):
        """Names and materials so far."""
        return [(name, material) for name, material in self._done.items() if material is not None]

    def make(self, name, element=None):
        """A new material of an element, or of another version of it."""
        material = bpy.data.materials.new(name)
        material.use_nodes = True
        tree = material.node_tree
        principled = next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED")
        uses = (element or self.elements[name])["shaders"]
        call = self.dump.call(uses[-1]) if uses else None
        if call is None:
            return material
        self.principled(material, tree, principled, call)
        self.native_nodes(tree, call)
        return material

    # Principled -------------------------------------------------------------------------------
    def principled(self, material, tree, node, call):
        parameters = call["parameters"]
        if call["type"] == "mib_glossy_reflection" and isinstance(
                parameters.get("base_material"), (str, dict)):
            inner = self.inner(parameters, "base_material")
            if inner:
                set_value(node, 1.0, "Coat Weight", "Clearcoat")
                return self.principled(material, tree, node, inner)
        if call["type"] == "oriel_plastic":
            return self.plastic(material, tree, node, parameters)
        if call["type"] == "mib_opacity" or call["type"] == "mib_color_mix" and \
                parameters.get("mode_0") == 2:
            inner = self.inner(parameters, "input" if call["type"] == "mib_opacity" else "color_base")
            if inner:
                self.beside(material, tree, node, call["type"], parameters)
                return self.principled(material, tree, node, inner)
        if call["type"] not in MATERIALS:
            self.report(f'material "{material.name}": {call["type"]} is approximated')
            for name in ("diffuse", "color", "diffuse_color"):
                if name in parameters:
                    self.colour(material, tree, node, parameters[name], "Base Color")
                    break
            return None
        get = lambda name, default: number(parameters.get(name, default), default)
        reflectivity, transparency = get("reflectivity", .6), get("transparency", 0.0)
        metal = parameters.get("refl_is_metal", False) is True
        f0 = get("brdf_0_degree_refl", .2)
        metallic = 1.0 if metal else 0.0
        if not metal and get("diffuse_weight", 1.0) == 0 and transparency == 0 and f0 > .25:
            metallic = 1.0
        base = "refl_color" if metallic and not metal else "diffuse"
        if transparency > .5 and not metallic:
            base = "refr_color"
        default = (.5, .5, .5) if base == "diffuse" else (1, 1, 1)
        roughness = roughness_of(get("refl_gloss", 1.0))
        colour = parameters.get(base, default)
        self.colour(material, tree, node, colour, "Base Color")
        set_value(node, metallic, "Metallic")
        set_value(node, roughness, "Roughness")
        set_value(node, get("refr_ior", 1.4), "IOR")
        set_value(node, transparency, "Transmission Weight", "Transmission")
        fresnel = parameters.get("brdf_fresnel", False) is True
        specular = .5 if fresnel else min(reflectivity * f0 / .08, 1.0)
        set_value(node, specular, "Specular IOR Level", "Specular")
        emission = parameters.get("additional_color")
        if emission is not None:
            self.colour(material, tree, node, emission, "Emission Color", "Emission")
            set_value(node, 1.0, "Emission Strength")
        cutout = parameters.get("cutout_opacity", 1.0)
        if isinstance(cutout, dict):
            self.link_image(material, tree, node, cutout, "Alpha")
        else:
            set_value(node, number(cutout, 1.0), "Alpha")
        if transparency or parameters.get("cutout_opacity", 1.0) != 1.0:
            versions.show_alpha(material)
        if parameters.get("thin_walled") is True and transparency > .5 and not metallic:
            self.pane(tree, node, transparency)
        self.bump(material, tree, node, parameters)
        return None

    def pane(self, tree, node, transparency):
        """Thin glass: other engines would block the light of sun and sky by a Principled BSDF."""
        output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
        mix, through, facing = (tree.nodes.new("ShaderNode" + kind) for kind in (
            "MixShader", "BsdfTransparent", "Fresnel"))
        facing.inputs["IOR"].default_value = node.inputs["IOR"].default_value
        colour = node.inputs["Base Color"]
        through.inputs["Color"].default_value = colour.default_value
        set_value(node, 0.0, "Transmission Weight", "Transmission")
        set_value(node, 1.0, "Metallic")
        node.inputs["Base Color"].default_value = (1.0, 1.0, 1.0, 1.0)
        for i, new in enumerate((mix, through, facing)):
            new.location = (node.location.x + 150 * i, node.location.y + 300)
        tree.links.new(facing.outputs[0], mix.inputs[0])
        tree.links.new(through.outputs[0], mix.inputs[1])
        tree.links.new(node.outputs[0], mix.inputs[2])
        tree.links.new(mix.outputs[0], output.inputs["Surface"])

    def bump(self, material, tree, node, parameters):
        """Rounded edges as a Bevel node; other bumps are kept in native nodes."""
        for name in ("overall_bump", "bump"):
            call = self.inner(parameters, name)
            if call is None:
                continue
            radius = call["parameters"].get("radius")
            if call["type"] == "mia_roundcorners" and isinstance(radius, (int, float)):
                bevel = tree.nodes.new("ShaderNodeBevel")
                bevel.inputs["Radius"].default_value = radius / ROUNDED
                bevel.location = (node.location.x - 200, node.location.y - 500)
                tree.links.new(bevel.outputs[0], node.inputs["Normal"])
            else:
                self.report(f'material "{material.name}": bumps are kept in native nodes only')
            return

    def inner(self, parameters, name):
        """The shader call that is connected to a parameter, or None."""
        value = parameters.get(name)
        return self.dump.shader(value if isinstance(value, str) else value.get("shader", "")) \
            if isinstance(value, (str, dict)) else None

    def beside(self, material, tree, node, kind, parameters):
        """Opacity of a surface, or light that is added to it."""
        if kind == "mib_opacity":
            opacity = parameters.get("opacity")
            if isinstance(opacity, dict):
                self.link_image(material, tree, node, opacity, "Alpha")
            elif isinstance(opacity, list) and opacity:
                set_value(node, number(opacity[0], 1.0), "Alpha")
            versions.show_alpha(material)
            return
        self.colour(material, tree, node, parameters.get("color_0"), "Emission Color", "Emission")
        set_value(node, 1.0, "Emission Strength")

    def plastic(self, material, tree, node, parameters):
        """The inverse of layers.plastic."""
        get = lambda name, default: number(parameters.get(name, default), default)
        self.colour(material, tree, node, parameters.get("diffuse", [.5, .5, .5]), "Base Color")
        if isinstance(parameters.get("roughness"), dict):
            self.link_image(material, tree, node, parameters["roughness"], "Roughness")
        else:
            set_value(node, get("roughness", .5), "Roughness")
        ior = max(get("ior", 1.5), 1.0)
        f0 = ((ior - 1) / (ior + 1)) ** 2
        if versions.principled_is_layered(node):
            set_value(node, ior, "IOR")
        else:
            set_value(node, min(f0 / .08, 1.0), "Specular")
        if parameters.get("bump"):
            self.report(f'material "{material.name}": bumps are kept in native nodes only')

    def colour(self, material, tree, node, value, *names):
        if isinstance(value, dict):
            self.link_image(material, tree, node, value, *names)
        elif isinstance(value, list) and len(value) >= 3:
            set_value(node, (*value[:3], 1.0), *names)

    def link_image(self, material, tree, node, value, *names):
        image, look = self.image_behind(value)
        if image is None:
            self.report(f'material "{material.name}": "{names[0]}" is computed by a shader that has '
                        "no equivalent; it is kept in native nodes only")
            return
        source = tree.nodes.new("ShaderNodeTexImage")
        source.image = image
        source.location = (node.location.x - 320, node.location.y)
        import_coordinates.link(self, material, tree, source, look)
        tree.links.new(source.outputs["Alpha" if self.reads_alpha(value) else "Color"],
                       find_socket(node, names))

    def reads_alpha(self, value):
        """Whether a connection is the alpha of an image."""
        call = self.dump.shader(value["shader"]) if "shader" in value else None
        return call is not None and call["type"] == "mib_color_alpha"

    def image_behind(self, value, depth=0):
        """The image that a connection reads, through shaders that modify colours, and the call that
        reads it."""
        if depth > 20 or not isinstance(value, dict) or "shader" not in value:
            return None, None
        call = self.dump.shader(value["shader"])
        if call is None:
            return None, None
        texture = call["parameters"].get("tex")
        if isinstance(texture, str):
            return self.image(texture), call
        for name in FOLLOWED.get(call["type"], ()):
            found = self.image_behind(call["parameters"].get(name), depth + 1)
            if found[0] is not None:
                return found
        return None, None

    def image(self, name):
        if name not in self._images:
            texture, image = self.textures.get(name), None
            if texture and texture.get("file"):
                path = texture["file"]
                if os.path.isfile(path):
                    image = bpy.data.images.load(path, check_existing=True)
                    gamma = self.dump.root.get("render", {}).get("gamma", 2.2)
                    if texture["type"] != "color texture" or gamma < 1.2:
                        image.colorspace_settings.name = "Non-Color"
                else:
                    self.report(f'texture "{name}": the file {path} is missing')
            self._images[name] = image
        return self._images[name]

    # Native nodes -----------------------------------------------------------------------------
    def native_nodes(self, tree, call, kind="Material"):
        """Native nodes of the call, linked to an output of their own, which Oriel prefers."""
        made = {}
        node = self.native_node(tree, call, made, 0, 0)
        if node is None:
            return
        output = tree.nodes.new("ShaderNodeOutput" + kind)
        output.name = output.label = NATIVE_OUTPUT
        output.location = (300, -600)
        output.is_active_output = False
        tree.links.new(node.outputs["BSDF"], output.inputs["Surface"])
        for other in tree.nodes:
            if other.bl_idname == output.bl_idname and other != output:
                other.is_active_output = True

    def native_node(self, tree, call, made, depth, row):
        if depth > 20:
            return None
        try:
            node = tree.nodes.new(native.PREFIX + call["type"])
        except RuntimeError:
            self.report(f'shader "{call["type"]}" has no node')
            return None
        node.location = (-300 * depth, -600 - 250 * row)
        kinds = {p["name"]: p["type"] for p in node.parameters}
        for i, (name, value) in enumerate(call["parameters"].items()):
            self.set_parameter(tree, node, name, kinds.get(name), value, made, depth, i)
        return node

    def set_parameter(self, tree, node, name, kind, value, made, depth, row):
        if kind in native.TEXTURES:
            if isinstance(value, str):
                setattr(node, "image_" + name, self.image(value))
            return
        if kind == "transform" and isinstance(value, list) and len(value) == 16:
            node[name] = [float(v) for v in value]
            return
        socket = node.inputs.get(name)
        if socket is None:
            if kind is not None:
                self.report(f'parameter "{name}" of {node.shader} is not kept')
            return
        reference = value.get("shader") if isinstance(value, dict) else None
        if kind == "shader" and isinstance(value, str):
            reference = value
        if reference:
            if reference not in made:
                inner = self.dump.shader(reference)
                made[reference] = inner and self.native_node(tree, inner, made, depth + 1, row)
            source = made[reference]
            if source:
                output = {"shader": "BSDF", "vector": "Vector"}.get(kind, "Color")
                tree.links.new(source.outputs[output], socket)
            return
        try:
            assign(socket, kind, value)
        except (TypeError, ValueError):
            self.report(f'parameter "{name}" of {node.shader} has an unusual value')


def assign(socket, kind, value):
    if kind == "boolean":
        socket.default_value = bool(value)
    elif kind == "integer":
        socket.default_value = int(value)
    elif kind == "scalar":
        socket.default_value = float(value)
    elif kind == "color":
        values = list(value)
        socket.default_value = values[:3] + [values[3] if len(values) > 3 else 1.0]
    elif kind == "vector":
        socket.default_value = list(value)[:3]
    elif kind == "string":
        socket.default_value = str(value)


def number(value, default):
    return float(value) if isinstance(value, (int, float)) else default


def find_socket(node, names):
    return next((node.inputs[n] for n in names if n in node.inputs), None)


def set_value(node, value, *names):
    socket = find_socket(node, names)
    if socket is not None:
        socket.default_value = value
