# SPDX-License-Identifier: Apache-2.0
"""Differences between versions of Blender. Features are tested, not version numbers."""
import bpy
import numpy


def split_normals(mesh):
    """Normals of the face corners, float32 of shape (corners, 3)."""
    normals = numpy.empty(len(mesh.loops) * 3, numpy.float32)
    if hasattr(mesh, "corner_normals"):  # from 4.1
        mesh.corner_normals.foreach_get("vector", normals)
    else:
        mesh.calc_normals_split()
        mesh.loops.foreach_get("normal", normals)
    return normals.reshape(-1, 3)


def has_vertex_normals(mesh):
    """Whether smooth faces have the normals of their vertices: neither sharp edges nor custom
    normals."""
    if hasattr(mesh, "normals_domain"):  # from 4.1
        return mesh.normals_domain == "POINT"
    return not mesh.use_auto_smooth


def smooth_faces(mesh):
    """Smooth flags of the faces, bool of shape (faces,)."""
    flags = numpy.empty(len(mesh.polygons), bool)
    mesh.polygons.foreach_get("use_smooth", flags)
    return flags


def uv_layer(layer):
    """Texture coordinates of the face corners, float32 of shape (corners, 2)."""
    uv = numpy.empty(len(layer.data) * 2, numpy.float32)
    if hasattr(layer, "uv") and len(getattr(layer, "uv")) == len(layer.data):  # from 3.5
        layer.uv.foreach_get("vector", uv)
    else:
        layer.data.foreach_get("uv", uv)
    return uv.reshape(-1, 2)


def triangle_polygons(mesh):
    """The face of each triangle."""
    faces = numpy.empty(len(mesh.loop_triangles), numpy.int32)
    if hasattr(mesh, "loop_triangle_polygons"):  # from 3.6
        mesh.loop_triangle_polygons.foreach_get("value", faces)
    else:
        mesh.loop_triangles.foreach_get("polygon_index", faces)
    return faces


def face_sizes(mesh):
    """Numbers of corners of the faces."""
    sizes = numpy.empty(len(mesh.polygons), numpy.int32)
    mesh.polygons.foreach_get("loop_total", sizes)
    return sizes


def set_corner_normals(mesh, normals):
    """Custom normals of the face corners. Removed functions are skipped."""
    if hasattr(mesh, "use_auto_smooth"):  # until 4.0
        mesh.use_auto_smooth = True
    mesh.normals_split_custom_set(normals)


def add_triangles(mesh, corners):
    """Adds triangles to a mesh with vertices; corners: int32 (3 x triangles,)."""
    count = len(corners) // 3
    mesh.loops.add(3 * count)
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", numpy.arange(0, 3 * count, 3, dtype=numpy.int32))
    if not bpy.types.MeshPolygon.bl_rna.properties["loop_total"].is_readonly:  # until 3.5
        mesh.polygons.foreach_set("loop_total", numpy.full(count, 3, numpy.int32))


def set_uv(layer, uv):
    """Sets texture coordinates of the face corners, float32 of shape (corners, 2)."""
    values = numpy.ascontiguousarray(uv).ravel()
    if hasattr(layer, "uv") and len(layer.uv) == len(layer.data):  # from 3.5
        layer.uv.foreach_set("vector", values)
    else:
        layer.data.foreach_set("uv", values)


def new_curve(ob, path, index):
    """A new animation curve of an object."""
    if ob.animation_data is None or ob.animation_data.action is None:
        ob.animation_data_create()
        ob.animation_data.action = bpy.data.actions.new(ob.name)
    action = ob.animation_data.action
    if hasattr(action, "fcurves"):  # until 4.5
        return action.fcurves.new(path, index=index)
    return action.fcurve_ensure_for_datablock(ob, path, index=index)


def show_alpha(material):
    """Shows transparency in the viewport of EEVEE; from 4.2 that is the default."""
    if not hasattr(material, "surface_render_method") and hasattr(material, "blend_method"):
        material.blend_method = "HASHED"


def principled_is_layered(node):
    """Whether the layers of Principled BSDF weaken those below (from 4.0)."""
    return "Coat Weight" in node.inputs


def displaces_vertices(material):
    """Whether a material moves vertices; otherwise its displacement is bump."""
    settings = getattr(material, "cycles", None)
    method = getattr(material, "displacement_method", None) or \
        getattr(settings, "displacement_method", "BUMP")  # of Cycles until 4.0
    return method != "BUMP"


def light_factor(light):
    """Exposure of a light (from 4.5)."""
    return 2.0 ** getattr(light, "exposure", 0.0)


def light_temperature(light):
    """Colour of the temperature of a light (from 4.5)."""
    if getattr(light, "use_temperature", False):
        return tuple(light.temperature_color)
    return (1.0, 1.0, 1.0)


def shutter_position(scene):
    """Place of the shutter around a frame: START, CENTER or END."""
    owner = scene.render if hasattr(scene.render, "motion_blur_position") else \
        getattr(scene, "cycles", None)  # of Cycles until 4.1
    return getattr(owner, "motion_blur_position", "CENTER")


def sky_dust(node):
    """Density of dust of a sky texture; that of aerosols from 5.0."""
    return getattr(node, "dust_density", getattr(node, "aerosol_density", 1.0))


def set_sky_dust(node, density):
    setattr(node, "dust_density" if hasattr(node, "dust_density") else "aerosol_density", density)


def input_of(node, name):
    """An input by name or identifier. Names have changed, such as Fac to Factor; identifiers stay."""
    return next((s for s in node.inputs if name in (s.name, s.identifier)), None)


def spots_have_cosine():
    """Whether the light of spots in Cycles falls with the cosine to the axis. Measured with 3.4; the
    sources of later versions have no such factor."""
    return bpy.app.version < (3, 5, 0)


def world_is_visible(world, kind):
    """Whether rays of a kind see the world; a setting of Cycles."""
    return bool(getattr(getattr(world, "cycles_visibility", None), kind, True))


def light_casts_shadow(light):
    cycles = getattr(light, "cycles", None)
    if cycles is not None and hasattr(cycles, "cast_shadow"):  # until 4.1
        return bool(cycles.cast_shadow)
    return bool(getattr(light, "use_shadow", True))


def linear_spaces():
    """Names of colour spaces without a curve."""
    return {"Linear", "Linear Rec.709", "Raw", "Non-Color", "scene_linear"}


def pass_names():
    """Names of the passes of Cycles, short until 4.5 and long from 5.0."""
    if bpy.app.version >= (5, 0, 0):
        return {"DiffDir": "Diffuse Direct", "DiffInd": "Diffuse Indirect", "DiffCol": "Diffuse Color",
                "GlossDir": "Glossy Direct", "GlossInd": "Glossy Indirect", "GlossCol": "Glossy Color",
                "TransDir": "Transmission Direct", "TransInd": "Transmission Indirect",
                "TransCol": "Transmission Color", "Emit": "Emission", "Env": "Environment",
                "IndexOB": "Object Index", "IndexMA": "Material Index"}
    return {}
