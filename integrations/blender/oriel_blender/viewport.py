# SPDX-License-Identifier: Apache-2.0
"""The rendered viewport: a worker per view restarts the program on changes.

The main thread only exports changes and draws the newest picture. Pictures of growing resolution
are rendered by processes of their own, so neither a long render nor a crash stops Blender.
"""
import os
import shutil
import tempfile
import threading
import time
import weakref

import numpy

from . import camera, export, exr, meshes, mi, passes, process, program

# Divisor of the resolution and samples of the stages; the last one has the samples of the scene.
STAGES = ((4, 4), (2, 8), (1, None))
POLL_SECONDS = 0.01
PART_SECONDS = 0.5   # between looks for the picture in progress
SETTLE_SECONDS = 0.05  # changes that follow each other faster start one render

SESSIONS = weakref.WeakSet()


class ViewWindow:
    """The view of a region: matrix, window at distance 1 (or in scene units), size in pixels."""

    def __init__(self, region, region_data):
        p = numpy.array(region_data.window_matrix, numpy.float64)
        self.to_world = numpy.linalg.inv(numpy.array(region_data.view_matrix, numpy.float64))
        self.perspective = abs(p[3, 3]) < .5
        self.half = 1 / p[0, 0], 1 / p[1, 1]
        sign, column = (1, 2) if self.perspective else (-1, 3)
        self.centre = sign * p[0, column] / p[0, 0], sign * p[1, column] / p[1, 1]
        self.size = region.width, region.height

    def key(self):
        numbers = numpy.concatenate([self.to_world.ravel(), self.half, self.centre])
        return tuple(numpy.round(numbers, 7)), self.size

    def text(self, environment, divisor, names):
        """Camera and instance; returns the text and the name of the instance."""
        width, height = (max(n // divisor, 1) for n in self.size)
        focal = "1" if self.perspective else "infinity"
        background = f"  environment = {mi.quoted(environment)}\n" if environment else ""
        offset = [c / (2 * h) * n for c, h, n in zip(self.centre, self.half, (width, height))]
        return (f"camera {mi.quoted(names[0])}\n{background}  focal {focal}\n"
                f"  aperture {mi.number(2 * self.half[0])}\n"
                f"  aspect {mi.number(self.half[0] / self.half[1])}\n"
                f"  resolution {width} {height}\n  offset {mi.numbers(offset)}\nend camera\n"
                f"instance {mi.quoted(names[1])} {mi.quoted(names[0])}\n"
                f"{mi.transform(self.to_world)}end instance\n")


class Job:
    """One state of scene and view."""

    def __init__(self, body, window):
        self.body, self.members, self.environment, self.samples, self.denoise, self.names = body
        self.window = window

    def scene(self, divisor):
        camera_text = self.window.text(self.environment, divisor, self.names)
        return self.body + camera_text + export.Exporter.ending(
            [*self.members, self.names[1]], self.names[1])


class Newest:
    """A file that another process replaces."""

    def __init__(self, path):
        self.path = path
        self._stamp = self._checked = 0
        if os.path.exists(path):  # left by a process that was ended
            os.unlink(path)

    def changed(self):
        now = time.monotonic()
        if now - self._checked < PART_SECONDS:
            return False
        self._checked = now
        try:
            stamp = os.stat(self.path).st_mtime_ns
        except OSError:
            return False
        if stamp == self._stamp:
            return False
        self._stamp = stamp
        return True


class Worker:
    """Renders the newest job in a thread. It never calls Blender except to ask for a redraw."""

    def __init__(self, folder, redraw):
        self.folder = folder
        self.picture = None       # float32 (height, width, 4), of the newest finished stage
        self.stage = -1           # index of that stage
        self.submitted = 0        # number of jobs
        self.finished = 0         # number of the last job whose stages are all done
        self.error = ""
        self._redraw = redraw
        self._job = None
        self._wake = threading.Event()
        self._stopped = False
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def submit(self, job):
        self.submitted += 1
        self._job = self.submitted, job
        self._wake.set()

    def stop(self):
        self._stopped = True
        self._wake.set()
        self._thread.join(timeout=5)

    def _run(self):
        while not self._stopped:
            self._wake.wait()
            time.sleep(SETTLE_SECONDS)
            self._wake.clear()
            if self._stopped or self._job is None:
                continue
            number, job = self._job
            try:
                self._render(number, job)
            except (OSError, RuntimeError, ValueError) as error:
                self.error = str(error)
                self._redraw()

    def _render(self, number, job):
        path = program.find_cached()
        for stage, (divisor, samples) in enumerate(STAGES):
            scene = os.path.join(self.folder, "view.mi")
            output = os.path.join(self.folder, "view.exr")
            with open(scene, "w", encoding="utf-8") as file:
                file.write(job.scene(divisor))
            part = Newest(os.path.join(self.folder, "view.part.exr"))
            last = stage == len(STAGES) - 1
            layers = "beauty,normal,albedo,variance,halves" if last and job.denoise else "beauty"
            run = process.RenderProcess(path, [
                scene, "-o", output, "--exr", "float,none", "--linear", "--layers", layers,
                "--samples", str(samples or job.samples),
                *(["--denoise"] if last and job.denoise else [])], self.folder)
            while run.running():
                if self._wake.is_set():
                    run.kill()
                    return
                if last and part.changed():
                    self._show(part.path, stage - 1)
                time.sleep(POLL_SECONDS)
            run.finish()
            if run.code != 0:
                if self._wake.is_set():
                    return
                raise RuntimeError(run.errors[-1] if run.errors else f"exit code {run.code}")
            if not self._show(output, stage):
                raise RuntimeError("the picture of the renderer cannot be read")
            if last:
                self.finished = number

    def _show(self, path, stage):
        """Takes over the picture of a file; False if it is not complete."""
        try:
            picture = exr.read(path)
        except (OSError, ValueError):
            return False
        width, height = picture.size
        pixels = passes.combined(picture, True).reshape(height, width, 4)
        self.picture, self.stage, self.error = pixels, stage, ""
        self._redraw()
        return True


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

        self.worker = Worker(self.folder, redraw)
        self._engine = reference
        self._known = {}
        self._body = None
        self._view = None
        self._texture = None
        self._shown = None
        program.find_cached(refresh=True)
        SESSIONS.add(self)

    def scene_changed(self, depsgraph):
        """Exports the scene; unchanged meshes are not read again."""
        for update in depsgraph.updates:
            if update.is_updated_geometry:
                # A key has the names of the object's data; objects do not tell their data's users.
                self._known.clear()
                break
        exporter = export.Exporter(depsgraph, self.folder, self.meshes, lambda text: None)
        exporter.known = self._known
        environment = exporter.body()
        self.meshes.remove_unused()
        names = [exporter.out.names.unique("view"), exporter.out.names.unique("view.instance")]
        settings = depsgraph.scene.oriel
        body = exporter.out.text(), tuple(exporter.out.members), environment, \
            settings.preview_samples, settings.preview_denoise, tuple(names)
        if body != self._body:
            self._body, self._view = body, None
        engine = self._engine()
        if engine is not None:
            engine.tag_redraw()

    def draw(self, context, depsgraph):
        if self._body is None:
            self.scene_changed(depsgraph)
        window = ViewWindow(context.region, context.region_data)
        if window.key() != self._view:
            self._view = window.key()
            self.worker.submit(Job(self._body, window))
        self.show(context, depsgraph)

    def show(self, context, depsgraph):
        engine = self._engine()
        if engine is None:
            return
        if self.worker.error:
            engine.update_stats("Oriel", self.worker.error)
        picture = self.worker.picture
        if picture is None:
            return
        import gpu
        from gpu_extras.presets import draw_texture_2d
        if picture is not self._shown:
            height, width = picture.shape[:2]
            factor = camera.exposure_factor(depsgraph.scene.oriel)
            pixels = picture
            if factor != 1:
                pixels = picture * numpy.array((factor, factor, factor, 1), numpy.float32)
            pixels = numpy.ascontiguousarray(numpy.clip(pixels, 0, 65504), numpy.float32)
            data = gpu.types.Buffer("FLOAT", (height, width, 4), pixels)
            self._texture = gpu.types.GPUTexture((width, height), format="RGBA16F", data=data)
            self._shown = picture
        gpu.state.blend_set("ALPHA_PREMULT")
        engine.bind_display_space_shader(depsgraph.scene)
        draw_texture_2d(self._texture, (0, 0), context.region.width, context.region.height)
        engine.unbind_display_space_shader()
        gpu.state.blend_set("NONE")

    def stop(self):
        self.worker.stop()
        shutil.rmtree(self.folder, ignore_errors=True)
