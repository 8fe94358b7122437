# SPDX-License-Identifier: Apache-2.0
"""Lights, with the units of Blender: watts, and W/m2 of suns."""
import hashlib
import math
import os

from . import camera, light_nodes, mi, versions

LUMENS_OF_WATT = 177.83  # of IES profiles in Cycles: the luminous efficacy of its white light
PROFILE_ANGLES = 1801  # of profiles of area lights with spread and of spots
SUN_DISTANCE = 1e5  # scene units; a scene of 100 units sees the disc under 0.06 degrees of parallax


def colour(light, factor):
    tint = versions.light_temperature(light)
    strength = light.energy * versions.light_factor(light) * factor
    return tuple(c * t * strength for c, t in zip(light.color, tint))


def blackbody(kelvin):
    """Linear Rec.709 of a black body, with luminance 1 (Planck's law, CIE 1931 by Wyman 2013)."""
    def gauss(x, mean, low, high):
        return math.exp(-0.5 * ((x - mean) * (low if x < mean else high)) ** 2)
    xyz = [0.0, 0.0, 0.0]
    for nm in range(380, 781, 5):
        planck = nm ** -5 / (math.exp(1.438777e7 / (nm * max(kelvin, 800.0))) - 1)
        x = 1.056 * gauss(nm, 599.8, .0264, .0323) + .362 * gauss(nm, 442, .0624, .0374) - \
            .065 * gauss(nm, 501.1, .0490, .0382)
        y = .821 * gauss(nm, 568.8, .0213, .0247) + .286 * gauss(nm, 530.9, .0613, .0322)
        z = 1.217 * gauss(nm, 437, .0845, .0278) + .681 * gauss(nm, 459, .0385, .0725)
        xyz = [a + b * planck for a, b in zip(xyz, (x, y, z))]
    x, y, z = (v / xyz[1] for v in xyz)
    rgb = (3.2406 * x - 1.5372 * y - .4986 * z, -.9689 * x + 1.8758 * y + .0415 * z,
           .0557 * x - .2040 * y + 1.0570 * z)
    return tuple(max(v, 0.0) for v in rgb)


def area_size(light, matrix):
    """Edges of the area light along local x and y, and its area in world units."""
    width = light.size
    height = light.size_y if light.shape in {"RECTANGLE", "ELLIPSE"} else light.size
    scale = [math.sqrt(sum(matrix[r][c] ** 2 for r in range(3))) for c in range(2)]
    area = width * scale[0] * height * scale[1]
    if light.shape in {"DISK", "ELLIPSE"}:
        area *= math.pi / 4
    return width, height, area, scale


def write(out, ob, light, name, matrix, motion, report, images):
    """Writes a light and its instance; returns the name of the instance, or None.

    images: of the scene; files that the light needs are written into their folder.
    """
    factor, profile = light_nodes.factor(out, images, light, report)
    folder = images.folder
    element = out.names.unique(name + ".light")
    unit = matrix
    if light.type == "SUN":
        body = sun(light, factor)
    elif light.type == "AREA":
        if getattr(getattr(light, "cycles", None), "is_portal", False):
            body, unit = portal(light, matrix), camera.unscaled(matrix)
        else:
            body = area(out, light, matrix, factor, getattr(ob, "visible_camera", True), report,
                        folder)
            unit = camera.unscaled(matrix)
    else:
        body = point(out, light, factor, profile, getattr(ob, "visible_camera", True), report,
                     folder)
    out.light(element, *by_lobe(ob, light, body, report))
    instance = out.names.unique(name)
    extra = mi.transform(motion, "motion transform") or "" if motion is not None else ""
    return instance if out.instance(instance, element, unit, extra) else None


def by_lobe(ob, light, body, report):
    """A light with the visibility of its object, and without shadows if they are off: oriel_light has
    the parameters of its shader, and factors by the kind of surface."""
    diffuse, glossy, through = (getattr(ob, f"visible_{kind}", True)
                                for kind in ("diffuse", "glossy", "transmission"))
    shader, rest = body
    shadows = versions.light_casts_shadow(light)
    if (diffuse and glossy and through and shadows) or shader.shader == "mia_portal_light":
        return body
    if glossy != through:
        report(f'light "{light.name}": refractions see it as reflections do')
    values = dict(shader.parameters, diffuse=float(diffuse), glossy=float(glossy), shadow=shadows)
    return mi.call_of("oriel_light", values), rest


def product(a, b):
    return tuple(x * y for x, y in zip(a, b))


def sun(light, factor):
    """A sun is directional; with an angle it is a disc that is far away."""
    irradiance = product(colour(light, 1.0), factor)
    angle = light.angle / 2
    if angle < 1e-4 or max(irradiance) <= 0:
        shader = mi.call("mib_light_infinite", color=tuple(c / math.pi for c in irradiance),
                         shadow=versions.light_casts_shadow(light))
        return shader, "  direction 0 0 -1\n"
    return sun_disc(irradiance, angle, False)


def sun_disc(irradiance, half, visible):
    """A distant disc with that half angle."""
    # physical_light has 4 times the intensity along the normal, which is E D^2.
    shader = mi.call("physical_light",
                     color=tuple(4 * c * SUN_DISTANCE ** 2 for c in irradiance))
    radius = SUN_DISTANCE * math.tan(min(half, 1.4))
    return shader, (f"  origin 0 0 {mi.number(SUN_DISTANCE)}\n  direction 0 0 -1\n"
                    f"  disc 0 0 -1 {mi.number(radius)} visible {'on' if visible else 'off'}\n")


def profile_light(out, light, power, intensity, folder):
    """A light whose intensity by the angle to its axis, for a power of 4 in every channel, is a
    photometric profile."""
    angles = [90.0 * (i / (PROFILE_ANGLES - 1)) for i in range(PROFILE_ANGLES)]
    values = [1000 * intensity(math.radians(degrees)) for degrees in angles]
    rows = ["IESNA:LM-63-1995", "TILT=NONE", f"1 -1 1 {len(angles)} 1 1 2 0 0 0", "1 1 0"]
    for numbers in (angles, [0.0], values):
        texts = [f"{v:.6g}" for v in numbers]
        rows += [" ".join(texts[i:i + 10]) for i in range(0, len(texts), 10)]
    path = write_profile(folder, "\n".join(rows) + "\n")
    name = out.names.unique(light.name + ".profile")
    out.add(f"lightprofile {mi.quoted(name)}\n  format ies\n  file {mi.quoted(path)}\n"
            "end lightprofile\n")
    return mi.call("mib_light_photometric", color=tuple(c / 4 / 1000 for c in power), shadow=True,
                   profile=mi.Words(mi.quoted(name)))


def spread_light(out, light, power, half, folder):
    """The light of an area through a grid of slats: none beyond the half angle. Its intensity is
    cos (tan half - tan) / (tan half - half) of that along the normal of an area that shines to the
    whole side; both have the same power."""
    reach = math.tan(half) - half
    def intensity(angle):
        return math.cos(angle) * (math.tan(half) - math.tan(angle)) / reach if angle < half else 0.0
    return profile_light(out, light, power, intensity, folder)


def cosine_spot(out, light, power, folder):
    """A spot of Cycles until 3.4, whose intensity falls with the cosine to its axis."""
    outer = math.cos(light.spot_size / 2)
    blend = light.spot_blend * (1 - outer)
    def intensity(angle):
        cosine = math.cos(angle)
        if cosine <= outer:
            return 0.0
        x = min((cosine - outer) / blend, 1.0) if blend > 0 else 1.0
        return cosine * x * x * (3 - 2 * x)
    return profile_light(out, light, power, intensity, folder)


def area(out, light, matrix, factor, visible, report, folder):
    """An area light shines with P / (4 A) W/(m2 sr); a quarter of the power along its normal."""
    width, height, surface, scale = area_size(light, matrix)
    power = product(colour(light, 1.0), factor)
    half = getattr(light, "spread", math.pi) / 2
    if half < math.radians(89.9):
        shader = spread_light(out, light, power, max(half, math.radians(.5)), folder)
    else:
        shader = mi.call("physical_light", color=power)
    width, height = width * scale[0], height * scale[1]
    seen = "on" if visible else "off"
    if light.shape in {"DISK", "ELLIPSE"}:
        if light.shape == "ELLIPSE" and abs(width - height) > 1e-6:
            report(f'light "{light.name}": the ellipse becomes a disc of the same area')
        shape = f"disc 0 0 -1 {mi.number(math.sqrt(width * height) / 2)}"
    else:
        shape = f"rectangle {mi.number(width)} 0 0 0 {mi.number(height)} 0"
    return shader, f"  origin 0 0 0\n  direction 0 0 -1\n  {shape} visible {seen}\n"


def point(out, light, factor, profile, visible, report, folder):
    """A point or spot light has P / (4 pi) W/sr; physical_light has 4 times the intensity."""
    power = tuple(c / math.pi for c in product(colour(light, 1.0), factor))
    parameters = {"color": power}
    text = ""
    if light.type == "SPOT":
        half = min(light.spot_size / 2, math.radians(89.9))
        inner = math.cos(half) + light.spot_blend * (1 - math.cos(half))
        parameters["cone"] = min(inner, 1.0)
        text = f"  direction 0 0 -1\n  spread {mi.number(math.cos(half))}\n"
    shader = mi.call_of("physical_light", parameters)
    if light.type == "SPOT" and profile is None and versions.spots_have_cosine():
        shader, text = cosine_spot(out, light, power, folder), ""
    if profile is not None:
        shader, text = photometric(out, light, power, profile, report, folder), ""
    if light.shadow_soft_size > 0 and profile is None:
        text += f"  sphere {mi.number(light.shadow_soft_size)} visible {'on' if visible else 'off'}\n"
    return shader, f"  origin 0 0 0\n{text}"


def write_profile(folder, text):
    """A file of an IES text, once for each content."""
    digest = hashlib.blake2b(text.encode(), digest_size=8).hexdigest()
    path = os.path.join(str(folder), f"profile-{digest}.ies")
    if not os.path.exists(path):
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    return path


def photometric(out, light, power, profile, report, folder):
    import bpy
    path = bpy.path.abspath(profile.filepath) if profile.mode == "EXTERNAL" else ""
    if profile.mode == "INTERNAL" and profile.ies is not None:
        path = write_profile(folder, profile.ies.as_string())
    if not path or not os.path.isfile(path):
        report(f'light "{light.name}": its IES file is missing: {path}')
        return mi.call("physical_light", color=power)
    name = out.names.unique(light.name + ".ies")
    out.add(f"lightprofile {mi.quoted(name)}\n  format ies\n  file {mi.quoted(path)}\n"
            "end lightprofile\n")
    # Cycles converts the candela of a profile to W/sr by 177.83 lm/W; `power` is P / pi.
    watts = tuple(c * math.pi / LUMENS_OF_WATT for c in power)
    return mi.call("mib_light_photometric", color=watts, shadow=True,
                   profile=mi.Words(mi.quoted(name)))


def portal(light, matrix):
    width, height, _area, scale = area_size(light, matrix)
    shader = mi.call("mia_portal_light", on=True, reverse=True, visible=False)
    return shader, (f"  origin 0 0 0\n  rectangle {mi.number(width * scale[0])} 0 0 "
                    f"0 {mi.number(height * scale[1])} 0\n")
