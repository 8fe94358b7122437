# SPDX-License-Identifier: Apache-2.0
"""Runs the program as a process of its own, and reads its messages."""
import atexit
import json
import os
import queue
import shutil
import signal
import subprocess
import threading
import weakref

_running = weakref.WeakSet()


@atexit.register
def kill_all():
    """Ends the processes of a Blender that quits."""
    for run in list(_running):
        run.kill()


def remember(run):
    """The process is ended when Blender quits."""
    _running.add(run)


class RenderProcess:
    """`oriel render --json`. Messages arrive in a queue; a crash of it leaves Blender running."""

    def __init__(self, program, arguments, folder):
        environment = dict(os.environ)
        environment.pop("PYTHONPATH", None)
        self.messages = queue.Queue()
        self.errors = []
        # The kernel ends the render if Blender crashes; the thread that starts it waits for it.
        guard = shutil.which("setpriv")
        start = [guard, "--pdeathsig", "KILL"] if guard else []
        self._process = subprocess.Popen(
            [*start, program, "render", *arguments, "--json"], cwd=folder, env=environment,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            errors="replace", start_new_session=True)
        remember(self)
        self._readers = [threading.Thread(target=self._read_events, daemon=True),
                         threading.Thread(target=self._read_errors, daemon=True)]
        for reader in self._readers:
            reader.start()

    def _read_events(self):
        for line in self._process.stdout:
            try:
                event = json.loads(line)
            except ValueError:
                continue
            if isinstance(event, dict):
                self.messages.put(event)

    def _read_errors(self):
        for line in self._process.stderr:
            self.errors = self.errors[-19:] + [line.rstrip()]

    def running(self):
        return self._process.poll() is None

    @property
    def code(self):
        return self._process.returncode

    def events(self):
        """Messages since the last call."""
        found = []
        while True:
            try:
                found.append(self.messages.get_nowait())
            except queue.Empty:
                return found

    def finish(self):
        """Waits for the end of the output of a process that has ended."""
        self._process.wait()
        for reader in self._readers:
            reader.join(timeout=5)

    def interrupt(self):
        """Ends the render with the picture so far."""
        if self.running():
            self._process.send_signal(signal.SIGINT)

    def kill(self):
        if self.running():
            self._process.kill()
        self.finish()
