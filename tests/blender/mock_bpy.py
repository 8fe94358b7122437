# SPDX-License-Identifier: Apache-2.0
"""Data of Blender 3.4 and of 4.0 to 5.0 without Blender, by the documented API of each version.

Objects have only the members that their version has, so that code that reads a removed member fails.
"""
import math
import sys
import types

import numpy

RELEASES = [(3, 4, 1), (4, 0, 0), (4, 1, 0), (4, 2, 0), (4, 3, 0), (4, 4, 0), (4, 5, 0), (5, 0, 0)]


class Data(types.SimpleNamespace):
    """A data-block or a part of one."""

    def as_pointer(self):
        return id(self)

    def get(self, _name, default=None):
        """A custom property; there are none."""
        return default

    @property
    def original(self):
        return self


class Items(list):
    """A collection that is read by name or index."""

    def __getitem__(self, key):
        if isinstance(key, str):
            found = self.get(key)
            if found is None:
                raise KeyError(key)
            return found
        return super().__getitem__(key)

    def __contains__(self, key):
        return self.get(key) is not None if isinstance(key, str) else super().__contains__(key)

    def get(self, name, default=None):
        return next((item for item in self if item.name == name), default)


class Values(list):
    """Elements whose members are read as arrays."""

    def __init__(self, count, **members):
        super().__init__([None] * count)
        self._members = members

    def foreach_get(self, name, target):
        target[:] = numpy.asarray(self._members[name]).ravel()


class Euler:
    def __init__(self, angles, _order):
        self.angles = angles

    def to_matrix(self):
        """Rotations about x, then y, then z, of column vectors."""
        matrix = numpy.eye(3)
        for axis, angle in enumerate(self.angles):
            turn, (i, j) = numpy.eye(3), ((1, 2), (2, 0), (0, 1))[axis]
            turn[i, i] = turn[j, j] = math.cos(angle)
            turn[j, i], turn[i, j] = math.sin(angle), -math.sin(angle)
            matrix = turn @ matrix
        return matrix


class Anything(types.ModuleType):
    """Base classes of the user interface, and functions that declare properties."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        if self.__name__ == "bpy.props":
            return lambda *_arguments, **_settings: None
        made = type(name, (), {})
        setattr(self, name, made)
        return made


def install(release):
    """Makes modules bpy and mathutils of a release. The modules of the extension are forgotten."""
    for name in [n for n in sys.modules if n.split(".")[0] == "oriel_blender"]:
        del sys.modules[name]
    bpy = types.ModuleType("bpy")
    bpy.app = Data(version=release, tempdir="/tmp", binary_path="blender")
    bpy.path = Data(abspath=lambda path, library=None: path)
    bpy.types, bpy.props = Anything("bpy.types"), Anything("bpy.props")
    bpy.utils = Data(register_classes_factory=lambda classes: (lambda: None, lambda: None))
    bpy.ops, bpy.data = Data(), Data()
    sys.modules.update({"bpy": bpy, "bpy.props": bpy.props, "bpy.types": bpy.types})
    for name in ("bmesh", "mathutils"):
        sys.modules[name] = types.ModuleType(name)
    sys.modules["mathutils"].Euler = Euler
    sys.modules["mathutils"].Matrix = sys.modules["mathutils"].Vector = lambda *_: None


class Tree:
    """Builds a node tree."""

    def __init__(self, name):
        self.tree = Data(name=name, name_full=name, nodes=Items(), links=[], bl_idname="ShaderNodeTree")
        self.tree.get_output_node = lambda _target: self.tree.nodes.get("Output")

    def node(self, kind, name, inputs=(), outputs=("Out",), **settings):
        """inputs, outputs: (name, type, value) or a name of a colour."""
        node = Data(type=kind, name=name, bl_idname="ShaderNode" + kind, bl_label=name, mute=False,
                    internal_links=[], id_data=self.tree, **settings)
        node.inputs = Items(self.socket(node, *spec) for spec in inputs)
        node.outputs = Items(self.socket(node, o, "RGBA", None) if isinstance(o, str) else
                             self.socket(node, *o) for o in outputs)
        self.tree.nodes.append(node)
        return node

    def socket(self, node, name, kind="RGBA", value=(0.0, 0.0, 0.0, 1.0)):
        socket = Data(name=name, identifier=name, type=kind, node=node, is_linked=False, links=[],
                      id_data=self.tree)
        if value is not None:
            socket.default_value = value
        return socket

    def link(self, output, target):
        link = Data(from_node=output.node, from_socket=output, to_node=target.node, to_socket=target)
        target.links, target.is_linked, output.is_linked = [link], True, True
        self.tree.links.append(link)


def rna(kind):
    """A node without settings in its RNA."""
    kind.bl_rna = Data(properties=[])
    return kind


def number(name, value):
    return name, "VALUE", float(value)


def colour(name, *rgb):
    return name, "RGBA", (*rgb, 1.0)


# Sockets of Principled BSDF: name in 3.4, name from 4.0; None where a version has none.
PRINCIPLED = (
    ("Base Color", "Base Color"), ("Subsurface", "Subsurface Weight"),
    ("Subsurface Radius", "Subsurface Radius"), ("Subsurface Color", None),
    (None, "Subsurface Scale"), ("Metallic", "Metallic"), ("Specular", "Specular IOR Level"),
    ("Specular Tint", "Specular Tint"), ("Roughness", "Roughness"), ("Anisotropic", "Anisotropic"),
    ("Anisotropic Rotation", "Anisotropic Rotation"), ("Sheen", "Sheen Weight"),
    ("Sheen Tint", "Sheen Tint"), (None, "Sheen Roughness"), ("Clearcoat", "Coat Weight"),
    ("Clearcoat Roughness", "Coat Roughness"), (None, "Coat IOR"), (None, "Coat Tint"),
    ("IOR", "IOR"), ("Transmission", "Transmission Weight"), ("Transmission Roughness", None),
    ("Emission", "Emission Color"), ("Emission Strength", "Emission Strength"), ("Alpha", "Alpha"),
    ("Normal", "Normal"), ("Clearcoat Normal", "Coat Normal"), ("Tangent", "Tangent"))
VALUES = {
    "Base Color": (.6, .3, .2, 1), "Subsurface Radius": (1.0, .2, .1), "Subsurface Color": (.8,) * 4,
    "Subsurface Scale": .05, "Specular": .5, "Specular Tint": 0.0, "Roughness": .4,
    "Sheen Tint": .5, "Sheen Roughness": .5, "Clearcoat Roughness": .03, "Coat IOR": 1.5,
    "Coat Tint": (1.0,) * 4, "IOR": 1.5, "Emission": (0.0, 0.0, 0.0, 1.0), "Emission Strength": 1.0,
    "Alpha": 1.0}
VECTORS = {"Normal", "Clearcoat Normal", "Tangent"}


def principled(tree, release, **changes):
    """changes: by the names of 3.4 with _ for spaces, or those of 4.0 of sockets that 3.4 lacks."""
    changes = {key.replace("_", " "): value for key, value in changes.items()}
    sockets = []
    for old, new in PRINCIPLED:
        name, key = (new if release >= (4, 0, 0) else old), old or new
        value = changes.get(key, VALUES.get(key, 0.0))
        if name == "Specular Tint" and release >= (4, 0, 0):
            value = (1.0, 1.0, 1.0, 1.0)
        if name == "Sheen Tint" and release >= (4, 0, 0):
            value = (1.0, 1.0, 1.0, 1.0)
        if name and key in VECTORS:
            sockets.append((name, "VECTOR", None))
        elif name:
            sockets.append((name, "RGBA" if isinstance(value, tuple) else "VALUE", value))
    return rna(tree.node("BSDF_PRINCIPLED", "Principled BSDF", sockets, [("BSDF", "SHADER", None)],
                         distribution="GGX", subsurface_method="RANDOM_WALK"))


def material(name, release, build):
    """A material; build(tree) returns the node of its surface."""
    tree = Tree(name)
    surface = build(tree)
    output = tree.node("OUTPUT_MATERIAL", "Output", [("Surface", "SHADER", None),
                                                    ("Volume", "SHADER", None),
                                                    ("Displacement", "VECTOR", None)], [],
                       is_active_output=True, target="ALL")
    tree.link(surface.outputs[0], output.inputs[0])
    made = Data(name=name, name_full=name, use_nodes=True, node_tree=tree.tree,
                diffuse_color=(.8, .8, .8, 1.0), blend_method="OPAQUE")
    if release >= (4, 1, 0):
        made.displacement_method = "BUMP"
    else:
        made.cycles = Data(displacement_method="BUMP")
    if release >= (4, 2, 0):
        made.surface_render_method = "DITHERED"
    return made


def group_tree(release, build):
    """A node group with an input and an output; build(tree, input) returns the output."""
    tree = Tree("Group")
    begin = tree.node("GROUP_INPUT", "Group Input", [], ["Colour"])
    end = tree.node("GROUP_OUTPUT", "Group Output", [("Colour", "RGBA", (0.0,) * 4)], [],
                    is_active_output=True)
    tree.link(build(tree, begin.outputs[0]), end.inputs[0])
    sockets = Items([Data(name="Colour", in_out="INPUT"), Data(name="Colour", in_out="OUTPUT")])
    if release >= (4, 0, 0):
        tree.tree.interface = Data(items_tree=sockets)
    else:
        tree.tree.inputs, tree.tree.outputs = Items(sockets[:1]), Items(sockets[1:])
    return tree.tree


def square(name, release, materials):
    """A square of two units with texture coordinates."""
    points = numpy.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], numpy.float32)
    up = numpy.tile(numpy.array([0, 0, 1], numpy.float32), (4, 1))
    uv = numpy.array([(0, 0), (1, 0), (1, 1), (0, 1)], numpy.float32)
    mesh = Data(name=name, name_full=name, materials=materials, shape_keys=None,
                vertices=Values(4, co=points), attributes=Items())
    mesh.calc_loop_triangles = lambda: None
    mesh.polygons = Values(1, material_index=[0], use_smooth=[True], loop_total=[4])
    mesh.loops = Values(4, vertex_index=[0, 1, 2, 3], **(
        {} if release >= (4, 1, 0) else {"normal": up}))
    layer = Data(name="UVMap", active_render=True, data=Values(4, uv=uv))
    triangles = {"loops": [0, 1, 2, 0, 2, 3]}
    if release >= (3, 5, 0):
        layer.uv = Values(4, vector=uv)
    if release >= (3, 6, 0):
        mesh.loop_triangle_polygons = Values(2, value=[0, 0])
    else:
        triangles["polygon_index"] = [0, 0]
    mesh.loop_triangles = Values(2, **triangles)
    mesh.uv_layers = Items([layer])
    mesh.color_attributes = Data(active_color=None)
    if release >= (4, 1, 0):
        mesh.corner_normals, mesh.normals_domain = Values(4, vector=up), "POINT"
    else:
        mesh.use_auto_smooth, mesh.calc_normals_split = False, lambda: None
    return mesh


def instance(name, kind, data, release, location=(0, 0, 0), **settings):
    """An instance of the dependency graph with an object of its own."""
    matrix = numpy.eye(4)
    matrix[:3, 3] = location
    ob = Data(name=name, name_full=name, type=kind, data=data, modifiers=[], particle_systems=[],
              material_slots=[Data(material=m) for m in getattr(data, "materials", ())],
              is_holdout=False, lightgroup="", color=(1.0,) * 4, pass_index=0, matrix_world=matrix,
              bound_box=[(-1, -1, 0), (1, 1, 0)], to_mesh=lambda: data, to_mesh_clear=lambda: None,
              holdout_get=lambda view_layer: False, indirect_only_get=lambda view_layer: False,
              **{f"visible_{k}": True for k in ("camera", "diffuse", "glossy", "transmission",
                                               "shadow", "volume_scatter")})
    vars(ob).update(settings)
    if release >= (4, 0, 0) and "light_linking" not in settings:
        ob.light_linking = Data(receiver_collection=None, blocker_collection=None)
    return Data(object=ob, instance_object=None, is_instance=False, matrix_world=matrix,
                show_self=True, show_particles=True, random_id=0, parent=None, persistent_id=())


def light(kind, release, **settings):
    made = Data(name=kind, name_full=kind, type=kind, energy=100.0, color=(1.0, .5, .25),
                use_nodes=False, node_tree=None, shadow_soft_size=.1)
    made.cycles = Data(is_portal=False)
    if release < (4, 2, 0):
        made.cycles.cast_shadow = True
    else:
        made.use_shadow = True
    if release >= (4, 5, 0):
        made.exposure, made.normalize, made.use_temperature = 0.0, True, False
        made.temperature, made.temperature_color = 6500.0, (1.0, 1.0, 1.0)
    vars(made).update(settings)
    return made


def scene(release, instances, world, engine_settings):
    """The dependency graph of a scene."""
    camera = Data(name="Camera", type="PERSP", sensor_fit="AUTO", sensor_width=36.0,
                  sensor_height=24.0, lens=50.0, ortho_scale=6.0, shift_x=.1, shift_y=0.0,
                  clip_start=.1, clip_end=100.0, cycles=Data(),
                  dof=Data(use_dof=True, focus_distance=4.0, focus_object=None, aperture_fstop=2.8,
                           aperture_blades=5, aperture_rotation=0.0))
    view = instance("Camera", "CAMERA", camera, release, (0, 0, 5))
    render = Data(use_motion_blur=False, motion_blur_shutter=.5, film_transparent=False,
                  pixel_aspect_x=1.0, pixel_aspect_y=1.0, resolution_x=64, resolution_y=48,
                  engine="ORIEL")
    cycles = Data(filter_width=1.5, pixel_filter_type="BLACKMAN_HARRIS")
    if release >= (4, 1, 0):
        render.motion_blur_position = "CENTER"
    else:
        cycles.motion_blur_position = "CENTER"
    made = Data(name="Scene", frame_current=1, camera=view.object, world=world, render=render,
                cycles=cycles, oriel=engine_settings)
    layer = Data(name="ViewLayer", material_override=None)
    return Data(scene=made, scene_eval=made, view_layer=layer, view_layer_eval=layer,
                object_instances=[*instances, view])
