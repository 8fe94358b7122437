# SPDX-License-Identifier: Apache-2.0
"""Passes: names and channels of Blender, and the layers of the EXR file that fill them."""
import numpy

from . import mattes, versions

RGB, XYZ = "RGB", "XYZ"


class Pass:
    """A pass of Blender: its property of the view layer, channels and source."""

    def __init__(self, name, flag, channels, kind, make):
        self.name = versions.pass_names().get(name, name)
        self.flag = flag
        self.channels = channels
        self.kind = kind
        self.make = make


def layer(name, channels=RGB):
    names = [f"{name}.{c}" for c in channels]
    return lambda picture: picture.stack(names)


def ratio(result, level):
    """Light divided by its colour, so that their product is the light of the layer."""
    def make(picture):
        light = sum_of(picture, result)
        colour = picture.stack([f"{level}.{c}" for c in RGB])
        if light is None or colour is None:
            return None
        return numpy.divide(light, colour, out=numpy.zeros_like(light), where=colour > 1e-6)
    return make


def sum_of(picture, names):
    planes = [picture.stack([f"{name}.{c}" for c in RGB]) for name in names]
    planes = [p for p in planes if p is not None]
    return sum(planes) if planes else None


def depth(picture):
    """Blender's depth of the background is 1e10."""
    z = picture.stack(["Z"])
    return None if z is None else numpy.where(z > 0, z, numpy.float32(1e10))


def mist(settings):
    """The share of the mist of the world, from the depth."""
    power = {"QUADRATIC": 2.0, "LINEAR": 1.0, "INVERSE_QUADRATIC": .5}[settings.falloff]
    start, length = settings.start, max(settings.depth, 1e-6)

    def make(picture):
        z = depth(picture)
        return None if z is None else numpy.clip((z - start) / length, 0, 1) ** power
    return make


def vector(picture):
    """Motion in pixels to the previous and the next frame."""
    m = picture.stack(["motion.X", "motion.Y"])
    return None if m is None else numpy.concatenate([-m, m], axis=1)


def noise(picture):
    variance = picture.stack([f"variance.{c}" for c in RGB])
    return None if variance is None else \
        numpy.sqrt(numpy.maximum(variance.mean(axis=1, keepdims=True), 0))


PASSES = (
    Pass("Depth", "use_pass_z", "Z", "VALUE", depth),
    Pass("Position", "use_pass_position", XYZ, "VECTOR", layer("position", XYZ)),
    Pass("Normal", "use_pass_normal", XYZ, "VECTOR", layer("normal", XYZ)),
    Pass("Vector", "use_pass_vector", "XYZW", "VECTOR", vector),
    Pass("DiffDir", "use_pass_diffuse_direct", RGB, "COLOR",
         ratio(["diffuse_result"], "diffuse_level")),
    Pass("DiffInd", "use_pass_diffuse_indirect", RGB, "COLOR",
         ratio(["indirect_result"], "diffuse_level")),
    Pass("DiffCol", "use_pass_diffuse_color", RGB, "COLOR", layer("diffuse_level")),
    Pass("GlossDir", "use_pass_glossy_direct", RGB, "COLOR", ratio(["spec_result"], "refl_level")),
    Pass("GlossInd", "use_pass_glossy_indirect", RGB, "COLOR",
         ratio(["refl_result"], "refl_level")),
    Pass("GlossCol", "use_pass_glossy_color", RGB, "COLOR", layer("refl_level")),
    Pass("TransInd", "use_pass_transmission_indirect", RGB, "COLOR",
         ratio(["refr_result", "tran_result"], "refr_level")),
    Pass("TransCol", "use_pass_transmission_color", RGB, "COLOR", layer("refr_level")),
    Pass("Emit", "use_pass_emit", RGB, "COLOR", layer("add_result")),
    Pass("AO", "use_pass_ambient_occlusion", RGB, "COLOR", layer("ao_raw")),
)
# Passes that Blender has no property for; settings of the view layer.
EXTRA = (
    Pass("Denoising Albedo", "use_albedo", RGB, "COLOR", layer("albedo")),
    Pass("Noise", "use_noise", "X", "VALUE", noise),
    Pass("Noisy Image", "use_noisy", RGB, "COLOR", lambda picture: None),
)
MATTES = (("use_pass_cryptomatte_object", "CryptoObject"),
          ("use_pass_cryptomatte_material", "CryptoMaterial"),
          ("use_pass_cryptomatte_asset", "CryptoAsset"))


# Passes of other engines that the program does not have, by their properties.
UNSUPPORTED = {"use_pass_uv": "UV", "use_pass_object_index": "IndexOB",
               "use_pass_material_index": "IndexMA", "use_pass_environment": "Env",
               "use_pass_shadow": "Shadow", "use_pass_subsurface_direct": "SubsurfaceDir",
               "use_pass_subsurface_indirect": "SubsurfaceInd",
               "use_pass_subsurface_color": "SubsurfaceCol", "use_pass_transmission_direct": "TransDir"}


def missing(view_layer):
    """Names of the passes of a view layer that are not rendered."""
    return [name for flag, name in UNSUPPORTED.items() if getattr(view_layer, flag, False)] + \
        [aov.name for aov in getattr(view_layer, "aovs", ())]


def matte_names(view_layer):
    """Names of the Cryptomatte passes of a view layer."""
    count = (min(16, view_layer.pass_cryptomatte_depth) + 1) // 2
    return [f"{name}{i:02d}" for flag, name in MATTES if getattr(view_layer, flag)
            for i in range(count)]


def wanted(view_layer, world):
    """Passes of a view layer besides Combined. world: of the scene, or None."""
    chosen = [p for p in PASSES if getattr(view_layer, p.flag, False)]
    if getattr(view_layer, "use_pass_mist", False) and world is not None:
        chosen.append(Pass("Mist", "use_pass_mist", "Z", "VALUE", mist(world.mist_settings)))
    settings = getattr(view_layer, "oriel", None)
    if settings:
        chosen += [p for p in EXTRA if getattr(settings, p.flag, False)]
    chosen += [Pass(name, "", "rgba", "COLOR", layer(name, "rgba")) for name in matte_names(view_layer)]
    for group in getattr(view_layer, "lightgroups", ()):
        name = f"Combined_{group.name}"
        chosen.append(Pass(name, "", RGB, "COLOR", layer(f"light_{group.name}")))
    return chosen


def register_all(engine, scene, view_layer):
    engine.register_pass(scene, view_layer, "Combined", 4, "RGBA", "COLOR")
    for p in wanted(view_layer, scene.world):
        engine.register_pass(scene, view_layer, p.name, len(p.channels), p.channels.upper(), p.kind)


def arguments(view_layer, denoise, coverage=False):
    """Arguments of `oriel render` for the passes of a view layer.

    coverage: mattes give the alpha.
    """
    chosen = wanted(view_layer, None)
    names = ["beauty", "depth", "normal", "albedo"]
    if any(p.name == "Noise" for p in chosen):
        names.append("variance")
    if getattr(view_layer, "use_pass_position", False):
        names.append("position")
    if getattr(view_layer, "use_pass_vector", False):
        names.append("motion")
    if any(getattr(view_layer, p.flag, False) for p in PASSES[4:]):
        names.append("outputs")
    if denoise:
        names += ["variance", "halves"]
    result = ["--layers", ",".join(dict.fromkeys(names))]
    if matte_names(view_layer) or coverage:
        depth_used = view_layer.pass_cryptomatte_depth if matte_names(view_layer) else 6
        result.append(f"--cryptomatte={depth_used}")
    return result


def coverage(picture, names=None):
    """Share of the camera paths of each pixel that hit an object: mattes without the id 0.

    names: count these objects only.
    """
    covered = numpy.zeros((picture.size[0] * picture.size[1], 1), numpy.float32)
    ids = None if names is None else numpy.array([mattes.value(n) for n in names], numpy.float32)
    rank = 0
    while f"CryptoObject{rank:02d}.r" in picture.channels:
        for identity, share in ("rg", "ba"):
            channels = [f"CryptoObject{rank:02d}.{c}" for c in (identity, share)]
            pair = picture.stack(channels)
            wanted = pair[:, 0] != 0 if ids is None else numpy.isin(pair[:, 0], ids)
            covered[:, 0] += numpy.where(wanted, pair[:, 1], 0)
        rank += 1
    return numpy.clip(covered, 0, 1)


def combined(picture, denoised):
    """The picture: the denoised layer if it is there, else the beauty. Values stay below half max."""
    names = ["denoised.R", "denoised.G", "denoised.B", "A"] if denoised else list("RGBA")
    pixels = picture.stack(names)
    if pixels is None and denoised:
        return combined(picture, False)
    if pixels is None:
        pixels = numpy.concatenate([picture.stack(list(RGB)), numpy.ones(
            (picture.size[0] * picture.size[1], 1), numpy.float32)], axis=1)
    return numpy.nan_to_num(pixels, copy=False, posinf=65504, neginf=0)
