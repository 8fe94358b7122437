# SPDX-License-Identifier: Apache-2.0
"""What the scripts that run inside Blender share: the add-on, scenes, and pixels."""
import os
import pathlib
import sys
import traceback

import bpy
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = pathlib.Path(os.environ.get("ORIEL_TEST_FOLDER", "/tmp"))
sys.path.insert(0, str(ROOT / "integrations" / "blender"))

import oriel_blender  # noqa: E402

oriel_blender.register()
PASSED = []


def check(condition, text):
    """Fails the script: the exit status of an exception is that of --python-exit-code."""
    print(("ok: " if condition else "FAILED: ") + text, flush=True)
    if not condition:
        raise AssertionError(text)
    PASSED.append(text)


def run(tests):
    """Runs the tests, or those that the arguments after -- name."""
    chosen = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    for test in tests:
        if not chosen or test.__name__ in chosen:
            print(f"-- {test.__name__}", flush=True)
            test()
    print("all tests passed")


def empty_scene(width=64, height=64):
    """Removes everything; returns the scene with a raw view transform."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Raw"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.cycles.device = "CPU"
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.world = bpy.data.worlds.new("World")
    scene.world.color = (0, 0, 0)
    return scene


def add(name, data, location=(0, 0, 0), rotation=(0, 0, 0)):
    ob = bpy.data.objects.new(name, data)
    ob.location, ob.rotation_euler = location, rotation
    bpy.context.scene.collection.objects.link(ob)
    return ob


def add_camera(location, rotation=(0, 0, 0), **settings):
    camera = bpy.data.cameras.new("Camera")
    for name, value in settings.items():
        setattr(camera, name, value)
    ob = add("Camera", camera, location, rotation)
    bpy.context.scene.camera = ob
    return ob


def add_mesh(name, vertices, faces, material=None, uvs=None):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    if uvs:
        layer = mesh.uv_layers.new(name="UVMap")
        layer.data.foreach_set("uv", numpy.array(uvs, numpy.float32).ravel())
    if material:
        mesh.materials.append(material)
    return add(name, mesh)


def add_plane(size=2.0, material=None, z=0.0):
    h = size / 2
    return add_mesh("Plane", [(-h, -h, z), (h, -h, z), (h, h, z), (-h, h, z)], [(0, 1, 2, 3)],
                    material, [(0, 0), (1, 0), (1, 1), (0, 1)])


def add_sphere(radius=1.0, material=None, location=(0, 0, 0), segments=64):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=segments, ring_count=segments // 2, radius=radius,
                                         location=location)
    ob = bpy.context.object
    bpy.ops.object.shade_smooth()
    if material:
        ob.data.materials.append(material)
    return ob


def node_material(name="Material"):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    return material, material.node_tree, material.node_tree.nodes["Principled BSDF"]


def diffuse_material(colour=(1, 1, 1), name="Diffuse"):
    material, tree, principled = node_material(name)
    node = tree.nodes.new("ShaderNodeBsdfDiffuse")
    node.inputs["Color"].default_value = (*colour, 1)
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    return material


def render(engine, samples=64, name=None):
    """Renders the scene; returns the pixels of the file as (height, width, 4), row 0 at the bottom."""
    scene = bpy.context.scene
    scene.render.engine = engine
    scene.oriel.samples = samples
    scene.cycles.samples = samples
    path = FOLDER / f"{name or 'picture'}_{engine.lower()}.exr"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    return pixels_of(path)


def pixels_of(path):
    image = bpy.data.images.load(str(path), check_existing=False)
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    pixels = numpy.empty(width * height * 4, numpy.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, 4)


def principled(name, colour, **values):
    """A material of the Principled node with that base colour and values by the names of inputs."""
    material, _tree, node = node_material(name)
    node.inputs["Base Color"].default_value = (*colour, 1)
    for key, value in values.items():
        node.inputs[key].default_value = value
    return material


def block_means(pixels, size):
    """Means of size x size blocks of the colours; rows and columns that fill no block are left out."""
    rows, columns = (n // size for n in pixels.shape[:2])
    part = pixels[:rows * size, :columns * size, :3]
    return part.reshape(rows, size, columns, size, 3).mean(axis=(1, 3))


def save_png(pixels, path):
    """Writes pixels with the sRGB curve, to look at them."""
    height, width = pixels.shape[:2]
    image = bpy.data.images.new("view", width, height)
    values = numpy.clip(pixels, 0, 1).copy()
    values[..., :3] = numpy.where(values[..., :3] <= .0031308, values[..., :3] * 12.92,
                                  1.055 * values[..., :3] ** (1 / 2.4) - .055)
    values[..., 3] = 1
    image.pixels.foreach_set(values.astype(numpy.float32).ravel())
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()
    bpy.data.images.remove(image)


def run_steps(steps, interval, seconds):
    """Continues a generator of conditions, each when the one before holds; then ends Blender."""
    state = {"ready": None, "left": round(seconds / interval)}

    def tick():
        try:
            if state["ready"] is None or state["ready"]():
                state["ready"] = next(steps)
            state["left"] -= 1
            if state["left"] <= 0:
                raise AssertionError("the viewport did not finish in time")
            return interval
        except StopIteration:
            pass
        except Exception:
            traceback.print_exc()
        bpy.ops.wm.quit_blender()
        return None

    bpy.app.timers.register(tick, first_interval=1.0)
