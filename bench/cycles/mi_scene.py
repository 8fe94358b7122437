# SPDX-License-Identifier: Apache-2.0
"""Writes a scene of scenes.py as .mi."""
import math

import scenes

OPTIONS = '''options "opt"
  object space
  filter box 1 1
  trace on
  trace depth {n} {n} {n}
  "indirect" "path"
end options
'''


def numbers(*values):
    return " ".join(f"{v:.9g}" for v in values)


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


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
    """Of the GGX lobe with alpha = roughness squared; src/bsdf/gloss.h has the way back."""
    return (-2 * math.log2(roughness) - 1.5) / 7


def material(m):
    p = {"diffuse": (.5, .5, .5), "diffuse_weight": 1.0, "reflectivity": 0.0}
    if m["kind"] == "diffuse":
        p["diffuse"] = m["diffuse"]
    elif m["kind"] in ("metal", "plastic"):
        p.update({"reflectivity": 1.0, "refl_gloss": gloss(m["roughness"]), "brdf_90_degree_refl": 1.0,
                  "brdf_curve": 5.0, "refl_gloss_samples": 8})
        if m["kind"] == "metal":
            p.update({"refl_color": m["colour"], "brdf_0_degree_refl": 1.0, "diffuse_weight": 0.0})
        else:
            p.update({"diffuse": m["diffuse"], "brdf_0_degree_refl": .04})
    else:
        p.update({"transparency": 1.0, "reflectivity": 1.0, "refr_ior": m["ior"], "refr_gloss": 1.0,
                  "refl_gloss": 1.0, "diffuse_weight": 0.0, "brdf_fresnel": True,
                  "refr_color": (1, 1, 1), "refl_color": (1, 1, 1),
                  "do_refractive_caustics": True, "skip_inside_refl": False})
    def text(v):
        if isinstance(v, bool):
            return "on" if v else "off"
        return numbers(*v) if isinstance(v, tuple) else str(v)
    return ", ".join(f'"{k}" {text(v)}' for k, v in p.items())


def mesh(f, name, m):
    f.write(f'object "{name}"\n visible shadow trace\n group\n')
    f.writelines(numbers(*v) + "\n" for v in m["vertices"])
    normals = m.get("normals")
    if normals:
        f.writelines(numbers(*v) + "\n" for v in normals)
    count = len(m["vertices"])
    f.writelines(f"v {i} n {i + count}\n" if normals else f"v {i}\n" for i in range(count))
    f.writelines("p " + " ".join(map(str, face)) + "\n" for face in m["faces"])
    f.write(f' end group\nend object\ninstance "{name}_i" "{name}" material "{m["material"]}" '
            'end instance\n')


def light(f, name, l):
    """A rectangle of radiance L sends what a lamp of 4 L A sends that spreads it over 4 pi."""
    if l["kind"] == "sun":
        c = l["albedo_one"]
        f.write(f'light "{name}" "mib_light_infinite" ( "color" {c} {c} {c}, "shadow" on ) '
                f'direction {numbers(*l["direction"])} end light\n'
                f'instance "{name}_i" "{name}" end instance\n')
        return
    across, up = unit(l["across"]), unit(l["up"])
    w, h = math.sqrt(dot(l["across"], l["across"])), math.sqrt(dot(l["up"], l["up"]))
    normal = cross(across, up)  # it shines along this
    if l["kind"] == "area":
        c = 4 * l["radiance"] * w * h
        shader = f'"physical_light" ( "color" {c} {c} {c} )'
    else:
        shader = '"mia_portal_light" ( "cutoff_threshold" 0 )'
    place = world_to(across, up, normal, l["centre"])
    f.write(f'light "{name}" {shader} origin 0 0 0 rectangle {w} 0 0 0 {h} 0 4 4 end light\n'
            f'instance "{name}_i" "{name}" {"visible " if l["kind"] == "area" else ""}{place} '
            'end instance\n')


def write(scene, path, probe, exr):
    with open(path, "w", encoding="ascii") as f:
        f.write('$include <base.mi>\n$include <physics.mi>\n$include <architectural.mi>\n')
        f.write(OPTIONS.format(n=scene.get("bounces", scenes.BOUNCES)))
        for name, m in scene["materials"].items():
            f.write(f'material "{name}" "mia_material_x" ( {material(m)} ) end material\n')
        members = []
        for i, m in enumerate(scene["meshes"]):
            mesh(f, f"mesh{i}", m)
            members.append(f"mesh{i}_i")
        for i, l in enumerate(scene["lights"]):
            light(f, f"light{i}", l)
            members.append(f"light{i}_i")
        b = scene["background"]
        if scene.get("probe"):
            f.write(f'color texture "probe" "{probe}"\n'
                    f'shader "sky" "mib_lookup_spherical" ( "tex" "probe", "rotate" {-math.pi / 2:.9g} )\n')
        else:
            f.write(f'shader "sky" "mib_color_mix" ( "num" 0, "color_base" {b} {b} {b} )\n')
        c = scene["camera"]
        z = unit(sub(c["position"], c["target"]))
        x = unit(cross((0, 1, 0), z))
        f.write(f'camera "cam" output "rgba_fp" "exr" "{exr}" focal 1 aperture {c["width"]} '
                f'aspect {scenes.WIDTH / scenes.HEIGHT:.9g} resolution {scenes.WIDTH} '
                f'{scenes.HEIGHT} environment = "sky" end camera\n'
                f'instance "cam_i" "cam" {world_to(x, cross(z, x), z, c["position"])} '
                'end instance\n')
        f.write('instgroup "world" "cam_i" ' + " ".join(f'"{m}"' for m in members) +
                ' end instgroup\nrender "world" "cam_i" "opt"\n')
