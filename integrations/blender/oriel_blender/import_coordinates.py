# SPDX-License-Identifier: Apache-2.0
"""Texture coordinates of imported images as nodes of Blender: UV maps by number, scale and offset."""

IDENTITY = [1.0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0, 1.0]
DIAGONAL = (0, 5, 10)


def call_behind(reader, call, name):
    """The call that is connected to a parameter, or None."""
    value = call["parameters"].get(name)
    return reader.dump.shader(value["shader"]) if isinstance(value, dict) and "shader" in value else \
        None


def link(reader, material, tree, image, look):
    """Links the coordinates of a look-up to the node of its image."""
    place, transform, repeats = call_behind(reader, look, "coord"), IDENTITY, True
    if place is not None and place["type"] == "mib_texture_remap":
        transform = place["parameters"].get("transform") or IDENTITY
        repeats = any(place["parameters"].get(f"torus_{axis}") is True for axis in "xyz")
        if place["parameters"].get("repeat"):
            reader.report(f'material "{material.name}": repetitions of a texture are kept in native nodes '
                          "only")
        place = call_behind(reader, place, "input")
    if not repeats:
        image.extension = "CLIP"
    number = 0
    if place is not None and place["type"] == "mib_texture_vector":
        number = max(int(place["parameters"].get("select", 0)), 0)
    elif place is not None:
        reader.report(f'material "{material.name}": {place["type"]} is replaced by the UV map in other '
                      "engines")
    if number == 0 and transform == IDENTITY:
        return
    uv = tree.nodes.new("ShaderNodeUVMap")
    uv.uv_map = f"UV{number}" if number else "UVMap"
    uv.location = (image.location.x - 400, image.location.y)
    source = uv.outputs[0]
    if transform != IDENTITY:
        source = mapped(reader, material, tree, transform, source, image.location)
    tree.links.new(source, image.inputs["Vector"])


def mapped(reader, material, tree, transform, source, location):
    """A Mapping node with the scale and offset of a transform for row vectors."""
    rest = [v for i, v in enumerate(transform[:12]) if i not in DIAGONAL and abs(v) > 1e-6]
    if rest:
        reader.report(f'material "{material.name}": a texture is turned in native nodes only')
    mapping = tree.nodes.new("ShaderNodeMapping")
    mapping.location = (location.x - 200, location.y)
    mapping.inputs["Scale"].default_value = [transform[i] for i in DIAGONAL]
    mapping.inputs["Location"].default_value = transform[12:15]
    tree.links.new(source, mapping.inputs["Vector"])
    return mapping.outputs[0]
