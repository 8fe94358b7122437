# SPDX-License-Identifier: Apache-2.0
"""Opens an EXR file in Blender's compositor.

    blender -b --factory-startup --python blender_compositor.py -- FILE NAME WIDTH HEIGHT OUT.exr

Prints the outputs of the Image node and the layers of the Cryptomatte node, and writes the matte of
the object NAME.
"""
import sys

import bpy

path, name, width, height, out = sys.argv[sys.argv.index("--") + 1:]
scene = bpy.context.scene
scene.use_nodes = True
tree = scene.node_tree
tree.nodes.clear()
image = bpy.data.images.load(path)
node = tree.nodes.new("CompositorNodeImage")
node.image = image
for output in node.outputs:
    print("LAYER", output.name)

crypto = tree.nodes.new("CompositorNodeCryptomatteV2")
crypto.source = "IMAGE"
crypto.image = image
crypto.layer_name = "CryptoObject"
crypto.matte_id = name
composite = tree.nodes.new("CompositorNodeComposite")
tree.links.new(crypto.outputs["Matte"], composite.inputs["Image"])
for thing in list(bpy.data.objects):
    if thing.type != "CAMERA":
        bpy.data.objects.remove(thing)
scene.render.engine = "CYCLES"
scene.cycles.samples = 1
scene.render.resolution_x, scene.render.resolution_y = int(width), int(height)
scene.render.resolution_percentage = 100
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.filepath = out
bpy.ops.render.render(write_still=True)
