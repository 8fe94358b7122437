# SPDX-License-Identifier: Apache-2.0
"""The camera: window, shift, depth of field and exposure."""
import math

import numpy

from . import mi


class Window:
    """Half sizes and centre of the window at distance 1 (perspective) or in scene units."""

    def __init__(self, camera, width, height, pixel_x=1.0, pixel_y=1.0, shift_x=None):
        xr, yr = width * pixel_x, height * pixel_y
        vertical = camera.sensor_fit == "VERTICAL" or (camera.sensor_fit == "AUTO" and xr < yr)
        sensor = camera.sensor_height if camera.sensor_fit == "VERTICAL" else camera.sensor_width
        self.orthographic = camera.type == "ORTHO"
        half = camera.ortho_scale / 2 if self.orthographic else sensor / (2 * camera.lens)
        self.half_x = half * xr / yr if vertical else half
        self.half_y = half if vertical else half * yr / xr
        self.centre_x = 2 * half * (camera.shift_x if shift_x is None else shift_x)
        self.centre_y = 2 * half * camera.shift_y
        self.aspect = xr / yr


def depth_of_field(camera_object, camera, to_world):
    """Focus distance and lens radius in scene units; None if depth of field is off."""
    dof = camera.dof
    if not dof.use_dof:
        return None
    distance = dof.focus_distance
    if dof.focus_object:
        axis = -numpy.array(to_world)[:3, 2]
        offset = numpy.array(dof.focus_object.matrix_world.translation) - \
            numpy.array(to_world)[:3, 3]
        distance = float(abs(offset @ (axis / numpy.linalg.norm(axis))))
    stop = max(dof.aperture_fstop, 1e-5)
    radius = 1 / (2 * stop) if camera.type == "ORTHO" else camera.lens * 1e-3 / (2 * stop)
    return distance, radius


def unscaled(matrix):
    """The matrix without scale, as Blender uses it for cameras."""
    m = numpy.array(matrix, numpy.float64)
    m[:3, :3] /= numpy.maximum(numpy.linalg.norm(m[:3, :3], axis=0), 1e-30)
    return m


class Unsupported(RuntimeError):
    """A camera that the program does not have."""


def panorama_settings(camera):
    """Reads settings of panoramas: of Cycles until 4.x, later of the camera."""
    settings = getattr(camera, "cycles", None)
    def get(name, default):
        found = getattr(camera, name, None)
        return getattr(settings, name, default) if found is None else found
    return get


def panorama_turn(camera):
    """Rotation of the camera for longitudes that are not symmetric, as a 3x3 matrix."""
    get = panorama_settings(camera)
    if camera.type != "PANO" or get("panorama_type", "EQUIRECTANGULAR") != "EQUIRECTANGULAR":
        return numpy.eye(3)
    middle = (get("longitude_min", -math.pi) + get("longitude_max", math.pi)) / 2
    return numpy.array([[math.cos(middle), 0, -math.sin(middle)], [0, 1, 0],
                        [math.sin(middle), 0, math.cos(middle)]])


def panorama_text(scene, camera):
    """The lens shader of a panoramic camera."""
    get = panorama_settings(camera)
    kind = get("panorama_type", "EQUIRECTANGULAR")
    render = scene.render
    size = render.resolution_x * render.pixel_aspect_x, render.resolution_y * render.pixel_aspect_y
    if kind == "EQUIRECTANGULAR":
        low, high = get("latitude_min", -math.pi / 2), get("latitude_max", math.pi / 2)
        if abs(low + high) > 1e-4:
            raise Unsupported("panoramas have the same latitude above and below the horizon")
        wide = get("longitude_max", math.pi) - get("longitude_min", -math.pi)
        return "  lens " + mi.call("oriel_lens_panorama", projection=0,
                                   horizontal=math.degrees(wide),
                                   vertical=math.degrees(high - low)) + "\n"
    angle = get("fisheye_fov", math.pi)
    if kind == "FISHEYE_EQUISOLID":
        # The image circle inside the frame shows the angle that the lens projects on the sensor.
        reach = camera.sensor_width / 2 * min(size) / max(size)
        angle = 4 * math.asin(min(reach / (2 * max(get("fisheye_lens", 10.5), 1e-3)), 1.0))
        return "  lens " + mi.call("oriel_lens_fisheye", mapping=1,
                                   angle=min(math.degrees(angle), 360.0)) + "\n"
    if kind == "FISHEYE_EQUIDISTANT":
        if abs(size[0] - size[1]) > 1e-3 * size[0]:
            raise Unsupported("equidistant fisheye cameras need square pictures")
        return "  lens " + mi.call("oriel_lens_fisheye", mapping=0,
                                   angle=min(math.degrees(angle), 360.0)) + "\n"
    raise Unsupported(f"panoramas of the type {kind} are unsupported")


def lens_text(scene, camera_object, camera, to_world):
    """Lens shaders: the panorama and depth of field."""
    text = panorama_text(scene, camera) if camera.type == "PANO" else ""
    bokeh = bokeh_call(camera_object, camera, to_world)
    return text + (f"  lens {bokeh}\n" if bokeh else "")


def bokeh_call(camera_object, camera, to_world):
    """The lens shader of depth of field; None if it is off."""
    focus = depth_of_field(camera_object, camera, to_world)
    if not focus:
        return None
    dof = camera.dof
    blades = dof.aperture_blades if dof.aperture_blades >= 3 else 0
    return mi.call("mia_lens_bokeh", on=True, plane=focus[0], radius=focus[1], samples=1, bias=1.0,
                   blade_count=blades, blade_angle=dof.aperture_rotation / (2 * math.pi))


def write(out, scene, camera_object, to_world, size, environment, options):
    """Writes camera and instance; returns the name of the instance.

    size: width and height in pixels. options: shift_x of multi-view, motion matrix or None; farthest:
    distance that must be seen.
    """
    camera = camera_object.data
    width, height = size
    render = scene.render
    window = Window(camera, width, height, render.pixel_aspect_x, render.pixel_aspect_y,
                    options.get("shift_x"))
    name = out.names.unique(camera_object.name)
    focal = "infinity" if window.orthographic else mi.number(camera.lens)
    aperture = 2 * window.half_x * (1 if window.orthographic else camera.lens)
    offset_x = window.centre_x / (2 * window.half_x) * width
    offset_y = window.centre_y / (2 * window.half_y) * height
    text = f"camera {mi.quoted(name)}\n" + \
        lens_text(scene, camera_object, camera, to_world)
    if environment:
        text += f"  environment = {mi.quoted(environment)}\n"
    text += (f"  focal {focal}\n  aperture {mi.number(aperture)}\n"
             f"  aspect {mi.number(window.aspect)}\n  resolution {width} {height}\n")
    if offset_x or offset_y:
        text += f"  offset {mi.number(offset_x)} {mi.number(offset_y)}\n"
    if camera.type != "PANO":
        end = max(camera.clip_end, options.get("farthest", 0.0))
        text += f"  clip {mi.number(camera.clip_start)} {mi.number(end)}\n"
    out.add(text + "end camera\n")
    motion = ""
    if options.get("motion") is not None:
        motion = mi.transform(unscaled(options["motion"]), "motion transform") or ""
    instance = out.names.unique(name + "_inst")
    placed = unscaled(to_world)
    placed[:3, :3] = placed[:3, :3] @ panorama_turn(camera)
    out.instance(instance, name, placed, motion)
    return instance


def exposure_factor(settings):
    """Factor of the photographic exposure, linear: grey of 12.7 % at the metered luminance.

    The saturation based speed of ISO 12232: a luminance of 78 N^2 / (t S) cd/m2 at an aperture N,
    a time t and a speed S gives 1. Watts are converted to cd/m2 by 683 lm/W.
    """
    if not settings.use_exposure:
        return 1.0
    white = 78.0 * settings.f_number ** 2 * settings.shutter / settings.iso
    return 683.0 / white
