# SPDX-License-Identifier: Apache-2.0
"""Simple surface nodes as mia_material_x; writer: the MaterialWriter."""
import math

from . import arithmetic, mi
from .surface import Surface, single_scattering


VELVET_ROUGHNESS = 0.5


def diffuse(writer, graph, node):
    colour = arithmetic.not_negative(graph, graph.colour(graph.value(node.inputs["Color"])))
    surface = Surface(diffuse=colour)
    rough = graph.value(node.inputs["Roughness"])
    if rough:
        surface.parameters["diffuse_roughness"] = rough
    writer.bumped(graph, node, surface.parameters)
    return surface


def sharp_or_rough(graph, node):
    """The roughness of a node; 0 if its distribution is sharp."""
    rough = graph.scalar(graph.value(node.inputs["Roughness"]))
    return 0.0 if getattr(node, "distribution", "") == "SHARP" else rough


def glossy(writer, graph, node):
    rough = sharp_or_rough(graph, node)
    single = getattr(node, "distribution", "") == "GGX"
    weight = single_scattering(1.0, rough, 1.0) if single else 1.0
    surface = Surface(diffuse_weight=0.0, reflectivity=weight, brdf_fresnel=False,
                      brdf_0_degree_refl=1.0, brdf_90_degree_refl=1.0, diffuse=(0.0, 0.0, 0.0),
                      refl_color=graph.colour(graph.value(node.inputs["Color"])),
                      refl_gloss=graph.curve(rough, writer.gloss))
    writer.bumped(graph, node, surface.parameters)
    return surface


def glass(writer, graph, node):
    rough = sharp_or_rough(graph, node)
    ior = graph.scalar(graph.value(node.inputs["IOR"]))
    ior = 1.45 if isinstance(ior, mi.Connection) else ior
    colour = graph.colour(graph.value(node.inputs["Color"]))
    reflects = node.type == "BSDF_GLASS"
    bending = math.sqrt(abs(1 - 1 / max(ior, 1.0001)) / 2)
    surface = Surface(
        diffuse_weight=0.0, diffuse=(0.0, 0.0, 0.0), reflectivity=1.0 if reflects else 0.0,
        refl_color=colour, brdf_fresnel=True, refr_ior=ior, transparency=1.0, refr_color=colour,
        refl_gloss=graph.curve(rough, writer.gloss), thin_walled=False,
        refr_gloss=graph.curve(rough, lambda r: writer.gloss(r * math.sqrt(bending))),
        skip_inside_refl=False, refl_depth=0, refr_depth=0)
    surface.transmits = True
    writer.bumped(graph, node, surface.parameters)
    return surface


def transparent(writer, graph, node):
    colour = graph.value(node.inputs["Color"])
    if colour == (1.0, 1.0, 1.0):
        surface = Surface(diffuse_weight=0.0)
        surface.opacity = 0.0
        return surface
    surface = Surface(diffuse_weight=0.0, reflectivity=0.0, transparency=1.0, thin_walled=True,
                      refr_color=graph.colour(colour), refr_ior=1.0)
    surface.transmits = True
    return surface


def translucent(writer, graph, node):
    surface = Surface(diffuse=(0.0, 0.0, 0.0), transparency=1.0, refr_translucency=True,
                      refr_trans_weight=1.0, thin_walled=True,
                      refr_trans_color=graph.colour(graph.value(node.inputs["Color"])))
    surface.transmits = True
    return surface


def emission(writer, graph, node):
    light = graph.product(graph.colour(graph.value(node.inputs["Color"])),
                          graph.scalar(graph.value(node.inputs["Strength"])))
    return Surface(diffuse_weight=0.0, diffuse=(0.0, 0.0, 0.0), additional_color=light)


def uv_tangent(graph, node):
    """Reads the directions of anisotropic highlights from the UV map of a Tangent node."""
    found = graph.origin(node.inputs["Tangent"])
    source = found[0] if found else None
    if getattr(source, "type", "") == "TANGENT" and source.direction_type == "UV_MAP":
        if source.uv_map:
            graph.unsupported(source, "is read from the active UV map")
    else:
        graph.unsupported(node, "has its highlights along the active UV map, not around an axis")
    graph.space("uv", "")


def anisotropic(writer, graph, node):
    """Reflections of which one half axis is (1 - amount)^2 of the other one; across the tangent until
    negative amounts."""
    surface = glossy(writer, graph, node)
    amount = graph.scalar(graph.value(node.inputs["Anisotropy"]))
    turn = graph.scalar(graph.value(node.inputs["Rotation"]))
    if isinstance(amount, mi.Connection) or isinstance(turn, mi.Connection):
        graph.unsupported(node, "has a linked anisotropy, which is ignored")
        return surface
    surface.parameters.update(
        anisotropy=min((1 - min(abs(amount), .99)) ** -2, 10.0), anisotropy_channel=-3,
        anisotropy_rotation=turn + (.25 if amount > 0 else 0.0))
    uv_tangent(graph, node)
    return surface


def subsurface(writer, graph, node):
    """Subsurface scattering alone, with one radius for all channels."""
    radius = graph.constant(node.inputs["Radius"])
    scale = graph.scalar(graph.value(node.inputs["Scale"]))
    if isinstance(scale, mi.Connection):
        scale = 1.0
    surface = Surface(diffuse=(0.0, 0.0, 0.0), diffuse_weight=0.0)
    if max(radius) - min(radius) > 1e-3 * max(radius):
        graph.unsupported(node, "has one subsurface radius for each channel; their mean is used")
    surface.scattered = graph.add(
        "subsurface", "misss_fast_shader", front_sss_weight=1.0, diffuse_weight=0.0,
        front_sss_color=graph.colour(graph.value(node.inputs["Color"])), back_sss_weight=0.0,
        front_sss_radius=sum(radius) / 3 * scale, screen_composit=False)
    return surface


def velvet(writer, graph, node):
    """Cloth by the sheen of the program above black."""
    graph.unsupported(node, "is approximated by another model of cloth")
    surface = Surface()
    black = graph.add("base", "mia_material_x", diffuse_weight=0.0, reflectivity=0.0)
    surface.shader = graph.add("velvet", "oriel_sheen", base_material=str(black),
                               color=graph.colour(graph.value(node.inputs["Color"])),
                               roughness=VELVET_ROUGHNESS)
    return surface


def coloured(writer, graph, node):
    """A diffuse surface of the colour of a surface that the program does not have."""
    graph.unsupported(node, "is approximated by a diffuse surface")
    if getattr(node, "parametrization", "") == "MELANIN" and "Melanin" in node.inputs:
        colour = hair_colour(graph.scalar(graph.constant(node.inputs["Melanin"])),
                             graph.scalar(graph.constant(node.inputs["Melanin Redness"])))
    else:
        colour = graph.colour(graph.value(node.inputs["Color"]))
    return Surface(diffuse=colour, diffuse_weight=1.0)


def hair_colour(melanin, redness):
    """The colour of hair with that amount of melanin: light that has crossed a fibre.

    Absorption of eumelanin and pheomelanin: d'Eon et al., "An Energy-Conserving Hair Reflectance
    Model", 2011.
    """
    amount = -math.log(max(1 - melanin, 1e-4))
    kinds = zip((.506, .841, 1.653), (.343, .733, 1.924))
    return tuple(math.exp(-amount * ((1 - redness) * dark + redness * red)) for dark, red in kinds)


SURFACES = {
    "BSDF_DIFFUSE": diffuse, "BSDF_GLOSSY": glossy, "BSDF_GLASS": glass, "BSDF_REFRACTION": glass,
    "BSDF_TRANSPARENT": transparent, "BSDF_TRANSLUCENT": translucent, "EMISSION": emission,
    "BACKGROUND": emission, "BSDF_ANISOTROPIC": anisotropic, "SUBSURFACE_SCATTERING": subsurface,
    "BSDF_VELVET": velvet, "BSDF_SHEEN": velvet, "BSDF_TOON": coloured, "BSDF_HAIR": coloured,
    "BSDF_HAIR_PRINCIPLED": coloured,
}
