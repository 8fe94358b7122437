# SPDX-License-Identifier: Apache-2.0
"""The rendered viewport: the main thread exports changes and draws the newest picture.

Pictures are rendered by a process for each view, so neither a long render nor a crash stops
Blender.
"""
import os
import shutil
import tempfile
import weakref

import numpy

from . import camera, export, meshes, mi, program, viewport_worker, world_bake

SESSIONS = weakref.WeakSet()


class ViewWindow:
    """The view of a region: matrix, window at distance 1 (or in scene units), size in pixels."""

    def __init__(self, region, region_data, scene=None, space=None):
        p = numpy.array(region_data.window_matrix, numpy.float64)
        self.to_world = numpy.linalg.inv(numpy.array(region_data.view_matrix, numpy.float64))
        self.perspective = abs(p[3, 3]) < .5
        self.half = 1 / p[0, 0], 1 / p[1, 1]
        sign, column = (1, 2) if self.perspective else (-1, 3)
        self.centre = sign * p[0, column] / p[0, 0], sign * p[1, column] / p[1, 1]
        self.size = region.width, region.height
        self.lens, self.region = None, None
        if scene is None:
            return
        camera_object = scene.camera if region_data.view_perspective == "CAMERA" else None
        if camera_object is not None and camera_object.type == "CAMERA":
            self.lens = camera.bokeh_call(camera_object, camera_object.data, self.to_world)
            self.region = camera_region(scene, camera_object, p, self.size)
        elif space is not None and space.use_render_border:
            self.region = border_pixels(
                (0, 0, *self.size), (space.render_border_min_x, space.render_border_min_y,
                                     space.render_border_max_x, space.render_border_max_y),
                self.size)

    def parts(self, environment, names):
        """Texts of the camera and its instance."""
        width, height = self.size
        focal = "1" if self.perspective else "infinity"
        background = f"  environment = {mi.quoted(environment)}\n" if environment else ""
        offset = [c / (2 * h) * n for c, h, n in zip(self.centre, self.half, self.size)]
        values = {"aperture": mi.number(2 * self.half[0]),
                  "aspect": mi.number(self.half[0] / self.half[1]),
                  "resolution": f"{width} {height}", "offset": mi.numbers(offset)}
        frame, lens = (names[0], focal, environment), ""
        body = "".join(f"  {key} {value}\n" for key, value in values.items())
        if self.lens:
            parameters, fixed = mi.call_values(self.lens)
            values.update(parameters)
            frame, lens = (*frame, fixed), f"  lens {self.lens}\n"
        text = (f"camera {mi.quoted(names[0])}\n{lens}{background}  focal {focal}\n{body}"
                "end camera\n")
        return [mi.part(text, frame, names[0], values),
                mi.instance_part(names[1], names[0], self.to_world)]


def camera_region(scene, camera_object, window_matrix, size):
    """The border of the scene inside the frame of the camera, or None."""
    render = scene.render
    if not render.use_border:
        return None
    corners = []
    for point in camera_object.data.view_frame(scene=scene):
        x, y, _z, w = window_matrix @ numpy.array((*point, 1.0))
        corners.append(((x / w + 1) / 2 * size[0], (y / w + 1) / 2 * size[1]))
    low, high = numpy.min(corners, axis=0), numpy.max(corners, axis=0)
    return border_pixels((*low, *high), (render.border_min_x, render.border_min_y,
                                         render.border_max_x, render.border_max_y), size)


def border_pixels(frame, border, size):
    """A border inside a frame (lower left, upper right) as x0, y0, x1, y1 from the upper left."""
    x0, y0, x1, y1 = frame
    left = min(max(round(x0 + border[0] * (x1 - x0)), 0), size[0] - 1)
    right = min(max(round(x0 + border[2] * (x1 - x0)), left + 1), size[0])
    bottom = min(max(round(y0 + border[1] * (y1 - y0)), 0), size[1] - 1)
    top = min(max(round(y0 + border[3] * (y1 - y0)), bottom + 1), size[1])
    return left, size[1] - top, right, size[1] - bottom


class Session:
    """The viewport of one engine instance."""

    def __init__(self, engine, base):
        self.folder = tempfile.mkdtemp(prefix="view-", dir=base)
        self.meshes = meshes.MeshFolder(os.path.join(self.folder, "meshes"))
        reference = weakref.ref(engine)

        def redraw():
            try:
                owner = reference()
                if owner is not None:
                    owner.tag_redraw()
            except ReferenceError:
                pass

        self.worker = viewport_worker.Worker(self.folder, redraw)
        self._engine = reference
        self._base = base
        self._known = {}
        self._scene = None      # what the last export wrote
        self._submitted = None  # scene and view of the last job
        self._texture = None
        self._shown = None
        program.find_cached(refresh=True)
        SESSIONS.add(self)

    def forget(self, updates):
        """Forgets the geometry of changed data-blocks and of what is made from them."""
        names = set()
        for update in updates:
            if update.is_updated_geometry:
                names.add(update.id.name_full)
                data = getattr(update.id, "data", None)
                if data is not None and hasattr(data, "name_full"):
                    names.add(data.name_full)
        if names:
            self._known = {key: value for key, value in self._known.items()
                           if not any(part in names for part in key if isinstance(part, str))}

    def _world_is_ready(self):
        """Exports the scene again when the picture of the world is finished."""
        try:
            engine = self._engine()
            if engine is not None:
                engine.tag_update()
        except ReferenceError:
            pass

    def scene_changed(self, depsgraph):
        """Exports the scene; unchanged meshes are not read again."""
        self.forget(depsgraph.updates)
        exporter = export.Exporter(depsgraph, self.folder, self.meshes, lambda text: None)
        exporter.known = self._known
        exporter.baker = world_bake.Baker(self._base, self._world_is_ready)
        environment = exporter.body()
        self.meshes.remove_unused()
        names = exporter.out.names.unique("view"), exporter.out.names.unique("view.instance")
        settings = depsgraph.scene.oriel
        arguments = ("--threads", str(settings.threads)) if settings.threads else ()
        self._scene = (exporter.out.parts, tuple(exporter.out.members), environment, names,
                       settings.preview_samples, settings.preview_denoise, arguments)
        engine = self._engine()
        if engine is not None:
            engine.tag_redraw()

    def job(self, window):
        parts, members, environment, names, samples, denoise, arguments = self._scene
        view = {"samples": samples, "denoise": denoise,
                "region": list(window.region) if window.region else None}
        ending = export.Exporter.ending([*members, names[1]], names[1])
        return viewport_worker.Job([*parts, *window.parts(environment, names)], ending, view,
                                   arguments, window.size)

    def draw(self, context, depsgraph):
        if self._scene is None:
            self.scene_changed(depsgraph)
        window = ViewWindow(context.region, context.region_data, depsgraph.scene_eval,
                            context.space_data)
        job = self.job(window)
        if job != self._submitted:
            self._submitted = job
            self.worker.submit(job)
        self.show(context, depsgraph)

    def show(self, context, depsgraph):
        engine = self._engine()
        if engine is None:
            return
        worker = self.worker
        if worker.error:
            engine.update_stats("Oriel", worker.error)
        picture = worker.picture
        if picture is None:
            return
        if not worker.error:
            engine.update_stats("", f"Samples {picture.samples}"
                                if picture.divider == 1 else f"1/{picture.divider}")
        import gpu
        from gpu_extras.presets import draw_texture_2d
        height, width = picture.pixels.shape[:2]
        factor = camera.exposure_factor(depsgraph.scene.oriel)
        if self._shown != (id(picture), factor):
            pixels = picture.pixels
            if factor != 1:
                pixels = pixels * numpy.array((factor, factor, factor, 1), numpy.float32)
            pixels = numpy.ascontiguousarray(numpy.clip(pixels, 0, 65504), numpy.float32)
            data = gpu.types.Buffer("FLOAT", (height, width, 4), pixels)
            self._texture = gpu.types.GPUTexture((width, height), format="RGBA16F", data=data)
            self._shown = id(picture), factor
        scale_x = context.region.width / picture.size[0]
        scale_y = context.region.height / picture.size[1]
        gpu.state.blend_set("ALPHA_PREMULT")
        engine.bind_display_space_shader(depsgraph.scene)
        draw_texture_2d(self._texture, (picture.x * scale_x, picture.y * scale_y),
                        width * scale_x, height * scale_y)
        engine.unbind_display_space_shader()
        gpu.state.blend_set("NONE")

    def stop(self):
        self.worker.stop()
        shutil.rmtree(self.folder, ignore_errors=True)
