#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Jobs of oriel submit on a real Slurm: tests/farm/slurm_test.py ORIEL [CASE...]

tools/farm-up starts a cluster on this machine, which ends with the test. The cases run at the same time, each in a
process of its own, since most of their time is waiting for Slurm. Exit code 77: Slurm is not installed.

acceptance: F3
"""
import contextlib
import glob
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
ORIEL = ""
FARM = ROOT / "tools/farm-up"
NODES = 11
DOOMED = "n1,n2,n3"  # nodes of the case that kills one

SCENE = """
options "opt" object space trace depth 4 4 8 "indirect" "path" end options
camera "cam" focal 1 aperture 1 aspect 1.5 resolution 96 64 end camera
instance "cam_inst" "cam" end instance
light "lamp" "mib_light_point" ( "color" 1 1 1 ) origin 0 1 -3 end light
instance "lamp_inst" "lamp" end instance
material "grey" "mia_material_x" ( "diffuse" .5 .5 .5, "reflectivity" .2, "refl_gloss" .6 ) end material
object "floor" visible trace shadow tagged group
  -4 -1 -8  4 -1 -8  4 -1 0  -4 -1 0  -4 -1 -8  4 -1 -8  4 3 -8  -4 3 -8
  v 0 v 1 v 2 v 3 v 4 v 5 v 6 v 7
  p 0 3 2 1 0 p 0 4 5 6 7
end group end object
instance "floor_inst" "floor" material [ "grey" ] end instance
instgroup "root" "cam_inst" "lamp_inst" "floor_inst" end instgroup
"""
LONG = 250  # samples: some seconds of processor time
LONG_REFERENCE = "house/reference.exr"
USR1 = 1 << (signal.SIGUSR1 - 1)  # in the masks of /proc
HUGE = 400000  # more pixels than memory holds
RENDER = 'render "root" "cam_inst" "opt"\n'


def options(samples):
    """Long pictures learn nothing: one that is interrupted while it learns has no samples to save."""
    return ["--samples", str(samples), *(["--no-guiding"] if samples == LONG else [])]


def lamp(energy):
    return f'incremental light "lamp" "mib_light_point" ( "color" {energy} 1 1 ) origin 0 1 -3 end light\n'


def resolution(width, height):
    return f'incremental camera "cam" resolution {width} {height} end camera\n'


def mask(process, name):
    """A set of signals of a process, empty if it has ended."""
    try:
        status = pathlib.Path(f"/proc/{process}/status").read_text()
    except OSError:
        return 0
    return next(int(line.split()[1], 16) for line in status.splitlines() if line.startswith(name + ":"))


def run(*words, check=True, **more):
    result = subprocess.run([str(w) for w in words], text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            check=False, **more)
    if check and result.returncode != 0:
        raise AssertionError(f"{words}: status {result.returncode}\n{result.stdout}{result.stderr}")
    return result


class Slurm(unittest.TestCase):
    """One cluster for all tests, a folder for each."""

    base = farm = ""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(dir=self.base, prefix="it's \"a\" job "))
        self.scene = self.folder / "house.mi"
        self.output = self.folder / "still.exr"
        self.job = self.folder / "still.job"

    def tearDown(self):
        for job in self.queued():
            run("scancel", "--full", job, check=False)
        for task in glob.glob(str(self.job) + "/log/*"):
            if self.failed():
                print(task, pathlib.Path(task).read_text(errors="replace"), file=sys.stderr)

    def failed(self):
        result = self._outcome.result
        return bool(result.errors or result.failures)

    def write_scene(self, text):
        self.scene.write_text(text)

    def submit(self, *words, samples=4, excluded=DOOMED):
        result = run(ORIEL, "submit", self.scene, "-o", self.output, "-q", "--sbatch=--exclude=" + excluded, *words,
                     "--", *options(samples))
        return result.stdout.split()[1].rstrip(":")  # "job 7: ..."

    def reference(self, samples=4, output="reference.exr"):
        run(ORIEL, "render", self.scene, "-o", self.folder / output, *options(samples), "-q")

    def status(self):
        return json.loads(run(ORIEL, "status", self.job, "--json", check=False).stdout)

    def renders(self):
        """Processes that render for the job."""
        for folder in glob.glob("/proc/[0-9]*"):
            try:
                words = pathlib.Path(folder, "cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if words[:2] == [ORIEL.encode(), b"render"] and words[2].startswith(bytes(self.job)):
                yield int(os.path.basename(folder))

    def hold_renders(self, count=1, together=False):
        """Stops processes within their picture, so that what follows meets unfinished ones. Returns them.
        together: not before all render, as ranks wait for each other."""
        def is_rendering(process):
            try:
                fields = pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
            except OSError:
                return False
            seconds = int(fields[11]) / os.sysconf("SC_CLK_TCK")
            return seconds > 0.4 and mask(process, "SigCgt") & USR1

        held = []

        def hold():
            held[:] = [p for p in self.renders() if is_rendering(p)]
            if len(held) >= count or not together:
                for process in held:
                    os.kill(process, signal.SIGSTOP)
            return len(held) >= count

        self.wait(hold, "the render", pause=0.02)
        return held

    @staticmethod
    def release(processes):
        for process in processes:
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, signal.SIGCONT)

    def continue_when_signalled(self, processes):
        """Slurm looks at time limits twice a minute."""
        self.wait(lambda: all(mask(p, "ShdPnd") & USR1 for p in processes), "the signal before the time limit")
        self.release(processes)

    def record(self, frame=1, part=1):
        path = self.job / f"units/frame-{frame:04}.part-{part}.json"
        try:
            return json.loads(path.read_text())
        except (OSError, ValueError):
            return {"state": "waiting", "attempts": 0, "node": ""}

    def wait(self, condition, what, seconds=200, pause=0.2):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                queue = run("squeue", "-r", check=False).stdout
                self.fail(f"{what} did not happen\n{queue}\n{self.status()}")
            time.sleep(pause)
        print(f"{what}: {time.monotonic() - end + seconds:.1f} s", flush=True)

    def wait_for_picture(self):
        self.wait(self.output.exists, "the picture")

    def queued(self):
        """The jobs of this test: those with its folder."""
        lines = run("squeue", "-h", "-o", "%A|%Z", check=False).stdout.splitlines()
        return {line.split("|")[0] for line in lines if line.split("|", 1)[1] == str(self.job)}

    def wait_until_idle(self):
        self.wait(lambda: not self.queued(), "the end of all jobs")

    def expect_same_bytes(self, samples=4):
        if samples == LONG:  # one render for all cases
            reference = pathlib.Path(self.base, LONG_REFERENCE)
            self.wait(reference.exists, "the reference")
        else:
            self.reference(samples)
            reference = self.folder / "reference.exr"
        self.assertEqual(reference.read_bytes(), self.output.read_bytes())

    def test_parts_of_an_array_give_the_bytes_of_one_machine(self):
        self.write_scene(SCENE + RENDER)
        job = self.submit("--parts", 5)
        self.wait_for_picture()
        self.expect_same_bytes()
        status = self.status()
        self.assertEqual((5, 5, 1), (status["units"], status["done"], status["frames_done"]))
        nodes = {self.record(part=k)["node"] for k in range(1, 6)}
        self.assertGreater(len(nodes), 1, nodes)
        # By its number, as long as Slurm knows it.
        self.assertIn("5 of 5 parts done", run(ORIEL, "status", job).stdout)

    def test_ranks_of_srun_give_the_bytes_of_one_machine(self):
        if not (pathlib.Path(ORIEL).parent / "oriel_mpi.so").exists():
            self.skipTest("Open MPI was not installed when Oriel was built")
        self.write_scene(SCENE + RENDER)
        render = [ORIEL, "render", self.scene, "-o", self.output, "--samples", 4, "--threads", 1, "-q"]
        run("srun", "--mpi=pmix", "--exclude=" + DOOMED, "-N3", "-n3", *render, timeout=100)
        self.expect_same_bytes()

    def test_nodes_that_render_a_still_together_continue_after_a_requeue(self):
        if not (pathlib.Path(ORIEL).parent / "oriel_mpi.so").exists():
            self.skipTest("Open MPI was not installed when Oriel was built")
        self.write_scene(SCENE + RENDER)
        job = self.submit("--mpi", 2, "--time", "1", "--lead", 57, samples=LONG)
        self.continue_when_signalled(self.hold_renders(2, together=True))
        self.wait(lambda: self.record()["state"] == "stopped", "the checkpoint")
        self.assertTrue((self.job / "parts/frame-0001.checkpoint").exists())
        self.wait(lambda: "PENDING" in run("squeue", "-h", "-r", "-j", job, "-o", "%T").stdout, "the requeue")
        run("scontrol", "update", f"JobId={job}_0", "TimeLimit=60")
        # The picture so far was written, too.
        self.wait(lambda: self.record()["state"] == "done", "the picture")
        self.assertEqual(2, self.record()["attempts"])
        self.expect_same_bytes(LONG)

    def test_a_requeued_task_continues(self):
        self.write_scene(SCENE + RENDER)
        job = self.submit("--parts", 2, samples=LONG)
        held = self.hold_renders(2)
        run("scontrol", "requeue", f"{job}_0")
        self.release(held)
        self.wait_for_picture()
        self.assertEqual(2, self.record()["attempts"])
        self.expect_same_bytes(LONG)

    def test_a_task_near_its_time_limit_continues_later(self):
        self.write_scene(SCENE + RENDER)
        job = self.submit("--parts", 1, "--time", "1", "--lead", 57, samples=LONG)
        self.continue_when_signalled(self.hold_renders())
        self.wait(lambda: self.record()["state"] == "stopped", "the checkpoint")
        self.assertTrue((self.job / "parts/frame-0001.part-1-of-1").exists())
        self.assertEqual(1, self.status()["stopped"])
        self.wait(lambda: "PENDING" in run("squeue", "-h", "-r", "-j", job, "-o", "%T").stdout, "the requeue")
        # Enough time for the rest.
        run("scontrol", "update", f"JobId={job}_0", "TimeLimit=60")
        self.wait_for_picture()
        self.assertEqual(2, self.record()["attempts"])
        self.expect_same_bytes(LONG)

    def test_a_killed_node_loses_nothing(self):
        self.write_scene(SCENE + RENDER)
        others = ",".join(f"n{k}" for k in range(1, NODES + 1) if f"n{k}" not in DOOMED.split(","))
        self.submit("--parts", 2, samples=LONG, excluded=others)
        held = self.hold_renders(2)
        node = self.record()["node"]
        pid = int(pathlib.Path(f"{self.farm}/slurmd-{node}.pid").read_text())
        task = self.record()["task"]
        os.kill(pid, signal.SIGKILL)
        for process in self.processes_of(task):
            os.kill(process, signal.SIGKILL)
        self.release(held)
        try:
            self.wait_for_picture()
            self.assertNotEqual(node, self.record()["node"])
            self.expect_same_bytes(LONG)
        finally:
            environment = dict(os.environ, ORIEL_FARM=self.farm, PATH=os.environ["PATH"] + ":/usr/sbin")
            run("slurmd", "-f", os.environ["SLURM_CONF"], "-N", node, env=environment)

    @staticmethod
    def processes_of(task):
        """The step daemon of a task and its processes."""
        for folder in glob.glob("/proc/[0-9]*"):
            try:
                name = pathlib.Path(folder, "cmdline").read_bytes()
                environment = pathlib.Path(folder, "environ").read_bytes().split(b"\0")
            except OSError:
                continue
            if name.startswith(f"slurmstepd: [{task}.".encode()) or f"SLURM_JOB_ID={task}".encode() in environment:
                yield int(os.path.basename(folder))

    def test_frames_of_an_animation(self):
        self.write_scene(SCENE + RENDER + lamp(2) + RENDER + lamp(4) + RENDER)
        self.output = self.folder / "shot.##.exr"
        self.job = self.folder / "shot.job"
        self.submit("--frames", "1..3")
        self.wait(lambda: self.status()["frames_done"] == 3, "the last frame")
        self.reference(output="whole.##.exr")
        for frame in (1, 2, 3):
            self.assertEqual((self.folder / f"whole.0{frame}.exr").read_bytes(),
                             (self.folder / f"shot.0{frame}.exr").read_bytes(), frame)
        self.wait_until_idle()

    def test_a_failing_frame_is_named_and_only_it_is_repeated(self):
        self.write_scene(SCENE + RENDER + resolution(HUGE, HUGE) + RENDER + resolution(96, 64) + lamp(4) + RENDER)
        self.output = self.folder / "shot.#.exr"
        self.job = self.folder / "shot.job"
        self.submit("--retries", 1)
        self.wait_until_idle()
        self.assertEqual([1, 2, 1], [self.record(frame=k)["attempts"] for k in (1, 2, 3)])
        result = run(ORIEL, "status", self.job, check=False)
        self.assertEqual(1, result.returncode)
        self.assertIn("2 of 3 frames done, 1 failed", result.stdout)
        self.assertIn("frame 2 failed (attempt 2): ", result.stdout)
        self.assertIn("memory", result.stdout)
        # Once the scene is repaired.
        packed = self.job / "scene/house.mi"
        packed.write_text(packed.read_text().replace(f"{HUGE} {HUGE}", "48 32"))
        run("sbatch", f"--chdir={self.job}", "--array=1", self.job / "render.sh")
        self.wait(lambda: self.status()["done"] == 3, "the repetition")
        self.assertEqual([1, 3, 1], [self.record(frame=k)["attempts"] for k in (1, 2, 3)])


def run_cases(names):
    """All cases at the same time, on one cluster. Returns the exit code."""
    base = tempfile.mkdtemp(prefix="oriel-slurm-")
    farm = os.path.join(base, "farm")
    try:
        house = pathlib.Path(base, "house")
        house.mkdir()
        (house / "house.mi").write_text(SCENE + RENDER)
        reference = subprocess.Popen([ORIEL, "render", "house.mi", "-o", "reference.exr", *options(LONG), "-q"],
                                     cwd=house)
        run(FARM, "--folder", farm, "--nodes", NODES, "--while", os.getpid())
        environment = dict(os.environ, SLURM_CONF=farm + "/slurm.conf", ORIEL_SLURM_TEST=base)
        words = [sys.executable, os.path.abspath(__file__), ORIEL]
        # Those that wait for a time limit are to run when Slurm looks at limits for the first time.
        names = sorted(names, key=lambda name: not ("limit" in name or "together" in name))
        cases = [subprocess.Popen([*words, "Slurm." + name], env=environment, text=True, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT) for name in names]
        code = 0
        for case in cases:
            print(case.communicate()[0], flush=True)
            code = code or case.returncode
        return code or reference.wait()
    finally:
        run(FARM, "--stop", "--folder", farm, check=False)
        shutil.rmtree(base, ignore_errors=True)


def main():
    global ORIEL
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    ORIEL = os.path.abspath(sys.argv.pop(1))
    path = os.environ["PATH"] + ":/usr/sbin"
    if not all(shutil.which(p, path=path) for p in ("munged", "slurmctld", "slurmd", "sbatch")):
        print("Slurm is not installed: tools/install tools/packages-of-tests.txt")
        sys.exit(77)
    if "ORIEL_SLURM_TEST" in os.environ:
        Slurm.base = os.environ["ORIEL_SLURM_TEST"]
        Slurm.farm = os.path.join(Slurm.base, "farm")
        unittest.main(verbosity=2)
    sys.exit(run_cases(sys.argv[1:] or unittest.defaultTestLoader.getTestCaseNames(Slurm)))


if __name__ == "__main__":
    main()
