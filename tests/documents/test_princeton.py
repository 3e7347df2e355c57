# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of the Princeton Segmentation Benchmark, made by hand, as benchmarks read them."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
POINTS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.5]]
FACES = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]


@pytest.fixture
def benchmark(tmp_path):
    """The benchmark's folder with two tetrahedra: people are numbered, and the tenth comes after the second."""
    source = tmp_path / "MeshsegBenchmark-1.0"
    (source / "data" / "off").mkdir(parents=True)
    rows = [*(" ".join(map(str, point)) for point in POINTS), *("3 " + " ".join(map(str, face)) for face in FACES)]
    drawn = {0: [0, 0, 1, 1], 2: [0, 0, 0, 0], 10: [2, 1, 0, 1]}
    for number in (5, 6):
        (source / "data" / "off" / f"{number}.off").write_text("\n".join(["OFF", "4 4 0", *rows, ""]))
        folder = source / "data" / "seg" / "Benchmark" / str(number)
        folder.mkdir(parents=True)
        for person, labels in drawn.items():
            (folder / f"{number}_{person}.seg").write_text("".join(f"{label}\n" for label in labels))
    return source, list(drawn.values())


def convert(source, out):
    program = str(ROOT / "benchmarks" / "princeton.py")
    return subprocess.run([sys.executable, program, str(source), str(out)], capture_output=True, text=True)


def test_meshes_and_what_people_drew_are_as_in_the_files(benchmark, tmp_path):
    source, drawn = benchmark
    done = convert(source, tmp_path / "out")
    assert done.returncode == 0, done.stderr
    made = sorted(path.relative_to(tmp_path / "out").as_posix() for path in (tmp_path / "out").rglob("*.npz"))
    assert made == ["half/5.npz", "rest/6.npz"]
    for name in made:
        with np.load(tmp_path / "out" / name) as mesh:
            assert set(mesh) == {"vertices", "faces", "human"}
            assert mesh["vertices"].tolist() == POINTS
            assert mesh["faces"].tolist() == FACES
            assert mesh["human"].tolist() == drawn


def test_labels_of_another_mesh_are_refused(benchmark, tmp_path):
    source, _ = benchmark
    (source / "data" / "seg" / "Benchmark" / "5" / "5_2.seg").write_text("0\n1\n")
    done = convert(source, tmp_path / "out")
    assert done.returncode != 0
    assert "5_2.seg has 2 lines, but its mesh 4 faces" in done.stderr


def test_a_folder_of_something_else_is_refused(tmp_path):
    done = convert(tmp_path, tmp_path / "out")
    assert done.returncode != 0
    assert "holds none of the models" in done.stderr
