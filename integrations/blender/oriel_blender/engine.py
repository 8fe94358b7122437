# SPDX-License-Identifier: Apache-2.0
"""The render engine: final renders, previews of materials and the viewport."""
import os
import tempfile
import time
import traceback

import bpy
import numpy

from . import camera, export, exr, mattes, meshes, passes, process, program, viewport

ENGINE = "ORIEL"
POLL_SECONDS = 0.05
SHOW_SECONDS = 1.5
UNINTERESTING = {"OR-GEOM-001"}  # triangles without area, which caps of texts have


class RenderFailed(RuntimeError):
    pass


_mesh_folders = {}


def session_folder():
    """A folder in Blender's temporary folder; meshes stay in it between frames."""
    base = bpy.app.tempdir or tempfile.gettempdir()
    folder = os.path.join(base, f"oriel-{os.getpid()}")
    os.makedirs(folder, exist_ok=True)
    return folder


def mesh_folder():
    folder = os.path.join(session_folder(), "meshes")
    if folder not in _mesh_folders or not os.path.isdir(folder):
        _mesh_folders[folder] = meshes.MeshFolder(folder)
    return _mesh_folders[folder]


class Border:
    """The rectangle of the picture that is rendered, in pixels, ends included."""

    def __init__(self, render, width, height):
        self.used = render.use_border
        self.x0, self.y0, self.x1, self.y1 = 0, 0, width, height
        if self.used:  # Blender rounds down, in single precision
            def pixel(part, count):
                return int(numpy.float32(part) * numpy.float32(count))
            self.x0 = pixel(render.border_min_x, width)
            self.x1 = max(pixel(render.border_max_x, width), self.x0 + 1)
            self.y0 = pixel(render.border_min_y, height)
            self.y1 = max(pixel(render.border_max_y, height), self.y0 + 1)

    @property
    def size(self):
        return self.x1 - self.x0, self.y1 - self.y0

    def arguments(self):
        if not self.used:
            return []
        return ["--crop", f"{self.x0},{self.y0},{self.x1 - 1},{self.y1 - 1}"]


class OrielEngine(bpy.types.RenderEngine):
    bl_idname = ENGINE
    bl_label = "Oriel"
    bl_use_preview = True
    bl_use_postprocess = True
    bl_use_shading_nodes_custom = False
    bl_use_eevee_viewport = True

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        self.session = None
        self.background = None
        self.holdouts = ()

    def __del__(self):
        try:
            session = self.session
        except (AttributeError, ReferenceError):  # Blender has freed the instance
            return
        if session is not None:
            session.stop()

    # Final renders ----------------------------------------------------------------------------
    def update_render_passes(self, scene, renderlayer):
        passes.register_all(self, scene, renderlayer)

    def render(self, depsgraph):
        try:
            self.render_layer(depsgraph)
        except (RenderFailed, program.ProgramMissing, camera.Unsupported) as error:
            self.fail(str(error))
        except Exception as error:  # an exception would leave an empty picture and exit status 0
            traceback.print_exc()
            self.fail(f"the export failed: {error}")

    def fail(self, text):
        self.error_set("Oriel: " + text)
        self.report({"ERROR"}, "Oriel: " + text)

    def render_layer(self, depsgraph):
        scene = depsgraph.scene
        if scene.camera is None and self.camera_override is None:
            raise RenderFailed("the scene has no camera")
        viewer = self.camera_override or scene.camera
        if viewer.type != "CAMERA":
            raise RenderFailed(f'object "{viewer.name}" is the camera of the scene, but is no camera')
        width, height = self.resolution_x, self.resolution_y
        border = Border(scene.render, width, height)
        for view in self.views(scene):
            self.render_view(depsgraph, view, (width, height), border)
        if not self.is_preview:
            mesh_folder().remove_unused()

    def views(self, scene):
        if scene.render.use_multiview and not self.is_preview:
            return [view.name for view in scene.render.views if view.use]
        return [""]

    def render_view(self, depsgraph, view, size, border):
        scene, layer = depsgraph.scene, depsgraph.view_layer
        if view:
            self.active_view_set(view)
        # Animations of the command line update evaluated data only.
        camera_object = depsgraph.scene_eval.camera
        matrix = numpy.array(self.camera_model_matrix(camera_object), numpy.float64).reshape(4, 4)
        shift = {"shift_x": self.camera_shift_x(camera_object)} if view else {}
        if not self.is_preview and passes.missing(layer):
            self.warn(f'view layer "{layer.name}": the passes {", ".join(passes.missing(layer))} are not '
                      "rendered")
        folder = session_folder()
        started = time.time()
        self.update_stats("", "Exporting")
        exporter = export.Exporter(
            depsgraph, folder, mesh_folder(), self.warn,
            None if self.is_preview else self.frame_set, matrix, shift)
        if self.is_preview:
            exporter.baker = None  # previews are small and frequent
        name = "preview" if self.is_preview else "frame"
        scene_path = exporter.write(os.path.join(folder, f"{name}.mi"), size)
        print(f"Oriel: exported in {time.time() - started:.2f} s, "
              f"{exporter.meshes.written} new meshes")
        exporter.meshes.written = 0
        self.holdouts = sorted(exporter.holdouts)
        output = os.path.join(folder, f"{name}.exr")
        arguments = [scene_path, "-o", output, "--exr", "float,none", "--linear",
                     *border.arguments(), *self.quality(scene), *self.group_arguments(exporter),
                     *passes.arguments(layer, self.denoises(scene),
                                       exporter.transparent or bool(exporter.holdouts))]
        result_size = border.size if border.used else size
        result = self.begin_result(0, 0, *result_size, layer=layer.name, view=view)
        self.background = self.render_background(scene_path, border) if exporter.transparent \
            else None
        try:
            self.follow(scene, layer, arguments, output, result, result_size, view)
        except BaseException:
            self.end_result(result, cancel=True)
            raise
        self.end_result(result, cancel=self.cancelled())

    def render_background(self, scene_path, border):
        """The light of the world behind the objects of a transparent film, (pixels, 3)."""
        folder, path = os.path.dirname(scene_path), export.background_path(scene_path)
        output = os.path.join(folder, "background.exr")
        run = process.RenderProcess(program.find(), [
            path, "-o", output, "--exr", "float,none", "--linear", "--layers", "beauty",
            "--samples", "16", *border.arguments()], folder)
        while run.running():
            if self.cancelled():
                run.kill()
                return None
            time.sleep(POLL_SECONDS)
        run.finish()
        return exr.read(output).stack(list(passes.RGB)) if run.code == 0 else None

    def cancelled(self):
        return self.test_break()

    def warn(self, text):
        if not self.is_preview:
            self.report({"WARNING"}, "Oriel: " + text)

    def denoises(self, scene):
        return scene.oriel.denoise and not self.is_preview

    def quality(self, scene):
        settings = scene.oriel
        if self.is_preview:
            return ["--samples", "16"]
        result = ["--samples", str(settings.samples), "--seed", str(settings.seed)]
        if settings.noise > 0:
            result += ["--noise", str(settings.noise)]
        if settings.time > 0:
            result += ["--time", str(settings.time)]
        threads = settings.threads or (scene.render.threads
                                       if scene.render.threads_mode == "FIXED" else 0)
        if threads:
            result += ["--threads", str(threads)]
        if settings.denoise:
            result.append("--denoise")
        return result

    @staticmethod
    def group_arguments(exporter):
        result = []
        for group, names in exporter.groups.items():
            result += ["--light-group", f"{group}={','.join(names)}"]
        world = exporter.scene.world
        if world and getattr(world, "lightgroup", ""):
            result += ["--light-group", f"{world.lightgroup}=environment"]
        return result

    def follow(self, scene, layer, arguments, output, result, size, view):
        """Runs the program, shows its progress, and fills the result."""
        folder = os.path.dirname(output)
        part = os.path.splitext(output)[0] + ".part.exr"
        for path in (output, part):
            if os.path.exists(path):
                os.unlink(path)
        run = process.RenderProcess(program.find(), arguments, folder)
        shown, stamp = time.time(), None
        try:
            while run.running():
                if self.cancelled():
                    return
                for event in run.events():
                    self.progress(event)
                if time.time() - shown > SHOW_SECONDS and os.path.exists(part):
                    shown, now = time.time(), os.stat(part).st_mtime_ns
                    if now != stamp and self.show(scene, layer, part, result, size, view):
                        stamp = now
                        self.update_result(result)
                time.sleep(POLL_SECONDS)
            run.finish()
            for event in run.events():
                self.progress(event)
        finally:
            run.kill()
        if not os.path.exists(output):
            reason = run.errors[-1] if run.errors else f"exit code {run.code}"
            raise RenderFailed(f"the renderer failed: {reason}")
        if not self.show(scene, layer, output, result, size, view):
            raise RenderFailed("the picture of the renderer cannot be read")

    def progress(self, event):
        kind = event.get("event")
        if kind == "progress":
            self.update_progress(min(max(float(event.get("done", 0)), 0), 1))
            noise = event.get("noise")
            self.update_stats(str(event.get("stage", "")), f"Samples {event.get('samples', 0):g}" + (
                f", noise {noise:.3f}" if isinstance(noise, float) else ""))
        elif kind == "diagnostic" and event.get("severity") in {"warning", "error"} and \
                event.get("code") not in UNINTERESTING:
            self.warn(str(event.get("message", "")))

    def show(self, scene, layer, path, result, size, view):
        """Copies the passes of a file into the result. False if the file is not complete."""
        try:
            picture = exr.read(path)
        except (OSError, ValueError):
            return False
        if picture.size != tuple(size):
            return False
        factor = camera.exposure_factor(scene.oriel)
        layers = result.layers
        if not len(layers):
            return True  # the view layer is disabled
        combined = passes.combined(picture, self.denoises(scene))
        if self.background is not None and len(self.background) == len(combined):
            combined[:, 3:] = passes.coverage(picture)
            behind = (1 - combined[:, 3:]) * self.background
            combined[:, :3] = numpy.maximum(combined[:, :3] - behind, 0)
        if self.holdouts:
            combined[:, 3:] = numpy.maximum(
                combined[:, 3:] - passes.coverage(picture, self.holdouts), 0)
        if factor != 1:
            combined[:, :3] *= factor
        fill(layers[0].passes, "Combined", combined, view)
        for p in passes.wanted(layer, scene.world):
            pixels = passes.combined(picture, False)[:, :3] if p.name == "Noisy Image" \
                else p.make(picture)
            if pixels is not None:
                fill(layers[0].passes, p.name, pixels, view)
        if passes.matte_names(layer):
            stamp_mattes(self.get_result(), layer, picture.attributes)
        return True

    # Viewport ---------------------------------------------------------------------------------
    def view_update(self, context, depsgraph):
        self.viewport_session().scene_changed(depsgraph)

    def view_draw(self, context, depsgraph):
        self.viewport_session().draw(context, depsgraph)

    def viewport_session(self):
        if self.session is None:
            self.session = viewport.Session(self, session_folder())
        return self.session


def stamp_mattes(result, layer, attributes):
    """Cryptomatte metadata: the names of the layers begin with that of the view layer."""
    for key, value in attributes.items():
        if not key.startswith("cryptomatte/"):
            continue
        name = attributes.get(key.rsplit("/", 1)[0] + "/name", "")
        if not any(p.startswith(name) for p in passes.matte_names(layer)):
            continue
        field, full = key.split("/", 2)[2], f"{layer.name}.{name}"
        result.stamp_data_add_field(f"cryptomatte/{mattes.identifier(full)}/{field}",
                                    full if field == "name" else value)


def fill(found, name, pixels, view):
    target = found.find_by_name(name, view) if hasattr(found, "find_by_name") else found.get(name)
    if target is None:
        target = next((p for p in found if p.name == name), None)
    if target is None:
        return
    target.rect.foreach_set(numpy.ascontiguousarray(pixels, dtype=numpy.float32))


def register():
    bpy.utils.register_class(OrielEngine)


def unregister():
    bpy.utils.unregister_class(OrielEngine)
