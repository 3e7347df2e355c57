# SPDX-License-Identifier: GPL-3.0-or-later
"""The command of the installed extension, as a process of the full Blender.

Run by tests/run_in_blender.py, which says which Blender and where its settings are.
"""

import json
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SPOT = ROOT / "models" / "spot.obj"


#: A command that runs ours with every format of parts.
EACH = """
import bpy, sys
from pathlib import Path

def each(arguments):
    name = next(name for name in sys.modules if name.endswith(".reeb_parts.batch.command"))
    return max(sys.modules[name].main(["--parts", str(Path({folder!r}) / kind), "--parts-format", kind])
               for kind in ("obj", "ply", "stl", "glb", "3mf"))

keep = bpy.utils.register_cli_command("each", each)
"""


def blender(*arguments):
    """Run Blender without a window; returns the finished process."""
    command = [os.environ["BLENDER"], "--background", *map(str, arguments)]
    return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)


def answer(process):
    """The JSON on standard output, after what Blender printed before it loaded the extension."""
    return json.loads(process.stdout[process.stdout.index("{") :])


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """One run on the bundled model with everything written: the process and its folder."""
    folder = tmp_path_factory.mktemp("run")
    files = ("--save", folder / "spot.blend", "--json", folder / "spot.json", "--picture", folder / "spot.png")
    done = blender("--command", "reeb_parts", SPOT, *files, "--parts", folder / "parts")
    assert done.returncode == 0, done.stderr
    return done, folder


def test_standard_output_is_one_json_object_equal_to_the_file(run):
    done, folder = run
    assert answer(done) == json.loads((folder / "spot.json").read_text())


def test_every_face_of_the_model_is_in_one_part(run):
    done, _ = run
    (report,) = answer(done)["objects"]
    n_faces = sum(line.startswith("f ") for line in SPOT.read_text().splitlines())
    assert sum(part["faces"] for part in report["parts"]) == n_faces
    assert sum(part["share"] for part in report["parts"]) == pytest.approx(1.0)


def test_one_file_for_each_part(run):
    done, folder = run
    (report,) = answer(done)["objects"]
    assert len(list((folder / "parts").glob("*.obj"))) == len(report["parts"]) > 1


def test_the_picture_is_a_png_of_the_default_size(run):
    _, folder = run
    png = (folder / "spot.png").read_bytes()
    assert png.startswith(b"\x89PNG\r\n\x1a\n")
    width, height = (int.from_bytes(png[at : at + 4], "big") for at in (16, 20))
    assert (width, height) == (960, 540)


def test_the_saved_scene_decomposes_again_to_the_same_parts(run):
    done, folder = run
    again = blender(folder / "spot.blend", "--command", "reeb_parts")
    assert again.returncode == 0, again.stderr
    first, second = (answer(process)["objects"][0]["parts"] for process in (done, again))
    assert first == second


def test_a_missing_file_is_named_and_fails(tmp_path):
    done = blender("--command", "reeb_parts", tmp_path / "nothing.obj", "--json", tmp_path / "out.json")
    assert done.returncode != 0
    assert "nothing.obj" in done.stderr
    assert "{" not in done.stdout
    assert list(tmp_path.iterdir()) == []


def test_help_lists_the_parameters():
    done = blender("--command", "reeb_parts", "--help")
    assert done.returncode == 0
    for option in ("--detail", "--n-parts", "--preset", "--picture", "--save"):
        assert option in done.stdout


def test_a_scene_that_blender_opened_is_exported_in_all_formats(run, tmp_path):
    """There is a window, but it is not at hand while the command runs."""
    _, folder = run
    script = tmp_path / "each.py"
    script.write_text(EACH.format(folder=str(tmp_path)))
    done = blender(folder / "spot.blend", "--python", script, "--command", "each")
    assert done.returncode == 0, done.stderr
    for kind in ("obj", "ply", "stl", "glb", "3mf"):
        assert (tmp_path / kind / "spot.3mf").is_file() if kind == "3mf" else len(list((tmp_path / kind).iterdir())) > 1


def test_a_scene_that_could_not_be_opened_is_not_taken_for_another(tmp_path):
    """Blender has its own cube open then."""
    (tmp_path / "broken.blend").write_bytes(b"no scene")
    for name, words in (("none.blend", "There is no file"), ("broken.blend", "broken.blend could not be read.")):
        done = blender(tmp_path / name, "--command", "reeb_parts", "--json", tmp_path / "out.json")
        assert done.returncode == 1
        assert words in done.stderr
        assert "{" not in done.stdout
        assert not (tmp_path / "out.json").exists()
