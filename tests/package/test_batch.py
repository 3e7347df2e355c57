# SPDX-License-Identifier: GPL-3.0-or-later
"""``reeb-parts batch``: what it writes, what one bad model costs, and what is lost when something is killed."""

import argparse
import base64
import errno
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext, suppress
from pathlib import Path
from types import SimpleNamespace

import dask
import jsonschema
import numpy as np
import psutil
import pyarrow as pa
import pytest
import shapes
import trimesh
from distributed import Client, LocalCluster
from pyarrow import parquet
from reeb_parts.batch import cluster, similar
from reeb_parts.batch.model_process import ModelProcess
from reeb_parts.batch.records import RECORD, Settings, is_done, read_record, record_of
from reeb_parts.batch.similar import PartError, similar_parts
from reeb_parts.batch.sources import SourceError, find_sources
from reeb_parts.batch.tables import MODELS, PARTS
from reeb_parts.batch.work import do_model
from reeb_parts.command import batch as command
from reeb_parts.output_files import remove_leftovers

from core import Parameters, decompose
from core.uses.descriptors import distances, part_descriptors

ROOT = Path(__file__).resolve().parents[2]
SCHEMA = json.loads((ROOT / "docs" / "reeb_parts.schema.json").read_text(encoding="utf-8"))
LOCAL = ("--workers", 2, "--dashboard", "127.0.0.1:0")
ONE = ("--workers", 1, *LOCAL[2:])  # where what many do is not asked for: each takes seconds to start


def save(shape, path):
    """A model file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    trimesh.Trimesh(*shape, process=False).export(path)
    return path


def many(folder, count):
    """So many models, each a little different."""
    shape = shapes.dumbbell(20, 8)
    return [save((shape.vertices * (1 + 0.01 * n), shape.faces), folder / f"tree_{n:03d}.ply") for n in range(count)]


def rows(path):
    """A table as a list of dicts."""
    return parquet.read_table(path).to_pylist()


@pytest.mark.parametrize(("table", "schema"), [("models", MODELS), ("parts", PARTS)])
def test_the_page_names_all_columns_of_the_tables(table, schema):
    page = (ROOT / "docs" / "package.md").read_text(encoding="utf-8")
    (cell,) = re.findall(rf"^\| `{table}\.parquet` \| (.*) \|$", page, re.M)
    assert re.findall("`([a-z_]+)`", cell) == schema.names


@pytest.fixture(scope="module")
def models(tmp_path_factory):
    """A folder with two models, one too small, one damaged, and what is no model."""
    folder = tmp_path_factory.mktemp("archive")
    save(shapes.tube_tree(step=0.2), folder / "tree.ply")
    save(shapes.dumbbell(20, 8), folder / "deep" / "dumb bell.obj")
    save((np.eye(3), np.array([[0, 1, 2]])), folder / "tiny.stl")
    (folder / "damaged.ply").write_text("ply\nnonsense")
    (folder / "notes.txt").write_text("no model")
    return folder


@pytest.fixture(scope="module")
def batch(models, reeb_parts_command, tmp_path_factory):
    """The folder of results of a whole run, and what it answered.

    Files in the working folder that are called like modules of Python's ended the processes that the run started.
    """
    work = tmp_path_factory.mktemp("work")
    for name in ("socket", "types", "queue", "trimesh", "reeb_parts"):
        (work / f"{name}.py").write_text("raise SystemExit('not this one')")
    out = tmp_path_factory.mktemp("batch") / "out"
    done = reeb_parts_command("batch", models, "--out", out, "--colored", "ply", "--parts", "glb", *LOCAL, cwd=work)
    assert done.returncode == 1, done.stderr  # two of the models are none
    return out, json.loads(done.stdout), done.stderr


def test_each_model_has_its_folder_and_nothing_else_is_there(batch, models):
    out, answer, _ = batch
    assert answer["models"] == {"done": 2, "refused": 1, "unreadable": 1}
    folders = {path.parent.relative_to(out / "models").as_posix() for path in out.rglob(RECORD)}
    assert folders == {"tree.ply", "deep/dumb bell.obj", "tiny.stl", "damaged.ply"}
    assert {path.name for path in out.iterdir()} == {"models", "models.parquet", "parts.parquet", "index.html"}
    parts = sorted(path.name for path in (out / "models/tree.ply/parts").iterdir())
    count = len(parts)
    assert parts == [f"tree Part {n + 1:02d}.glb" for n in range(count)]
    files = {path.name for path in (out / "models" / "tree.ply").iterdir()}
    assert files == {"model.json", "labels.npy", "colored.ply", "parts", "thumbnail.png", RECORD}
    assert {path.name for path in (out / "models" / "tiny.stl").iterdir()} == {RECORD}


def test_the_results_are_those_of_core(batch, models):
    out, _, _ = batch
    mesh = trimesh.load_mesh(models / "tree.ply", process=False)
    expected = decompose(mesh.vertices, mesh.faces).parts()
    assert (np.load(out / "models/tree.ply/labels.npy") == expected.labels).all()
    document = json.loads((out / "models/tree.ply/model.json").read_text())
    jsonschema.validate(document, SCHEMA)
    (entry,) = document["objects"]
    found = [row for row in rows(out / "parts.parquet") if row.pop("model") == "tree.ply"]
    assert [{key: row[key] for key in entry["parts"][0]} for row in found] == entry["parts"]
    described = part_descriptors(mesh.vertices, mesh.faces, expected)
    assert np.array([row["descriptor"] for row in found]) == pytest.approx(described, abs=1e-6)


def test_the_tables_have_a_column_for_all_that_is_known(batch):
    """Of what there is no column for, Arrow says nothing."""
    documented = set(SCHEMA["$defs"]["part"]["properties"]) - {"check"}  # which takes a Blender
    assert set(PARTS.names) == {"model", "descriptor", *documented}
    records = [json.loads(path.read_text()) for path in batch[0].rglob(RECORD)]
    assert {frozenset(part) for record in records for part in record["parts"]} == {frozenset(PARTS.names) - {"model"}}
    assert {key for record in records for key in record["model"]} <= set(MODELS.names)


def test_parts_like_a_part_are_found_with_pictures(batch, reeb_parts_command, tmp_path):
    done = reeb_parts_command("similar", batch[0], "tree.ply:2", "--count", 4, "--page", tmp_path / "page.html")
    assert done.returncode == 0, done.stderr
    answer = json.loads(done.stdout)
    table = {(row["model"], row["number"]): np.array(row["descriptor"]) for row in rows(batch[0] / "parts.parquet")}
    one = table.pop(("tree.ply", 2))
    nearest = sorted((float(distances(one, other[None])[0]), *part) for part, other in table.items())[:4]
    assert [(row["distance"], row["model"], row["number"]) for row in answer["similar"]] == [
        (pytest.approx(distance), model, number) for distance, model, number in nearest]
    assert (answer["part"]["model"], answer["part"]["number"]) == ("tree.ply", 2)
    page = (tmp_path / "page.html").read_text()
    assert page.count("data:image/png;base64,") == page.count("<figure>") == 5
    elsewhere = json.loads(reeb_parts_command("similar", batch[0], "tree.ply:2", "--other-models").stdout)
    assert {row["model"] for row in elsewhere["similar"]} == {"deep/dumb bell.obj"}


def test_pictures_show_the_part_whatever_labels_were_asked_for(batch, models, tmp_path):
    """Of labels as text, pictures were those of whole models."""
    shown = {}
    for kind in (".npy", ".txt", ".seg"):
        do_model(job(models / "tree.ply", tmp_path / kind / "models" / "tree.ply", labels=kind))
        part = {"model": "tree.ply", "number": 2, "name": "Part 02", "share": 0.1}
        shown[kind] = similar._image(tmp_path / kind, str(models / "tree.ply"), part)
    assert shown[".txt"] == shown[".seg"] == shown[".npy"]
    thumbnail = (tmp_path / ".npy" / "models" / "tree.ply" / "thumbnail.png").read_bytes()
    assert base64.b64encode(thumbnail).decode() not in shown[".npy"]


def test_a_model_that_has_changed_is_shown_as_it_was(models, tmp_path):
    """The labels of its former faces were shown on those that it has now."""
    path, folder = tmp_path / "tree.ply", tmp_path / "models" / "tree.ply"
    shutil.copy(models / "tree.ply", path)
    do_model(job(path, folder))
    mesh = trimesh.load_mesh(path, process=False)
    trimesh.Trimesh(mesh.vertices, mesh.faces[::-1], process=False).export(path)
    shown = similar._image(tmp_path, str(path), {"model": "tree.ply", "number": 2, "name": "Part 02", "share": 0.1})
    assert base64.b64encode((folder / "thumbnail.png").read_bytes()).decode() in shown


def test_a_model_that_only_one_table_has_costs_no_page(batch, tmp_path):
    """As after a power failure between the two; it was a traceback."""
    parquet.write_table(MODELS.empty_table(), tmp_path / "models.parquet")
    found = similar_parts(batch[0], "tree.ply", 1, 3, False)
    assert similar.page(tmp_path, found).count("<figure>") == 4


@pytest.mark.parametrize(("part", "status", "words"), [
    ("tree.ply:99", 1, "There is no part 99 of a model tree.ply"), ("tree.ply:²", 2, "must be the name of a model"),
])
def test_a_part_that_is_not_there_is_said_not_to_be(part, status, words, batch, reeb_parts_command):
    done = reeb_parts_command("similar", batch[0], part)
    assert done.returncode == status
    assert words in done.stderr


@pytest.mark.parametrize(("change", "words"), [
    (lambda row: {**row, "descriptor": row["descriptor"][:-1]}, "is of another version of Reeb Parts"),
    (lambda row: {key: value for key, value in row.items() if key != "descriptor"}, "is of another version of Reeb"),
    (lambda row: {**row, "descriptor": [np.nan] * len(row["descriptor"])}, "parts.parquet is damaged"),
    (lambda row: {**row, "descriptor": 1.0}, "parts.parquet could not be read: "),
    (lambda row: {**row, "share": "all"}, "parts.parquet could not be read: "),
    (None, "could not be read: Parquet")], ids=["shorter", "none", "no numbers", "a number", "text", "damaged"])
def test_tables_of_another_version_are_one_sentence(change, words, batch, tmp_path):
    """They ended with tracebacks."""
    table = tmp_path / "parts.parquet"
    if change is None:
        table.write_text("no table")
    else:
        parquet.write_table(pa.Table.from_pylist([change(row) for row in rows(batch[0] / table.name)]), table)
    with pytest.raises(PartError, match=words):
        similar_parts(tmp_path, "tree.ply", 1, 3, False)


@pytest.mark.parametrize(("page", "status", "words"), [
    ("parts.parquet", 2, "must end in .html or .htm"), ("index.html", 1, "index.html shows all models of the batch."),
    ("models/../index.html", 1, "index.html shows all models of the batch. Choose another name."),
])
def test_a_page_is_not_written_over_the_results(page, status, words, batch, reeb_parts_command):
    before = {path: path.read_bytes() for path in batch[0].glob("*.*")}
    done = reeb_parts_command("similar", batch[0], "tree.ply:2", "--page", batch[0] / page)
    assert (done.returncode, done.stdout) == (status, "")
    assert words in done.stderr.splitlines()[-1]
    assert {path: path.read_bytes() for path in batch[0].glob("*.*")} == before


def test_the_table_of_models_has_each_with_its_reason(batch, models):
    table = {row["name"]: row for row in rows(batch[0] / "models.parquet")}
    assert {name: row["status"] for name, row in table.items()} == {
        "damaged.ply": "unreadable", "deep/dumb bell.obj": "done", "tiny.stl": "refused", "tree.ply": "done"}
    assert "only 1 of the 4 faces" in table["tiny.stl"]["reason"]
    assert table["tree.ply"]["path"] == str(models / "tree.ply")
    assert table["tree.ply"]["n_parts"] == sum(row["model"] == "tree.ply" for row in rows(batch[0] / "parts.parquet"))
    assert table["damaged.ply"]["n_parts"] is None


def test_the_page_needs_no_other_file_and_shows_every_model(batch):
    text = (batch[0] / "index.html").read_text(encoding="utf-8")
    shown = json.loads(text.split('id="models">')[1].split("</script>")[0])
    assert [model["name"] for model in shown] == ["damaged.ply", "deep/dumb bell.obj", "tiny.stl", "tree.ply"]
    assert [model["image"][:22] for model in shown if model["status"] == "done"] == ["data:image/png;base64,"] * 2
    assert "http" not in text
    assert "src=" not in text.split("<script", 1)[0]
    assert (batch[0] / shown[3]["link"] / "model.json").is_file()


def test_progress_has_the_rate_and_the_time_left_and_the_dashboard_is_named(batch):
    assert "4/4" in batch[2]
    assert "model/s" in batch[2] or "s/model" in batch[2]
    assert "Dask's dashboard: http://127.0.0.1:" in batch[2]


def test_what_is_done_is_not_done_again(batch, models, reeb_parts_command):
    before = {path: path.stat().st_mtime_ns for path in (batch[0] / "models").rglob("*")}
    done = reeb_parts_command("batch", models, "--out", batch[0], "--colored", "ply", "--parts", "glb", *LOCAL)
    assert json.loads(done.stdout)["kept"] == 4
    assert {path: path.stat().st_mtime_ns for path in (batch[0] / "models").rglob("*")} == before
    assert "dashboard" not in done.stderr


def test_other_bytes_parameters_or_missing_files_are_not_done(batch, models, tmp_path):
    settings = Settings(Parameters(), colored=".ply", parts="glb")
    folder = tmp_path / "tree.ply"
    shutil.copytree(batch[0] / "models" / "tree.ply", folder)
    model = tmp_path / "model.ply"
    model.write_bytes((models / "tree.ply").read_bytes())
    assert is_done(model, folder, settings)
    assert not is_done(model, folder, Settings(Parameters(n_parts=3), colored=".ply", parts="glb"))
    assert not is_done(model, folder, Settings(Parameters(), colored=".glb", parts="glb"))
    (folder / "colored.ply").write_bytes(b"")
    assert not is_done(model, folder, settings)
    shutil.copy(batch[0] / "models" / "tree.ply" / "colored.ply", folder)
    assert is_done(model, folder, settings)
    assert is_done(model, folder, settings, name="tree.ply")
    assert not is_done(model, folder, settings, name="shrub.ply")  # both were renamed: the tables had the former name
    (folder / "record.json").write_text('{"format": 1, "files": {}}')  # which ended the whole batch
    assert not is_done(model, folder, settings)
    shutil.copy(batch[0] / "models" / "tree.ply" / "record.json", folder)
    model.write_bytes(model.read_bytes() + b"\n")
    assert not is_done(model, folder, settings)


@pytest.mark.parametrize(("suffix", "blender", "words"), [
    ("fbx", None, "Say where it is with --blender"), ("blend", "/none", "could not be started: No such file"),
    ("xyz_", None, "is none of"), ("usdz", None, "Say where it is with --blender"),
    ("abc", None, "Say where it is with --blender"),
])
def test_what_lacked_a_reader_is_tried_again(suffix, blender, words, tmp_path):
    model = tmp_path / f"model.{suffix}"
    model.write_bytes(b"Kaydara")
    answer = do_model(job(model, tmp_path / "out") | {"blender": blender})
    assert answer["status"] == "reader"
    assert words in answer["reason"]
    assert not is_done(model, tmp_path / "out", Settings(Parameters()))


@pytest.mark.skipif(sys.platform == "win32", reason="no signals end processes there")
def test_a_blender_that_crashes_costs_one_model(tmp_path):
    """As at damage within a file of Alembic; what it said last is about lines of its own."""
    blender = tmp_path / "blender"
    blender.write_text("#!/bin/sh\necho 'terminate called' >&2\nkill -SEGV $$\n")
    blender.chmod(0o755)
    (tmp_path / "model.abc").write_bytes(b"Ogawa")
    answer = do_model(job(tmp_path / "model.abc", tmp_path / "out") | {"blender": str(blender)})
    assert answer["status"] == "crash"
    assert answer["reason"] == f"{tmp_path}/model.abc could not be read, as {blender} crashed: Segmentation fault"
    assert not is_done(tmp_path / "model.abc", tmp_path / "out", Settings(Parameters()))


@pytest.mark.skipif(sys.platform == "win32", reason="no signals end processes there")
@pytest.mark.parametrize("words", [
    "echo 'numpy._core._exceptions._ArrayMemoryError: Unable to allocate 3 GiB' >&2; exit 1",
    "echo 'MemoryError' >&2; exit 1",
    "echo 'Malloc returns null: len=16000000 in from_uninitialized, total 106634832' >&2; kill -SEGV $$",
])
def test_a_model_for_which_a_blender_has_no_memory_is_tried_again(words, process, tmp_path):
    """It counted as unreadable, and was left alone where there was memory for it, too."""
    blender = tmp_path / "blender"
    blender.write_text(f"#!/bin/sh\n{words}\n")
    blender.chmod(0o755)
    (tmp_path / "model.abc").write_bytes(b"Ogawa")
    answer = process.run(job(tmp_path / "model.abc", tmp_path / "out") | {"blender": str(blender)}, 60.0)
    assert answer["status"] == "memory"
    assert not is_done(tmp_path / "model.abc", tmp_path / "out", Settings(Parameters()))


def test_a_blender_is_found_from_other_working_folders(address, reeb_parts_command, tmp_path):
    """It was looked for below that of each worker of a cluster."""
    blender = tmp_path / "tools" / "blender"
    blender.parent.mkdir()
    blender.write_text("#!/bin/sh\necho 'Error: found'\nexit 1\n")
    blender.chmod(0o755)
    (tmp_path / "model.abc").write_bytes(b"Ogawa")
    reeb_parts_command("batch", "model.abc", "--out", "out", "--blender", "tools/blender", "--scheduler", address,
                       cwd=tmp_path)
    (row,) = rows(tmp_path / "out" / "models.parquet")
    assert (row["status"], row["reason"]) == ("unreadable", f"{tmp_path}/model.abc could not be read: found")


def test_results_of_other_parameters_are_said_to_be_there(models, tmp_path):
    """Of two runs at the same time, each said that it had not reached what the other had replaced."""
    do_model(job(models / "tree.ply", tmp_path / "tree"))
    other = record_of("tree.ply", tmp_path / "tree", Settings(Parameters(detail=0.1)).digest)
    assert (other["status"], other["reason"]) == (
        "open", "What is there was made with other parameters or outputs, or by another version.")
    assert record_of("none.ply", tmp_path / "none", "")["reason"] == "It was not reached."


def test_what_lacks_a_reader_in_a_folder_is_counted(tree, reeb_parts_command, tmp_path):
    for name in ("scene.blend", "deep/thing.FBX"):
        path = tmp_path / "models" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(b"Kaydara")
    place, out = tmp_path / "models", tmp_path / "out"
    for more, expected in (([], {"reader": 2}), ([tree], {"done": 1, "reader": 2}), ([], {"done": 1, "reader": 2})):
        for shape in more:
            save(shape, place / "tree.ply")
        done = reeb_parts_command("batch", place, "--out", out, *ONE)
        assert done.returncode == 1, done.stderr
        assert json.loads(done.stdout)["models"] == expected
    table = {row["name"]: row for row in rows(out / "models.parquet")}
    assert {name: row["status"] for name, row in table.items()} == {
        "scene.blend": "reader", "deep/thing.FBX": "reader", "tree.ply": "done"}
    assert "Say where it is with --blender" in table["scene.blend"]["reason"]


@pytest.mark.parametrize("name", ["models.parquet", "parts.parquet", "index.html", "models"])
def test_places_of_results_that_are_taken_are_said_at_once(name, models, reeb_parts_command, tmp_path):
    """Each model was computed, and then no table could be written; in place of the folder, none of them could."""
    taken = tmp_path / "out" / name
    taken.parent.mkdir()
    taken.write_text("") if name == "models" else taken.mkdir()
    done = reeb_parts_command("batch", str(models / "tree.ply"), "--out", str(taken.parent))
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith(f"reeb-parts: {taken} ")
    assert len(done.stderr.splitlines()) == 1
    assert [path.name for path in taken.parent.iterdir() if not path.name.startswith(".")] == [name]


@pytest.mark.parametrize(("arguments", "status", "words"), [
    (["--out", "MODEL"], 1, "could not be written: File exists"), (["--out", "/proc/none"], 1, "could not be written"),
    (["--out", ""], 2, "argument --out: the name of the folder is empty"),
    (["--out", "/proc"], 1, "/proc could not be written: "),
    (["--out", "OUT", "--workers", "0"], 2, "must be a whole number, 1 or more, not 0"),
    (["--out", "OUT", "--memory-limit", "nan"], 2, "must be a number from 0 to 100000, not nan"),
    (["--out", "OUT", "--memory-limit", "8589934592"], 2, "must be a number from 0 to 100000, not 8589934592"),
    (["--out", "OUT", "--memory-limit=-1"], 2, "must be a number from 0 to 100000, not -1"),
    (["--out", "OUT", "--time-limit=-1"], 2, "must be a number, 0 or more, not -1"),
    (["--out", "OUT", "--time-limit", "nan"], 2, "must be a number, 0 or more, not nan"),
    (["--out", "OUT", "--dashboard", "http://host:80"], 2, "http://host:80 is no address such as 127.0.0.1:8787"),
    (["--out", "OUT", "--list", "-"], 1, "- could not be read: No such file or directory"),
    (["--out", "OUT", "--dashboard", ":99999"], 2, ":99999 is no address such as 127.0.0.1:8787"),
])
def test_a_batch_that_cannot_be_is_one_sentence(arguments, status, words, models, reeb_parts_command, tmp_path):
    model = str(models / "tree.ply")
    places = {"MODEL": model, "OUT": str(tmp_path / "out")}
    done = reeb_parts_command("batch", model, *(places.get(word, word) for word in arguments))
    assert (done.returncode, done.stdout) == (status, "")
    assert words in done.stderr.splitlines()[-1]
    assert "Dask" not in done.stderr  # no model was computed before
    assert list(tmp_path.iterdir()) == []


# One model that goes wrong ---------------------------------------------------------------------


def job(path, folder, labels=".npy", **settings):
    """What a worker is given for a model."""
    return {"path": str(path), "name": path.name, "folder": str(folder), "blender": None, "retry": False,
            "settings": Settings(Parameters(**settings), labels=labels).to_dict()}


@pytest.fixture(scope="module")
def process():
    """A process for models."""
    made = ModelProcess(2**30)
    yield made
    made.close()


@pytest.fixture(scope="module")
def large(tmp_path_factory):
    """A model that takes seconds and hundreds of megabytes."""
    shape = shapes.surface_of_genus(3, 0.1)
    for _ in range(3):
        shape = shapes.subdivide(shape)
    return save(shape, tmp_path_factory.mktemp("large") / "large.ply")


def test_a_model_that_takes_too_long_is_ended_and_the_next_one_is_done(process, large, models, tmp_path):
    answer = process.run(job(large, tmp_path / "large"), 0.5)
    assert (answer["status"], answer["reason"]) == ("time", "It took longer than 0.5 s.")
    assert read_record(tmp_path / "large")["status"] == "time"
    assert process.run(job(models / "tree.ply", tmp_path / "tree"), 60.0)["status"] == "done"


def test_a_model_that_needs_too_much_memory_costs_only_itself(large, models, tmp_path):
    small = ModelProcess(320 * 2**20)
    try:
        answer = small.run(job(large, tmp_path / "large"), 60.0)
        assert (answer["status"], answer["reason"]) == ("memory", "It needed more memory than 0.312 GiB.")
        assert small.run(job(models / "tree.ply", tmp_path / "tree"), 60.0)["status"] == "done"
    finally:
        small.close()


@pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="other systems do not have it")
def test_a_run_takes_the_processors_and_the_memory_that_it_may_use(models, tmp_path, monkeypatch):
    """In a container it took all of the machine's: too many models at a time, which the system then killed."""
    monkeypatch.setattr("distributed.system.memory_limit", lambda: 2**31)
    parser = argparse.ArgumentParser()
    command.add_options(parser)
    run = command._Batch(parser.parse_args([str(models / "tree.ply"), "--out", str(tmp_path / "out")]))
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(before)})
    try:
        assert (run.workers, run._job(run.sources[0])["memory_limit"]) == (1, 2**31)
    finally:
        os.sched_setaffinity(0, before)


def test_a_model_keeps_one_processor_busy(tmp_path, monkeypatch):
    """There is a process for each; threads of one would get in the way of the others."""
    monkeypatch.setenv("OMP_NUM_THREADS", "2")
    path = save(shapes.subdivide(shapes.surface_of_genus(3, 0.1)), tmp_path / "model.ply")
    alone, counts = ModelProcess(), []
    with ThreadPoolExecutor(1) as pool:
        try:
            answer = pool.submit(alone.run, job(path, tmp_path / "out"), 100.0)
            while not answer.done():
                with suppress(AttributeError, psutil.Error):  # it is about to start, or has just ended
                    counts.append(psutil.Process(alone._process.pid).num_threads())
                time.sleep(0.001)
            assert answer.result()["status"] == "done"
        finally:
            alone.close()
    assert len(counts) > 100
    assert max(counts) == 2  # that which computes, and that which waits for the next model


@pytest.mark.skipif(sys.platform != "linux", reason="other systems limit no process")
@pytest.mark.parametrize("megabytes", [10, 60, 100, 130])
def test_a_process_without_memory_to_start_or_to_compute_is_no_crash(megabytes, models, tmp_path):
    """Threads get no stack then, and OpenBLAS ends the process."""
    small = ModelProcess(megabytes * 2**20)
    try:
        answer = small.run(job(models / "tree.ply", tmp_path / "tree"), 60.0)
    finally:
        small.close()
    assert answer["status"] == "memory", answer
    assert answer["reason"] == f"It needed more memory than {megabytes / 1024:.3g} GiB."


@pytest.mark.skipif(sys.platform != "linux", reason="other systems limit no process")
@pytest.mark.parametrize("megabytes", [10, 60, 80])
def test_memory_is_limited_once_all_is_imported(megabytes):
    """OpenBLAS, refused the memory with which it starts, ends the process or, in SciPy 1.17, asks again for ever: each
    model took two minutes to fail.
    """
    small = ModelProcess(megabytes * 2**20)
    try:
        assert small._start_surely() == "MemoryError"
    finally:
        small.close()


def test_a_link_that_leads_nowhere_is_unreadable(models, tmp_path):
    (tmp_path / "link.ply").symlink_to(tmp_path / "none.ply")
    answer = do_model(job(tmp_path / "link.ply", tmp_path / "out"))
    assert answer["status"] == "unreadable"
    assert answer["reason"].endswith("link.ply could not be read: No such file or directory")
    (tmp_path / "link.ply").unlink()
    shutil.copy(models / "tree.ply", tmp_path / "link.ply")
    assert not is_done(tmp_path / "link.ply", tmp_path / "out", Settings(Parameters()))


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no such pipes")
def test_a_pipe_in_a_folder_is_unreadable_and_the_next_model_is_done(models, reeb_parts_command, tmp_path):
    """Its bytes were waited for, outside the time limit."""
    folder = tmp_path / "models"
    folder.mkdir()
    pipes = [folder / "pipe.ply", folder / "pipe.gltf"]
    for pipe in pipes:
        os.mkfifo(pipe)
    shutil.copy(models / "tree.ply", folder / "tree.ply")
    done = reeb_parts_command("batch", folder, "--out", tmp_path / "out", "--time-limit", 60, *ONE)
    assert done.returncode == 1, done.stderr
    assert json.loads(done.stdout)["models"] == {"done": 1, "unreadable": 2}
    for pipe in pipes:
        assert read_record(tmp_path / "out" / "models" / pipe.name)["reason"] == (
            f"{pipe} is no file but a pipe or a device: write the model to a file first.")


def test_results_that_cannot_be_written_are_no_crash(models):
    answer = do_model(job(models / "tree.ply", Path("/proc/none/tree.ply")))
    assert answer["status"] == "error"
    assert answer["reason"] == "/proc/none/tree.ply could not be written: No such file or directory"


@pytest.mark.skipif(sys.platform == "win32", reason="there Ctrl+C comes another way")
@pytest.mark.parametrize("number", cluster.OWN_SIGNALS)
def test_what_a_terminal_sends_while_workers_start_is_heard(number, monkeypatch):
    """Ctrl+C in the first seconds was lost: the batch did all of its models."""
    class Started:
        ended = 0

        def __init__(self, *_, **__):
            os.kill(os.getpid(), number)

        def __enter__(self):
            return self

        def __exit__(self, *_):
            Started.ended += 1

    def stop(*_):
        raise KeyboardInterrupt

    former = signal.signal(number, stop)
    try:
        monkeypatch.setattr(cluster, "LocalCluster", Started)
        monkeypatch.setattr(cluster, "Client", lambda _: nullcontext())
        with pytest.raises(KeyboardInterrupt), cluster.connected(None, 1, ":0"):
            pytest.fail("The workers have begun.")
        assert signal.getsignal(number) is stop
        assert number not in signal.pthread_sigmask(signal.SIG_BLOCK, [])
    finally:
        signal.signal(number, former)
    assert Started.ended == 1


def run_here(monkeypatch, models, out, spread=lambda client, function, jobs: ((job, do_model(job)) for job in jobs)):
    """The exit status of a batch in this process, without a cluster."""
    monkeypatch.setattr(cluster, "spread", spread)
    monkeypatch.setattr(cluster, "connected", lambda *_: nullcontext(
        SimpleNamespace(dashboard_link="", nthreads=lambda: {"": 1})))
    parser = argparse.ArgumentParser()
    command.add_options(parser)
    return command.run(parser.parse_args([str(models), "--out", str(out)]))


def test_what_another_run_did_after_it_was_given_out_is_not_done_again(models, tmp_path, monkeypatch, capsys):
    """Each worker has models in advance: of ten, two runs that began together did nine twice."""
    records = []

    def spread(client, function, jobs):
        waiting = list(jobs)
        for one in waiting:  # by another run
            assert "kept" not in do_model(one)
        records.extend((tmp_path / "out").rglob(RECORD))
        before = [record.stat().st_ino for record in records]
        yield from ((one, do_model(one)) for one in waiting)
        assert [record.stat().st_ino for record in records] == before

    assert run_here(monkeypatch, models, tmp_path / "out", spread) == 1
    captured = capsys.readouterr()
    answer = json.loads(captured.out)
    assert (answer["models"], answer["kept"], len(records)) == ({"done": 2, "refused": 1, "unreadable": 1}, 4, 4)
    assert "damaged.ply" not in captured.err


def test_what_could_not_be_written_is_no_model_that_was_not_reached(models, tmp_path, monkeypatch, capsys):
    """Where the record cannot be written either, tables and answer had "open", standard error the truth."""
    (tmp_path / "archive" / "deep").mkdir(parents=True)
    shutil.copy(models / "tree.ply", tmp_path / "archive" / "deep")
    (tmp_path / "out" / "models").mkdir(parents=True)
    (tmp_path / "out" / "models" / "deep").write_text("a file in the place of the folder")
    status = run_here(monkeypatch, tmp_path / "archive", tmp_path / "out")
    assert (status, json.loads(capsys.readouterr().out)["models"]) == (1, {"error": 1})
    (row,) = rows(tmp_path / "out" / "models.parquet")
    assert row["status"] == "error"
    assert "tree.ply could not be written: " in row["reason"]


@pytest.mark.skipif(sys.platform == "win32", reason="the program is one of Unix")
def test_what_says_nothing_is_named_with_its_status(tmp_path):
    (tmp_path / "model.blend").write_bytes(b"BLENDER")
    answer = do_model(job(tmp_path / "model.blend", tmp_path / "out") | {"blender": "/bin/true"})
    assert answer["status"] == "unreadable"
    assert answer["reason"].endswith("model.blend could not be read: /bin/true ended with status 0 and said nothing")


@pytest.mark.skipif(sys.platform == "win32", reason="the script is one of a shell")
def test_a_blender_that_takes_too_long_leaves_nothing_in_the_temporary_folder(tmp_path, monkeypatch):
    (tmp_path / "temporary").mkdir()
    monkeypatch.setenv("TMPDIR", str(tmp_path / "temporary"))
    (tmp_path / "blender").write_text('#!/bin/sh\necho half > "$TMPDIR/own"\nsleep 60\n')
    (tmp_path / "blender").chmod(0o755)
    (tmp_path / "slow.blend").write_bytes(b"BLENDER")
    process = ModelProcess()
    try:
        answer = process.run(job(tmp_path / "slow.blend", tmp_path / "out" / "slow.blend")
                             | {"blender": str(tmp_path / "blender")}, 3.0)
    finally:
        process.close()
    assert answer["status"] == "time"
    assert list((tmp_path / "temporary").iterdir()) == []
    assert len(list((tmp_path / "out").glob(".reeb_parts_*/own"))) == 1
    remove_leftovers(tmp_path / "out")
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["slow.blend"]


@pytest.mark.parametrize(("number", "words"), [
    (signal.SIGSEGV, "crashed (SIGSEGV): Fatal Python error: Segmentation fault"),
    (signal.SIGKILL, "was killed, perhaps for lack of memory"),
])
def test_a_crash_is_recorded_with_its_reason(number, words, process, large, tmp_path):
    process.run(job(large, tmp_path / "first"), 0.01)  # a new process next time

    def crash():
        time.sleep(0.3)
        os.kill(process._process.pid, number)

    assert process._start()
    thread = threading.Thread(target=crash)
    thread.start()
    answer = process.run(job(large, tmp_path / "large"), 60.0)
    thread.join()
    assert answer["status"] == "crash"
    assert words in answer["reason"]
    assert not is_done(large, tmp_path / "large", Settings(Parameters()))  # it will be tried again


def test_a_process_that_is_killed_while_it_starts_costs_no_model(models, tmp_path):
    process = ModelProcess()

    def crash():
        while process._process is None:
            time.sleep(0.01)
        process._process.kill()

    thread = threading.Thread(target=crash)
    thread.start()
    try:
        assert process.run(job(models / "tree.ply", tmp_path / "tree"), 60.0)["status"] == "done"
    finally:
        thread.join()
        process.close()


def test_what_a_python_prints_when_it_starts_is_no_message(models, tmp_path, monkeypatch):
    (tmp_path / "sitecustomize.py").write_text("print('hello')\nprint(1)\nprint('[]', flush=True)\n")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(tmp_path), os.environ["PYTHONPATH"]]))
    process = ModelProcess()
    try:
        assert process.run(job(models / "tree.ply", tmp_path / "tree"), 60.0)["status"] == "done"
    finally:
        process.close()


def test_a_lost_model_whose_record_cannot_be_written_costs_only_itself(models, tmp_path):
    parser = argparse.ArgumentParser()
    command.add_options(parser)
    run = command._Batch(parser.parse_args([str(models / "tree.ply"), "--out", str(tmp_path / "out")]))
    (tmp_path / "file").touch()
    answer = run._lost(job(models / "tree.ply", tmp_path / "file" / "tree.ply"), RuntimeError("killed"))
    assert answer == {"status": "crash", "reason": "The workers that had it ended: killed"}


def test_what_another_run_does_meanwhile_is_not_done_again(models, tmp_path):
    """Two runs on one folder did every model, both."""
    parser = argparse.ArgumentParser()
    command.add_options(parser)
    run = command._Batch(parser.parse_args([str(models), "--out", str(tmp_path / "out")]))
    jobs = run._jobs(run.sources, argparse.Namespace(update=lambda: None))
    first = next(jobs)
    do_model(run._job(run.sources[2]))  # tiny.stl, which is refused
    assert [first["name"], *(entry["name"] for entry in jobs)] == ["damaged.ply", "deep/dumb bell.obj", "tree.ply"]
    assert run.kept == 1


def test_nothing_is_left_of_a_process_when_the_one_that_asked_is_killed(large, tmp_path):
    code = ("import sys, json; from reeb_parts.batch.model_process import ModelProcess; p = ModelProcess(); p._start();"
            "print(p._process.pid, flush=True); p.run(json.loads(sys.argv[1]), 0)")
    with subprocess.Popen([sys.executable, "-c", code, json.dumps(job(large, tmp_path / "x"))],
                          stdout=subprocess.PIPE) as asking:
        child = psutil.Process(int(asking.stdout.readline()))
        asking.kill()
    child.wait(timeout=20)


# What is killed --------------------------------------------------------------------------------


def start(request, *arguments):
    """Start a batch in a session of its own."""
    return subprocess.Popen([sys.executable, request.config.command, "batch", *map(str, arguments)],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)


def wait_for(condition, process):
    """Wait until something holds."""
    until = time.monotonic() + 120
    while not condition():
        assert process.poll() is None, process.communicate()[1]
        assert time.monotonic() < until
        time.sleep(0.02)


def alive(process):
    """Whether a process still runs; one that nobody has taken note of yet does not."""
    try:
        return process.status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False


def finished(out):
    """Names of the models whose results are there."""
    return {path.parent.name for path in (out / "models").glob("*/" + RECORD)}


def test_a_killed_worker_a_killed_run_and_ctrl_c_lose_nothing(request, reeb_parts_command, tmp_path):
    many(tmp_path / "in", 16)
    out = tmp_path / "out"
    arguments = (tmp_path / "in", "--out", out, *LOCAL)
    run = start(request, *arguments)
    wait_for(lambda: len(finished(out)) >= 3, run)
    # One of the processes that has one for models is a worker.
    models = [process for process in psutil.Process(run.pid).children(recursive=True)
              if "reeb_parts.batch.model_process" in process.cmdline()]
    worker = models[0].parent()
    worker.kill()
    known = finished(out)
    wait_for(lambda: len(finished(out)) >= len(known) + 3, run)
    children = psutil.Process(run.pid).children(recursive=True)
    os.killpg(run.pid, signal.SIGKILL)
    run.communicate()
    until = time.monotonic() + 30
    while any(map(alive, children)):
        assert time.monotonic() < until
        time.sleep(0.05)
    known = {name: (out / "models" / name / RECORD).stat().st_mtime_ns for name in finished(out)}
    assert 6 <= len(known) < 16

    run = start(request, *arguments)
    wait_for(lambda: len(finished(out)) >= len(known) + 3, run)
    os.killpg(run.pid, signal.SIGINT)  # as a terminal sends it: to all processes
    stdout, stderr = run.communicate(timeout=60)
    assert run.returncode == 130, stderr
    assert "Traceback" not in stderr
    answer = json.loads(stdout)
    assert answer["kept"] == len(known)
    assert answer["models"]["done"] + answer["models"]["open"] == 16
    assert len(rows(out / "models.parquet")) == 16

    done = reeb_parts_command("batch", *arguments)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["models"] == {"done": 16}
    assert finished(out) == {f"tree_{n:03d}.ply" for n in range(16)}
    # What was done before is as it was, and nothing half done is left.
    assert {name: (out / "models" / name / RECORD).stat().st_mtime_ns for name in known} == known
    assert {path.name for path in (out / "models").iterdir()} == finished(out)


@pytest.mark.skipif(not hasattr(signal, "pthread_sigmask"), reason="other systems close terminals in another way")
def test_what_python_starts_beside_the_workers_does_not_end_with_the_terminal():
    """It ended, and a new one that knew of nothing printed a traceback for each lock that it was to forget."""
    run = ("import os, time; from multiprocessing import resource_tracker; from reeb_parts.batch import cluster\n"
           "with cluster._signals_held_back(): pass\n"
           "process = resource_tracker._resource_tracker._pid\n"
           "for number in cluster.OWN_SIGNALS: os.kill(process, number)\n"
           "time.sleep(0.3); print(os.waitpid(process, os.WNOHANG)[0])")
    done = subprocess.run([sys.executable, "-c", run], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("0\n", "")


def test_what_an_ended_process_was_writing_is_gone_after_the_run(request, tmp_path):
    """Its own folder would be removed by the next run, of which there may be none."""
    many(tmp_path / "in", 6)
    run = start(request, tmp_path / "in", "--out", tmp_path / "out", *LOCAL)
    wait_for(lambda: finished(tmp_path / "out"), run)
    (tmp_path / "out" / "models" / ".reeb_parts_half").mkdir()
    stderr = run.communicate(timeout=120)[1]
    assert run.returncode == 0, stderr
    assert {path.name for path in (tmp_path / "out" / "models").iterdir()} == finished(tmp_path / "out")


# A cluster that is there -----------------------------------------------------------------------


@pytest.fixture(scope="module")
def address():
    """The address of a cluster of two workers."""
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, memory_limit=0) as there:
        yield there.scheduler_address


def processes_of_models(client):
    """Those that the workers of a cluster have."""
    found = []
    for process in (child for pid in client.run(os.getpid).values() for child in psutil.Process(pid).children()):
        with suppress(psutil.Error):  # it is just being ended
            found += [process] if "reeb_parts.batch.model_process" in process.cmdline() else []
    return found


def test_a_cluster_that_is_there_is_used_and_left_as_it_was(address, reeb_parts_command, tmp_path):
    """A process of 180 MB stayed for each thread of the workers, for as long as these lasted."""
    many(tmp_path / "in", 2)
    with Client(address) as client:
        client.run(exec, "import reeb_parts.batch.cluster as cluster; cluster.IDLE = 2.0")
    done = reeb_parts_command("batch", tmp_path / "in", "--out", tmp_path / "out", "--scheduler", address)
    assert done.returncode == 0, done.stderr
    assert len(finished(tmp_path / "out")) == 2
    with Client(address) as client:
        assert len(client.nthreads()) == 2
        assert client.run_on_scheduler(lambda dask_scheduler: len(dask_scheduler.tasks)) == 0
        until = time.monotonic() + 15
        while processes_of_models(client):
            assert time.monotonic() < until
            time.sleep(0.1)


def test_a_process_of_models_waits_for_the_next_one_and_is_ended_but_once(models, tmp_path, monkeypatch):
    monkeypatch.setattr(cluster, "IDLE", 1.0)
    idle = cluster._IdleProcesses()
    first = idle.take(2**30)
    assert first.run(job(models / "tree.ply", tmp_path / "tree"), 60.0)["status"] == "done"
    child = psutil.Process(first._process.pid)
    idle.put_by(first)
    assert idle.take(2**30) is first
    assert idle.take(2**30) is not first  # two models at a time have two
    time.sleep(1.5)
    assert alive(child)  # what was to end it had been called off
    idle.put_by(first)
    other = idle.take(2**31)
    assert (other is first, other.memory_limit, alive(child)) == (False, 2**31, False)
    assert first.run(job(models / "tree.ply", tmp_path / "again"), 60.0)["status"] == "done"
    child = psutil.Process(first._process.pid)
    idle.put_by(first)
    child.wait(timeout=20)
    assert idle.take(2**30) is not first


def test_an_address_where_nobody_answers_is_said_to_be_one(reeb_parts_command, tmp_path, monkeypatch):
    monkeypatch.setattr(cluster, "PATIENCE", 0.5)
    with pytest.raises(cluster.ClusterError, match="No scheduler answers at tcp://127.0.0.1:1"):
        cluster.connected("tcp://127.0.0.1:1", 1, "").__enter__()


@pytest.mark.parametrize("address", ["host", "tcp://", "http://127.0.0.1:1", "tcp://127.0.0.1:8x", ""])
def test_what_is_no_address_of_a_scheduler_is_said(address):
    """It was said in the words of Dask and Python: invalid literal for int() with base 10."""
    with (pytest.raises(cluster.ClusterError, match=f"^({address or 'An empty word'}) is no address of a scheduler"),
          cluster.connected(address, 1, ":0")):
        pass


@pytest.mark.parametrize("scheme", ["tls", "wss"])
def test_an_encrypted_connection_without_certificates_says_where_they_belong(scheme):
    """It ended in a TypeError of Dask's, or waited for an answer."""
    for settings, words in (({}, "at distributed.comm.tls"), ({"distributed.comm.tls.client.cert": "none.pem",
                            "distributed.comm.tls.ca-file": "none.pem"}, "could not be read: .*No such file")):
        with (dask.config.set(settings), pytest.raises(cluster.ClusterError, match=words),
              cluster.connected(f"{scheme}://127.0.0.1:1", 1, ":0")):
            pass


def test_a_cluster_without_workers_is_said_to_have_none(request, models, tmp_path):
    """The bar of progress stood still, and nobody knew why."""
    with LocalCluster(n_workers=0, dashboard_address=None) as there:
        run = start(request, models, "--out", tmp_path / "out", "--scheduler", there.scheduler_address)
        try:
            run.stderr.readline()  # the address of the dashboard
            assert run.stderr.readline() == "reeb-parts: The cluster has no workers; the models wait for some.\n"
            there.scale(1)
            assert json.loads(run.communicate(timeout=120)[0])["models"]["done"] == 2
        finally:
            run.kill()


def test_a_scheduler_that_goes_loses_nothing_that_is_done(models, tmp_path, monkeypatch, capsys):
    """What the workers were at became crashes, in place of results that were there by then; then came a traceback."""
    def spread(client, function, jobs):
        job = next(jobs)
        yield job, do_model(job)
        raise cluster.SchedulerLostError("The scheduler does not answer any more")

    monkeypatch.setattr(cluster, "spread", spread)
    monkeypatch.setattr(cluster, "connected", lambda *_: nullcontext(
        SimpleNamespace(dashboard_link="", nthreads=lambda: {"": 1})))
    parser = argparse.ArgumentParser()
    command.add_options(parser)
    status = command.run(parser.parse_args([str(models), "--out", str(tmp_path / "out")]))
    said = capsys.readouterr()
    assert (status, json.loads(said.out)["models"]["open"]) == (1, 3)
    assert len(rows(tmp_path / "out" / "models.parquet")) == 4
    assert "The scheduler does not answer any more" in said.err


def test_workers_of_a_scheduler_that_goes_have_not_crashed():
    with (LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address="127.0.0.1:0") as there,
          Client(there.scheduler_address, timeout=1) as client):
        answers = cluster.spread(client, double, range(1000))
        assert next(answers)[1] % 2 == 0
        there.close()
        with pytest.raises(cluster.SchedulerLostError):
            assert all(isinstance(answer, int) for _, answer in answers)


def test_workers_with_another_version_are_named(address, monkeypatch):
    """All that they did counted as not reached, and was done again by each run."""
    monkeypatch.setattr(cluster, "VERSION", "9.9.9")
    with (pytest.raises(cluster.ClusterError, match=r"2 workers do not have Reeb Parts 9\.9\.9 \(first: tcp://.*, "),
          cluster.connected(address, 1, "")):
        pass


def double(number):
    """A job."""
    return 2 * number


@pytest.mark.skipif(sys.platform == "win32", reason="limits of the system")
def test_a_cluster_that_cannot_be_made_is_said_to_be_none():
    """It was a traceback of a hundred lines."""
    import resource

    limits = resource.getrlimit(resource.RLIMIT_NOFILE)
    few = os.open(os.devnull, os.O_RDONLY)
    resource.setrlimit(resource.RLIMIT_NOFILE, (few + 4, limits[1]))
    try:
        with (pytest.raises(cluster.ClusterError, match="could be started: .*Too many open files"),
              cluster.connected(None, 1, "127.0.0.1:0")):
            pass
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, limits)
        os.close(few)


def test_the_scheduler_holds_a_bounded_number_of_jobs(address):
    taken = ended = most = 0

    def jobs():
        nonlocal taken, most
        for number in range(300):
            taken += 1
            most = max(most, taken - ended)
            yield number

    with Client(address) as client:
        answers = {}
        for number, answer in cluster.spread(client, double, jobs()):
            ended += 1
            answers[number] = answer
    assert answers == {number: 2 * number for number in range(300)}
    assert most <= 2 * cluster.AHEAD + 1


def test_a_job_that_raises_gives_its_exception(address):
    with Client(address) as client:
        ((_, answer),) = cluster.spread(client, double, [None])
    assert isinstance(answer, TypeError)


# Sources ---------------------------------------------------------------------------------------


def test_folders_patterns_lists_and_files_are_found_once_each(models, tmp_path, monkeypatch):
    monkeypatch.chdir(models)
    kinds = (".ply", ".obj")
    names = [source.name for source in find_sources([".", "*.ply", "deep/dumb bell.obj"], kinds, tmp_path)]
    assert names == ["damaged.ply", "deep/dumb bell.obj", "tree.ply"]
    assert [source.name for source in find_sources(["deep"], kinds, tmp_path)] == ["dumb bell.obj"]
    assert [source.name for source in find_sources(["deep"], kinds, tmp_path, models)] == ["deep/dumb bell.obj"]
    assert [source.name for source in find_sources(["**/*.obj"], kinds, tmp_path)] == ["deep/dumb bell.obj"]
    assert [source.name for source in find_sources(["."], kinds, models / "deep")] == names


@pytest.mark.parametrize("places", [["in"], ["in/*/*.ply"], ["in/**"], ["in/a", "in/b", "in/[ab]/*"]])
def test_models_keep_their_names_when_others_come_or_go(places, tmp_path, monkeypatch):
    """Of an archive with one folder left all had other names: they were done again, and the former results stayed."""
    monkeypatch.chdir(tmp_path)
    for name in ("in/a/cow.ply", "in/b/cow.ply"):
        (tmp_path / name).parent.mkdir(parents=True)
        (tmp_path / name).touch()
    assert [source.name for source in find_sources(places, (".ply",), tmp_path / "out")] == ["a/cow.ply", "b/cow.ply"]
    (tmp_path / "in" / "b" / "cow.ply").unlink()
    assert [source.name for source in find_sources(places, (".ply",), tmp_path / "out")] == ["a/cow.ply"]


def test_what_an_earlier_run_made_is_no_model(batch, models, tmp_path):
    archive = tmp_path / "archive"
    shutil.copytree(models, archive)
    shutil.copytree(batch[0], archive / "results")
    (archive / "deep" / "record.json").write_text("{}")  # somebody's own
    names = ["damaged.ply", "deep/dumb bell.obj", "tiny.stl", "tree.ply"]
    kinds = (".obj", ".ply", ".stl", ".glb")
    assert (archive / "results" / "models" / "tree.ply" / "colored.ply").is_file()
    for place in (archive, f"{archive}/**/*.*"):
        found = [source.name for source in find_sources([str(place)], kinds, tmp_path / "out", archive)]
        assert [name for name in found if name.endswith(kinds)] == names
    named = archive / "results" / "models" / "tree.ply" / "colored.ply"
    assert [source.path for source in find_sources([str(named)], kinds, tmp_path / "out")] == [named]


def test_models_in_the_folder_of_the_results_are_models(tree, reeb_parts_command, tmp_path):
    """They were left out without a word; in the second run, what the first made is none."""
    for name in ("here.ply", "models/deep/there.ply", "b/beside.ply"):
        save(tree, tmp_path / name)
    for place, out, names in ((".", ".", ["b/beside.ply", "here.ply", "models/deep/there.ply"]),
                              (".", ".", ["b/beside.ply", "here.ply", "models/deep/there.ply"]),
                              ("b", "b", ["beside.ply"])):
        done = reeb_parts_command("batch", place, "--out", out, "--colored", "ply", *ONE, cwd=tmp_path)
        assert json.loads(done.stdout)["models"] == {"done": len(names)}, done.stderr
        assert [row["name"] for row in rows(tmp_path / out / "models.parquet")] == names


@pytest.mark.parametrize("place", ["models", "models/*.ply", "models/tree.ply"])
def test_results_do_not_take_the_place_of_models(place, tree, tmp_path, monkeypatch):
    """It was said that there is no model."""
    save(tree, tmp_path / "models" / "tree.ply")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SourceError, match="Results would take the place of 1 model .*tree.ply.* another folder"):
        find_sources([place], (".ply",), Path())


@pytest.mark.parametrize(("places", "root", "words"), [
    (["none"], None, "no file and no folder none"), (["x" * 300], None, "x could not be read: "),
    (["*.xyz"], None, "no model"), (["tree.ply"], "deep", "1 model is"),
])
def test_places_without_models_are_refused(places, root, words, models, tmp_path, monkeypatch):
    monkeypatch.chdir(models)
    with pytest.raises(SourceError, match=words):
        find_sources(places, (".ply",), tmp_path, root and models / root)


def test_models_on_several_drives_are_one_sentence(models, tmp_path, monkeypatch):
    """On Windows, where no folder holds them all: that was a traceback."""
    def fail(paths):
        raise ValueError("Paths don't have the same drive")

    monkeypatch.setattr(os.path, "commonpath", fail)
    with pytest.raises(SourceError, match="Models are on several drives"):
        find_sources([str(models)], (".ply",), tmp_path)


def test_what_is_gone_of_a_list_costs_only_itself(tree, tmp_path, capsys):
    """A batch of a whole archive was refused for one model that somebody had removed since. What is done stays."""
    model = save(tree, tmp_path / "in" / "tree.ply")
    do_model({**job(model, tmp_path / "out" / "models" / "in" / "tree.ply"), "name": "in/tree.ply"})
    gone = [str(tmp_path / name) for name in ("in/gone.ply", "none/gone.obj", "x" * 300 + ".ply")]
    (tmp_path / "list.txt").write_text("\n".join([*gone, str(model)]))
    parser = argparse.ArgumentParser()
    command.add_options(parser)

    def run():
        return command.run(parser.parse_args(["--list", str(tmp_path / "list.txt"), "--out", str(tmp_path / "out")]))

    status, said = run(), capsys.readouterr()
    answer = json.loads(said.out)
    # It has the name that it has beside those that are gone.
    assert (status, answer["models"], answer["kept"], answer["unread"]) == (1, {"done": 1}, 1, gone)
    assert f"3 of 4 in the list cannot be found (first: {gone[0]})." in said.err
    model.unlink()  # as where the disk with all of them is not there
    with pytest.raises(SourceError, match="no model"):
        run()
    assert (tmp_path / "out" / "models" / "in" / "tree.ply" / "labels.npy").is_file()
    (tmp_path / "list.txt").write_text("no folder")
    with pytest.raises(SourceError, match="no file and no folder"):
        run()


@pytest.mark.parametrize("patterns", [[""], ["**/*.ply"], ["*.ply", "*/*.ply"]])
def test_a_folder_where_nobody_can_look_is_named_and_no_success(patterns, tree, tmp_path, monkeypatch, capsys):
    """Its models were missing, and the exit status 0; where a pattern led to it, for longer."""
    model, secret = save(tree, tmp_path / "in" / "tree.ply"), tmp_path / "in" / "secret"
    secret.mkdir()
    do_model(job(model, tmp_path / "out" / "models" / "tree.ply"))
    scandir = os.scandir

    def refuse(folder):
        if Path(folder) == secret:
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), folder)
        return scandir(folder)

    monkeypatch.setattr(os, "scandir", refuse)
    parser = argparse.ArgumentParser()
    command.add_options(parser)
    places = [str(tmp_path / "in" / pattern) for pattern in patterns]
    status = command.run(parser.parse_args([*places, "--out", str(tmp_path / "out")]))
    said = capsys.readouterr()
    answer = json.loads(said.out)
    assert (status, answer["models"], answer["unread"]) == (1, {"done": 1}, [str(secret)])
    assert f"{secret} could not be read: Permission denied" in said.err


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have no such names")
def test_a_file_whose_name_is_no_utf8_is_a_model_as_any_other(tree, reeb_parts_command, tmp_path):
    """Nor does it matter which letters the locale has: with those of ASCII alone, a "größe.ply" ended the whole run."""
    plain = {"env": {**os.environ, "LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}}
    save(tree, tmp_path / "models" / "größe.ply")
    odd = Path(os.fsdecode(os.fsencode(tmp_path) + b"/models/Stra\xdfe.ply"))
    shutil.copy(tmp_path / "models" / "größe.ply", odd)
    # As editors for Windows write it, and find.
    (tmp_path / "list.txt").write_bytes(b"\xef\xbb\xbf" + str(tmp_path / "models" / "größe.ply").encode() + b"\r\n"
                                        + os.fsencode(odd))
    odd.with_name(f"torn {odd.name}").write_text("ply\nnonsense")
    done = reeb_parts_command("batch", tmp_path / "models", "--list", tmp_path / "list.txt", "--out", tmp_path / "out",
                              "--parts", "ply", *ONE, **plain)
    assert json.loads(done.stdout)["models"] == {"done": 2, "unreadable": 1}, done.stderr
    table = {row["name"]: row for row in rows(tmp_path / "out" / "models.parquet")}
    assert set(table) == {"größe.ply", r"Stra\xdfe.ply", r"torn Stra\xdfe.ply"}
    assert table[r"Stra\xdfe.ply"]["n_parts"] == table["größe.ply"]["n_parts"]
    assert (tmp_path / "out" / "models" / "größe.ply" / "parts" / "größe Part 01.ply").is_file()
    assert r"Stra\xdfe.ply could not be read" in table[r"torn Stra\xdfe.ply"]["reason"]
    assert r"Stra\\xdfe.ply" in (tmp_path / "out" / "index.html").read_text(encoding="utf-8")
    done = reeb_parts_command("similar", tmp_path / "out", "größe.ply:1", "--page", tmp_path / "ü.html", **plain)
    assert done.returncode == 0, done.stderr
    parts = json.loads(done.stdout)
    assert (parts["part"]["model"], {part["model"] for part in parts["similar"]}) == (
        "größe.ply", {"größe.ply", r"Stra\xdfe.ply"})
    done = reeb_parts_command("decompose", tmp_path / "models" / "größe.ply", "--parts", tmp_path / "ü", **plain)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["files"]["parts"][0] == str(tmp_path / "ü" / "größe Part 01.obj")
    done = reeb_parts_command("decompose", odd, "--json", tmp_path / "odd.json", "--labels", odd.with_suffix(".npy"))
    assert done.returncode == 0, done.stderr
    answer = json.loads(done.stdout)
    assert answer["objects"][0]["name"] == r"Stra\xdfe"
    assert answer["files"]["labels"].endswith(r"Stra\xdfe.npy")
    assert odd.with_suffix(".npy").is_file()


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have no such names")
def test_of_two_models_of_one_name_one_is_left_out_and_said_to_be(tree, tmp_path):
    """They shared a folder, so that both were "done", each with the results of whichever came last."""
    letters = save(tree, tmp_path / r"a\xdf.ply")
    byte = Path(os.fsdecode(os.fsencode(tmp_path) + b"/a\xdf.ply"))
    shutil.copy(letters, byte)
    said = []
    sources = find_sources([str(tmp_path)], (".ply",), tmp_path / "out", unread=said.append)
    assert [source.path for source in sources] == [letters]
    assert [error.filename for error in said] == [str(byte)]
