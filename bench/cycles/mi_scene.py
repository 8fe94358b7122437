# SPDX-License-Identifier: Apache-2.0
"""Writes a scene of scenes.py as .mi."""
import math

import scenes

OPTIONS = '''options "opt"
  object space
  filter box 1 1
  trace on
  trace depth {n} {n} {n}
  caustic {caustic}
  "indirect" "path"
  {motion}
end options
'''


def numbers(*values):
    return " ".join(f"{v:.9g}" for v in values)


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def plus(a, b):
    return tuple(x + y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return tuple(x / math.sqrt(dot(a, a)) for x in a)


def world_to(x, y, z, origin):
    """The matrix that takes the world to these axes; rows as .mi has them."""
    rows = [(x[i], y[i], z[i], 0) for i in range(3)]
    rows.append((-dot(x, origin), -dot(y, origin), -dot(z, origin), 1))
    return "transform " + "  ".join(numbers(*row) for row in rows)


def gloss(roughness):
    """Glossiness of the GGX lobe with alpha = roughness squared; inverse of src/bsdf/gloss.h."""
    return (-2 * math.log2(roughness) - 1.5) / 7


def material(m):
    # The default limits of the material, 5, would be below those of the options.
    p = {"diffuse": (.5, .5, .5), "diffuse_weight": 1.0, "reflectivity": 0.0,
         "refl_depth": 0, "refr_depth": 0}
    if m["kind"] == "diffuse":
        p["diffuse"] = m["diffuse"]
    elif m["kind"] in ("metal", "brushed", "plastic"):
        p.update({"reflectivity": 1.0, "refl_gloss": gloss(m["roughness"]), "refl_gloss_samples": 8,
                  "anisotropy": m.get("ratio", 1.0)})
        if m["kind"] != "plastic":
            p.update({"refl_color": m["colour"], "brdf_0_degree_refl": 1.0, "brdf_90_degree_refl": 1.0,
                      "diffuse_weight": 0.0})
        else:
            p.update({"diffuse": m["diffuse"], "brdf_fresnel": True, "refr_ior": 1.5})
    elif m["kind"] == "glow":
        p.update({"diffuse_weight": 0.0, "additional_color": m["radiance"]})
    elif m["kind"] == "cloth":  # of the light that is not reflected, all is scattered through
        share = max(m["through"])
        p.update({"diffuse": tuple(c / (1 - share) for c in m["diffuse"]), "transparency": share,
                  "refr_translucency": True, "refr_trans_weight": 1.0, "thin_walled": True,
                  "refr_color": (1, 1, 1), "refr_trans_color": tuple(c / share for c in m["through"])})
    elif m["kind"] == "mirror":
        p.update({"reflectivity": 1.0, "refl_gloss": 1.0, "refl_color": m["colour"],
                  "brdf_0_degree_refl": 1.0, "brdf_90_degree_refl": 1.0, "diffuse_weight": 0.0})
    else:
        # The blur of the material does not depend on the index of refraction: at 1.5 microfacets
        # turn light through a pane by about a quarter of the angle.
        smooth = gloss(m["roughness"] / 2) if m["kind"] == "frosted" else 1.0
        p.update({"transparency": 1.0, "reflectivity": 1.0, "refr_ior": m["ior"], "refr_gloss": smooth,
                  "refl_gloss": smooth, "diffuse_weight": 0.0, "brdf_fresnel": True,
                  "refr_color": (1, 1, 1), "refl_color": (1, 1, 1),
                  "do_refractive_caustics": not m.get("straight"), "skip_inside_refl": False})
    if "bump" in m:
        p["bump"] = '= "{}_dents"'.format(m["bump"][0])
    if "picture" in m:
        p["diffuse"] = f'= "{m["picture"]}_look_up"'
    if "cut_out" in m:
        p["cutout_opacity"] = f'= "{m["cut_out"]}_look_up"'

    def text(v):
        if isinstance(v, bool):
            return "on" if v else "off"
        return numbers(*v) if isinstance(v, tuple) else str(v)
    return ", ".join(f'"{k}" {text(v)}' for k, v in p.items())


def moves(motion):
    """The places of an instance when the shutter opens and when it closes."""
    c, angle = motion["centre"], math.radians(motion.get("turn", 0))
    x, z = (math.cos(angle), 0, -math.sin(angle)), (math.sin(angle), 0, math.cos(angle))
    end = plus(c, motion.get("by", (0, 0, 0)))
    return (world_to((1, 0, 0), (0, 1, 0), (0, 0, 1), c) + " motion " +
            world_to(x, (0, 1, 0), z, end))


def mesh(f, name, m):
    f.write(f'object "{name}"\n visible shadow trace\n group\n')
    f.writelines(numbers(*v) + "\n" for v in m["vertices"])
    normals = m.get("normals")
    if normals:
        f.writelines(numbers(*v) + "\n" for v in normals)
    uvs = m.get("uvs")
    if uvs:
        f.writelines(numbers(*uv, 0) + "\n" for uv in uvs)
    count = len(m["vertices"])
    for i in range(count):
        normal = f" n {i + count}" if normals else ""
        f.write(f"v {i}{normal}" + (f" t {i + count * (2 if normals else 1)}" if uvs else "") + "\n")
    f.writelines("p " + " ".join(map(str, face)) + "\n" for face in m["faces"])
    f.write(f' end group\nend object\ninstance "{name}_i" "{name}" material "{m["material"]}" '
            f'{moves(m["motion"]) if "motion" in m else ""} end instance\n')


def light(f, name, l):
    """A rectangle of radiance L sends what a lamp of 4 L A sends that spreads it over 4 pi."""
    if l["kind"] == "sun":
        c = l["albedo_one"]
        f.write(f'light "{name}" "mib_light_infinite" ( "color" {c} {c} {c}, "shadow" on ) '
                f'direction {numbers(*l["direction"])} end light\n'
                f'instance "{name}_i" "{name}" end instance\n')
        return
    if l["kind"] == "spot":
        c, edge = 4 * l["intensity"], math.cos(math.radians(l["half_angle"]))
        f.write(f'light "{name}" "physical_light" ( "color" {c} {c} {c}, "cone" {edge:.9g} ) '
                f'origin {numbers(*l["centre"])} direction {numbers(*l["direction"])} '
                f'spread {edge:.9g} end light\ninstance "{name}_i" "{name}" end instance\n')
        return
    if l["kind"] == "profile":
        c = l["factor"]
        place = world_to((1, 0, 0), (0, 0, -1), (0, 1, 0), l["centre"])
        f.write(f'light "{name}" "mib_light_photometric" ( "color" {c} {c} {c}, "shadow" on, '
                f'"profile" "profile" ) origin 0 0 0 end light\n'
                f'instance "{name}_i" "{name}" {place} end instance\n')
        return
    across, up = unit(l["across"]), unit(l["up"])
    w, h = math.sqrt(dot(l["across"], l["across"])), math.sqrt(dot(l["up"], l["up"]))
    normal = cross(across, up)  # the light shines along it
    if l["kind"] == "area":
        c = 4 * l["radiance"] * w * h
        shader = f'"physical_light" ( "color" {c} {c} {c} )'
    else:
        shader = '"mia_portal_light" ( "cutoff_threshold" 0 )'
    place = world_to(across, up, normal, l["centre"])
    f.write(f'light "{name}" {shader} origin 0 0 0 rectangle {w} 0 0 0 {h} 0 4 4 end light\n'
            f'instance "{name}_i" "{name}" {"visible " if l["kind"] == "area" else ""}{place} '
            'end instance\n')


def physical_sky(f, sky):
    """Sun and sky; the disc is left out, as the light is the sun."""
    f.write(f'light "sun" "mia_physicalsun" ( "haze" {sky["haze"]}, "y_is_up" on ) direction '
            f'{numbers(*(-x for x in sky["to_sun"]))} end light\n'
            'instance "sun_i" "sun" end instance\n'
            f'shader "sky" "mia_physicalsky" ( "haze" {sky["haze"]}, "y_is_up" on, "sun" "sun_i", '
            '"sun_disk_intensity" 0, "sun_glow_intensity" 0 )\n')


def camera(f, place, width, pixels, more=""):
    f.write(f'camera "cam" output "rgba_fp" "exr" "unused.exr" focal 1 aperture {width} '
            f'aspect {pixels[0] / pixels[1]:.9g} resolution {pixels[0]} {pixels[1]} '
            f'environment = "sky" {more} end camera\ninstance "cam_i" "cam" {place} end instance\n')


def write_sky(sky, path):
    """The sky alone as a latitude-longitude picture whose centre is +x, as in Blender."""
    with open(path, "w", encoding="ascii") as f:
        f.write('$include <base.mi>\n$include <architectural.mi>\n$include <oriel.mi>\n'
                'options "opt" object space filter box 1 1 trace on "indirect" "path" end options\n')
        physical_sky(f, sky)
        f.write('material "grey" "mia_material_x" ( "diffuse" .5 .5 .5 ) end material\n')
        mesh(f, "speck", {"vertices": [(0, 0, 9e3), (1e-3, 0, 9e3), (0, 1e-3, 9e3)],
                          "faces": [(0, 1, 2)], "material": "grey"})
        camera(f, world_to((0, 0, 1), (0, 1, 0), (-1, 0, 0), (0, 0, 0)), 1, (1024, 512),
               'lens "oriel_lens_panorama" ( )')
        f.write('instgroup "world" "cam_i" "sun_i" "speck_i" end instgroup\n'
                'render "world" "cam_i" "opt"\n')


def write_sunlit(sky, path):
    """A white square that faces the sun, under the sun alone."""
    z = unit(sky["to_sun"])
    x = unit(cross((0, 1, 0), z))
    y = cross(z, x)
    corner = [tuple(a * i + b * j for i, j in zip(x, y)) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    with open(path, "w", encoding="ascii") as f:
        f.write('$include <base.mi>\n$include <architectural.mi>\n'
                'options "opt" object space filter box 1 1 trace on "indirect" "path" end options\n')
        physical_sky(f, sky)
        f.write('shader "black" "mib_color_mix" ( "num" 0, "color_base" 0 0 0 )\n'
                'material "w" "mia_material_x" ( "diffuse" 1 1 1, "reflectivity" 0 ) end material\n')
        mesh(f, "square", {"vertices": corner, "faces": [(0, 1, 2, 3)], "material": "w"})
        f.write('camera "cam" focal 1 aperture .1 aspect 1 resolution 8 8 environment = "black" '
                f'end camera\ninstance "cam_i" "cam" {world_to(x, y, z, z)} end instance\n'
                'instgroup "world" "cam_i" "sun_i" "square_i" end instgroup\n'
                'render "world" "cam_i" "opt"\n')


def write_profile(path, candela):
    """An IES file of equidistant vertical angles from straight down to straight up."""
    angles = [180 * i / (len(candela) - 1) for i in range(len(candela))]
    with open(path, "w", encoding="ascii") as f:
        f.write("IESNA:LM-63-1995\n[TEST] computed\nTILT=NONE\n"
                f"1 -1 1 {len(candela)} 1 1 2 0 0 0\n1 1 0\n")
        f.write(numbers(*angles) + "\n0\n" + numbers(*candela) + "\n")


def moving(scene):
    return "by" in scene["camera"] or any("motion" in m for m in scene["meshes"])


def write(scene, path, probe, profile):
    with open(path, "w", encoding="ascii") as f:
        f.write('$include <base.mi>\n$include <physics.mi>\n$include <architectural.mi>\n')
        refracts = any(m["kind"] == "frosted" or not m.get("straight", True)
                       for m in scene["materials"].values())
        f.write(OPTIONS.format(n=scene.get("bounces", scenes.BOUNCES),
                               caustic="on" if refracts else "off",
                               motion="motion on motion steps 15 shutter 1" if moving(scene) else ""))
        if "profile" in scene:
            f.write(f'lightprofile "profile" format ies file "{profile}" hermite 3 end lightprofile\n')
        for name, picture in scene.get("pictures", {}).items():
            f.write(f'color texture "{name}" "{picture}"\n'
                    f'shader "{name}_place" "mib_texture_vector" ( "select" 0 )\n'
                    f'shader "{name}_tile" "mib_texture_remap" ( "input" = "{name}_place", '
                    '"torus_x" on, "torus_y" on )\n'
                    f'shader "{name}_look_up" "mib_texture_lookup" ( "tex" "{name}", '
                    f'"coord" = "{name}_tile" )\n')
        for name, m in scene["materials"].items():
            if "bump" in m:  # the shader's step is .01 of the picture, and its normal turns to dents
                f.write(f'shader "{m["bump"][0]}_dents" "mib_bump_map2" ( "tex" "{m["bump"][0]}", '
                        f'"factor" {-100 * m["bump"][1]:.9g} )\n')
            # A material without shadow shader has opaque shadows, and paths refract light in it.
            shadow = f'shadow = "{name}_s" ' if m.get("straight") or "cut_out" in m else ""
            f.write(f'shader "{name}_s" "mia_material_x" ( {material(m)} )\n'
                    f'material "{name}" = "{name}_s" {shadow}end material\n')
        members = []
        for i, m in enumerate(scene["meshes"]):
            mesh(f, f"mesh{i}", m)
            members.append(f"mesh{i}_i")
        for i, l in enumerate(scene["lights"]):
            light(f, f"light{i}", l)
            members.append(f"light{i}_i")
        b = scene["background"]
        if "sky" in scene:
            physical_sky(f, scene["sky"])
            members.append("sun_i")
        elif scene.get("probe"):
            f.write(f'color texture "probe" "{probe}"\n'
                    f'shader "sky" "mib_lookup_spherical" ( "tex" "probe", "rotate" {-math.pi / 2:.9g} )\n')
        else:
            f.write(f'shader "sky" "mib_color_mix" ( "num" 0, "color_base" {b} {b} {b} )\n')
        c = scene["camera"]
        z = unit(sub(c["position"], c["target"]))
        x = unit(cross((0, 1, 0), z))
        more = ""
        if "lens" in c:
            radius, plane = c["lens"]
            more += f'lens "mia_lens_bokeh" ( "plane" {plane}, "radius" {radius}, "samples" 1 ) '
        if "fog" in scene:
            more += f'volume "parti_volume" ( "scatter" 1 1 1, "extinction" {scene["fog"]} ) '
        place = world_to(x, cross(z, x), z, c["position"])
        if "by" in c:
            place += " motion " + world_to(x, cross(z, x), z, plus(c["position"], c["by"]))
        camera(f, place, c["width"], (scenes.WIDTH, scenes.HEIGHT), more)
        f.write('instgroup "world" "cam_i" ' + " ".join(f'"{m}"' for m in members) +
                ' end instgroup\nrender "world" "cam_i" "opt"\n')
