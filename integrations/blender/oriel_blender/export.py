# SPDX-License-Identifier: Apache-2.0
"""Writes the evaluated scene as .mi text and binary meshes."""
import os

import numpy

from . import (camera, curves, images, light_links, lights, materials, meshes, mi, variants, versions, world,
               world_bake)

MOTION_STEPS = 8  # of transforms that turn
NARROW = .9999  # refl_gloss of a lobe of 0.16 degrees
# Curves, surfaces and texts have instances of their meshes beside them.
SURFACES = {"MESH", "META"}
# Types of objects that are not rendered; Blender draws grease pencil itself.
UNSUPPORTED = {"VOLUME": "volumes", "POINTCLOUD": "point clouds"}


class Placed:
    """One instance of the depsgraph: what must be copied inside its loop."""

    def __init__(self, instance):
        self.object = instance.instance_object if instance.is_instance else instance.object
        self.object = self.object.original if instance.is_instance else self.object
        evaluated = instance.object
        self.name = evaluated.name
        self.matrix = numpy.array(instance.matrix_world, numpy.float64)
        self.show = instance.show_self
        self.particles = instance.show_particles
        self.is_instance = instance.is_instance
        self.random_id = instance.random_id
        # Collections of view layers hold out, or hide from the camera, the objects that place others.
        self.owner = instance.parent.original if instance.is_instance and instance.parent else \
            evaluated.original
        identity = tuple(instance.persistent_id) if instance.is_instance else ()
        self.key = (evaluated.name_full, instance.parent.name_full if instance.parent else "",
                    identity)


class Exporter:
    """One scene file for one frame."""

    def __init__(self, depsgraph, folder, mesh_folder, report, frame_set=None, camera_matrix=None,
                 view=None):
        self.depsgraph = depsgraph
        self.scene = depsgraph.scene_eval
        self.layer = depsgraph.view_layer_eval
        self.original_layer = depsgraph.view_layer
        self.folder = folder
        self.meshes = mesh_folder
        self.frame_set = frame_set
        self.camera_matrix = camera_matrix
        self.view = view or {}
        self.out = mi.SceneText()
        self._reported = []
        self._report = report
        self.transparent = False   # the picture is without its background, which is subtracted
        self._background = ""      # the scene without objects
        self.baker = world_bake.Baker(folder)
        self.images = images.Images(self.out, folder, self.report)
        self.materials = materials.MaterialWriter(self.out, self.images, self.report)
        self.links = light_links.LightLinks(self.report)
        self.holdouts = set()      # names of instances that are held out
        self.groups = {}           # light group -> instance names
        self.known = {}            # key of geometry -> name and file of an earlier export
        self._objects = {}         # key of geometry -> element name
        self._orders = {}          # names of geometry -> addresses of its meshes
        self._opening = {}         # key of instance -> matrix at shutter opening
        self._motion = {}          # the same at shutter close
        self._opening_points = {}  # key of geometry -> points at shutter opening
        self._motion_points = {}   # the same at shutter close
        self._middle_points = {}   # key of geometry -> points at the middle of the shutter

    def report(self, text):
        if text not in self._reported:
            self._reported.append(text)
            self._report(text)

    # Motion -----------------------------------------------------------------------------------
    def motion_blur(self):
        """Shutter opening and closing in frames around the current one, or None."""
        render = self.scene.render
        if not render.use_motion_blur or self.frame_set is None:
            return None
        shutter = render.motion_blur_shutter
        position = versions.shutter_position(self.scene)
        start = {"START": 0.0, "CENTER": -shutter / 2, "END": -shutter}.get(position, -shutter / 2)
        return start, start + shutter

    def read_motion(self, start, end):
        """Reads matrices and points at shutter opening and close, and points at its middle. Everything
        else is that of the frame, as in Cycles."""
        frame = self.scene.frame_current

        def at(time):
            whole = int(numpy.floor(frame + time))
            self.frame_set(whole, frame + time - whole)
        try:
            at(start)
            self._opening = self.read_matrices()
            self.read_points(self._opening_points)
            at(end)
            self._motion = self.read_matrices()
            self.read_points(self._motion_points)
            if self._motion_points:
                at((start + end) / 2)
                self.read_points(self._middle_points)
        finally:
            self.frame_set(frame, 0.0)

    def read_points(self, found):
        self._orders.clear()
        for instance in self.depsgraph.object_instances:
            ob = instance.object
            key = self.geometry_key(ob)
            if ob.type == "MESH" and key not in found and self.deforms(ob):
                found[key] = meshes.points_of(ob.data)

    def read_matrices(self):
        """Matrices of the instances by their keys, and of the camera."""
        found = {}
        for instance in self.depsgraph.object_instances:
            placed = Placed(instance)
            found[placed.key] = placed.matrix
        camera_object = self.depsgraph.scene_eval.camera
        if camera_object:
            found["camera"] = numpy.array(camera_object.matrix_world, numpy.float64)
        return found

    def opening(self, placed):
        """The matrix of an instance at shutter opening."""
        return self._opening.get(placed.key, placed.matrix)

    @staticmethod
    def deforms(ob):
        original = ob.original
        keys = getattr(original.data, "shape_keys", None)
        return bool(original.modifiers) or keys is not None

    # Scene ------------------------------------------------------------------------------------
    def write(self, path, size):
        """Writes the scene to a file; returns the path."""
        blur = self.motion_blur()
        if blur:
            self.read_motion(*blur)
            self.scene = self.depsgraph.scene_eval
        environment = self.body(blur)
        instance = self.camera(size, environment)
        write_text(path, self.out.text() + self.ending(self.out.members, instance))
        if self.transparent:
            view = "".join(self.out.parts[self._camera_part:])
            write_text(background_path(path),
                       self._background + view + self.ending([instance], instance))
        return path

    def body(self, blur=None):
        """Adds everything but the camera; returns the name of the environment shader."""
        self.images.frame = self.scene.frame_current
        self.out.add(self.options(blur))
        writer = world.WorldWriter(self.out, self.images, self.report, self.baker)
        environment = writer.write(self.scene.world)
        if writer.shows_disc:
            self.view = {**self.view, "farthest": 2 * lights.SUN_DISTANCE}
        self.transparent = bool(environment) and self.scene.render.film_transparent
        self._background = self.out.text()
        self.instances()
        return environment

    @staticmethod
    def ending(members, camera_instance):
        """The root group and the render statement."""
        group = " ".join(mi.quoted(m) for m in members)
        return (f"instgroup {mi.quoted('oriel.root')} {group}\nend instgroup\n"
                f"render {mi.quoted('oriel.root')} {mi.quoted(camera_instance)} "
                f"{mi.quoted('oriel.options')}\n")

    def options(self, blur):
        settings = self.scene.oriel
        link = "".join(f'$include "{name}.mi"\n'
                       for name in ("base", "physics", "architectural", "oriel"))
        depth = settings.depth
        text = (f"{link}options {mi.quoted('oriel.options')}\n  object space\n  samples 0 2\n"
                f"  filter {filter_of(self.scene)}\n  trace on\n"
                f"  trace depth {depth} {depth} {2 * depth}\n  gamma 2.2\n  shadow segments\n"
                f"  {mi.quoted('indirect')} {mi.quoted(settings.indirect)}\n")
        if blur:
            text += f"  shutter 0 1\n  motion on\n  motion steps {MOTION_STEPS}\n"
        return text + "end options\n"

    def camera(self, size, environment):
        camera_object = self.scene.camera
        matrix = self.camera_matrix
        if matrix is None:
            matrix = numpy.array(camera_object.matrix_world, numpy.float64)
        options = dict(self.view)
        if "camera" in self._motion and "camera" in self._opening:
            # The view of an eye of stereo pictures is relative to the camera.
            eye = numpy.linalg.inv(numpy.array(camera_object.matrix_world, numpy.float64)) @ matrix
            matrix, close = (found["camera"] @ eye for found in (self._opening, self._motion))
            if not numpy.allclose(close, matrix):
                options["motion"] = close
        self._camera_part = len(self.out.parts)
        return camera.write(self.out, self.scene, camera_object, matrix, size, environment, options)

    def instances(self):
        self._orders.clear()
        if any(hidden_shape(instance.object) for instance in self.depsgraph.object_instances):
            # Mirrors do not see lights that the camera does not see; narrow lobes do.
            self.materials.sharpest = NARROW
        lights_first = light_links.are_used(self.depsgraph.object_instances)
        if lights_first:  # lists of objects name them
            for instance in self.depsgraph.object_instances:
                if instance.object.type == "LIGHT" and instance.show_self:
                    self.light(instance.object, Placed(instance))
        for instance in self.depsgraph.object_instances:
            placed = Placed(instance)
            ob = instance.object
            if ob.type == "LIGHT" and placed.show:
                if not lights_first:
                    self.light(ob, placed)
            elif ob.type in SURFACES and placed.show:
                self.surface(ob, placed)
            elif ob.type in {"CURVES", "HAIR"} and placed.show:
                self.curves(ob, placed)
            elif ob.type in UNSUPPORTED and placed.show:
                self.report(f'object "{placed.name}": {UNSUPPORTED[ob.type]} are not rendered')
            if placed.particles and ob.type == "MESH":
                self.particle_hair(ob, placed)

    def is_held_out(self, placed):
        return placed.owner.is_holdout or placed.owner.holdout_get(view_layer=self.original_layer)

    def visibility(self, ob, placed):
        return self.links.statement(ob.original.name) + self.ray_visibility(ob, placed)

    def ray_visibility(self, ob, placed):
        if placed.owner.indirect_only_get(view_layer=self.original_layer):
            return "  visible off\n" + visibility(ob).replace("  visible off\n", "")
        return visibility(ob)

    def motion_statement(self, placed):
        end = self._motion.get(placed.key)
        if end is None or numpy.allclose(end, self.opening(placed), rtol=0, atol=1e-9):
            return ""
        return mi.transform(end, "motion transform") or ""

    def light(self, ob, placed):
        name = self.out.names.unique(placed.name)
        motion, matrix = self._motion.get(placed.key), self.opening(placed)
        if motion is not None and numpy.allclose(motion, matrix):
            motion = None
        written = lights.write(self.out, ob, ob.data, name, matrix, motion, self.report,
                               self.images)
        if written:
            self.links.add(ob.original, written)
        group = getattr(ob.original, "lightgroup", "")
        if written and group:
            self.groups.setdefault(group, []).append(written)

    def geometry_key(self, ob):
        """Objects with the same key have the same geometry."""
        original = ob.original
        shared = original.data is not None and not original.modifiers and ob.type == "MESH" and \
            ob.data is not None
        if shared:
            return "data", original.data.session_uid if hasattr(original.data, "session_uid") else \
                original.data.name_full, ob.data.name_full
        if ob.data is None:
            return "object", original.name_full, "", 0
        # Geometry nodes place several meshes with the same name; their order is that of other frames.
        names = "object", original.name_full, ob.data.name_full
        order = self._orders.setdefault(names, {})
        return *names, order.setdefault(ob.data.as_pointer(), len(order))

    def slots(self, ob, placed):
        """Material names of the slots, and the number of texture spaces of all of them."""
        override = self.layer.material_override
        slots = [override or slot.material for slot in ob.material_slots] or [override]
        def values_of(wanted):
            return variants.values_of(wanted, ob, placed)
        written = [self.materials.write(m, values_of) for m in slots]
        if self.is_held_out(placed):
            written = [(self.materials.held_out(name), count) for name, count in written]
        return [name for name, _ in written], max(count for _, count in written)

    def surface(self, ob, placed):
        if getattr(placed.owner, "is_shadow_catcher", False):
            self.report(f'object "{placed.name}": shadow catchers are rendered as other objects')
        names, spaces = self.slots(ob, placed)
        key = self.geometry_key(ob) + (spaces,)
        if key not in self._objects:
            self._objects[key] = self.geometry(ob, placed, self.materials.spaces[:spaces], key)
        element = self._objects[key]
        if element is None:
            return
        slot_list = ", ".join(mi.quoted(n) for n in names)
        extra = f"  material [ {slot_list} ]\n" + self.visibility(ob, placed) + \
            self.motion_statement(placed)
        name = self.out.names.unique(placed.name)
        if self.is_held_out(placed):
            self.holdouts.add(name)
        if not self.out.instance(name, element, self.opening(placed), extra):
            self.report(f'object "{placed.name}": its transform is singular; it is skipped')
        group = getattr(ob.original, "lightgroup", "")
        if group:
            self.groups.setdefault(group, []).append(name)

    def geometry(self, ob, placed, spaces, key):
        """Writes the mesh of an object; returns the element, or None without triangles."""
        if key in self.known:
            wish, path = self.known[key]
            name = self.out.names.unique(wish)
            if name == wish and path.exists():
                self.meshes.keep(path)
                self.out.add(f"$include {mi.quoted(str(path))}\n")
                return name
        mesh = ob.to_mesh()
        if mesh is None:
            return None
        try:
            data = meshes.read(mesh, spaces)
        finally:
            ob.to_mesh_clear()
        if data is None:
            return None
        if len(ob.material_slots) > 0:
            data.labels = numpy.clip(data.labels, 0, len(ob.material_slots) - 1)
        else:
            data.labels = numpy.zeros_like(data.labels)
        first = self._opening_points.get(key[:-1])
        if first is not None and first.shape == data.points.shape:
            data.points, data.smooth = first, None
        motion = self.displacements(key[:-1], data.points)
        name = self.out.names.unique((ob.data.name if ob.data else ob.name) + ".mesh")
        path = self.meshes.add_mesh(name, data, motion)
        self.known[key] = name, path
        self.out.add(f"$include {mi.quoted(str(path))}\n")
        return name

    def displacements(self, key, points):
        """Motion of points until shutter close, by way of the middle if the path is bent; None if
        they rest."""
        close, middle = self._motion_points.get(key), self._middle_points.get(key)
        if close is None or close.shape != points.shape:
            return None
        motion = close - points
        if middle is not None and middle.shape == points.shape:
            bent = middle - points
            if numpy.abs(bent - motion / 2).max() > 1e-4 * max(numpy.abs(points).max(), 1e-6):
                return numpy.hstack([bent, motion])
        return motion if motion.any() else None

    def curves(self, ob, placed):
        arrays = curves.curves_arrays(ob.data)
        self.hair(ob, placed, *arrays, wish=ob.data.name)

    def particle_hair(self, ob, placed):
        for i, system in enumerate(ob.particle_systems):
            if system.settings.type != "HAIR" or system.settings.render_type != "PATH":
                continue
            arrays = curves.particle_arrays(ob, system, numpy.linalg.inv(placed.matrix))
            if arrays:
                index = system.settings.material - 1
                self.hair(ob, placed, *arrays, wish=f"{placed.name}.{system.name}", slot=index)

    def hair(self, ob, placed, points, radii, first, wish, slot=0):
        names, _ = self.slots(ob, placed)
        name = self.out.names.unique(wish + ".hair")
        chunks = curves.hair_text(name, points, radii, first)
        if chunks is None:
            self.report(f'object "{placed.name}": its curves have no segments; it is skipped')
            return
        path = self.meshes.store(chunks, "hair")
        self.out.add(f"$include {mi.quoted(str(path))}\n")
        extra = f"  material {mi.quoted(names[min(slot, len(names) - 1)])}\n"
        self.out.instance(self.out.names.unique(placed.name), name, self.opening(placed),
                          extra + self.visibility(ob, placed) + self.motion_statement(placed))


def write_text(path, text):
    part = f"{path}.part"
    with open(part, "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(part, path)


def background_path(path):
    """The file of the scene without objects, beside the scene."""
    return os.path.splitext(path)[0] + "-background.mi"


def hidden_shape(ob):
    """Whether an object is a light with a shape that reflections see and the camera does not."""
    if ob.type != "LIGHT" or ob.visible_camera:
        return False
    light = ob.data
    if light.type == "AREA":
        return not getattr(getattr(light, "cycles", None), "is_portal", False)
    return light.type != "SUN" and light.shadow_soft_size > 0


def visibility(ob):
    """Statements of the ray visibility of an object."""
    text = ""
    if not ob.visible_camera:
        text += "  visible off\n"
    if not ob.visible_shadow:
        text += "  shadow 4\n"
    if not ob.visible_glossy:
        text += "  reflection 4\n"
    if not ob.visible_transmission:
        text += "  refraction 4\n"
    if not ob.visible_diffuse:
        text += "  finalgather 4\n"
    return text


def filter_of(scene):
    """The pixel filter of Cycles; its Blackman-Harris of width w is close to a Gauss filter."""
    settings = getattr(scene, "cycles", None)
    width = getattr(settings, "filter_width", 1.5)
    if getattr(settings, "pixel_filter_type", "BLACKMAN_HARRIS") == "BOX":
        return "box 1 1"
    return f"gauss {mi.number(width)} {mi.number(width)}"
