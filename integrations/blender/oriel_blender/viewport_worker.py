# SPDX-License-Identifier: Apache-2.0
"""The renderer of one view: a thread that passes the newest state of scene and view to a process.

Changes of values go as edits of the scene that the process renders. Other changes write the scene
again. A change is sent when the first picture of the one before has arrived, so that a view that
changes all the time shows pictures, too.
"""
import os
import threading
import time

from . import export, interactive, mi, program

FIRST_PICTURE_SECONDS = 5.0  # a change is sent after this time even without a picture
MAX_EDITS = 2000             # more changes are faster as a new scene


class Job:
    """One state of scene and view.

    parts: text of the scene, the camera last; ending: text after it; view: fields of the request;
    arguments: of the process; size: of the view in pixels.
    """

    def __init__(self, parts, ending, view, arguments, size):
        self.parts, self.ending = parts, ending
        self.view, self.arguments, self.size = view, arguments, size

    def __eq__(self, other):
        return isinstance(other, Job) and vars(self) == vars(other)

    def text(self):
        return "".join(self.parts) + self.ending


def ordered(edits, before):
    """The edits, unchanged ones first: the process does again what follows the first difference."""
    wanted = set(edits)
    kept = [edit for edit in before if edit in wanted]
    known = set(kept)
    return kept + [edit for edit in edits if edit not in known]


class Worker:
    """Renders the newest job. It never calls Blender except to ask for a redraw."""

    def __init__(self, folder, redraw):
        self.folder = folder
        self.picture = None       # the newest picture
        self.submitted = 0        # number of jobs
        self.finished = 0         # number of the last job whose picture is complete
        self.reloads = 0          # number of times that the scene was written
        self.latencies = []       # seconds from a job to its first picture
        self.error = ""
        self.process = None
        self._redraw = redraw
        self._job = None
        self._sent = None         # job whose scene and edits the process has
        self._base = None         # job whose text the process has read
        self._edits = []
        self._processes = 0       # number of processes so far
        self._request = 0         # number of the last request
        self._epoch = None        # epoch of its pictures; None before the reply
        self._first = True        # its first picture has arrived
        self._failed = ""         # why the last request failed
        self._stopped = False
        self._changed = threading.Condition()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    # Called by Blender ------------------------------------------------------------------------
    def submit(self, job):
        with self._changed:
            self.submitted += 1
            self._job = self.submitted, time.monotonic(), job
            self._changed.notify_all()

    def stop(self):
        with self._changed:
            self._stopped = True
            self._changed.notify_all()
        process = self.process
        if process is not None:
            process.kill()
        self._thread.join(timeout=5)

    # Called by the reader of the process --------------------------------------------------------
    def _on_message(self, message):
        with self._changed:
            kind = message.get("type")
            if kind in {"reply", "error"} and message.get("id") == self._request:
                self._epoch = message.get("epoch")
                self._failed = str(message.get("message", "")) if kind == "error" else ""
            elif kind == "state" and self._epoch is not None and \
                    message.get("epoch", -1) >= self._epoch:
                if message.get("state") == "failed":
                    self._failed = str(message.get("message", "failed"))
                elif message.get("state") == "converged" and self._sent is not None:
                    self.finished = self._sent[0]
            self._changed.notify_all()

    def _on_picture(self, picture):
        with self._changed:
            if self._epoch is None or picture.epoch < self._epoch:
                return  # of an older state of the scene or view
            picture.place(self._sent[2].size)
            self.picture, self.error = picture, ""
            if not self._first:
                self._first = True
                self.latencies.append(time.monotonic() - self._sent[1])
            self._changed.notify_all()
        self._redraw()

    def _on_end(self):
        with self._changed:
            self._changed.notify_all()

    # The thread ---------------------------------------------------------------------------------
    def _run(self):
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._stopped or self._waits() or self._died())
                if self._stopped:
                    break
                died = self._died()
                job = self._job
            try:
                if died:
                    self._report_end()
                    continue
                self._send(job)
            except (OSError, RuntimeError, ValueError) as error:
                self._sent = job
                self._show_error(str(error))
        if self.process is not None:
            self.process.kill()

    def _waits(self):
        return self._job is not None and self._job is not self._sent

    def _died(self):
        return self.process is not None and not self.process.running()

    def _report_end(self):
        reason = self.process.reason()
        self.process = self._base = None
        self._show_error(reason)

    def _show_error(self, text):
        if not self._stopped:
            self.error = text
            self._redraw()

    def _send(self, job):
        state = job[2]
        if self.process is not None and self._base is not None and \
                self._base.arguments != state.arguments:
            self.process.kill()
            self.process = None
        edits = None
        if self.process is not None and self._base is not None and \
                self._base.ending == state.ending:
            edits = mi.edits_between(self._base.parts, state.parts)
        if edits is not None and len(edits) <= MAX_EDITS:
            edits = ordered(edits, self._edits)
            if edits == self._edits and self._sent[2].view == state.view:
                with self._changed:  # the process shows it already
                    if self.finished == self._sent[0]:
                        self.finished = job[0]
                    self._sent = job
                return
            fields = {} if edits == self._edits else {"edits": edits}
            self._edits = edits
            failed = self._ask(job, {**state.view, **fields})
            if not failed or self._died():
                return
        failed = self._load(job)
        if failed and not self._died():
            self._base = None
            self._show_error(failed)

    def _load(self, job):
        """Writes the scene and lets the process read it."""
        state = job[2]
        path = os.path.join(self.folder, "view.mi")
        export.write_text(path, state.text())
        if self.process is None:
            self._processes = number = self._processes + 1

            def of_this(function):  # messages of an earlier process may still arrive
                return lambda value: function(value) if number == self._processes else None
            self.process = interactive.Process(
                program.find_cached(), path, state.arguments, self.folder,
                of_this(self._on_message), of_this(self._on_picture), self._on_end)
        self._base, self._edits = state, []
        self.reloads += 1
        return self._ask(job, {**state.view, "reload": True})

    def _ask(self, job, fields):
        """Sends a request and waits for its first picture; returns why it failed, or ''."""
        with self._changed:
            self._request += 1
            self._sent, self._epoch, self._first, self._failed = job, None, False, ""
            request = {"type": "update", "id": self._request, **fields}
        try:
            self.process.send(request)
        except OSError:
            return ""  # it has ended, which _run() reports
        with self._changed:
            self._changed.wait_for(
                lambda: self._stopped or self._failed or self._first or self._died(),
                FIRST_PICTURE_SECONDS)
            while not (self._stopped or self._died()) and self._epoch is None and \
                    not self._failed:
                self._changed.wait(1.0)  # reading the scene takes longer
            return self._failed
