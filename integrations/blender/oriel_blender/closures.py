# SPDX-License-Identifier: Apache-2.0
"""Simple surface nodes as mia_material_x; writer: the MaterialWriter."""
import math

from . import arithmetic, mi
from .surface import Surface, single_scattering


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


SURFACES = {
    "BSDF_DIFFUSE": diffuse, "BSDF_GLOSSY": glossy, "BSDF_GLASS": glass, "BSDF_REFRACTION": glass,
    "BSDF_TRANSPARENT": transparent, "BSDF_TRANSLUCENT": translucent, "EMISSION": emission,
}
