# SPDX-License-Identifier: Apache-2.0
"""Panels of the properties editor. Panels of Blender that apply are shown as well."""
import bpy

from .engine import ENGINE


class OrielPanel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    COMPAT_ENGINES = {ENGINE}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES


class ORIEL_PT_sampling(OrielPanel, bpy.types.Panel):
    bl_label = "Sampling"
    bl_context = "render"

    def draw(self, context):
        layout, settings = self.layout, context.scene.oriel
        layout.use_property_split = True
        for name in ("samples", "noise", "time", "denoise", "preview_samples", "preview_denoise",
                     "seed", "threads"):
            layout.prop(settings, name)


class ORIEL_PT_light_paths(OrielPanel, bpy.types.Panel):
    bl_label = "Light Paths"
    bl_context = "render"

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.prop(context.scene.oriel, "indirect")
        self.layout.prop(context.scene.oriel, "depth")


class ORIEL_PT_motion_blur(OrielPanel, bpy.types.Panel):
    bl_label = "Motion Blur"
    bl_context = "render"

    def draw_header(self, context):
        self.layout.prop(context.scene.render, "use_motion_blur", text="")

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.prop(context.scene.render, "motion_blur_shutter")
        for owner in (context.scene.render, getattr(context.scene, "cycles", None)):
            if hasattr(owner, "motion_blur_position"):  # of Cycles until 4.1
                self.layout.prop(owner, "motion_blur_position")
                break


class ORIEL_PT_exposure(OrielPanel, bpy.types.Panel):
    bl_label = "Photographic Exposure"
    bl_context = "render"

    def draw_header(self, context):
        self.layout.prop(context.scene.oriel, "use_exposure", text="")

    def draw(self, context):
        settings = context.scene.oriel
        self.layout.use_property_split = True
        self.layout.active = settings.use_exposure
        for name in ("iso", "shutter", "f_number"):
            self.layout.prop(settings, name)


class ORIEL_PT_passes(OrielPanel, bpy.types.Panel):
    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context):
        from . import passes
        layout, layer = self.layout, context.view_layer
        layout.use_property_split = True
        column = layout.column(heading="Include")
        for p in passes.PASSES:
            if hasattr(layer, p.flag):
                column.prop(layer, p.flag)
        column.prop(layer, "use_pass_mist")
        column = layout.column(heading="Oriel")
        for p in passes.EXTRA:
            column.prop(layer.oriel, p.flag)
        column = layout.column(heading="Cryptomatte")
        for flag, _name in passes.MATTES:
            column.prop(layer, flag)
        column.prop(layer, "pass_cryptomatte_depth", text="Levels")


CLASSES = (ORIEL_PT_sampling, ORIEL_PT_light_paths, ORIEL_PT_motion_blur, ORIEL_PT_exposure,
           ORIEL_PT_passes)

# Panels for properties that are specific to another engine.
EXCLUDED = {"VIEWLAYER_PT_filter", "VIEWLAYER_PT_layer_passes", "RENDER_PT_freestyle",
            "VIEWLAYER_PT_freestyle_lineset", "DATA_PT_light", "NODE_DATA_PT_light", "DATA_PT_distance",
            "DATA_PT_falloff_curve"}
# Panels of EEVEE for data that Oriel reads as well.
INCLUDED = {"MATERIAL_PT_preview", "EEVEE_MATERIAL_PT_context_material",
            "EEVEE_MATERIAL_PT_surface", "EEVEE_NEXT_MATERIAL_PT_surface", "WORLD_PT_preview",
            "EEVEE_WORLD_PT_surface", "WORLD_PT_surface", "EEVEE_WORLD_PT_mist", "DATA_PT_light", "DATA_PT_EEVEE_light",
            "DATA_PT_spot", "DATA_PT_camera_dof", "DATA_PT_camera_dof_aperture",
            "DATA_PT_normals", "OBJECT_PT_motion_paths", "RENDER_PT_color_management"}


def shared_panels():
    """Panels that all engines share, and panels of EEVEE for materials, worlds and lights."""
    for panel in bpy.types.Panel.__subclasses__():
        engines = getattr(panel, "COMPAT_ENGINES", None)
        if engines is None or panel.__name__ in EXCLUDED or issubclass(panel, OrielPanel):
            continue
        if "BLENDER_RENDER" in engines or panel.__name__ in INCLUDED:
            yield panel


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for panel in shared_panels():
        panel.COMPAT_ENGINES.add(ENGINE)


def unregister():
    for panel in shared_panels():
        panel.COMPAT_ENGINES.discard(ENGINE)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
