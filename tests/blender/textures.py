# SPDX-License-Identifier: Apache-2.0
"""Procedural textures, each on a luminous square: pixels of Cycles and Oriel agree within 3 % of the
contrast of the texture."""
# acceptance: Y2
import pathlib
import sys

import bpy
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402

LIMIT = .03
PIXELS, COLUMNS, SAMPLES = 24, 9, 64


def noise(**inputs):
    return "TexNoise", {}, inputs, "Color"


def musgrave(kind, **inputs):
    return "TexMusgrave", {"musgrave_type": kind}, {"Scale": 3.0, **inputs}, 0


def voronoi(feature="F1", output="Distance", metric="EUCLIDEAN", **inputs):
    settings = {"feature": feature}
    if feature not in {"DISTANCE_TO_EDGE", "N_SPHERE_RADIUS"}:
        settings["distance"] = metric
    return "TexVoronoi", settings, {"Scale": 4.0, **inputs}, output


def wave(kind, direction, profile="SIN", **inputs):
    settings = {"wave_type": kind, "wave_profile": profile}
    settings["bands_direction" if kind == "BANDS" else "rings_direction"] = direction
    return "TexWave", settings, {"Scale": 1.0, **inputs}, "Color"


def magic(depth, output="Color", **inputs):
    return "TexMagic", {"turbulence_depth": depth}, {"Scale": 2.0, **inputs}, output


def brick(output="Color", inputs=None, **settings):
    return "TexBrick", settings, {"Scale": 3.0, **(inputs or {})}, output


def white(count, output="Color"):
    """White noise of places that square() rounds to cells."""
    return with_dimensions(("TexWhiteNoise", {}, {"W": .37}, output), count)


def with_dimensions(case, count):
    kind, settings, inputs, output = case
    name = {"TexVoronoi": "voronoi_dimensions", "TexMusgrave": "musgrave_dimensions"}.get(
        kind, "noise_dimensions")
    return kind, {**settings, name: count}, inputs, output


SHAPES = dict(Dimension=.8, Detail=3.4, Lacunarity=2.2)
CASES = {
    "noise": noise(Scale=3.0), "noise detail": noise(Scale=3.0, Detail=4.6, Roughness=.7),
    "noise distorted": noise(Scale=2.0, Detail=0.0, Distortion=1.5),
    **{f"noise {d}": with_dimensions(noise(Scale=3.0, W=.37, Distortion=.3), d)
       for d in ("1D", "2D", "4D")},
    **{f"musgrave {k}": musgrave(k, **SHAPES) for k in ("FBM", "MULTIFRACTAL")},
    **{f"musgrave {k}": musgrave(k, **SHAPES, Offset=.6, Gain=1.3)
       for k in ("HYBRID_MULTIFRACTAL", "RIDGED_MULTIFRACTAL")},
    "musgrave HETERO_TERRAIN": musgrave("HETERO_TERRAIN", **SHAPES, Offset=.6),
    "musgrave 4D": with_dimensions(musgrave("FBM", W=.7), "4D"),
    **{f"voronoi {f}": voronoi(f) for f in ("F1", "F2", "SMOOTH_F1", "DISTANCE_TO_EDGE")},
    "voronoi N_SPHERE_RADIUS": voronoi("N_SPHERE_RADIUS", "Radius"),
    **{f"voronoi {m}": voronoi(metric=m, Randomness=.7)
       for m in ("MANHATTAN", "CHEBYCHEV")},
    "voronoi MINKOWSKI": voronoi(metric="MINKOWSKI", Exponent=3.0),
    "voronoi smooth colour": voronoi("SMOOTH_F1", "Color", Smoothness=.5),
    "voronoi position": voronoi("F2", "Position"),
    **{f"voronoi 2D {f}": with_dimensions(voronoi(f), "2D")
       for f in ("F1", "F2", "SMOOTH_F1", "DISTANCE_TO_EDGE")},
    "voronoi 2D position": with_dimensions(voronoi(output="Position"), "2D"),
    **{f"voronoi 4D {f}": with_dimensions(voronoi(f, W=.37), "4D")
       for f in ("F1", "F2", "SMOOTH_F1", "DISTANCE_TO_EDGE")},
    "voronoi 4D radius": with_dimensions(voronoi("N_SPHERE_RADIUS", "Radius", W=.37), "4D"),
    "voronoi 4D metric": with_dimensions(voronoi(metric="MANHATTAN", W=.37), "4D"),
    "voronoi 4D position": with_dimensions(voronoi("SMOOTH_F1", "Position", W=.37), "4D"),
    "voronoi 4D W": with_dimensions(voronoi("SMOOTH_F1", "W", W=.37), "4D"),
    **{f"bands {d}": wave("BANDS", d) for d in ("X", "Y", "DIAGONAL")},
    **{f"rings {d}": wave("RINGS", d, "TRI") for d in ("X", "Z", "SPHERICAL")},
    "wave distorted": wave("BANDS", "X", Distortion=4.0, **{
        "Detail": 3.0, "Detail Scale": 1.5, "Detail Roughness": .6, "Phase Offset": 1.0}),
    **{f"magic {n}": magic(n, Distortion=1.3) for n in (0, 1, 2, 5, 10)},
    "magic Fac": magic(2, "Fac"),
}
# Pixels at sharp edges depend on the samples.
EDGES = {"brick": brick(),
         "brick mortar": brick("Fac", {"Mortar Size": .06, "Mortar Smooth": .8}),
         "brick squashed": brick(inputs={"Bias": -.2}, offset=.3, offset_frequency=3, squash=.6,
                                 squash_frequency=2),
         "voronoi colour": voronoi(output="Color"),
         "voronoi 2D colour": with_dimensions(voronoi(output="Color"), "2D"),
         "voronoi 4D colour": with_dimensions(voronoi(output="Color", W=.37), "4D"),
         **{f"voronoi 1D {f}": with_dimensions(voronoi(f), "1D")
            for f in ("F1", "F2", "SMOOTH_F1", "DISTANCE_TO_EDGE")},
         "voronoi 1D radius": with_dimensions(voronoi("N_SPHERE_RADIUS", "Radius"), "1D"),
         "voronoi 1D colour": with_dimensions(voronoi(output="Color"), "1D"),
         "voronoi 1D W": with_dimensions(voronoi(output="W"), "1D"),
         **{f"white noise {d}": white(d) for d in ("1D", "2D", "3D", "4D")},
         "white noise value": white("3D", "Value"),
         "saw": wave("BANDS", "X", "SAW")}


def square(k, name, case):
    """A luminous square whose light is texture / 4 + 1 / 2, so that negative values show."""
    kind, settings, inputs, output = case
    material, tree, _ = support.node_material(name)
    node = tree.nodes.new("ShaderNode" + kind)
    for key, value in settings.items():
        setattr(node, key, value)
    for key, value in inputs.items():
        node.inputs[key].default_value = value
    mapping, place = tree.nodes.new("ShaderNodeMapping"), tree.nodes.new("ShaderNodeTexCoord")
    mapping.inputs["Location"].default_value = (.3, -.2, .37)
    scale = tree.nodes.new("ShaderNodeVectorMath")
    scale.operation = "MULTIPLY_ADD"
    scale.inputs[1].default_value, scale.inputs[2].default_value = (.25,) * 3, (.5,) * 3
    light = tree.nodes.new("ShaderNodeEmission")
    at = mapping.outputs[0]
    if kind == "TexWhiteNoise":
        cells = tree.nodes.new("ShaderNodeVectorMath")
        cells.operation, cells.inputs[1].default_value = "SNAP", (.17, .17, .17)
        tree.links.new(at, cells.inputs[0])
        at = cells.outputs[0]
    if "1D" in settings.values():
        split = tree.nodes.new("ShaderNodeSeparateXYZ")
        tree.links.new(at, split.inputs[0])
        tree.links.new(split.outputs["X"], node.inputs["W"])
    for source, target in ((place.outputs["UV"], mapping.inputs["Vector"]),
                           (at, node.inputs["Vector"]),
                           (node.outputs[output], scale.inputs[0]),
                           (scale.outputs[0], light.inputs["Color"]),
                           (light.outputs[0], tree.nodes["Material Output"].inputs["Surface"])):
        tree.links.new(source, target)
    support.add_plane(1.0, material).location = k % COLUMNS + .5, -(k // COLUMNS) - .5, 0


def main():
    cases = {**CASES, **EDGES}
    rows = -(-len(cases) // COLUMNS)
    support.empty_scene(COLUMNS * PIXELS, rows * PIXELS)
    for k, (name, case) in enumerate(cases.items()):
        square(k, name, case)
    support.add_camera((COLUMNS / 2, -rows / 2, 5), type="ORTHO", ortho_scale=max(COLUMNS, rows))
    ours, theirs = (support.render(e, SAMPLES, "textures") for e in ("ORIEL", "CYCLES"))
    support.save_png(numpy.concatenate([ours, theirs], axis=0), support.FOLDER / "textures.png")
    failed = []
    for k, name in enumerate(cases):
        x, y = k % COLUMNS * PIXELS, (rows - 1 - k // COLUMNS) * PIXELS
        a, b = (p[y + 1:y + PIXELS - 1, x + 1:x + PIXELS - 1, :3] for p in (ours, theirs))
        error = numpy.sqrt(numpy.mean((a - b) ** 2)) / max(b.std(), 1e-6)
        if name in EDGES:
            error = numpy.median(numpy.abs(a - b)) / max(b.std(), 1e-6)
        print(f"{name:30s} difference {error:7.2%} of the contrast {b.std():.4f}", flush=True)
        if not error < LIMIT:
            failed.append(name)
    support.check(not failed, f"{len(cases)} textures within {LIMIT:.0%}: all but {failed}")


main()
print("all tests passed")
