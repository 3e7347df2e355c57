# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure ``reeb-parts batch``: two workers beside one, what is lost when something is killed, and many simulated jobs.

    python3 benchmarks/batch.py [--models N] [--from FOLDER] [--no-compare] [--no-kill] [--simulate N]

The package is built from the checkout and installed into a folder of its own. Models are shapes of 300 to 1,500 faces,
or models of a folder decimated to about as many, each copy stretched a little differently. Half of them are done by one
worker, then by two, the other half the other way round. The overhead of a run is the share of its workers' time, from
the first model to the end, in which none of them was at a model; it means something only where nothing else runs.

Then all are done by two workers while a process that computes a model, then a worker, then the whole run are killed
(``kill -9``), and once more to the end: what was recorded as done has to be whole and must not be done again. The exit
status is 1 if it is not so. Simulated models are jobs that do nothing: the time of each is what Dask takes for it.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from contextlib import suppress
from pathlib import Path

import packages

ROOT = packages.ROOT
sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "tests")]
import environments

FEWEST, MOST = 300, 1_500  # faces of a model
SUFFIXES = (".npz", ".obj", ".ply", ".stl", ".glb")
# What is killed after which share of the models.
KILLS = ((0.1, "a process that computes a model"), (0.2, "a worker"), (0.4, "the whole run"))
PATIENCE = 600.0  # seconds in which a model has to be done

SIMULATED = """
import sys, time
import psutil
from reeb_parts.batch import cluster
total = int(sys.argv[1])
memory = psutil.Process().memory_info
with cluster.connected(None, 2, "127.0.0.1:0") as client:
    start = time.perf_counter()
    for number, _ in enumerate(cluster.spread(client, abs, range(total)), 1):
        if number % (total // 10) == 0:
            held = len(client.cluster.scheduler.tasks)
            print(f"{number:>8} {1000 * (time.perf_counter() - start) / (total // 10):6.2f} ms each "
                  f"{memory().rss / 2**20:7.1f} MiB, {held} jobs held", flush=True)
            start = time.perf_counter()
"""


def main() -> int:
    """Run what is asked for; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", type=int, default=2000, metavar="N", help="small models (default: %(default)s)")
    parser.add_argument("--from", type=Path, dest="source", metavar="FOLDER", help="make them of the models there")
    parser.add_argument("--compare", action=argparse.BooleanOptionalAction, default=True, help="two workers beside one")
    parser.add_argument("--kill", action=argparse.BooleanOptionalAction, default=True, help="what a kill costs")
    parser.add_argument("--simulate", type=int, default=0, metavar="N", help="jobs that do nothing")
    parser.add_argument("--make", type=Path, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.make:
        make(arguments.make, arguments.models, arguments.source)
        return 0
    python = environments.prepare(environments.package())
    if Path(sys.prefix).resolve() != python.parent.parent.resolve():
        os.execv(python, [str(python), *sys.argv])
    sound = True
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        variables = _installed(folder)
        if arguments.models:
            # Models of files are read and decimated by what other benchmarks have.
            maker = [environments.prepare(environments.benchmarks()), __file__, "--make", folder / "models", "--models",
                     str(arguments.models), *(("--from", arguments.source) if arguments.source else ())]
            subprocess.run(maker, check=True)
            command = [sys.executable, str(folder / "site" / "bin" / "reeb-parts"), "batch"]
            if arguments.compare:
                compare(command, variables, folder)
            if arguments.kill:
                sound = kill(command, variables, folder)
        if arguments.simulate:
            subprocess.run([sys.executable, "-c", SIMULATED, str(arguments.simulate)], env=variables, check=True)
    return int(not sound)


def _installed(folder: Path) -> dict[str, str]:
    """Build and install the package; returns the variables of a process that has it."""
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet"]
    subprocess.run([*pip, "wheel", "--no-deps", "--no-build-isolation", "-w", folder, ROOT], check=True)
    subprocess.run([*pip, "install", "--no-deps", "--target", folder / "site", *folder.glob("*.whl")], check=True)
    return {**os.environ, "PYTHONPATH": str(folder / "site"), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


def make(out: Path, count: int, source: Path | None) -> None:
    """Write so many models, in turns of each that there is, all of them different."""
    packages.need("numpy", "trimesh", "fast_simplification")
    import numpy as np
    import trimesh

    rng = np.random.default_rng(0)
    bases = _shapes() if source is None else _decimated(source, rng)
    if not bases:
        environments.fail(f"no model in {source}")
    out.mkdir()
    for number in range(count):
        name, (vertices, faces) = bases[number % len(bases)]
        mesh = trimesh.Trimesh(vertices * rng.uniform(0.8, 1.2, 3), faces, process=False)
        mesh.export(out / f"{number:05d}_{name}.ply")
    sizes = [len(faces) for _, (_, faces) in bases]
    print(f"{count} models of {len(bases)} with {min(sizes)} to {max(sizes)} faces", flush=True)


def _shapes() -> list:
    """Names and arrays of shapes that are made by formulas."""
    import shapes

    return [("tree", shapes.tube_tree(4, 0.2)), ("rod", shapes.tube_tree(2, 0.2)), ("torus", shapes.torus(30, 12)),
            ("dumbbell", shapes.dumbbell(24, 14)), ("ring", shapes.surface_of_genus(1, 0.25)),
            ("chain", shapes.surface_of_genus(2, 0.3)), ("horse", shapes.horse(0.16)), ("insect", shapes.insect(0.2)),
            ("jug", shapes.genus_two(0.2)), ("ball", shapes.icosphere(3)), ("cylinder", shapes.cylinder(20, 16))]


def _decimated(folder: Path, rng) -> list:
    """Names and arrays of the models of a folder, with no more faces than a small model has."""
    import fast_simplification
    from meshes import load_mesh

    found = []
    for path in sorted(path for path in folder.rglob("*") if path.suffix.lower() in SUFFIXES):
        vertices, faces = load_mesh(path)
        if len(faces) > MOST:
            wanted = int(rng.integers(FEWEST, MOST))
            vertices, faces = fast_simplification.simplify(vertices.astype("f4"), faces.astype("i4"),
                                                           target_count=wanted)
        found.append((path.stem, (vertices, faces)))
    return found


def compare(command: list[str], variables: dict[str, str], folder: Path) -> None:
    """One worker and two, half of the models at a time and in turns, since others use the machine, too."""
    lists = [folder / f"list_{half}.txt" for half in range(2)]
    paths = sorted(map(str, (folder / "models").iterdir()))
    for half, path in enumerate(lists):
        path.write_text("\n".join(paths[half::2]))
    walls, busy, done = Counter(), Counter(), Counter()
    for half, order in enumerate(((1, 2), (2, 1))):
        for workers in order:
            out = folder / f"out_{half}_{workers}"
            options = ["--list", str(lists[half]), "--out", str(out), "--workers", str(workers), "--dashboard",
                       "127.0.0.1:0"]
            # Of a folder of real models some have no parts; those cost their time, too.
            answer = json.loads(subprocess.run([*command, *options], env=variables, check=False, text=True,
                                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout)
            records = list(out.rglob("record.json"))
            ended = [path.stat().st_mtime for path in records]
            seconds = [json.loads(path.read_text())["model"]["seconds"] for path in records]
            wall = max(ended) - min(end - taken for end, taken in zip(ended, seconds, strict=True))
            walls[workers] += wall
            busy[workers] += sum(seconds)
            done[workers] += len(records)
            print(f"{len(records)} models, {workers} workers: {answer['seconds']:.1f} s in all, {wall:.1f} s from the "
                  f"first model on, {sum(seconds):.1f} s at models; {answer['models']}", flush=True)
    for workers, wall in sorted(walls.items()):
        print(f"{workers} workers: {done[workers] / wall:.2f} models a second, overhead "
              f"{1 - busy[workers] / (workers * wall):.1%}")
    print(f"two workers do {walls[1] / walls[2]:.2f} times what one does", flush=True)


def kill(command: list[str], variables: dict[str, str], folder: Path) -> bool:
    """Kill what KILLS says in one run, and have a second one end it; whether nothing was lost."""
    out, models = folder / "killed", folder / "models"
    count = len(list(models.iterdir()))
    every = [*command, str(models), "--out", str(out), "--workers", "2", "--dashboard", "127.0.0.1:0"]
    _killed(subprocess.Popen(every, env=variables, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                             start_new_session=True), out, count)
    before = _records(out)
    stamps = {name: _stamp(out, name) for name, record in before.items()
              if record["status"] in ("done", "refused", "unreadable")}
    again = subprocess.run(every, env=variables, check=False, text=True, stdout=subprocess.PIPE,
                           stderr=subprocess.DEVNULL)
    answer = json.loads(again.stdout)
    print(f"recorded before: {dict(Counter(record['status'] for record in before.values()))}, "
          f"kept: {answer['kept']}, in the end: {answer['models']}", flush=True)
    wrong = _lost(out, count, before, stamps, answer)
    for words, names in wrong.items():
        if names:
            print(f"{len(names)}: {words}, such as {names[0]}", flush=True)
    sound = not any(wrong.values())
    print("nothing was lost" if sound else "NOT ALL OF IT HOLDS", flush=True)
    return sound


def _killed(run: subprocess.Popen, out: Path, count: int) -> None:
    """Kill what KILLS says in a run over so many models, each at its time."""
    import psutil

    for share, what in KILLS:
        _wait(out, int(share * count), run)
        children = psutil.Process(run.pid).children(recursive=True)
        if what == "the whole run":
            os.killpg(run.pid, signal.SIGKILL)
            run.wait()
            psutil.wait_procs(children, timeout=60)  # what computes ends when it sees that it is alone
        else:
            computing = _computing(run)
            (computing if what == "a process that computes a model" else computing.parent()).kill()
        print(f"killed {what} when {len(_records(out))} of {count} models had a record", flush=True)


def _lost(
    out: Path, count: int, before: dict[str, dict], stamps: dict[str, tuple], answer: dict
) -> dict[str, list[str]]:
    """What does not hold after a run that was killed and one more, and the models, by what is wrong with them.

    before : the records of the first run. stamps : of the models it was done with. answer : that of the second run.
    """
    after = _records(out)
    return {
        "was recorded and is not whole": [name for name in stamps if not _whole(out, name, before[name])],
        "was done and was done again": [name for name in stamps if _stamp(out, name) != stamps[name]],
        "was done and was not kept": [] if answer["kept"] == len(stamps) else [
            f"{len(stamps) - answer['kept']} models"],
        "is not whole in the end": [name for name, record in after.items() if not _whole(out, name, record)],
        "was never reached": [] if len(after) == sum(answer["models"].values()) == count else [f"{len(after)} records"],
        "crashed, and was not tried again": [name for name, record in after.items() if record["status"] == "crash"],
        "is left under a hidden name": [str(path) for path in out.rglob(".reeb_parts_*")],
        "is not as the tables have it": _untabled(out, after),
    }


def _computing(run: subprocess.Popen):
    """A process that computes models, as psutil has it; the one that started it is a worker."""
    import psutil

    while True:
        if run.poll() is not None:
            environments.fail("the run ended before its time")
        for child in psutil.Process(run.pid).children(recursive=True):
            with suppress(psutil.Error):  # it has just ended
                if "reeb_parts.batch.model_process" in child.cmdline():
                    return child
        time.sleep(0.05)


def _wait(out: Path, count: int, run: subprocess.Popen) -> None:
    """Wait until so many models have a record."""
    known, since = -1, time.monotonic()
    while known < count:
        found = len(list((out / "models").glob("*/record.json")))
        if found > known:
            known, since = found, time.monotonic()
        if run.poll() is not None or time.monotonic() > since + PATIENCE:
            environments.fail(f"the run ended or stood still at {known} models, before {count}")
        time.sleep(0.05)


def _records(out: Path) -> dict[str, dict]:
    """The record of each model that has one, by the name of its folder."""
    return {path.parent.name: json.loads(path.read_text()) for path in (out / "models").glob("*/record.json")}


def _stamp(out: Path, name: str) -> tuple:
    """What changes when the results of a model are written again."""
    files = sorted((out / "models" / name).rglob("*"))
    return tuple((path.name, path.stat().st_ino, path.stat().st_mtime_ns) for path in files)


def _whole(out: Path, name: str, record: dict) -> bool:
    """Whether all files that a record names are there, as long as it says, and can be read."""
    import numpy as np

    folder = out / "models" / name
    if any(not (folder / file).is_file() or (folder / file).stat().st_size != size
           for file, size in record["files"].items()):
        return False
    return record["status"] != "done" or (
        len(np.load(folder / "labels.npy")) == record["model"]["faces"]
        and len(json.loads((folder / "model.json").read_text())["objects"][0]["parts"]) == record["model"]["n_parts"]
        and (folder / "thumbnail.png").read_bytes()[-8:-4] == b"IEND")


def _untabled(out: Path, records: dict[str, dict]) -> list[str]:
    """Models that the tables or the page have otherwise than the records."""
    from pyarrow import parquet

    rows = {row["name"]: row for row in parquet.read_table(out / "models.parquet").to_pylist()}
    parts = Counter(parquet.read_table(out / "parts.parquet", columns=["model"]).column("model").to_pylist())
    page = (out / "index.html").read_text(encoding="utf-8").split('id="models">')[1].split("</script>")[0]
    shown = {model["name"]: model["status"] for model in json.loads(page)}
    return [name for name, record in records.items()
            if name not in rows or rows[name]["status"] != record["status"] or shown.get(name) != record["status"]
            or parts[name] != len(record["parts"])]


if __name__ == "__main__":
    began = time.perf_counter()
    status = main()
    print(f"{time.perf_counter() - began:.0f} s")
    sys.exit(status)
