# SPDX-License-Identifier: Apache-2.0
"""Key frames of an imported scene: values of cameras, lights, materials and the world by frame.

A dump contains the versions of the elements that change. For each frame with a change the data is
built again from these versions by the functions that build a scene without motion, and the values
that differ become key frames.
"""
import contextlib

import bpy
import numpy

from . import versions

# Values of data that can change.
CAMERA = ("lens", "ortho_scale", "shift_x", "shift_y", "clip_start", "clip_end",
          "dof.focus_distance", "dof.aperture_fstop")
LIGHT = ("energy", "color", "size", "size_y", "shadow_soft_size", "spot_size", "spot_blend", "angle")
SKY = ("sun_elevation", "sun_rotation", "sun_size", "sun_intensity", "air_density", "dust_density",
       "aerosol_density")


def value_at(owner, path):
    for name in path.split("."):
        owner = getattr(owner, name, None)
    return owner


class Frames:
    """The versions of the elements of a dump."""

    def __init__(self, dump):
        self.dump = dump
        self.count = int(dump.root.get("render", {}).get("frames", 1))
        self.changes = dump.root.get("changes", {})

    def frames_of(self, kind, names):
        """Frames, from 0, in which one of the elements begins to differ, and the first one."""
        found = {version["frame"] for name in names
                 for version in self.changes.get(kind, {}).get(name, ())}
        return sorted(found | {0}) if found else []

    def version(self, kind, name, frame, last):
        """An element in a frame; last: that of the last frame."""
        value = last
        versions_of = self.changes.get(kind, {}).get(name, ())
        for version in versions_of:
            if version["frame"] <= frame or version is versions_of[0]:
                value = version["value"]
        return value

    @contextlib.contextmanager
    def at(self, frame):
        """The dump with the shaders of a frame."""
        last = self.dump.root.get("shaders", {})
        self.dump.root["shaders"] = {name: self.version("shaders", name, frame, calls)
                                     for name, calls in last.items()}
        try:
            yield
        finally:
            self.dump.root["shaders"] = last

    def shaders_behind(self, uses):
        """Names of the shaders that shader calls use, in all frames."""
        found, waiting = set(), [uses]
        while waiting:
            part = waiting.pop()
            if isinstance(part, dict):
                waiting += part.values()
            elif isinstance(part, list):
                waiting += part
            elif isinstance(part, str):
                for name in (part, part.rsplit(".", 1)[0], part.split(".")[0]):
                    if name in self.dump.root.get("shaders", {}) and name not in found:
                        found.add(name)
                        waiting.append(self.dump.root["shaders"][name])
                        waiting += [v["value"] for v in
                                    self.changes.get("shaders", {}).get(name, ())]
        return found

    def frames_of_element(self, kind, element):
        """Frames in which an element or a shader behind it changes."""
        every = [element] + [v["value"] for v in self.changes.get(kind, {}).get(element["name"], ())]
        return sorted({*self.frames_of(kind, [element["name"]]),
                       *self.frames_of("shaders", self.shaders_behind(every))})


def insert(owner, path, frames, values):
    """Linear key frames of the components of a value that change. frames: from 1."""
    rows = numpy.array(values, numpy.float64).reshape(len(values), -1)
    for index in range(rows.shape[1]):
        column = rows[:, index]
        if numpy.ptp(column) == 0:
            continue
        # A value holds until the frame before a change, so that changes do not begin early.
        keys = [(frames[0], column[0])]
        for i in range(1, len(frames)):
            if frames[i] - frames[i - 1] > 1:
                keys.append((frames[i] - 1, column[i - 1]))
            keys.append((frames[i], column[i]))
        curve = versions.new_curve(owner, path, index)
        curve.keyframe_points.add(len(keys))
        curve.keyframe_points.foreach_set("co", numpy.array(keys, numpy.float32).ravel())
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
        curve.update()


def animate_values(owner, paths, states):
    """Key frames of an owner; states: frame from 0 -> values by path."""
    frames = sorted(states)
    if len(frames) < 2:
        return
    for path in paths:
        values = [states[frame].get(path) for frame in frames]
        if all(v is not None for v in values):
            insert(owner, path, [frame + 1 for frame in frames], values)


def read_values(owner, paths):
    found = {}
    for path in paths:
        value = value_at(owner, path)
        if value is not None:
            found[path] = tuple(value) if hasattr(value, "__len__") else value
    return found


def node_values(tree):
    """Values of the inputs of the nodes of a tree, and of sky textures, by their paths."""
    found = {}
    for node in tree.nodes:
        base = f'nodes["{bpy.utils.escape_identifier(node.name)}"]'
        for i, socket in enumerate(node.inputs):
            value = getattr(socket, "default_value", None)
            if isinstance(value, (bool, str)) or value is None:
                continue
            found[f"{base}.inputs[{i}].default_value"] = \
                tuple(value) if hasattr(value, "__len__") else value
        if node.type == "TEX_SKY":
            found.update({f"{base}.{name}": value
                          for name, value in read_values(node, SKY).items()})
    return found


def animate_data(frames, kind, element, data, paths, make, remove):
    """Key frames of the data of an element. make(version): builds it again."""
    states = {}
    for frame in frames.frames_of_element(kind, element):
        with frames.at(frame):
            made = make(frames.version(kind, element["name"], frame, element))
        if made is not None:
            states[frame] = read_values(made, paths)
            remove(made)
    animate_values(data, paths, states)


def animate_material(frames, element, material, make):
    """Key frames of the values of the nodes of a material. False if its nodes change."""
    states = {}
    for frame in frames.frames_of_element("materials", element):
        with frames.at(frame):
            made = make(frames.version("materials", element["name"], frame, element))
        states[frame] = node_values(made.node_tree)
        bpy.data.materials.remove(made)
    own = node_values(material.node_tree)
    animate_values(material.node_tree, own, states)
    return all(set(state) == set(own) for state in states.values())


def animate_world(frames, element, tree, make):
    """Key frames of the nodes of the world. element: the camera with its environment."""
    states = {}
    lights = frames.changes.get("lights", {})
    for frame in sorted({*frames.frames_of_element("cameras", element),
                         *frames.frames_of("lights", lights), *sun_frames(frames)}):
        with frames.at(frame):
            world = make(frames.version("cameras", element["name"], frame, element), frame)
        states[frame] = node_values(world.node_tree)
        bpy.data.worlds.remove(world)
    animate_values(tree, node_values(tree), states)


def animate_exposure(frames, element, scene, exposure):
    """Key frames of the exposure of the view."""
    states = {}
    for frame in frames.frames_of_element("cameras", element):
        with frames.at(frame):
            states[frame] = {"view_settings.exposure": exposure(
                frames.version("cameras", element["name"], frame, element))}
    animate_values(scene, ["view_settings.exposure"], states)


def sun_frames(frames):
    """All frames if a light of the sky moves."""
    for placed in frames.dump.list("instances"):
        if placed["kind"] == "light" and "motion" in placed:
            return range(frames.count)
    return ()


def mark_cameras(frames, scene, cameras):
    """Markers of the time line that change the camera."""
    before = None
    for i, name in enumerate(frames.dump.root.get("render", {}).get("cameras", ())):
        if name != before and name in cameras:
            marker = scene.timeline_markers.new(name, frame=i + 1)
            marker.camera = cameras[name][0]
        before = name
