# SPDX-License-Identifier: GPL-3.0-or-later
"""Decomposing in a process of its own: what it gives, and what is left when it does not end well.

The process is the real one that the button starts; signals and limits come from the system.
"""

import importlib
import os
import signal
import stat
import subprocess
import sys
import time
from pathlib import Path

import bpy
import numpy as np
import pytest
import shapes
from diagonal import some
from systems import unix

TESTS = Path(__file__).resolve().parents[3]
WAIT = 60.0  # seconds for a computation of some thousand vertices on a busy machine


@pytest.fixture
def jobs(package):
    """The module; nothing is remembered from other tests, and nothing may be left."""
    importlib.import_module(f"{package}.scene.runs.compute").forget()
    yield importlib.import_module(f"{package}.scene.runs.jobs")
    assert folders() == []


@pytest.fixture
def compute(package):
    return importlib.import_module(f"{package}.scene.runs.compute")


@pytest.fixture
def read(package, make):
    """A function that makes objects of shapes, and gives what is decomposed of them."""
    read_shape = importlib.import_module(f"{package}.scene.bridge").read_shape

    def read_shapes(*several):
        return [(obj.name, read_shape(obj)) for obj in (make(shape, f"Object {i}") for i, shape in enumerate(several))]

    return read_shapes


def folders() -> list[str]:
    """What is left of jobs in Blender's temporary folder."""
    return [name for name in os.listdir(bpy.app.tempdir) if name.startswith("reeb_parts_")]


def alive(pid) -> bool:
    """Whether a process is running; one that has ended and was not asked for does not count."""
    if os.name == "nt":
        import _winapi

        try:
            return _winapi.GetExitCodeProcess(_winapi.OpenProcess(0x1000, False, int(pid))) == 259  # still active
        except OSError:
            return False
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except OSError:
        return False
    return state != "Z"


def until(condition, seconds=WAIT) -> float:
    """Wait until something holds; returns the seconds it took."""
    start = time.monotonic()
    while not condition():
        assert time.monotonic() < start + seconds
        time.sleep(0.005)
    return time.monotonic() - start


def followed(job) -> list:
    """Start a job and follow it to its end; returns what it said on the way."""
    job.start()
    seen = []

    def ended():
        job.poll()
        if (job.of, job.stage, job.share) not in seen[-1:]:
            seen.append((job.of, job.stage, job.share))
        return not job.running

    until(ended)
    return seen


def started(jobs, shapes, parameters):
    """A job that has begun to compute."""
    job = jobs.Job(shapes, parameters)
    job.start()
    until(lambda: job.poll() or job.stage)
    assert job.running
    return job


def arrays_of(value, name="") -> dict:
    """All arrays and numbers in a result, by their path, with their types; the seconds left out."""
    if hasattr(value, "__dataclass_fields__"):
        found = {}
        for field in value.__dataclass_fields__:
            if field != "seconds":
                found |= arrays_of(getattr(value, field), f"{name}.{field}")
        return found
    if isinstance(value, np.ndarray):
        return {name: (value.dtype.str, value.shape, value.tobytes())}
    if isinstance(value, tuple):
        return {name: [(str(v), getattr(v, "message", None), getattr(v, "values", None)) for v in value]}
    return {name: (type(value).__name__, value)}


def broken() -> list:
    """Shapes that get notes, and some that cannot be decomposed."""
    triangle = shapes.Shape(np.eye(3), np.array([[0, 1, 2]]))
    tree = shapes.tube_tree()
    flat = shapes.Shape(tree.vertices * (0, 0, 0), tree.faces)
    return [shapes.two_spheres(), shapes.with_fin(tree), triangle, shapes.torus(), flat,
            shapes.with_unused_vertices(tree)]


@pytest.mark.parametrize("preset", some("Perceptual", "Berretti 2009"))
def test_the_results_are_those_of_blenders_own_process_bit_by_bit(jobs, compute, read, parameters, preset):
    chosen = parameters.preset(preset, n_parts=3)
    given = read(shapes.tube_tree(), *broken())
    expected = compute.compute_all(given, chosen, lambda *_: None)
    compute.forget()
    job = jobs.Job(given, chosen)
    followed(job)
    assert job.error is None
    assert [outcome.object_name for outcome in job.result] == [name for name, _ in given]
    for outcome, other in zip(job.result, expected, strict=True):
        assert arrays_of(outcome.decomposition) == arrays_of(other.decomposition)
        assert (str(outcome.problem), vars(outcome.problem) if outcome.problem else {}) == (
            str(other.problem), vars(other.problem) if other.problem else {})
        assert outcome.shape is other.shape
        if other.decomposition:
            assert outcome.decomposition.seconds.keys() == other.decomposition.seconds.keys()
            assert outcome.seconds == sum(outcome.decomposition.seconds.values()) > 0
    assert sum(outcome.decomposition is None for outcome in job.result) == 2
    assert any(outcome.decomposition.notes for outcome in job.result if outcome.decomposition)


def test_what_was_computed_is_not_computed_again(jobs, compute, read, parameters):
    given = read(shapes.tube_tree(), shapes.torus())
    followed(jobs.Job(given[:1], parameters()))
    first = compute.known(given[0][1], parameters())
    again = jobs.Job(given[:1], parameters(detail=0.9))
    again.start()
    assert again.pid is None
    assert again.result[0].decomposition.candidates is first.candidates
    assert again.result[0].decomposition.parameters.detail == 0.9
    assert again.result[0].seconds == 0.0  # not those of before
    assert compute.compute_all(given[:1], parameters(), lambda *_: None)[0].seconds == 0.0
    both = jobs.Job(given, parameters())
    seen = followed(both)
    assert {of for of, stage, _ in seen if stage} == {"Object 1"}
    assert both.result[0].decomposition.candidates is first.candidates
    assert both.result[1].decomposition.n_faces == len(given[1][1].triangles)
    assert both.result[0].seconds == 0.0 < both.result[1].seconds


@pytest.fixture
def processors(jobs, monkeypatch):
    """A function that says how many processors there are."""
    return lambda count: monkeypatch.setattr(jobs, "n_processors", lambda: count)


def test_progress(jobs, read, parameters, processors):
    processors(1)
    job = jobs.Job(read(shapes.tube_tree(), shapes.torus()), parameters())
    seen = [step for step in followed(job) if step[1]]
    shares = [share for _, _, share in seen]
    assert shares == sorted(shares)
    assert 0.0 <= shares[0] < 0.5 < shares[-1] == 1.0
    for name in ("Object 0", "Object 1"):
        stages = list(dict.fromkeys(stage for of, stage, _ in seen if of == name))
        assert stages == [s for s in ("mesh", "distances", "reeb graph", "cuts", "parts", "done") if s in stages]
        assert len(stages) > 2


def test_several_are_computed_side_by_side(jobs, compute, read, parameters, processors):
    """The shares of all make up how far it is; what the first process does is shown, then what the others do."""
    processors(3)
    given = read(shapes.tube_tree(), *broken(), shapes.tube_tree())
    job = jobs.Job(given, parameters())
    seen = followed(job)
    assert [share for _, _, share in seen] == sorted(share for _, _, share in seen)
    found = {outcome.object_name: outcome for outcome in job.result}
    assert list(found) == [name for name, _ in given]
    assert found["Object 7"].decomposition.candidates is found["Object 0"].decomposition.candidates
    compute.forget()
    processors(1)
    alone = jobs.Job(given, parameters())
    followed(alone)
    for one, other in zip(job.result, alone.result, strict=True):
        assert (arrays_of(one.decomposition), str(one.problem)) == (arrays_of(other.decomposition), str(other.problem))


@pytest.mark.parametrize("end", ["cancel", "crash", "no process"])
def test_none_of_several_processes_outlives_a_job(package, jobs, read, parameters, processors, monkeypatch, end):
    processors(2)
    given = read(shapes.subdivide(shapes.tube_tree()), shapes.subdivide(shapes.subdivide(shapes.torus())))
    if end == "no process":
        one, tried = importlib.import_module(f"{package}.scene.runs.processes").Worker, []

        def second_fails(*args):
            tried.append(one(*args) if not tried else None)
            if tried[-1] is None:
                raise OSError("no more processes")
            return tried[-1]

        monkeypatch.setattr(jobs, "Worker", second_fails)
        job = jobs.Job(given, parameters())
        job.start()
        assert job.in_blender
        pids = [tried[0].pid]
    else:
        job = started(jobs, given, parameters(base_spacing=0.0005))
        until(lambda: job.poll() or all(task.ready for task in job._tasks))
        pids = [task.worker.pid for task in job._tasks]
        assert len(pids) == 2
        if end == "cancel":
            job.cancel()
        else:
            os.kill(pids[1], signal.SIGSEGV)
            until(lambda: job.poll() or not job.running)
            assert "The process that decomposed Object 1 ended unexpectedly" in str(job.error)
    assert not any(map(alive, pids))
    assert folders() == []


@unix
@pytest.mark.parametrize("goes_wrong", ["nothing", "a process", "the caller"])
def test_who_waits_gets_all_or_what_was_raised(
        package, jobs, compute, read, parameters, processors, monkeypatch, goes_wrong):
    """A process that is killed costs time: all is computed here then."""
    processors(2)
    given = read(shapes.tube_tree(), shapes.two_spheres())
    expected = compute.compute_all(given, parameters(), lambda *_: None)
    compute.forget()

    class Killed(importlib.import_module(f"{package}.scene.runs.processes").Worker):
        def __init__(self, *given):
            super().__init__(*given)
            os.kill(self.pid, signal.SIGKILL)

    said = []

    def progress(stage, share):
        said.append(share)
        if goes_wrong == "the caller" and stage == "cuts":
            raise KeyboardInterrupt

    if goes_wrong == "a process":
        monkeypatch.setattr(jobs, "Worker", Killed)
    if goes_wrong == "the caller":
        with pytest.raises(KeyboardInterrupt):
            jobs.computed(given, parameters(), progress)
        return
    found = jobs.computed(given, parameters(), progress)
    assert [arrays_of(o.decomposition) for o in found] == [arrays_of(o.decomposition) for o in expected]
    assert max(said) == 1.0


@unix
@pytest.mark.parametrize("waits", [True, False])
def test_what_other_processes_had_computed_is_not_computed_again(
        package, jobs, compute, read, parameters, processors, monkeypatch, waits):
    """After one of them has failed, here or in the window, for lack of a Python that loads NumPy."""
    processors(2)
    tree = shapes.tube_tree()
    given = read(*(shapes.Shape(tree.vertices * scale, tree.faces) for scale in range(1, 9)))
    workers, here = [], []

    class SecondStops(importlib.import_module(f"{package}.scene.runs.processes").Worker):
        def __init__(self, own, *more):
            super().__init__(own, *more)
            workers.append(self)
            self.own = own
            if len(workers) == 2:
                os.kill(self.pid, signal.SIGSTOP)

    def progress(*_):
        if len(workers) == 2 and workers[0].ended and workers[1].ended is False:
            workers[1]._process.kill() if waits else workers[1]._process.terminate()
            os.kill(workers[1].pid, signal.SIGCONT)

    def decomposition(shape, *more, one=compute.decomposition):
        here.append(shape)
        return one(shape, *more)

    monkeypatch.setattr(jobs, "Worker", SecondStops)
    monkeypatch.setattr(compute, "_KEEP", 3)  # as it is
    monkeypatch.setattr(compute, "decomposition", decomposition)
    if waits:
        found = jobs.computed(given, parameters(), progress)
    else:
        job = jobs.Job(given, parameters())
        job.start()
        until(lambda: progress() or job.poll() or not job.running)
        found = job.result
    assert len(workers[0].own) == len(workers[1].own) == 4
    assert here == workers[1].own
    compute.forget()
    expected = compute.compute_all(given, parameters(), lambda *_: None)
    assert [arrays_of(o.decomposition) for o in found] == [arrays_of(o.decomposition) for o in expected]
    assert all(outcome.seconds > 0.0 for outcome in found)


@unix
def test_the_folder_is_private_and_holds_what_is_computed_only(jobs, read, parameters):
    job = started(jobs, read(shapes.subdivide(shapes.tube_tree())), parameters())
    (folder,) = folders()
    assert stat.S_IMODE(os.stat(Path(bpy.app.tempdir, folder)).st_mode) == 0o700
    job.cancel()


def test_cancel_ends_it_at_once(jobs, read, parameters):
    large = shapes.subdivide(shapes.subdivide(shapes.subdivide(shapes.tube_tree())))
    job = started(jobs, read(large), parameters())
    pid = job.pid
    assert alive(pid)
    start = time.monotonic()
    job.cancel()
    assert time.monotonic() < start + 0.5
    assert not alive(pid)
    assert not job.running
    assert job.cancelled
    assert (job.result, job.error, job.pid) == (None, None, None)
    job.poll()
    assert job.result is None


def test_it_is_ended_when_the_extension_is_switched_off(jobs, read, parameters, package):
    jobs.current = started(jobs, read(shapes.subdivide(shapes.tube_tree())), parameters())
    pid = jobs.current.pid
    jobs.cancel()  # what unregister calls
    assert not alive(pid)
    jobs.current = None


@unix
@pytest.mark.parametrize(("name", "words"), [
    ("SIGSEGV", "The process that decomposed Object 0 ended unexpectedly (signal 11); nothing was changed."),
    ("SIGTERM", "The process that decomposed Object 0 ended unexpectedly (signal 15); nothing was changed."),
    ("SIGKILL", "There is not enough memory to decompose Object 0 (5812 vertices); nothing was changed."),
])
def test_a_crash_costs_one_sentence(jobs, read, parameters, name, words):
    tree = shapes.subdivide(shapes.tube_tree())
    words = words.replace("5812", str(len(tree.vertices)))
    job = started(jobs, read(tree), parameters(base_spacing=0.0005))
    os.kill(job.pid, signal.Signals[name])
    until(lambda: job.poll() or not job.running)
    assert str(job.error).startswith(words)
    assert job.result is None


@unix
def test_out_of_memory_costs_one_sentence(jobs, read, parameters, capfd):
    import resource

    large = shapes.subdivide(shapes.subdivide(shapes.subdivide(shapes.tube_tree())))
    job = jobs.Job(read(large), parameters())
    job.start()
    until(lambda: job.poll() or job._tasks[0].ready)
    size = int(Path(f"/proc/{job.pid}/statm").read_text().split()[0]) * resource.getpagesize()
    resource.prlimit(job.pid, resource.RLIMIT_AS, (size + 20_000_000, size + 20_000_000))
    until(lambda: job.poll() or not job.running)
    assert str(job.error) == (
        f"There is not enough memory to decompose Object 0 ({len(large.vertices)} vertices); nothing was changed. "
        "Close other programs, or decimate a copy and decompose that.")
    assert "MemoryError" in capfd.readouterr().err


@pytest.mark.parametrize("words", some("RuntimeError: can't start new thread", "[Errno 12] Cannot allocate memory"))
def test_whatever_words_say_so_a_lack_of_memory_is_one(package, jobs, read, parameters, words):
    processes = importlib.import_module(f"{package}.scene.runs.processes")
    worker = processes.Worker([read(shapes.tube_tree())[0][1]], parameters())
    try:
        os.kill(worker.pid, signal.SIGTERM)
        until(lambda: not alive(worker.pid))
        assert not worker.lacked_memory()
        (worker.folder / "errors").write_text(words)
        assert worker.lacked_memory()
    finally:
        worker.close()


@unix
def test_a_result_that_cannot_be_written_costs_one_sentence(jobs, read, parameters, capfd, monkeypatch):
    import resource

    monkeypatch.setattr(sys, "dont_write_bytecode", True)  # of modules that it imports by then half would be written
    job = started(jobs, read(shapes.subdivide(shapes.tube_tree())), parameters())
    resource.prlimit(job.pid, resource.RLIMIT_FSIZE, (30_000, 30_000))
    until(lambda: job.poll() or not job.running)
    assert "ended unexpectedly (OSError: [Errno 27] File too large)" in str(job.error)
    assert job.result is None


@pytest.fixture
def other_python(monkeypatch, tmp_path):
    """A function that has Blender believe that its Python is another program."""

    def replace(name, text):
        path = tmp_path / name
        if text is not None:
            path.write_text(text)
            path.chmod(0o755)
        monkeypatch.setattr(sys, "executable", str(path) if name else "")

    return replace


@pytest.mark.parametrize(("name", "text"), some(
    ("", None),                                      # in a program that embeds Python
    ("host", "#!/bin/sh\ntouch $(dirname $0)/started"),  # which must not be started again
    ("python3", None),
    ("python3", "#!/bin/sh\nexit 3"),
))
def test_where_no_python_can_be_started_blender_computes(
        jobs, compute, read, parameters, other_python, name, text, tmp_path):
    given = read(shapes.tube_tree(), shapes.two_spheres())
    expected = compute.compute_all(given, parameters(), lambda *_: None)
    compute.forget()
    other_python(name, text)
    job = jobs.Job(given, parameters())
    job.start()
    until(lambda: job.in_blender or job.poll())
    shown = []
    job.poll(lambda: shown.append((job.of, job.stage, job.share)))
    assert not job.running
    assert [arrays_of(o.decomposition) for o in job.result] == [arrays_of(o.decomposition) for o in expected]
    assert ("Object 0", "distances") in {step[:2] for step in shown}
    assert [step[2] for step in shown] == sorted(step[2] for step in shown)
    assert not (tmp_path / "started").exists()


@pytest.mark.parametrize(("name", "known"), [
    ("python3.11", True), ("python3.13", True), ("python.exe", True), ("python", True), ("Python", True),
    ("blender", False), ("blender.exe", False), ("Blender", False), ("maya.bin", False),
])
def test_what_counts_as_an_interpreter(package, other_python, name, known):
    """By the names that it has in builds of Blender, and those of programs around it."""
    processes = importlib.import_module(f"{package}.scene.runs.processes")
    other_python(name, "#!/bin/sh")
    assert processes.interpreter() == (sys.executable if known else None)


def test_an_error_of_our_own_is_raised_when_all_is_closed(jobs, read, parameters):
    job = started(jobs, read(shapes.subdivide(shapes.tube_tree())), parameters())
    pid = job.pid
    job._tasks[0].numbers.clear()  # so that it does not know what the process speaks of
    until(lambda: job.poll() or not job.running)
    assert isinstance(job.error, IndexError)
    assert not alive(pid)


def test_errors_while_blender_computes(jobs, read, parameters, other_python):
    other_python("", None)
    triangle = shapes.Shape(np.eye(3), np.array([[0, 1, 2]]))
    job = jobs.Job(read(triangle, shapes.torus()), parameters())
    job.start()
    job.poll()
    assert "faces" in str(job.result[0].problem)
    assert job.result[1].decomposition is not None


def test_nothing_around_changes_what_the_process_imports(jobs, compute, read, parameters, monkeypatch, tmp_path):
    """Neither the working folder nor the user's variables and packages."""
    for name in ("core", "numpy", "scipy", "json", "sitecustomize", "usercustomize"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit(7)")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    monkeypatch.setenv("PYTHONUSERBASE", str(tmp_path))
    monkeypatch.setenv("PYTHONHOME", str(tmp_path))
    monkeypatch.setenv("PYTHONWARNINGS", "error")
    given = read(shapes.tube_tree())
    job = jobs.Job(given, parameters())
    followed(job)
    assert not job.in_blender
    found = arrays_of(job.result[0].decomposition)
    compute.forget()
    assert found == arrays_of(compute.decomposition(given[0][1], parameters()))


ALONE = """
import importlib, os, pathlib, sys, tempfile, time
sys.dont_write_bytecode = True
sys.path.insert(0, {tests!r})
import bpy, checkout, shapes
package = checkout.enable(pathlib.Path(tempfile.mkdtemp(dir={scratch!r})))
jobs, bridge, p = (importlib.import_module(package + name) for name in (".scene.runs.jobs", ".scene.bridge",
                                                                        ".core.parameters"))
shape = shapes.subdivide(shapes.subdivide(shapes.tube_tree()))
mesh = bpy.data.meshes.new("Tree")
mesh.from_pydata(shape.vertices.tolist(), [], shape.faces.tolist())
obj = bpy.data.objects.new("Tree", mesh)
jobs.current = jobs.Job([("Tree", bridge.read_shape(obj))], p.Parameters(base_spacing=0.0005))
jobs.current.start()
while jobs.current.stage != "distances":
    jobs.current.poll()
    time.sleep(0.01)
pathlib.Path({scratch!r}, "pid").write_text(f"{{jobs.current.pid}} {{jobs.current._tasks[0].worker.folder}}")
while {wait}:
    time.sleep(1)
checkout.leave(0)
"""


@pytest.mark.parametrize("end", ["quits", "is killed"])
def test_nothing_is_left_when_blender(end, tmp_path):
    code = ALONE.format(tests=str(TESTS), scratch=str(tmp_path), wait=end == "is killed")
    command = [bpy.app.binary_path, "-b", "--python-expr"] if bpy.app.binary_path else [sys.executable, "-c"]
    blender = subprocess.Popen([*command, code], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    try:
        until((tmp_path / "pid").exists)
        until(lambda: len((tmp_path / "pid").read_text().split()) == 2)
        pid, folder = (tmp_path / "pid").read_text().split()
        if end == "is killed":
            assert alive(pid)
            assert Path(folder).is_dir()
            blender.kill()
        blender.wait(WAIT)
    finally:
        blender.kill()
        blender.wait()
    until(lambda: not alive(pid), 5.0)
    assert not Path(folder).exists()


def test_the_operator_computes_in_blender_for_scripts(obj):
    before = folders()
    bpy.ops.reeb_parts.decompose()
    assert folders() == before == []
    assert len(obj.data.reeb_parts.parts) > 1


@pytest.fixture
def computed(package, obj):
    """The outcome of a run, and a function that says why it is not written, or nothing."""
    results, errors = (importlib.import_module(f"{package}.scene.{name}") for name in ("runs.results", "errors"))
    bridge, compute = (importlib.import_module(f"{package}.scene.{name}") for name in ("bridge", "runs.compute"))
    outcomes = [compute.Outcome(obj.name, bridge.read_shape(obj))]

    def why_not():
        try:
            results.check_unchanged(bpy.context, outcomes)
        except errors.SceneError as error:
            return str(error)
        return ""

    assert not why_not()
    return why_not


def test_parts_of_what_was_edited_or_deleted_meanwhile_are_not_written(computed, obj):
    obj.data.vertices[0].co.x += 0.1
    assert "was changed while its parts were computed" in computed()
    obj.data.vertices[0].co.x -= 0.1
    bpy.data.objects.remove(obj)
    assert "is gone" in computed()


def test_another_frame_is_no_edit(computed, obj):
    """While animated shape keys, or an animated scale, were played, all was computed in vain."""
    obj.scale.x = 2.0
    assert not computed()
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Up")
    key.data[0].co.z += 0.5
    key.value = 1.0
    assert not computed()
    obj.data.vertices[1].co.z += 0.5
    assert "was changed while its parts were computed" in computed()


def test_an_object_that_is_renamed_meanwhile_gets_its_parts(computed, obj):
    obj.name = "Renamed"
    assert not computed()


def test_parts_are_not_written_where_the_object_is_not_in_the_scene_any_more(computed, obj):
    """A graph came without a model where it was deleted while it was computed again, and in a scene gone to meanwhile.

    What refers to an object, as its graph does, keeps it in the file when it is deleted.
    """
    obj.use_fake_user = True
    there = obj.users_collection[0]
    bpy.data.scenes.new("Other").collection.objects.link(obj)
    there.objects.unlink(obj)
    assert "is not in this scene" in computed()
    bpy.data.scenes["Other"].collection.objects.unlink(obj)
    assert "is gone" in computed()
