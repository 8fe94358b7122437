# SPDX-License-Identifier: Apache-2.0
"""File > Import > mental ray (.mi)."""
import os

import bpy
import numpy
from bpy.props import EnumProperty, StringProperty
from mathutils import Matrix

from . import dump, import_frames, import_lights, import_materials, program, versions

Y_UP = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))


# Kinds of rays of a dump as properties of objects.
RAYS = {"camera": "visible_camera", "shadow": "visible_shadow", "reflection": "visible_glossy",
        "refraction": "visible_transmission", "finalgather": "visible_diffuse"}


def matrix_of(rows):
    """A matrix for column vectors from 16 numbers for row vectors."""
    return Matrix([rows[0:4], rows[4:8], rows[8:12], rows[12:16]]).transposed()


def sheared(matrix, parts):
    """Whether a matrix differs from the product of its location, rotation and scale."""
    size = max(abs(v) for row in matrix for v in row) or 1.0
    return any(abs(matrix[r][c] - parts[r][c]) > 1e-4 * size for r in range(3) for c in range(4))


class SceneReader:
    """Builds Blender data from a dump."""

    def __init__(self, source, context, up):
        self.dump = source
        self.context = context
        self.reports = []
        self.materials = import_materials.MaterialReader(source, self.report)
        self.cameras = {c["name"]: c for c in source.list("cameras")}
        self.lights = {l["name"]: l for l in source.list("lights")}
        self.objects = {o["name"]: o for o in source.list("objects")}
        self.frames = import_frames.Frames(source)
        self._meshes = {}
        self._data = {}  # kind and element -> camera or light
        self._upright = Y_UP if up == "Y" or (up == "AUTO" and self.y_is_up()) else Matrix()

    def report(self, text):
        if text not in self.reports:
            self.reports.append(text)

    def y_is_up(self):
        """Whether the vertical of the rendered camera is nearest to y; of skies, what they say."""
        for calls in self.dump.root.get("shaders", {}).values():
            for call in calls:
                if call.get("type") in {"mia_physicalsky", "mia_ciesky"}:
                    return call["parameters"].get("y_is_up", False) is True
        wanted = self.dump.root.get("render", {}).get("camera")
        for placed in self.dump.list("instances"):
            if placed["kind"] == "camera" and (not wanted or placed["name"] == wanted):
                up = placed["matrix"][4:7]
                return abs(up[1]) > abs(up[2])
        return False

    def run(self, collection):
        cameras = {}
        for placed in self.dump.list("instances"):
            data = getattr(self, "make_" + placed["kind"])(placed)
            if data is None:
                continue
            ob = bpy.data.objects.new(placed["name"], data)
            collection.objects.link(ob)
            ob.matrix_world = self.pose(placed, self.frames.count - 1, data)
            self.animate(ob, placed)
            if placed["kind"] == "camera":
                cameras[placed["name"]] = ob, self.cameras[placed["element"]]
            if placed["kind"] == "object":
                self.assign_materials(ob, placed)
                for kind in placed.get("hidden_from", ()):
                    setattr(ob, RAYS.get(kind, "visible_camera"), False)
        self.finish(cameras)

    def matrix_at(self, placed, frame):
        """The matrix of a placement in a frame, from 0."""
        if "motion" in placed:
            rows = self.dump.floats(placed["motion"], 16)
            return self._upright @ matrix_of(rows[min(frame, len(rows) - 1)].tolist())
        return self._upright @ matrix_of(placed["matrix"])

    def pose(self, placed, frame, data):
        """The matrix of an object in a frame. Lights of Blender shine along -z."""
        matrix = self.matrix_at(placed, frame)
        if placed["kind"] != "light":
            return matrix
        element = self.lights[placed["element"]]
        return import_lights.orientation(
            matrix, self.frames.version("lights", element["name"], frame, element), data)

    def finish(self, cameras):
        scene = self.context.scene
        render = self.dump.root.get("render", {})
        chosen = cameras.get(render.get("camera")) or next(iter(cameras.values()), None)
        if chosen:
            scene.camera, element = chosen
            width, height = element.get("resolution", (1280, 720))
            scene.render.resolution_x, scene.render.resolution_y = int(width), int(height)
            scene.render.resolution_percentage = 100
            aspect = element.get("aspect", width / height) * height / width
            scene.render.pixel_aspect_x = max(aspect, 1.0)
            scene.render.pixel_aspect_y = max(1 / aspect, 1.0)
            scene.view_settings.exposure = import_lights.exposure(self.dump, element)
            scene.world = import_lights.environment(self, element)
        if self.frames.count > 1:
            scene.frame_start, scene.frame_end = 1, self.frames.count
            self.animate_elements(chosen[1] if chosen else None)
            import_frames.mark_cameras(self.frames, scene, cameras)
            scene.frame_set(self.frames.count)
            self.report(f"the scene has {self.frames.count} frames; meshes, textures and connections "
                        "are those of the last one")

    def animate_elements(self, camera):
        """Key frames of everything but placements; camera: element of the rendered camera."""
        frames, kept = self.frames, list(self.reports)
        for placed in self.dump.list("instances"):
            kind, name = placed["kind"], placed["element"]
            data = self._data.pop((kind, name), None)
            if data is not None and kind == "camera":
                import_frames.animate_data(frames, "cameras", self.cameras[name], data,
                                           import_frames.CAMERA, self.camera_data,
                                           bpy.data.cameras.remove)
            elif data is not None and kind == "light":
                import_frames.animate_data(
                    frames, "lights", self.lights[name], data, import_frames.LIGHT,
                    lambda source: import_lights.light(self, source), bpy.data.lights.remove)
        changed = [name for name, material in self.materials.made() if not
                   import_frames.animate_material(frames, self.materials.elements[name], material,
                                                  lambda v: self.materials.make(v["name"], v))]
        if camera is not None:
            world = self.context.scene.world
            import_frames.animate_world(frames, camera, world.node_tree,
                                        lambda v, i: import_lights.environment(self, v, i))
            import_frames.animate_exposure(
                frames, camera, self.context.scene,
                lambda v: import_lights.exposure(self.dump, v))
        self.reports[:] = kept
        for name in changed:
            self.report(f'material "{name}": its connections change over frames; those of the last '
                        "one are imported")

    def animate(self, ob, placed):
        """Key frames of location, rotation and scale; one for each frame of the scene."""
        element = self.lights.get(placed["element"]) if placed["kind"] == "light" else None
        if "motion" not in placed and not (
                element and self.frames.frames_of("lights", [element["name"]])):
            return
        poses = [self.pose(placed, frame, ob.data) for frame in range(self.frames.count)]
        if all(pose == poses[0] for pose in poses):
            return
        parts = [pose.decompose() for pose in poses]
        ob.rotation_mode = "QUATERNION"
        for i in range(1, len(parts)):  # the shorter way between two frames
            if parts[i][1].dot(parts[i - 1][1]) < 0:
                parts[i][1].negate()
        frames = numpy.arange(1, len(parts) + 1)
        for path, part in (("location", 0), ("rotation_quaternion", 1), ("scale", 2)):
            for index in range(len(parts[0][part])):
                curve = versions.new_curve(ob, path, index)
                curve.keyframe_points.add(len(parts))
                points = numpy.stack([frames, [p[part][index] for p in parts]], axis=1)
                curve.keyframe_points.foreach_set("co", points.ravel())
                for key in curve.keyframe_points:
                    key.interpolation = "LINEAR"
                curve.update()
        if any(sheared(pose, Matrix.LocRotScale(*part)) for pose, part in zip(poses, parts)):
            self.report(f'object "{ob.name}": its motion shears, which key frames cannot')

    # Elements ---------------------------------------------------------------------------------
    def make_object(self, placed):
        name = placed["element"]
        if name not in self._meshes:
            self._meshes[name] = self.mesh(self.objects[name])
        return self._meshes[name]

    def mesh(self, source):
        mesh = bpy.data.meshes.new(source["name"])
        points = self.dump.floats(source["positions"])
        triangles = self.dump.integers(source["triangles"]).astype(numpy.int32)
        if len(triangles) == 0 or triangles.min() < 0 or triangles.max() >= len(points):
            raise dump.DumpError(f"object {source['name']}: corners without vertices")
        count = len(triangles) // 3
        mesh.vertices.add(len(points))
        mesh.vertices.foreach_set("co", points.ravel())
        versions.add_triangles(mesh, triangles[:3 * count])
        mesh.polygons.foreach_set("use_smooth", numpy.ones(count, bool))
        for i, place in enumerate(source.get("uvs", ())):
            layer = mesh.uv_layers.new(name=f"UV{i}" if i else "UVMap")
            if layer is not None:
                uv = self.dump.floats(place)[:, :2][triangles]
                versions.set_uv(layer, uv)
        self.slots(mesh, source, count)
        mesh.update(calc_edges=True)
        if "normals" in source:
            normals = self.dump.floats(source["normals"])[triangles]
            versions.set_corner_normals(mesh, normals.tolist())
        else:
            mesh.polygons.foreach_set("use_smooth", numpy.zeros(count, bool))
        return mesh

    def slots(self, mesh, source, count):
        """Material slots: labels keep their numbers, names become materials."""
        slots = source.get("slots", [])
        index = numpy.zeros(count, numpy.int32)
        if "slot" in source:
            index = self.dump.integers(source["slot"])[:count].astype(numpy.int32)
        if any("label" in s for s in slots):
            numbers = numpy.array([s.get("label", 0) for s in slots], numpy.int64)
            index = numbers[numpy.clip(index, 0, len(numbers) - 1)]
            for _ in range(int(min(index.max(), 4000)) + 1):
                mesh.materials.append(None)
        else:
            for slot in slots or [{}]:
                mesh.materials.append(self.materials.material(slot.get("material", "")))
        mesh.polygons.foreach_set("material_index",
                                  numpy.clip(index, 0, 32767).astype(numpy.int32))

    def assign_materials(self, ob, placed):
        """Materials of the instance, for slots that have none of their own."""
        names = placed.get("materials", [])
        for i, slot in enumerate(ob.material_slots):
            if slot.material is not None and not placed.get("override"):
                continue
            material = self.materials.material(names[min(i, len(names) - 1)]) if names else None
            if material is not None:
                slot.link = "OBJECT"
                slot.material = material

    def make_camera(self, placed):
        return self.shared("camera", placed, self.camera_data, self.cameras)

    def make_light(self, placed):
        return self.shared("light", placed, lambda source: import_lights.light(self, source),
                           self.lights)

    def shared(self, kind, placed, make, elements):
        """The data of an element, which all its placements have."""
        key = kind, placed["element"]
        if key not in self._data:
            self._data[key] = make(elements[placed["element"]])
        return self._data[key]

    def camera_data(self, source):
        camera = bpy.data.cameras.new(source["name"])
        width, height = source.get("resolution", (1280, 720))
        aspect = source.get("aspect", width / height)
        camera.sensor_fit = "HORIZONTAL"
        aperture = max(float(source["aperture"]), 1e-6)
        if source["orthographic"]:
            camera.type, camera.ortho_scale = "ORTHO", aperture
        else:
            camera.sensor_width = 36.0
            camera.lens = 36.0 * max(float(source["focal"]), 1e-6) / aperture
        offset = source.get("offset", (0, 0))
        camera.shift_x = offset[0] / width
        camera.shift_y = offset[1] / height / aspect
        near, far = source.get("clip", (0, 0))
        camera.clip_start = near if near > 0 else 0.01
        camera.clip_end = far if far > 0 else 1e5
        import_lights.focus(self.dump, source, camera)
        return camera


class ORIEL_OT_import(bpy.types.Operator):
    bl_idname = "import_scene.oriel_mi"
    bl_label = "Import mental ray (.mi)"
    bl_options = {"UNDO"}

    filepath: StringProperty(subtype="FILE_PATH")
    filter_glob: StringProperty(default="*.mi;*.mi.gz", options={"HIDDEN"})
    include: StringProperty(
        name="Include Folders", description="Folders of include files, separated by semicolons. The "
                                            "folder of the scene and those above it are searched")
    up: EnumProperty(name="Up Axis", default="AUTO", items=[
        ("AUTO", "Automatic", "From the sky, else from the camera"), ("Y", "Y", "Y points up"),
        ("Z", "Z", "Z points up")])

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        try:
            folders = [bpy.path.abspath(f) for f in self.include.split(";") if f.strip()]
            source, messages = dump.convert(bpy.path.abspath(self.filepath), folders)
            name = os.path.basename(self.filepath)
            collection = bpy.data.collections.new(name)
            context.scene.collection.children.link(collection)
            reader = SceneReader(source, context, self.up)
            reader.run(collection)
        except (dump.DumpError, program.ProgramMissing, KeyError) as error:
            self.report({"ERROR"}, f"Oriel: {error}")
            return {"CANCELLED"}
        notes = messages + reader.reports
        text = bpy.data.texts.new(f"{name} import")
        text.write("\n".join(notes) or "everything was imported")
        for note in reader.reports:
            self.report({"WARNING"}, "Oriel: " + note)
        return {"FINISHED"}


def draw_menu(self, _context):
    self.layout.operator(ORIEL_OT_import.bl_idname, text="mental ray (.mi)")


def register():
    bpy.utils.register_class(ORIEL_OT_import)
    bpy.types.TOPBAR_MT_file_import.append(draw_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(draw_menu)
    bpy.utils.unregister_class(ORIEL_OT_import)
