# SPDX-License-Identifier: GPL-3.0-or-later
"""The command ``reeb-parts decompose``, as it is installed."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import jsonschema
import numpy as np
import pytest
import trimesh
from reeb_parts.command import commands
from reeb_parts.output_files import OutputFileError

from core import decompose

ROOT = Path(__file__).resolve().parents[2]
SCHEMA = json.loads((ROOT / "docs" / "reeb_parts.schema.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def model(tree, tmp_path_factory):
    """A file with the small tree."""
    path = tmp_path_factory.mktemp("models") / "tree.ply"
    trimesh.Trimesh(*tree, process=False).export(path)
    return path


@pytest.fixture(scope="module")
def everything(model, reeb_parts_command, tmp_path_factory):
    """The folder with every kind of output, and what was printed."""
    out = tmp_path_factory.mktemp("out")
    done = reeb_parts_command(
        "decompose", model, "--n-parts", 3, "--json", out / "tree.json", "--labels", out / "tree.npy", "--colored",
        out / "tree.glb", "--parts", out / "parts", "--parts-format", "ply", "--picture", out / "tree.png")
    assert done.returncode == 0, done.stderr
    return out, done


@pytest.fixture(scope="module")
def expected(model):
    """What core finds."""
    mesh = trimesh.load_mesh(model, process=False)
    return mesh, decompose(mesh.vertices, mesh.faces).parts(n_parts=3)


def test_the_answer_is_the_json_of_the_schema(everything, expected):
    out, done = everything
    result = json.loads(done.stdout)
    jsonschema.validate(result, SCHEMA)
    assert (out / "tree.json").read_text() == done.stdout
    (found,) = result["objects"]
    mesh, parts = expected
    assert found["name"] == "tree"
    assert (found["faces"], len(found["parts"])) == (len(mesh.faces), 3)
    assert [part["area"] for part in found["parts"]] == pytest.approx(parts.area.tolist())
    for index, part in enumerate(found["parts"]):
        corners = mesh.vertices[mesh.faces[parts.labels == index]].reshape(-1, 3)
        assert np.array(part["bounding_box"]) == pytest.approx(np.array([corners.min(axis=0), corners.max(axis=0)]))


def test_files_are_named_in_the_answer_and_nothing_else_is_there(everything):
    out, done = everything
    files = json.loads(done.stdout)["files"]
    named = [files["json"], files["labels"], files["colored"], files["picture"], *files["parts"]]
    assert sorted(map(str, (path for path in out.rglob("*") if path.is_file()))) == sorted(named)


def test_of_a_failed_run_only_an_old_answer_is_removed(reeb_parts_command, tmp_path):
    """A model that was named after --json by mistake was removed."""
    for name, text, stays in (("own.obj", "v 0 0 0", True), ("own.json", "cut sho", False), ("own", '{"a": 1}', False)):
        (tmp_path / name).write_text(text)
        assert reeb_parts_command("decompose", tmp_path / "missing.obj", "--json", tmp_path / name).returncode == 1
        assert (tmp_path / name).exists() == stays


def test_labels_are_those_of_core(everything, expected):
    assert (np.load(everything[0] / "tree.npy") == expected[1].labels).all()


def test_parts_are_the_whole_surface(everything, expected):
    _, parts = expected
    pieces = [trimesh.load_mesh(path, process=False) for path in sorted((everything[0] / "parts").iterdir())]
    assert [piece.area for piece in pieces] == pytest.approx(parts.area.tolist(), rel=1e-5)


def test_a_glb_has_an_object_for_each_part(everything, expected):
    scene = trimesh.load_scene(everything[0] / "tree.glb")
    area = [scene.geometry[name].area for name in expected[1].names]
    assert area == pytest.approx(expected[1].area.tolist(), rel=1e-5)
    colors = {tuple(mesh.visual.material.baseColorFactor) for mesh in scene.geometry.values()}
    assert len(colors) == 3


@pytest.mark.parametrize("kind", ["ply", "obj"])
def test_colored_models_have_the_surface_and_three_colors(kind, model, reeb_parts_command, expected, tmp_path):
    done = reeb_parts_command("decompose", model, "--n-parts", 3, "--colored", tmp_path / f"tree.{kind}", "--labels",
                              tmp_path / "tree.txt")
    assert done.returncode == 0, done.stderr
    mesh = trimesh.load_mesh(tmp_path / f"tree.{kind}", process=False)
    labels = expected[1].labels
    assert np.loadtxt(tmp_path / "tree.txt").tolist() == labels.tolist()
    assert mesh.area == pytest.approx(expected[0].area, rel=1e-5)
    colors = mesh.visual.face_colors
    assert len(np.unique(np.column_stack([labels, colors]), axis=0)) == 3
    assert len(np.unique(colors, axis=0)) == 3


def test_the_picture_shows_three_colors_on_white(everything):
    data = (everything[0] / "tree.png").read_bytes()
    assert data.startswith(b"\x89PNG")
    assert int.from_bytes(data[16:20], "big") == 640


def test_it_reads_its_options_without_docstrings(monkeypatch):
    """As with python -OO, where it ended with a traceback."""
    monkeypatch.setattr(commands.decompose, "__doc__", None)
    assert commands.parse(["decompose", "x.obj"]).command == "decompose"


@pytest.mark.parametrize(("arguments", "words"), [
    (["none.obj"], "There is no file none.obj."),
    (["MODEL", "--n-parts", "-1"], "n_parts must be a whole number"),
    (["MODEL", "--json", "MODEL"], "is read, or is no file"),
    (["MODEL", "--labels", "OUT/x.npy", "--json", "OUT/x.npy"], "would be written twice"),
    (["MODEL", "--labels", "OUT/x.npy", "--json", "OUT/x/../x.npy"], "would be written twice"),
    (["MODEL", "--json", "/proc/none/x.json"], "could not be written"),
    (["MODEL", "--labels", "OUT/x.npy", "--parts", "MODEL"], "could not be written: Not a directory"),
    (["/dev/null"], "reeb-parts: /dev/null is no file but a pipe or a device: write the model to a file first."),
])
def test_what_is_wrong_is_one_sentence_and_nothing_is_written(arguments, words, model, reeb_parts_command, tmp_path):
    before = model.read_bytes()
    places = {"MODEL": str(model), "OUT": str(tmp_path)}
    named = [word.replace("OUT", places["OUT"]) for word in arguments]
    done = reeb_parts_command("decompose", *(places.get(word, word) for word in named))
    assert (done.returncode, done.stdout) == (2 if "--n-parts" in arguments else 1, "")
    assert words in done.stderr.splitlines()[-1]
    assert list(tmp_path.iterdir()) == []
    assert model.read_bytes() == before


@pytest.mark.skipif(sys.platform == "win32", reason="there a folder stays while somebody works in it")
@pytest.mark.parametrize("arguments", [
    ["decompose", "MODEL", "--json", "x.json"], ["batch", "models", "--out", "results"],
])
def test_a_working_folder_that_is_gone_is_one_sentence(arguments, model, reeb_parts_command, tmp_path):
    """It was a traceback."""
    (tmp_path / "gone").mkdir()
    gone = {"cwd": tmp_path / "gone", "preexec_fn": (tmp_path / "gone").rmdir}
    done = reeb_parts_command(*(model if word == "MODEL" else word for word in arguments), **gone)
    assert (done.returncode, done.stdout) == (1, "")
    assert "The folder in which the command was started is gone." in done.stderr.splitlines()[-1]
    assert "Traceback" not in done.stderr


def _without_a_normal(tree, path):
    """A file of words in which a number became bytes of zero."""
    text = trimesh.exchange.stl.export_stl_ascii(trimesh.Trimesh(*tree, process=False))
    path.write_text(text.replace("facet normal ", "facet normal \0\0", 1))


def _with_a_signaling_nan(tree, path):
    """A file in which a coordinate became what may not even be converted without an error."""
    data = bytearray(trimesh.Trimesh(*tree, process=False).export(file_type="glb"))
    place = np.float32(tree.vertices[0]).tobytes()
    at = data.index(place)
    data[at:at + 4] = b"\1\0\xa0\x7f"
    path.write_bytes(data)


@pytest.mark.parametrize(("name", "make", "status"), [
    ("tree.stl", _without_a_normal, 0), ("tree.glb", _with_a_signaling_nan, 1)])
def test_what_readers_log_and_warn_of_is_not_said(name, make, status, tree, reeb_parts_command, tmp_path):
    make(tree, tmp_path / name)
    done = reeb_parts_command("decompose", tmp_path / name)
    assert done.returncode == status, done.stderr
    assert [line for line in done.stderr.splitlines() if not line.startswith("reeb-parts: ")] == []


def test_an_earlier_answer_does_not_outlive_a_run_that_fails(model, reeb_parts_command, tmp_path):
    (tmp_path / "out.json").write_text("{}")
    done = reeb_parts_command("decompose", model, "--json", tmp_path / "out.json", "--labels", "/proc/none/x.npy")
    assert done.returncode == 1
    assert list(tmp_path.iterdir()) == []


def test_ctrl_c_ends_it_with_130_and_nothing_is_written(request, model, tmp_path):
    command = [sys.executable, request.config.command, "decompose", model, "--json", tmp_path / "x.json"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    process.stderr.readline()  # it has begun
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out, list(tmp_path.iterdir())) == (130, "", [])
    assert err.splitlines()[-1] == "reeb-parts: Interrupted."


#: The command, which gets a signal when it begins to import some module.
IMPORTING = """
import os, signal, sys
class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == sys.argv[1]:
            os.kill(os.getpid(), getattr(signal, sys.argv[2]))
sys.meta_path.insert(0, Finder())
from reeb_parts.command.main import main
sys.exit(main(["decompose", sys.argv[3]]))
"""


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
@pytest.mark.parametrize("module", ["numpy", "scipy.sparse", "trimesh", "networkx"])
def test_ctrl_c_is_heard_while_modules_are_imported(module, name, model):
    """It ended in a traceback, with the exit status of a crash."""
    done = subprocess.run([sys.executable, "-c", IMPORTING, module, name, model], capture_output=True, text=True,
                          check=False, timeout=60)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "reeb-parts: Interrupted.\n")


#: The command, for which a module finds no memory, as after ulimit -v (SGE's h_vmem).
LACKING = """
import sys
class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == sys.argv[1]:
            raise MemoryError if sys.argv[2] == "-" else ImportError(sys.argv[2])
sys.meta_path.insert(0, Finder())
from reeb_parts.command.main import main
sys.exit(main(["decompose", "none.obj"]))
"""


@pytest.mark.parametrize("error", ["-", "libgfortran.so.5.0.0: failed to map segment from shared object"])
@pytest.mark.parametrize("module", ["numpy", "scipy.linalg", "trimesh"])
def test_where_memory_ends_while_modules_are_imported_it_is_a_sentence(module, error):
    """It was a traceback."""
    done = subprocess.run([sys.executable, "-c", LACKING, module, error], capture_output=True, text=True, check=False,
                          timeout=60)
    assert (done.returncode, done.stdout, done.stderr) == (1, "", "reeb-parts: There is not enough memory.\n")


#: The command, which gets a signal while Python ends, as from somebody impatient while Dask closes its workers.
ENDING = """
import atexit, os, signal, sys, time
def late():
    os.kill(os.getpid(), getattr(signal, sys.argv[1]))
    time.sleep(60)
from reeb_parts.command import commands, main
def run(options, plain=commands.run):
    atexit.register(late)
    return plain(options)
commands.run = run
sys.exit(main.main(["decompose", "none.obj"]))
"""


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
def test_ctrl_c_once_more_ends_it_at_once(name):
    """It printed what Python and Dask were at, and its exit status was another one."""
    done = subprocess.run([sys.executable, "-c", ENDING, name], capture_output=True, text=True, check=False, timeout=50)
    assert (done.returncode, done.stdout) == (130, "")
    assert done.stderr.splitlines() == ["reeb-parts: There is no file none.obj.", "reeb-parts: Interrupted."]


#: The command, which gets a signal when all is done, and Python has only its modules to take down.
DONE = """
import os, signal, sys
class Last:
    def __del__(self, kill=os.kill, process=os.getpid(), signal=getattr(signal, sys.argv[1])):
        kill(process, signal)
last = Last()
from reeb_parts.command.main import main
sys.exit(main(["decompose", "none.obj"]))
"""


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
def test_a_signal_when_all_is_done_changes_nothing(name):
    """Its exit status was that of a process that was killed, whatever it had done."""
    done = subprocess.run([sys.executable, "-c", DONE, name], capture_output=True, text=True, check=False, timeout=50)
    assert (done.returncode, done.stderr) == (1, "reeb-parts: There is no file none.obj.\n")


#: The command, which gets a signal while it writes its files, and one of another kind while it takes them back.
CLEANING = """
import os, signal, sys
from pathlib import Path
from reeb_parts import output_files
from reeb_parts.command import main
def sync(handle):
    if len(list(Path(sys.argv[2]).rglob(output_files.HIDDEN + "*"))) == 3:
        signal.raise_signal(signal.SIGINT)
def unlink(path, missing_ok=False, plain=Path.unlink):
    try:
        raise OSError  # what is caught meanwhile is not what is going on
    except OSError:
        signal.raise_signal(signal.SIGTERM)
    plain(path, missing_ok)
output_files.os.fsync, Path.unlink = sync, unlink
model, folder = sys.argv[1:]
sys.exit(main.main(["decompose", model, "--parts", folder + "/parts", "--labels", folder + "/labels.npy"]))
"""


def test_ctrl_c_once_more_leaves_nothing_behind(model, tmp_path):
    """What it had written under hidden names stayed in the folders, as the second one ended the clean-up, too."""
    done = subprocess.run([sys.executable, "-c", CLEANING, model, tmp_path], capture_output=True, text=True,
                          check=False, timeout=60)
    assert (done.returncode, done.stdout, done.stderr.splitlines()[-1]) == (130, "", "reeb-parts: Interrupted.")
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == []


#: The command, which gets a signal in the middle of its work, and another one while it says so.
TWICE = """
import signal, sys
from reeb_parts.command import commands, main
class Open:
    def __del__(self):
        raise ValueError("write to closed file")
def run(options):
    opened = Open()
    signal.raise_signal(signal.SIGINT)
def say(text, plain=main.say):
    signal.raise_signal(signal.SIGTERM)
    plain(text)
if sys.argv[1] == "work":
    commands.run = run
else:
    main.say = say
    main._hear_signals(main._end)
    signal.raise_signal(signal.SIGINT)
sys.exit(main.main(["decompose", "none.obj"]))
"""


@pytest.mark.parametrize("where", ["work", "words"])
def test_nothing_of_what_was_broken_off_is_said(where):
    """It ended in what Python says of files that are closed when they are collected, or of a line within a line."""
    done = subprocess.run([sys.executable, "-c", TWICE, where], capture_output=True, text=True, check=False, timeout=50)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "reeb-parts: Interrupted.\n")


@pytest.mark.skipif(not hasattr(signal, "SIGHUP"), reason="other systems close terminals in another way")
@pytest.mark.parametrize("kept", [False, True], ids=["closed", "nohup"])
def test_a_terminal_that_is_closed_ends_it_unless_the_signal_is_ignored(request, model, tmp_path, kept):
    words = [sys.executable, request.config.command, "decompose", model, "--json", tmp_path / "x.json"]
    ignored = (lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)) if kept else None
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          preexec_fn=ignored) as process:
        process.stderr.readline()  # it has begun
        process.send_signal(signal.SIGHUP)
        _, err = process.communicate(timeout=60)
    assert process.returncode == (0 if kept else 130), err
    assert (tmp_path / "x.json").exists() == kept
    assert "Traceback" not in err


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have no device that is full")
@pytest.mark.parametrize("reader", ["full", "gone"])
def test_an_answer_that_cannot_be_written_is_one_sentence(request, model, tmp_path, reader):
    """Files that were asked for are there all the same."""
    words = [sys.executable, request.config.command, "decompose", model, "--json", tmp_path / "x.json"]
    if reader == "full":
        out = os.open("/dev/full", os.O_WRONLY)
    else:
        own, out = os.pipe()
        os.close(own)
    done = subprocess.run(words, stdout=out, stderr=subprocess.PIPE, text=True, check=False)
    os.close(out)
    reason = "No space left on device" if reader == "full" else "Broken pipe"
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1] == f"reeb-parts: Standard output could not be written: {reason}"
    assert "Traceback" not in done.stderr
    assert json.loads((tmp_path / "x.json").read_text())["objects"]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no such device")
@pytest.mark.parametrize("end", ["2>/dev/full", "2>&-", "2>&- <&-"])
def test_standard_error_may_be_full_or_closed(end):
    """Bars of progress could not be written, and that was the end of a batch."""
    code = ("import sys, os; from reeb_parts.command import main; main._open_standard_streams(); "
            "print('x' * 9999, file=sys.stderr, flush=True); assert os.open(os.devnull, os.O_RDONLY) > 2")
    done = subprocess.run(["sh", "-c", f'exec "$0" -c "{code}" {end}', sys.executable], check=False)
    assert done.returncode == 0


def test_standard_output_is_no_file(model, reeb_parts_command, tmp_path):
    done = reeb_parts_command("decompose", model, "--json", "-", cwd=tmp_path)
    assert (done.returncode, list(tmp_path.iterdir())) == (2, [])
    assert done.stderr.endswith("--json: - is no file; standard output has the JSON in any case\n")


@pytest.mark.parametrize("option", ["--json", "--labels", "--colored", "--parts", "--picture"])
def test_a_name_without_letters_is_refused(option, capsys):
    """As of a variable that a script has not set: parts were written to the working folder."""
    with pytest.raises(SystemExit):
        commands.parse(["decompose", "model.off", option, ""])
    kind = "folder" if option == "--parts" else "file"
    assert capsys.readouterr().err.endswith(f"argument {option}: the name of the {kind} is empty\n")


@pytest.mark.parametrize("outputs", [
    {"json": "."}, {"json": "model.off"}, {"labels": "x.npy", "json": "x.npy"}, {"parts": "model.off"},
])
def test_files_that_cannot_be_written_are_known_before_anything_is_computed(outputs, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("model.off").write_text("no model")  # which would be said of what is read
    options = [word for name, place in outputs.items() for word in (f"--{name}", place)]
    with pytest.raises(OutputFileError):
        commands.decompose.run(commands.parse(["decompose", "model.off", *options]))


@pytest.mark.parametrize("size", ["15", "4097", "-1", "nan", "640x480"])
def test_a_picture_has_a_size_in_its_range(size, model, reeb_parts_command, tmp_path):
    done = reeb_parts_command("decompose", model, "--picture", tmp_path / "x.png", f"--picture-size={size}")
    assert (done.returncode, done.stdout, list(tmp_path.iterdir())) == (2, "", [])
    assert done.stderr.endswith(f"--picture-size: must be a whole number from 16 to 4096, not {size}\n")
