# SPDX-License-Identifier: Apache-2.0
"""Settings of scenes and view layers."""
import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty


class OrielSceneSettings(bpy.types.PropertyGroup):
    samples: IntProperty(name="Samples", default=128, min=1, soft_max=4096,
                         description="Samples per pixel of final renders")
    noise: FloatProperty(name="Noise Target", default=0.0, min=0.0, max=1.0, precision=3,
                         description="Stop at this relative noise, e.g. 0.02 (0 = off)")
    time: FloatProperty(name="Time Limit", default=0.0, min=0.0, unit="TIME_ABSOLUTE",
                        description="Seconds per frame (0 = none)")
    preview_samples: IntProperty(name="Viewport Samples", default=16, min=1, soft_max=1024,
                                 description="Samples per pixel of the viewport")
    preview_denoise: BoolProperty(name="Denoise Viewport", default=False,
                                  description="Denoise the finished picture of the viewport")
    depth: IntProperty(name="Trace Depth", default=8, min=0, max=64,
                       description="Maximum number of reflections and of refractions")
    indirect: EnumProperty(
        name="Indirect Light", default="path",
        items=[("path", "Path Tracing", "Every path by itself; no bias"),
               ("path+cache", "Path Tracing with Cache", "Faster in rooms"),
               ("fg", "Final Gathering", "Points that are interpolated")])
    seed: IntProperty(name="Seed", default=0, min=0, description="Seed of the noise")
    threads: IntProperty(name="Threads", default=0, min=0, max=4096,
                         description="Number of threads (0 = all)")
    denoise: BoolProperty(name="Denoise", default=False, description="Denoise final renders")
    use_exposure: BoolProperty(
        name="Photographic Exposure", default=False,
        description="Scale the picture by film speed, shutter and aperture. The view transform of "
                    "Blender is applied afterwards")
    iso: FloatProperty(name="Film Speed", default=100.0, min=1.0, soft_max=6400.0,
                       description="ISO")
    shutter: FloatProperty(name="Shutter", default=100.0, min=0.001, soft_max=8000.0,
                           description="Shutter speed: 100 means 1/100 s")
    f_number: FloatProperty(name="F-number", default=16.0, min=0.1, soft_max=32.0,
                            description="F-number of the exposure; depth of field is independent")


class OrielLayerSettings(bpy.types.PropertyGroup):
    use_albedo: BoolProperty(name="Albedo", description="Pass \"Denoising Albedo\"")
    use_noise: BoolProperty(name="Noise", description="Estimated error of each pixel")
    use_noisy: BoolProperty(name="Noisy Image",
                            description="The picture before denoising, pass \"Noisy Image\"")


CLASSES = (OrielSceneSettings, OrielLayerSettings)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.oriel = PointerProperty(type=OrielSceneSettings)
    bpy.types.ViewLayer.oriel = PointerProperty(type=OrielLayerSettings)


def unregister():
    del bpy.types.ViewLayer.oriel
    del bpy.types.Scene.oriel
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
