# SPDX-License-Identifier: Apache-2.0
"""Worlds as pictures that another process of Blender renders by Cycles.

The render thread and the viewport cannot render, and the models of Blender's sky textures are not
those of the program. Pictures are kept by the content of the world, so that an animation renders an
unchanged world once.
"""
import hashlib
import json
import os
import subprocess
import time

import bpy

from . import process

JOB = os.path.join(os.path.dirname(__file__), "world_bake_job.py")
SKY_WIDTH, MAX_WIDTH = 1024, 4096
SAMPLES = 4  # of worlds other than a sky alone
SECONDS = 120
_running = {}  # key -> path of its files without suffix, and process
_failed = {}   # key -> message
_sent_again = set()  # keys whose process had quit without a result


def content_of(tree):
    """Everything that determines the result of a node tree, as text."""
    found = []
    for node in tree.nodes:
        settings = {}
        for item in node.bl_rna.properties:
            name = item.identifier
            if item.type in {"BOOLEAN", "INT", "FLOAT", "ENUM", "STRING"} and \
                    name not in {"location", "width", "height", "select", "name", "label"}:
                value = getattr(node, name)
                settings[name] = list(value) if hasattr(value, "__len__") and not \
                    isinstance(value, (str, set)) else str(value)
        image, inner = getattr(node, "image", None), getattr(node, "node_tree", None)
        ramp, mapping = getattr(node, "color_ramp", None), getattr(node, "mapping", None)
        extra = [
            [image.name_full, image.filepath, list(image.size)] if image else None,
            content_of(inner) if inner else None,
            [[e.position, list(e.color)] for e in ramp.elements] if ramp else None,
            [[list(p.location) for p in c.points] for c in getattr(mapping, "curves", ())]
            if mapping else None]
        values = [list(s.default_value) if hasattr(s.default_value, "__len__") and not
                  isinstance(s.default_value, str) else s.default_value
                  for s in node.inputs if hasattr(s, "default_value")]
        outputs = [s.default_value for s in node.outputs
                   if node.type == "VALUE" and hasattr(s, "default_value")]
        outputs += [list(s.default_value) for s in node.outputs if node.type == "RGB"]
        found.append([node.name, node.bl_idname, node.mute, settings, extra, values, outputs])
    links = [[l.from_node.name, l.from_socket.identifier, l.to_node.name, l.to_socket.identifier]
             for l in tree.links]
    return json.dumps([found, links], default=str)


def values_of(tree):
    """Values of the inputs and settings of nodes by their names. Animations change evaluated data only,
    and files have the data before that."""
    found = []
    for node in tree.nodes:
        inputs = [[i, list(s.default_value) if hasattr(s.default_value, "__len__") else
                   s.default_value] for i, s in enumerate(node.inputs)
                  if hasattr(s, "default_value") and not isinstance(s.default_value, str)]
        settings = [[p.identifier, getattr(node, p.identifier)] for p in node.bl_rna.properties
                    if p.type == "FLOAT" and not p.is_readonly and not p.array_length and
                    p.identifier not in {"width", "height", "width_hidden"}]
        found.append([node.name, inputs, settings])
    return found


def is_smooth(tree):
    """Whether a world is a sky texture alone, maybe rotated."""
    return {node.type for node in tree.nodes} <= {
        "TEX_SKY", "BACKGROUND", "OUTPUT_WORLD", "MAPPING", "TEX_COORD", "REROUTE", "FRAME"}


def width_for(tree):
    """Width of the picture: that of the largest image of the world within limits."""
    images = [node.image for node in tree.nodes if getattr(node, "image", None) is not None]
    return min(max([SKY_WIDTH] + [image.size[0] for image in images]), MAX_WIDTH)


class Baked:
    """A picture of a world, and the irradiance of its sun."""

    def __init__(self, picture, sun):
        self.picture, self.sun = picture, sun


class Baker:
    """Renders worlds in a folder.

    on_ready: called when a picture is finished that was not waited for; None waits.
    """

    def __init__(self, folder, on_ready=None):
        self.folder = os.path.join(str(folder), "worlds")
        self._on_ready = on_ready

    def bake(self, world, sun=None):
        """The picture of a world, or None if it is not finished; raises RuntimeError if it fails.

        sun: direction and angle of the disc of its sky texture.
        """
        text = content_of(world.node_tree) + json.dumps(sun)
        key = hashlib.blake2b(text.encode(), digest_size=8).hexdigest()
        result = os.path.join(self.folder, f"{key}.json")
        while not os.path.exists(result) and key not in _failed:
            if key not in _running:
                _running[key] = self._start(key, world, sun)
            if self._on_ready is not None:
                self._watch(key)
                return None
            finish(key, SECONDS)
        if key in _failed:
            raise RuntimeError(_failed[key])
        with open(result, encoding="utf-8") as file:
            return Baked(os.path.join(self.folder, f"{key}.exr"), json.load(file)["sun"])

    def _start(self, key, world, sun):
        os.makedirs(self.folder, exist_ok=True)
        base = os.path.join(self.folder, key)
        bpy.data.libraries.write(base + ".blend", {world.original}, path_remap="ABSOLUTE")
        request = {"blend": base + ".blend", "world": world.name, "width": width_for(world.node_tree),
                   "samples": 1 if is_smooth(world.node_tree) else SAMPLES,
                   "picture": base + ".exr", "result": base + ".part", "error": base + ".error",
                   "sun": sun, "values": values_of(world.node_tree)}
        with open(base + ".request", "w", encoding="utf-8") as file:
            json.dump(request, file)
        job = BakeProcess.current()
        job.send(base + ".request")
        return base, job

    def _watch(self, key):
        """Calls on_ready from a timer of Blender when the process has ended."""
        ready = self._on_ready

        def look():
            if key in _running and not ended(*_running[key]):
                return .05
            finish(key, 0)
            ready()
            return None
        bpy.app.timers.register(look)


class BakeProcess:
    """Another Blender that renders worlds, one after the other. It stays for some minutes, because the
    start of Blender takes longer than a sky."""

    _processes = {}  # path of the script -> process

    def __init__(self):
        self._process = subprocess.Popen(
            [bpy.app.binary_path, "-b", "--factory-startup", "--python-exit-code", "3", "-P", JOB],
            stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, text=True)
        process.remember(self)

    @classmethod
    def current(cls):
        found = cls._processes.get(JOB)
        if found is None or not found.running():
            found = cls._processes[JOB] = cls()
        return found

    def send(self, path):
        try:
            self._process.stdin.write(path + "\n")
            self._process.stdin.flush()
        except OSError:
            pass  # it has ended, which ended() finds

    def running(self):
        return self._process.poll() is None

    def has_quit(self):
        """Whether it ended because it had no request for some time. A request is sent again."""
        return self._process.poll() == 0

    def kill(self):
        self._process.kill()
        self._process.wait()


def ended(base, job):
    """Whether there is a result, an error, or no process any more."""
    return os.path.exists(base + ".part") or os.path.exists(base + ".error") or not job.running()


def finish(key, seconds):
    """Waits for a result at most that long and keeps it, or why there is none."""
    if key not in _running:
        return
    base, job = _running[key]
    last = time.monotonic() + seconds
    while not ended(base, job) and time.monotonic() < last:
        time.sleep(.02)
    _running.pop(key, None)
    if os.path.exists(base + ".part"):
        os.replace(base + ".part", base + ".json")
    elif os.path.exists(base + ".error") or not job.has_quit() or key in _sent_again:
        if not ended(base, job):
            job.kill()
        _failed[key] = "Cycles could not render it" + error_of(base)
    else:
        _sent_again.add(key)
    for suffix in (".blend", ".request", ".error"):
        if os.path.exists(base + suffix):
            os.remove(base + suffix)


def error_of(base):
    if not os.path.exists(base + ".error"):
        return ""
    with open(base + ".error", encoding="utf-8") as file:
        return f" ({file.read().strip()})"
