# SPDX-License-Identifier: GPL-3.0-or-later
"""The same input has the same answer with every version of NumPy and SciPy, and on every machine.

The answers are in tests/data/everywhere.json. Where the method changes on purpose, they are written anew by

    REEB_PARTS_ANSWERS=write python3 -m pytest tests/unit/test_everywhere.py

in one environment, and hold in all others.
"""

import hashlib
import json
import os
import platform
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import shapes

from core import PRESETS, Parameters, decompose
from core.parameters import LIU

ANSWERS = Path(__file__).parents[1] / "data" / "everywhere.json"
# Even and symmetric shapes, on which much is equal but for rounding.
SHAPES = {
    "tube": lambda: shapes.cylinder(12, 24, capped=True),
    "torus": lambda: shapes.torus(24, 12),
    "ball": lambda: shapes.icosphere(3),
    "box": lambda: shapes.box((1.0, 2.0, 3.0)),
    "tree": shapes.tube_tree,
    "figure": shapes.mirrored_figure,
    "dumbbell": lambda: shapes.dumbbell(20, 8),
    "sheet": lambda: shapes.flat_grid(9, 9),
    "pan": lambda: shapes.together(shapes.cylinder(4, 32, capped=True),
                                   shapes.moved(shapes.box((3.0, 0.2, 0.2)), (2.0, 0.0, 0.0))),
    "turned torus": lambda: shapes.Shape(
        shapes.torus(24, 12).vertices @ shapes.rotation(np.random.default_rng(0)).T, shapes.torus(24, 12).faces),
}


def answer(name, preset):
    vertices, faces = SHAPES[name]()
    # Without the last digits, in which the sine of one version differs from that of another.
    result = decompose(vertices.round(9), faces, Parameters.preset(preset))
    arrays = result.candidates, result.hierarchy.merges, result.graph.arcs
    digest = hashlib.sha256(b"".join(np.ascontiguousarray(a, "<i8").tobytes() for a in arrays)).hexdigest()
    return [result.n_candidates, result.parts().count, digest[:16]]


# Eigenvectors of equal eigenvalues, by which "Liu 2007" cuts symmetric shapes, are up to the version of LAPACK.
@pytest.mark.parametrize("preset", [name for name, preset in PRESETS.items() if preset.method != LIU])
@pytest.mark.parametrize("name", list(SHAPES))
def test_the_same_answer_everywhere(name, preset):
    known = json.loads(ANSWERS.read_text()) if ANSWERS.exists() else {}
    found = answer(name, preset)
    if os.environ.get("REEB_PARTS_ANSWERS") == "write":
        known[f"{name}, {preset}"] = found
        lines = (f" {json.dumps(key)}: {json.dumps(value)}" for key, value in sorted(known.items()))
        ANSWERS.write_text("{\n" + ",\n".join(lines) + "\n}\n")
    assert known[f"{name}, {preset}"] == found


# Prints what NumPy can do on this processor and need not.
OPTIONAL = """
try:
    from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__
except ImportError:  # NumPy 1
    from numpy.core._multiarray_umath import __cpu_dispatch__, __cpu_features__
print(*(name for name in __cpu_dispatch__ if __cpu_features__[name]))
"""


@pytest.mark.skipif(platform.machine() not in {"x86_64", "AMD64"}, reason="OpenBLAS has a name for its oldest kernels")
def test_the_same_answer_on_an_older_processor():
    """Without AVX and all that came after it: sums and products of other instructions have other last digits."""
    def run(*options, **variables):
        return subprocess.run([sys.executable, *options], env={**os.environ, **variables}, check=False,
                              capture_output=True, text=True)

    there = run("-c", OPTIONAL).stdout.split()
    if not there:
        pytest.skip("this is one")
    # Within Blender a process of its own has no packages but by their paths.
    without = {"NPY_DISABLE_CPU_FEATURES": " ".join(there), "OPENBLAS_CORETYPE": "Nehalem",
               "PYTHONPATH": os.pathsep.join(sys.path)}
    assert run("-c", OPTIONAL, **without).stdout.split() == []
    again = run("-m", "pytest", "-q", "-p", "no:cacheprovider", __file__, "-k",
                test_the_same_answer_everywhere.__name__, **without, REEB_PARTS_ANSWERS="")
    assert again.returncode == 0, again.stdout
