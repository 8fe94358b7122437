# SPDX-License-Identifier: Apache-2.0
"""Lights, environment, focus and exposure of a dump; the inverse of lights.py and world.py."""
import math
import os

import bpy
import numpy
from mathutils import Vector

from . import lights, versions

EXPOSURE_CONSTANT = 1.2  # of mia_exposure_photographic


def parameters_of(dump, uses):
    """Type and parameters of the last shader of a list."""
    call = dump.call(uses[-1]) if uses else None
    return (call["type"], call["parameters"]) if call else ("", {})


def numbers(value, default):
    return [float(v) for v in value[:3]] if isinstance(value, list) and len(value) >= 3 else \
        list(default)


def set_energy(light, colour, factor):
    peak = max(max(colour), 0.0)
    light.energy = peak * factor
    light.color = [c / peak for c in colour] if peak > 0 else (1, 1, 1)


def light(reader, source):
    """The light data of an element; None if another part of the scene has its light."""
    kind, parameters = parameters_of(reader.dump, source["shaders"])
    name, area = source["name"], source.get("area")
    colour = numbers(parameters.get("color"), (1, 1, 1))
    if kind == "mia_physicalsun":
        return None  # part of the sky
    if kind == "mia_portal_light" or (kind == "physical_light" and area and
                                      area["shape"] in {"rectangle", "disc"}):
        made = bpy.data.lights.new(name, "AREA")
        set_energy(made, colour, 1.0)
        set_shape(made, area)
        if kind == "mia_portal_light" and hasattr(made, "cycles"):
            made.cycles.is_portal = True
        return made
    if kind == "mib_light_infinite" or ("direction" in source and "origin" not in source):
        made = bpy.data.lights.new(name, "SUN")
        made.angle = 0.0
        set_energy(made, colour, math.pi)
        return made
    made = bpy.data.lights.new(name, "SPOT" if "spread" in source else "POINT")
    made.shadow_soft_size = 0.0
    if area and area["shape"] == "sphere" and area["numbers"]:
        made.shadow_soft_size = area["numbers"][0]
    set_energy(made, colour, math.pi)
    if kind in {"mib_light_photometric", "mia_photometric_light"} and with_profile(
            reader, made, colour, parameters.get("profile", "")):
        if "manual_flux_lm" in parameters or "manual_intensity_cd" in parameters:
            reader.report(f'light "{name}": its intensity is that of its profile')
        return made
    if kind != "physical_light":
        reader.report(f'light "{name}": {kind} is approximated by a physical light')
    if "spread" in source:
        outer = math.acos(min(max(source["spread"], 0.0), 1.0))
        made.spot_size = 2 * outer
        inner = float(parameters.get("cone", source["spread"]))
        width = 1 - source["spread"]
        made.spot_blend = min(max((inner - source["spread"]) / width, 0), 1) if width > 0 else 0
    return made


def with_profile(reader, made, colour, name):
    """Gives a light the profile of an IES file, by the units of lights.photometric; False if there
    is no such file."""
    profiles = {p["name"]: p.get("file", "") for p in reader.dump.list("profiles")}
    path = profiles.get(name, "") if isinstance(name, str) else ""
    if not path.lower().endswith(".ies") or not os.path.isfile(path):
        return False
    set_energy(made, colour, lights.LUMENS_OF_WATT)
    made.use_nodes = True
    tree = made.node_tree
    emission = next(n for n in tree.nodes if n.type == "EMISSION")
    node = tree.nodes.new("ShaderNodeTexIES")
    node.mode, node.filepath = "EXTERNAL", path
    tree.links.new(node.outputs[0], emission.inputs["Strength"])
    return True


def set_shape(made, area):
    values = area["numbers"] if area else []
    if area and area["shape"] == "disc" and len(values) >= 4:
        made.shape, made.size = "DISK", 2 * values[3]
    elif len(values) >= 6:
        made.shape = "RECTANGLE"
        made.size, made.size_y = Vector(values[0:3]).length, Vector(values[3:6]).length


def orientation(matrix, source, data):
    """The matrix of an object whose -z axis is the direction of the light, at its origin."""
    area = source.get("area")
    direction = Vector(source.get("direction", (0, 0, -1)))
    if area and area["shape"] == "rectangle" and len(area["numbers"]) >= 6:
        x = Vector(area["numbers"][0:3]).normalized()
        z = -direction.normalized() if "direction" in source else \
            x.cross(Vector(area["numbers"][3:6])).normalized()
        if getattr(getattr(data, "cycles", None), "is_portal", False):
            z = -z  # portals shine along +z
    else:
        z = -direction.normalized()
        x = (Vector((0, 1, 0)) if abs(z.y) < .9 else Vector((1, 0, 0))).cross(z).normalized()
        if z.z > .999999:
            x = Vector((1, 0, 0))
    y = z.cross(x).normalized()
    turned = (matrix.to_3x3() @ _columns(x, y, z)).to_4x4()
    turned.translation = matrix @ Vector(source.get("origin", (0, 0, 0)))
    return turned


def _columns(x, y, z):
    from mathutils import Matrix
    return Matrix((x, y, z)).transposed()


def focus(dump, source, camera):
    """Depth of field of mia_lens_bokeh and physical_lens_dof."""
    for use in source.get("lens", ()):
        call = dump.call(use)
        if not call or call["type"] not in {"mia_lens_bokeh", "physical_lens_dof"}:
            continue
        parameters = call["parameters"]
        radius = float(parameters.get("radius", 1.0))
        if parameters.get("on", True) is False or radius <= 0:
            continue
        camera.dof.use_dof = True
        camera.dof.focus_distance = abs(float(parameters.get("plane", 100.0)))
        length = 1.0 if camera.type == "ORTHO" else camera.lens * 1e-3
        camera.dof.aperture_fstop = length / (2 * radius)


def exposure(dump, source):
    """The exposure of the view as that of mia_exposure_photographic, without its curve."""
    result = 0.0
    for use in source.get("lens", ()):
        call = dump.call(use)
        if not call or call["type"] != "mia_exposure_photographic":
            continue
        get = lambda name, default: float(call["parameters"].get(name, default))
        iso, factor = get("film_iso", 100), get("cm2_factor", 1)
        if iso > 0:
            factor /= EXPOSURE_CONSTANT * get("f_number", 16) ** 2 * \
                get("camera_shutter", 100) * 100 / iso
        if factor > 0:
            result = min(max(math.log2(factor), -32), 32)
    return result


def environment(reader, source, frame=None):
    """The world of the environment shader of a camera; frame: from 0, the last one if None."""
    kind, parameters = parameters_of(reader.dump, source.get("environment", ()))
    world = bpy.data.worlds.new("World")
    world.use_nodes = True
    tree = world.node_tree
    background = next(n for n in tree.nodes if n.type == "BACKGROUND")
    background.inputs["Color"].default_value = (0, 0, 0, 1)
    if kind == "mia_physicalsky":
        world.oriel.sky_model = "PHYSICAL"  # the same sky in Oriel
        sky(reader, parameters, tree, background, reader.frames.count - 1 if frame is None else frame)
    elif kind == "mib_lookup_spherical":
        image = reader.materials.image(parameters.get("tex", ""))
        if image is not None:
            node = tree.nodes.new("ShaderNodeTexEnvironment")
            node.image = image
            tree.links.new(node.outputs[0], background.inputs["Color"])
        keep_environment(reader, source, tree)
        reader.report("the rotation of the environment picture is kept in native nodes only")
    elif kind == "mib_color_mix" and isinstance(parameters.get("color_base"), list) and \
            not parameters.get("num"):
        rgb = numbers(parameters["color_base"], (0, 0, 0))
        background.inputs["Color"].default_value = (*rgb, 1)
    elif kind:
        keep_environment(reader, source, tree)
        reader.report(f"the environment shader {kind} is kept in native nodes; the world of other "
                      "engines is black")
    return world


def keep_environment(reader, source, tree):
    """The environment as native nodes."""
    call = reader.dump.call(source["environment"][-1])
    if call is not None:
        reader.materials.native_nodes(tree, call, "World")


def sky(reader, parameters, tree, background, frame):
    """Sun and sky as a sky texture; the strength converts its units (world.py)."""
    node = tree.nodes.new("ShaderNodeTexSky")
    types = {item.identifier for item in node.bl_rna.properties["sky_type"].enum_items}
    node.sky_type = next(t for t in ("NISHITA", "MULTIPLE_SCATTERING", "SINGLE_SCATTERING",
                                     "HOSEK_WILKIE") if t in types)
    direction = numpy.array([0.0, 0.0, 1.0])
    suns = [p for p in reader.dump.list("instances") if p["kind"] == "light" and (
        p["name"] == parameters.get("sun") or parameters_of(
            reader.dump, reader.lights[p["element"]]["shaders"])[0] == "mia_physicalsun")]
    if suns:
        element = reader.lights[suns[0]["element"]]
        element = reader.frames.version("lights", element["name"], frame, element)
        toward = -Vector(element.get("direction", (0, 0, -1)))
        rotation = reader.matrix_at(suns[0], frame).to_3x3()
        direction = numpy.array((rotation @ toward).normalized())
    elif isinstance(parameters.get("sun_direction"), list):
        direction = numpy.array(reader._upright.to_3x3() @ Vector(parameters["sun_direction"][:3]))
    if hasattr(node, "sun_elevation"):
        node.sun_elevation = math.asin(max(-1, min(1, direction[2] / numpy.linalg.norm(direction))))
        node.sun_rotation = math.atan2(direction[0], direction[1])
        node.sun_disc = bool(suns)
        versions.set_sky_dust(node, min(1.0 + float(parameters.get("haze", 0.0)) / 1.5, 10.0))
    conversion = numbers(parameters.get("rgb_unit_conversion"), (1e-4,) * 3)
    background.inputs["Strength"].default_value = max(conversion) * math.pi * 683
    tree.links.new(node.outputs[0], background.inputs["Color"])
    reader.report("sun and sky become a sky texture: other engines render another sky")
