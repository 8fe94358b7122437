# SPDX-License-Identifier: Apache-2.0
"""Bakes inputs of surfaces whose nodes have no equivalent into images, by Cycles.

A baked image is a node of the material with the property "oriel_bake": the node and the socket that
it replaces in Oriel. Other engines keep the original nodes.
"""
import bmesh
import bpy
from bpy.props import IntProperty

from . import nodes, textures, world as links
from .engine import ENGINE

PROPERTY = "oriel_bake"
SURFACES = {"BSDF_PRINCIPLED", "BSDF_DIFFUSE", "BSDF_GLOSSY", "BSDF_GLASS", "EMISSION"}
# Nodes that are read without a translator.
TRANSPARENT = {"REROUTE", "GROUP", "GROUP_INPUT", "MAPPING", "TEX_COORD", "UVMAP", "NEW_GEOMETRY",
               "NORMAL_MAP", "BUMP"}
KINDS = {"RGBA", "VALUE"}


def key_of(socket):
    return f"{socket.node.name}|{socket.identifier}"


def find(socket):
    """The node of the baked image of a socket, or None."""
    wanted = key_of(socket)
    return next((node for node in socket.id_data.nodes if node.get(PROPERTY) == wanted), None)


def has_unsupported(socket, seen=()):
    """Whether a node that feeds a socket has no equivalent."""
    for link in socket.links:
        node = link.from_node
        if node.name in seen or node.mute:
            continue
        known = node.type in TRANSPARENT or \
            node.type in nodes.TRANSLATORS and textures.has_equivalent(node) or \
            node.bl_idname.startswith("OrielNode_")
        if not known or any(has_unsupported(s, (*seen, node.name)) for s in node.inputs):
            return True
    return False


def sockets(material):
    """Inputs of surface nodes that should be baked."""
    tree = material.node_tree if material and material.use_nodes else None
    return [socket for node in (tree.nodes if tree else ()) if node.type in SURFACES
            for socket in node.inputs if socket.type in KINDS and socket.is_linked and
            has_unsupported(socket)]


def part_of(ob, slot):
    """A copy of an object with the faces of one slot; the caller removes it."""
    copy = ob.copy()
    copy.data = ob.data.copy()
    mesh = bmesh.new()
    mesh.from_mesh(copy.data)
    others = [face for face in mesh.faces if face.material_index != slot]
    bmesh.ops.delete(mesh, geom=others, context="FACES")
    mesh.to_mesh(copy.data)
    mesh.free()
    return copy


def bake_socket(context, part, material, socket, size):
    """Bakes one input; the node of the image stays in the material."""
    tree = material.node_tree
    target = find(socket) or tree.nodes.new("ShaderNodeTexImage")
    target[PROPERTY] = key_of(socket)
    target.label = f"Oriel Bake: {socket.name}"
    target.location = socket.node.location.x - 300, socket.node.location.y - 400
    is_colour = socket.type == "RGBA"
    if target.image is not None:
        bpy.data.images.remove(target.image)
    image = bpy.data.images.new(f"{material.name} {socket.name}", size, size,
                                float_buffer=not is_colour)
    image.colorspace_settings.name = "sRGB" if is_colour else "Non-Color"
    target.image = image
    output = links.output_node(tree, "OUTPUT_MATERIAL")
    surface = output.inputs["Surface"]
    before = surface.links[0].from_socket if surface.is_linked else None
    emission = tree.nodes.new("ShaderNodeEmission")
    try:
        tree.links.new(socket.links[0].from_socket, emission.inputs["Color"])
        tree.links.new(emission.outputs[0], surface)
        for node in tree.nodes:
            node.select = node == target
        tree.nodes.active = target
        with context.temp_override(object=part, active_object=part, selected_objects=[part],
                                   selected_editable_objects=[part]):
            bpy.ops.object.bake(type="EMIT", margin=8)
        image.pack()
    finally:
        tree.nodes.remove(emission)
        if before is not None:
            tree.links.new(before, surface)


class ORIEL_OT_bake(bpy.types.Operator):
    """Bake inputs of the selected objects' materials whose nodes Oriel does not have"""
    bl_idname = "object.oriel_bake"
    bl_label = "Bake Unsupported Nodes"
    bl_options = {"UNDO"}

    size: IntProperty(name="Size", default=1024, min=16, max=16384,
                      description="Width and height of the images in pixels")

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT" and bool(context.selected_objects)

    def execute(self, context):
        scene, done = context.scene, 0
        before = scene.render.engine, scene.cycles.samples
        chosen = [ob for ob in context.selected_objects if ob.type == "MESH"]
        try:
            scene.render.engine, scene.cycles.samples = "CYCLES", 1
            for ob in chosen:
                done += self.bake_object(context, ob)
        except RuntimeError as error:
            self.report({"ERROR"}, f"Oriel: {error}")
            return {"CANCELLED"}
        finally:
            scene.render.engine, scene.cycles.samples = before
        self.report({"INFO"}, f"Oriel: {done} inputs were baked")
        return {"FINISHED"}

    def bake_object(self, context, ob):
        done, materials = 0, set()
        for slot, holder in enumerate(ob.material_slots):
            wanted = sockets(holder.material)
            if not wanted or holder.material in materials:
                continue
            materials.add(holder.material)
            if not ob.data.uv_layers:
                self.report({"WARNING"}, f'Oriel: object "{ob.name}" has no UV map; it is skipped')
                continue
            part = part_of(ob, slot)
            context.collection.objects.link(part)
            try:
                for socket in wanted:
                    bake_socket(context, part, holder.material, socket, self.size)
                    done += 1
            finally:
                mesh = part.data
                bpy.data.objects.remove(part)
                bpy.data.meshes.remove(mesh)
        return done


class ORIEL_PT_bake(bpy.types.Panel):
    bl_label = "Oriel"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "material"
    bl_options = {"DEFAULT_CLOSED"}
    COMPAT_ENGINES = {ENGINE}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES and context.object and \
            context.object.type == "MESH"

    def draw(self, context):
        self.layout.operator(ORIEL_OT_bake.bl_idname)


CLASSES = (ORIEL_OT_bake, ORIEL_PT_bake)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
