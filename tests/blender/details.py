# SPDX-License-Identifier: Apache-2.0
"""Details of users' scenes: meshes of geometry nodes, texts, lights, borders and passes as in Cycles;
messages about what is not rendered; panels for all settings that the export reads."""
# acceptance: Y1, Y2
import math
import pathlib
import sys
import types

import bpy
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import support  # noqa: E402
from oriel_blender import data_panels, engine, exr, meshes, panels  # noqa: E402

MESSAGES = []


def warn(_engine, text):
    MESSAGES.append(text)


engine.OrielEngine.warn = warn


def lit_scene(width=64, height=48):
    scene = support.empty_scene(width, height)
    scene.world.color = (.4, .4, .4)
    sun = bpy.data.lights.new("Sun", "SUN")
    sun.energy, sun.angle = 2.0, .05
    support.add("Sun", sun, (0, 0, 5), (.5, .2, 0))
    support.add_camera((0, -3, 5), (math.radians(31), 0, 0), lens=40.0)
    return scene


def compare(label, limit, samples=64, size=4):
    ours, theirs = (support.render(e, samples, "detail") for e in ("ORIEL", "CYCLES"))
    a, b = support.block_means(ours, size), support.block_means(theirs, size)
    error = numpy.abs(a - b).mean() / max(b.mean(), 1e-6)
    support.save_png(numpy.concatenate([ours, theirs], axis=1),
                     support.FOLDER / f"detail_{label.replace(' ', '_')}.png")
    support.check(error <= limit, f"{label}: mean difference {error:.2%}")


def geometry_nodes():
    """Meshes that geometry nodes place have the same name, and are different."""
    lit_scene()
    ob = support.add_plane(1.0, support.diffuse_material())
    tree = bpy.data.node_groups.new("Place", "GeometryNodeTree")
    tree.inputs.new("NodeSocketGeometry", "Geometry")
    tree.outputs.new("NodeSocketGeometry", "Geometry")
    def add(kind, **inputs):
        node = tree.nodes.new("GeometryNode" + kind)
        for name, value in inputs.items():
            if isinstance(value, bpy.types.NodeSocket):
                tree.links.new(value, node.inputs[name])
            else:
                node.inputs[name].default_value = value
        return node.outputs[0]
    joined = tree.nodes.new("GeometryNodeJoinGeometry")
    for k, kind in enumerate(("MeshCube", "MeshUVSphere", "MeshCone")):
        colour = tuple(.8 if k == i else .1 for i in range(3))
        mesh = add("SetMaterial", Geometry=add(kind),
                   Material=support.diffuse_material(colour, kind))
        points = add("Points", Position=(k - 1, 0, 0))
        placed = add("InstanceOnPoints", Points=points, Instance=mesh, Scale=(.4, .4, .4))
        tree.links.new(placed, joined.inputs[0])
    output = tree.nodes.new("NodeGroupOutput")
    tree.links.new(joined.outputs[0], output.inputs[0])
    ob.modifiers.new("Nodes", "NODES").node_group = tree
    compare("geometry nodes", .005)


def texts():
    """Texts and curves are written once, and caps without area are no message."""
    lit_scene()
    material = support.principled("Paint", (.8, .2, .1))
    for operator in (lambda: bpy.ops.object.text_add(location=(-1, 0, 0)),
                     lambda: bpy.ops.curve.primitive_bezier_circle_add(location=(1, 0, 0))):
        operator()
        data = bpy.context.object.data
        data.extrude, data.bevel_depth = .1, .05
        data.materials.append(material)
    written, add = [], meshes.MeshFolder.add_mesh
    meshes.MeshFolder.add_mesh = lambda self, name, *rest: written.append(name) or add(self, name, *rest)
    try:
        MESSAGES.clear()
        compare("text and curve", .005)
    finally:
        meshes.MeshFolder.add_mesh = add
    support.check(len(written) == 2 and not MESSAGES, f"meshes {written}, messages {MESSAGES}")


def lights():
    """Lights without shadows, and constant nodes of lights through groups and reroutes."""
    scene = support.empty_scene(64, 48)
    support.add_plane(8.0, support.diffuse_material((.6, .6, .6)))
    support.add_sphere(.5, support.diffuse_material((.6, .5, .4)), (0, 0, 1), 32)
    for k, kind in enumerate(("POINT", "AREA", "SPOT")):
        light = bpy.data.lights.new(kind, kind)
        light.energy, light.cycles.cast_shadow = 100, False
        light.color = tuple(1.0 if k == i else .3 for i in range(3))
        support.add(kind, light, (2 - 2 * k, 0, 3), (0, .4 * (1 - k), 0))
    light = bpy.data.lights["POINT"]
    light.use_nodes = True
    tree = light.node_tree
    reroute, value, double, falloff = (tree.nodes.new(kind) for kind in (
        "NodeReroute", "ShaderNodeValue", "ShaderNodeMath", "ShaderNodeLightFalloff"))
    value.outputs[0].default_value, double.operation = .8, "MULTIPLY"
    double.inputs[1].default_value = 2.0
    for source, target in ((value.outputs[0], double.inputs[0]), (double.outputs[0], reroute.inputs[0]),
                           (reroute.outputs[0], falloff.inputs["Strength"]),
                           (falloff.outputs["Quadratic"], tree.nodes["Emission"].inputs["Strength"])):
        tree.links.new(source, target)
    support.add_camera((0, -6, 5), (math.radians(52), 0, 0), lens=40.0)
    scene.cycles.max_bounces = scene.oriel.depth = 4
    compare("lights without shadows", .01, 128)


def bevel():
    """Edges that the Bevel node rounds are rounded by mia_roundcorners."""
    lit_scene()
    material, tree, node = support.node_material("Cube")
    bevelled = tree.nodes.new("ShaderNodeBevel")
    bevelled.samples, bevelled.inputs["Radius"].default_value = 16, .3
    tree.links.new(bevelled.outputs[0], node.inputs["Normal"])
    bpy.ops.mesh.primitive_cube_add(size=1.6, rotation=(0, 0, .5))
    bpy.context.object.data.materials.append(material)
    compare("bevel", .004)


def anisotropic():
    """Anisotropic highlights have the light of GGX facets. Cycles 3.4 has twice as much of lamps."""
    scene = support.empty_scene(8, 8)
    material, tree, _ = support.node_material("Brushed")
    node, along = (tree.nodes.new("ShaderNode" + kind) for kind in ("BsdfAnisotropic", "Tangent"))
    along.direction_type = "UV_MAP"
    tree.links.new(along.outputs[0], node.inputs["Tangent"])
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    node.inputs["Color"].default_value = (.8, .8, .8, 1)
    node.inputs["Roughness"].default_value, node.inputs["Anisotropy"].default_value = .5, .3
    support.add_plane(2.0, material)
    sun = bpy.data.lights.new("Sun", "SUN")
    sun.energy, sun.angle = 1.5, 0
    support.add("Sun", sun, (0, 0, 5), (0, .9, 0))
    support.add_camera((0, 0, 5), type="ORTHO", ortho_scale=1.5)
    for turn, (across, other) in ((0.0, (.7, 1 / .7)), (.25, (1 / .7, .7))):
        node.inputs["Rotation"].default_value = turn
        # Half the angle between light and view; half axes of the facets along and across the plane.
        x, y, tangent = .25 * across, .25 * other, math.tan(.45)
        facets = 1 / (math.pi * x * y * math.cos(.45) ** 4 * (tangent ** 2 / x ** 2 + 1) ** 2)
        shadowed = 2 / (1 + math.sqrt(1 + (x * math.tan(.9)) ** 2))
        expected = .8 * 1.5 * facets * shadowed / 4
        found = support.render("ORIEL", 64, "brushed")[4, 4, 0]
        support.check(abs(found / expected - 1) < .02, f"turned by {turn}: {found:.4f} of {expected:.4f}")


def border():
    """Borders whose edges are inside of pixels have the pixels that Blender has for them."""
    scene = lit_scene(72, 48)
    support.add_sphere(.7, support.principled("Ball", (.2, .4, .8)), (0, 0, 0), 32)
    render = scene.render
    render.use_border = True
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = .25, .8, .3, .7
    for crop in (False, True):
        render.use_crop_to_border = crop
        compare(f"border, cropped: {crop}", .01)


def mist():
    """The mist pass is that of Cycles."""
    scene = lit_scene(32, 32)
    plane = support.add_plane(4.0, support.diffuse_material())
    plane.rotation_euler.x = .5
    bpy.context.view_layer.use_pass_mist = bpy.context.view_layer.use_pass_uv = True
    scene.world.mist_settings.start, scene.world.mist_settings.depth = 4.0, 4.0
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.exr_codec = "NONE"
    pictures = []
    MESSAGES.clear()
    for name in ("ORIEL", "CYCLES"):
        scene.render.engine, scene.oriel.samples, scene.cycles.samples = name, 32, 32
        scene.render.filepath = str(support.FOLDER / f"mist_{name}.exr")
        bpy.ops.render.render(write_still=True)
        pictures.append(exr.read(scene.render.filepath).channels["ViewLayer.Mist.Z"])
    error = numpy.abs(pictures[0] - pictures[1])
    support.check(numpy.median(error) < .005 and pictures[1].std() > .1,
                  f"mist: median difference {numpy.median(error):.4f}")
    support.check(any("UV" in m and "ViewLayer" in m for m in MESSAGES), f"missing passes: {MESSAGES}")


def messages():
    """Objects that are not rendered are named."""
    scene = lit_scene(8, 8)
    plane = support.add_plane(2.0, support.diffuse_material())
    plane.is_shadow_catcher = True
    bpy.ops.object.volume_add()
    bpy.context.object.name = "Smoke"
    scene.render.engine, scene.oriel.samples = "ORIEL", 1
    MESSAGES.clear()
    bpy.ops.render.render()
    for name in ("Smoke", "Plane"):
        support.check(any(f'"{name}"' in m for m in MESSAGES), f"{name} is named in {MESSAGES}")
    scene.camera = bpy.data.objects["Sun"]
    try:
        bpy.ops.render.render()
        support.check(False, "a light as camera is refused")
    except RuntimeError as error:
        support.check('"Sun"' in str(error), f"refused: {str(error).strip()}")


class Layout:
    """Records the properties that a panel draws; missing ones are errors."""

    def __init__(self):
        self.drawn = set()

    def prop(self, owner, name, **_settings):
        getattr(owner, name)
        self.drawn.add(name)

    def prop_search(self, owner, name, searched, collection, **_settings):
        getattr(searched, collection)
        self.prop(owner, name)

    def template_list(self, _kind, _name, owner, items, active, active_name, **_settings):
        getattr(active, active_name)
        self.prop(owner, items)

    def template_node_view(self, _tree, _node, socket):
        self.drawn.add(socket.name)

    def operator(self, name, **_settings):
        found = bpy.ops
        for part in name.split("."):
            found = getattr(found, part)
        found.get_rna_type()

    def label(self, **_settings):
        pass

    def row(self, **_settings):
        return self

    column = row


WANTED = {"film_transparent", "pixel_filter_type", "material_override", "lightgroups", "camera",
          "diffuse", "lightgroup", "visible_camera", "visible_shadow", "is_holdout", "cast_shadow",
          "spread", "is_portal", "Surface", "panorama_type", "latitude_min", "Displacement", "Volume",
          "displacement_method", "use_pass_mist", "use_motion_blur", "motion_blur_position"}


def shown_panels():
    """Every setting that the export reads is in a panel."""
    scene = lit_scene(8, 8)
    scene.render.engine = "ORIEL"
    scene.camera.data.type = "PANO"
    scene.camera.data.cycles.panorama_type = "EQUIRECTANGULAR"
    area = bpy.data.lights.new("Area", "AREA")
    area.use_nodes = True
    plane = support.add_plane(1.0, support.principled("Paint", (.5, .5, .5)))
    context = types.SimpleNamespace(
        engine="ORIEL", scene=scene, view_layer=bpy.context.view_layer, world=scene.world,
        object=plane, light=area, camera=scene.camera.data, material=bpy.data.materials["Paint"])
    layout = Layout()
    for cls in panels.CLASSES + data_panels.CLASSES:
        support.check(cls.poll(context), f"{cls.__name__} is shown")
        own = types.SimpleNamespace(layout=layout, socket=getattr(cls, "socket", ""))
        if hasattr(cls, "draw_header"):
            cls.draw_header(own, context)
        cls.draw(own, context)
    support.check(WANTED <= layout.drawn, f"missing settings: {WANTED - layout.drawn}")


support.run([geometry_nodes, texts, lights, bevel, anisotropic, border, mist, messages, shown_panels])
