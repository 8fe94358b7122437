# SPDX-License-Identifier: Apache-2.0
"""Layers of Principled BSDF beside its lobes, volumes, and displacement as bump."""
import math

from . import arithmetic, mi, versions

# Roughness and weight that come nearest to the sheen of Principled until 3.6.
SHEEN_ROUGHNESS, SHEEN_WEIGHT = 0.2, 0.5
MAX_ALPHA = 2 ** -1.5  # of refl_gloss 0


def plastic(graph, surface, base, roughness, ior, layered):
    """A surface without metal and transmission: facets that reflect by their own angle, and until
    3.6 a diffuse lobe with retro-reflection."""
    p = surface.parameters
    values = dict(diffuse=base, retro_reflective=not layered, roughness=roughness, ior=ior,
                  reflection_color=p["refl_color"], conserve=layered,
                  albedo_0=p["brdf_0_degree_refl"], albedo_90=p["brdf_90_degree_refl"],
                  albedo_curve=p["brdf_curve"])
    if "overall_bump" in p:
        values.update(bump=p["overall_bump"], bump_mode=p["bump_mode"])
    surface.shader = graph.add("surface", "oriel_plastic", **values)
    if "additional_color" in p:
        surface.shader = graph.add("emission", "mib_color_mix", num=1, mode_0=2, weight_0=1.0,
                                   color_base=surface.shader, color_0=p["additional_color"])


def rough_reflection(graph, surface, roughness, layered):
    """Reflections that are rougher than those of mia_material_x, as a layer of their own."""
    p = surface.parameters
    linked = isinstance(roughness, mi.Connection)
    if not p["reflectivity"] or p.get("transparency") or "anisotropy" in p or \
            not linked and roughness ** 2 <= MAX_ALPHA:
        return
    if "overall_bump" in p:  # the layer has no bump
        return
    spread = graph.curve(roughness, lambda r: max(r, 0.0) ** 2)
    layer = dict(reflection_color=p["refl_color"], reflection_base_weight=p["brdf_0_degree_refl"],
                 reflection_edge_weight=p["brdf_90_degree_refl"], edge_factor=p["brdf_curve"],
                 single_env_sample=False, u_spread=spread, v_spread=spread)
    p["reflectivity"] = 0.0
    base = graph.add("surface", "mia_material_x", **p)
    if layered:
        surface.shader = graph.add("rough", "mib_glossy_reflection", base_material=str(base),
                                   **layer)
        return
    rough = graph.add("rough", "mib_glossy_reflection", **layer)
    surface.shader = graph.add("rough_sum", "mib_color_mix", num=1, mode_0=2, weight_0=1.0,
                               color_base=base, color_0=rough)


def subsurface(graph, read, surface, layered):
    """Subsurface scattering in place of a part of the diffuse light; one radius for all channels."""
    amount = read.number("Subsurface Weight", "Subsurface")
    if amount <= 0 or surface.parameters.get("transparency", 0.0):
        return
    amount = min(amount, 1.0)
    p = surface.parameters
    base, weight = p["diffuse"], p["diffuse_weight"]
    if isinstance(weight, mi.Connection):
        graph.unsupported(read.node, "has subsurface scattering beside a linked metallic value; it "
                                     "is ignored")
        return
    radius = graph.constant(read.socket("Subsurface Radius"))
    scale = read.number("Subsurface Scale", default=1.0)
    if layered:
        colour, part = base, amount
    else:  # until 3.6 all diffuse light is scattered, with a radius that grows with the amount
        colour = graph.blend(amount, base, graph.colour(read.get("Subsurface Color")))
        scale, part = scale * amount, 1.0
    if max(radius) - min(radius) > 1e-3 * max(radius):
        graph.unsupported(read.node, "has one subsurface radius for each channel; their mean is used")
    scattered = graph.add(
        "subsurface", "misss_fast_shader", front_sss_color=graph.product(colour, weight * part),
        front_sss_weight=1.0, front_sss_radius=sum(radius) / 3 * scale, diffuse_weight=0.0,
        back_sss_weight=0.0, screen_composit=False)
    p["diffuse_weight"] = weight * (1 - part)
    surface.scattered = scattered


def add_scattered(graph, surface, shader):
    """The sum of a surface and its scattered light."""
    if surface.scattered is None:
        return shader
    return graph.add("subsurface_sum", "mib_color_mix", num=1, mode_0=2, weight_0=1.0,
                     color_base=shader, color_0=surface.scattered)


def sheen(graph, read, base, surface, layered, shader_of):
    """The sheen of cloth above everything else."""
    weight = read.get("Sheen Weight", "Sheen")
    if not isinstance(weight, mi.Connection) and weight <= 0:
        return
    white = (1.0, 1.0, 1.0)
    if layered:
        tint = graph.colour(read.get("Sheen Tint", default=white))
        roughness = read.number("Sheen Roughness", default=0.5)
    else:
        graph.unsupported(read.node, "has a sheen, which is approximated by another model")
        peak = max(max(base), 1e-6) if isinstance(base, tuple) else 1.0
        hue = tuple(c / peak for c in base) if isinstance(base, tuple) else base
        tint = graph.blend(read.number("Sheen Tint", default=0.5), white, hue)
        roughness, weight = SHEEN_ROUGHNESS, graph.product(weight, SHEEN_WEIGHT)
        metallic = read.get("Metallic")
        if not isinstance(metallic, mi.Connection):
            weight = graph.product(weight, 1.0 - metallic)
    surface.shader = graph.add("sheen", "oriel_sheen", base_material=str(shader_of(graph, surface)),
                               color=graph.product(tint, weight), roughness=roughness)


def volume(graph, socket, surface):
    """Statements of a homogeneous volume of a material. Absorption in glass is part of the glass."""
    found = graph.origin(socket)
    if found is None or not hasattr(found[0], "inputs"):
        return ""
    node = found[0]
    medium = medium_of(graph, node)
    if medium is None:
        graph.unsupported(node, "is unsupported as a volume and ignored")
        return ""
    density, albedo, anisotropy, absorbed = medium
    if density <= 0:
        return ""
    p = surface.parameters
    if surface.shader is None and p.get("transparency", 0.0) and not p.get("thin_walled", True):
        if max(albedo) > 0:
            graph.unsupported(node, "scatters light inside glass; only its absorption is rendered")
        p.update(refr_falloff_on=True, refr_falloff_dist=1.0 / density, refr_falloff_color_on=True,
                 refr_falloff_color=tuple(math.exp(-a) for a in absorbed))
        return ""
    if max(albedo) > 0:
        graph.unsupported(node, "scatters the light of lights once; light of the world and of "
                                "surfaces, and light that is scattered again, is missing")
    if max(absorbed) - min(absorbed) > 1e-3 and max(albedo) <= 0:
        graph.unsupported(node, "absorbs colours differently; their mean is used outside of glass")
    if max(albedo) <= 0:
        density *= sum(absorbed) / 3
    call = mi.call("parti_volume", mode=0, scatter=albedo, extinction=density, r=1.0, g1=anisotropy,
                   g2=0.0)
    return f"  volume {call}\n"


def medium_of(graph, node):
    """Extinction, scattering albedo, anisotropy, and absorption relative to the extinction."""
    def number(name, default=0.0):
        value = graph.value(node.inputs[name]) if name in node.inputs else default
        if isinstance(value, mi.Connection):
            graph.unsupported(node, f'has a link to "{name}", which is ignored')
            value = graph.constant(node.inputs[name])
        return graph.scalar(value)

    def colour(name):
        value = graph.value(node.inputs[name])
        if isinstance(value, mi.Connection):
            graph.unsupported(node, f'has a link to "{name}", which is ignored')
            value = graph.constant(node.inputs[name])
        return tuple(min(max(c, 0.0), 1.0) for c in graph.colour(value))

    density = number("Density", 1.0)
    if node.type == "VOLUME_ABSORPTION":
        return density, (0.0,) * 3, 0.0, tuple(1 - c for c in colour("Color"))
    if node.type == "VOLUME_SCATTER":
        return density, colour("Color"), number("Anisotropy"), (0.0,) * 3
    if node.type == "PRINCIPLED_VOLUME":
        if number("Emission Strength") > 0 or number("Blackbody Intensity") > 0:
            graph.unsupported(node, "emits light, which is ignored")
        albedo = colour("Color")
        return density, albedo, number("Anisotropy"), tuple(1 - c for c in albedo)
    return None


def displacement(graph, socket, material):
    """Statements of a displacement of vertices. Otherwise it becomes the bump of the surfaces."""
    found = graph.origin(socket)
    node = found[0] if found else None
    if node is None or getattr(node, "type", "") != "DISPLACEMENT":
        if node is not None and hasattr(node, "type"):
            graph.unsupported(node, "is unsupported as a displacement and ignored")
        return ""
    if versions.displaces_vertices(material):
        return displaced(graph, node)
    graph.displacement = node
    return ""


def displaced(graph, node):
    """Moves the vertices of the mesh by (height - midlevel) scale along their normals."""
    if getattr(node, "space", "OBJECT") != "OBJECT":
        graph.unsupported(node, "displaces in world space, which is read as object space")
    height, middle, scale = (graph.scalar(graph.value(node.inputs[k]))
                             for k in ("Height", "Midlevel", "Scale"))
    amount = arithmetic.operate(graph, "MULTIPLY",
                                arithmetic.operate(graph, "SUBTRACT", height, middle), scale)
    if not isinstance(amount, mi.Connection):
        amount = graph.add("displacement", "oriel_math", operation=0, input1=(amount,) * 3,
                           input2=(0.0,) * 3)
    return f"  displace = {mi.quoted(amount)}\n"
