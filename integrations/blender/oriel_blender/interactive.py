# SPDX-License-Identifier: Apache-2.0
"""A process of `oriel interactive`, whose scene is edited while it renders.

The messages are described in docs/dev/interactive-protocol.md.
"""
import json
import os
import shutil
import signal
import struct
import subprocess
import threading

import numpy

from . import process

HEADER = struct.Struct("<4s4BIHH4HII")
MAGIC = b"ORIL"
LAST = 1
MAX_MESSAGE = 1 << 28


class Picture:
    """A picture, or the part of it that is rendered.

    pixels: float32 (h, w, 4), row 0 at the bottom; top: upper left corner of the part. A pixel is
    `divider` pixels of the view wide.
    """

    def __init__(self, epoch, divider, samples, top, pixels):
        self.epoch, self.divider, self.samples = epoch, divider, samples
        self.top, self.pixels = top, pixels
        self.size = pixels.shape[1::-1]   # of the whole picture
        self.x = self.y = 0               # lower left corner of the part

    def place(self, view):
        """Sets the size of the whole picture by that of the view."""
        self.size = tuple(-(-n // self.divider) for n in view)
        self.x, self.y = self.top[0], self.size[1] - self.top[1] - self.pixels.shape[0]


class Assembler:
    """Puts the strips of pictures together."""

    def __init__(self):
        self._frame = None
        self._rows = []

    def add(self, message):
        """The finished picture, or None. Raises ValueError for a damaged message."""
        if len(message) < HEADER.size:
            raise ValueError("a strip is too short")
        (magic, version, kind, form, flags, epoch, layer, divider, x, y, w, h, samples,
         frame) = HEADER.unpack_from(message)
        if magic != MAGIC or version != 1 or kind or form or layer or not divider:
            raise ValueError("a strip has an unknown form")
        if len(message) != HEADER.size + w * h * 6 or not w or not h:
            raise ValueError("a strip has a wrong length")
        if frame != self._frame:
            self._frame, self._rows = frame, []
        self._rows.append((x, y, w, h, numpy.frombuffer(message, "<f2", w * h * 3, HEADER.size)))
        if not flags & LAST:
            return None
        rows, self._rows = self._rows, []
        first = rows[0]
        if any(r[0] != first[0] or r[2] != first[2] for r in rows):
            raise ValueError("strips of a picture have different widths")
        height = sum(r[3] for r in rows)
        pixels = numpy.ones((height, w, 4), numpy.float32)
        below = height
        for _x, _y, width, count, values in rows:  # the first strip is the top one
            pixels[below - count:below, :, :3] = values.reshape(count, width, 3)[::-1]
            below -= count
        return Picture(epoch, divider, samples, (first[0], first[1]), pixels)


class Process:
    """The process. Messages are passed to functions that a thread calls."""

    def __init__(self, program, scene, arguments, folder, on_message, on_picture, on_end):
        environment = dict(os.environ)
        environment.pop("PYTHONPATH", None)
        # The kernel ends the process if the thread that starts it ends: that of Blender.
        guard = shutil.which("setpriv")
        start = [guard, "--pdeathsig", "KILL"] if guard else []
        self.errors = []
        self._process = subprocess.Popen(
            [*start, program, "interactive", scene, *arguments], cwd=folder, env=environment,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            start_new_session=True)
        process.remember(self)
        self._on_message, self._on_picture, self._on_end = on_message, on_picture, on_end
        self._errors_reader = threading.Thread(target=self._read_errors, daemon=True)
        self._errors_reader.start()
        threading.Thread(target=self._read, daemon=True).start()

    @property
    def pid(self):
        return self._process.pid

    def running(self):
        return self._process.poll() is None

    def send(self, request):
        """Writes a request; raises OSError if the process has ended."""
        self._process.stdin.write(json.dumps(request).encode() + b"\n")
        self._process.stdin.flush()

    def kill(self):
        if self.running():
            self._process.kill()
        self._process.wait()

    def reason(self):
        """Why the process ended."""
        code = self._process.wait()
        self._errors_reader.join(timeout=1)
        if code < 0:
            return f"the renderer ended by signal {signal.Signals(-code).name}"
        return self.errors[-1] if self.errors else f"the renderer ended with exit code {code}"

    def _read_errors(self):
        for line in self._process.stderr:
            self.errors = self.errors[-19:] + [line.decode("utf-8", "replace").rstrip()]

    def _read_exactly(self, count):
        data = self._process.stdout.read(count)
        if len(data) != count:
            raise EOFError
        return data

    def _read(self):
        assembler = Assembler()
        try:
            while True:
                size, = struct.unpack("<I", self._read_exactly(4))
                if size > MAX_MESSAGE:
                    raise ValueError("a message is too long")
                message = self._read_exactly(size)
                if message[:4] == MAGIC:
                    picture = assembler.add(message)
                    if picture is not None:
                        self._on_picture(picture)
                else:
                    value = json.loads(message)
                    if isinstance(value, dict):
                        self._on_message(value)
        except (EOFError, OSError):
            pass
        except ValueError as error:
            self.errors.append(f"a message of the renderer is damaged: {error}")
            self._process.kill()
        self._process.wait()
        self._on_end()
