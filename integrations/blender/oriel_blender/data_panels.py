# SPDX-License-Identifier: Apache-2.0
"""Panels for settings of films, view layers, worlds, objects, lights, cameras and materials that
Blender shows with Cycles only."""
import bpy

from .panels import OrielPanel


def draw_first(layout, owners, name, **settings):
    """Draws a property of the first owner that has it: some moved from Cycles to Blender."""
    for owner in owners:
        if owner is not None and hasattr(owner, name):
            layout.prop(owner, name, **settings)
            return


def draw_group(layout, owner, view_layer):
    """The light group of an object or world."""
    layout.prop_search(owner, "lightgroup", view_layer, "lightgroups", text="Light Group",
                       results_are_suggestions=True)


def draw_nodes(layout, tree, name):
    """The nodes that are linked to a socket of the output."""
    node = tree.get_output_node("ALL") or tree.get_output_node("CYCLES")
    if node is None or name not in node.inputs:
        layout.label(text="No output node")
        return
    layout.template_node_view(tree, node, node.inputs[name])


class ORIEL_PT_film(OrielPanel, bpy.types.Panel):
    bl_label = "Film"
    bl_context = "render"

    def draw(self, context):
        layout, cycles = self.layout, getattr(context.scene, "cycles", None)
        layout.use_property_split = True
        layout.prop(context.scene.render, "film_transparent", text="Transparent")
        draw_first(layout, [cycles], "pixel_filter_type")
        draw_first(layout, [cycles], "filter_width")


class ORIEL_PT_override(OrielPanel, bpy.types.Panel):
    bl_label = "Override"
    bl_context = "view_layer"

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.prop(context.view_layer, "material_override")


class ORIEL_PT_lightgroups(OrielPanel, bpy.types.Panel):
    bl_label = "Light Groups"
    bl_context = "view_layer"

    def draw(self, context):
        layer, row = context.view_layer, self.layout.row()
        row.template_list("UI_UL_list", "oriel_lightgroups", layer, "lightgroups", layer,
                          "active_lightgroup_index", rows=3)
        column = row.column(align=True)
        column.operator("scene.view_layer_add_lightgroup", icon="ADD", text="")
        column.operator("scene.view_layer_remove_lightgroup", icon="REMOVE", text="")


class ORIEL_PT_world(OrielPanel, bpy.types.Panel):
    bl_label = "Ray Visibility"
    bl_context = "world"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.world is not None

    def draw(self, context):
        layout, world = self.layout, context.world
        layout.use_property_split = True
        column = layout.column()
        for kind in ("camera", "diffuse", "glossy", "transmission"):
            draw_first(column, [getattr(world, "cycles_visibility", None)], kind)
        draw_group(layout, world, context.view_layer)


class ORIEL_PT_object(OrielPanel, bpy.types.Panel):
    bl_label = "Ray Visibility"
    bl_context = "object"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.object is not None and \
            context.object.type not in {"CAMERA", "EMPTY", "ARMATURE", "SPEAKER"}

    def draw(self, context):
        layout, ob = self.layout, context.object
        layout.use_property_split = True
        column = layout.column()
        for name in ("visible_camera", "visible_diffuse", "visible_glossy", "visible_transmission"):
            column.prop(ob, name)
        if ob.type != "LIGHT":
            column.prop(ob, "visible_shadow")
            layout.prop(ob, "is_holdout")
        draw_group(layout, ob, context.view_layer)


class ORIEL_PT_light(OrielPanel, bpy.types.Panel):
    bl_label = "Oriel"
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and bool(context.light)

    def draw(self, context):
        layout, light = self.layout, context.light
        cycles = getattr(light, "cycles", None)
        layout.use_property_split = True
        draw_first(layout, [cycles, light], "cast_shadow" if hasattr(cycles, "cast_shadow") else
                   "use_shadow")
        if light.type == "AREA":
            draw_first(layout, [light], "spread")
            draw_first(layout, [cycles], "is_portal", text="Portal")


class ORIEL_PT_light_nodes(OrielPanel, bpy.types.Panel):
    bl_label = "Nodes"
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and bool(context.light)

    def draw(self, context):
        light = context.light
        self.layout.prop(light, "use_nodes", icon="NODETREE")
        if light.use_nodes and light.node_tree:
            draw_nodes(self.layout, light.node_tree, "Surface")


class ORIEL_PT_panorama(OrielPanel, bpy.types.Panel):
    bl_label = "Panorama"
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.camera is not None and context.camera.type == "PANO"

    def draw(self, context):
        layout, camera = self.layout, context.camera
        owners = [camera, getattr(camera, "cycles", None)]
        layout.use_property_split = True
        draw_first(layout, owners, "panorama_type")
        kind = next((o.panorama_type for o in owners if hasattr(o, "panorama_type")), "")
        for name in {"EQUIRECTANGULAR": ("latitude_min", "latitude_max", "longitude_min",
                                         "longitude_max"),
                     "FISHEYE_EQUIDISTANT": ("fisheye_fov",),
                     "FISHEYE_EQUISOLID": ("fisheye_lens",)}.get(kind, ()):
            draw_first(layout, owners, name)


class MaterialPanel(OrielPanel):
    bl_context = "material"
    bl_options = {"DEFAULT_CLOSED"}
    socket = ""

    @classmethod
    def poll(cls, context):
        return super().poll(context) and bool(context.material) and context.material.use_nodes

    def draw(self, context):
        if context.material.node_tree:
            draw_nodes(self.layout, context.material.node_tree, self.socket)


class ORIEL_PT_volume(MaterialPanel, bpy.types.Panel):
    bl_label = "Volume"
    socket = "Volume"


class ORIEL_PT_displacement(MaterialPanel, bpy.types.Panel):
    bl_label = "Displacement"
    socket = "Displacement"

    def draw(self, context):
        material = context.material
        self.layout.use_property_split = True
        draw_first(self.layout, [material, getattr(material, "cycles", None)], "displacement_method",
                   text="Method")
        MaterialPanel.draw(self, context)


CLASSES = (ORIEL_PT_film, ORIEL_PT_override, ORIEL_PT_lightgroups, ORIEL_PT_world, ORIEL_PT_object,
           ORIEL_PT_light, ORIEL_PT_light_nodes, ORIEL_PT_panorama, ORIEL_PT_volume,
           ORIEL_PT_displacement)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
