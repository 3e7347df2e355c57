# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare what two checkouts make of the same meshes, bit by bit.

    python3 benchmarks/same_results.py OTHER MESHES [MESHES ...] [--preset NAME ...]

OTHER is the folder of another checkout, MESHES are .npz with `vertices` and `faces`, .obj, .ply or .stl. Each mesh is
decomposed by both checkouts with all presets or those given. Compared are all public arrays of the result - candidates,
field, hierarchy, graph - and of the parts at five levels of detail. An array that only one of the checkouts has is
named: it may have been renamed. The exit status is 1 if an array that both have differs.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import packages

packages.need("numpy", "scipy", "trimesh")

import numpy as np
from meshes import load_mesh

DETAILS = (0.0, 0.25, 0.5, 0.75, 1.0)


def main() -> int:
    """Print a row for each mesh and preset; returns the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("other", type=Path, metavar="OTHER")
    parser.add_argument("meshes", nargs="+", type=Path, metavar="MESHES")
    parser.add_argument("--preset", nargs="+", metavar="NAME", help="default: all that this checkout has")
    parser.add_argument("--write", type=Path, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.write:
        write(arguments.other, arguments.meshes[0], arguments.preset[0], arguments.write)
        return 0
    if not (arguments.other / "core").is_dir():
        parser.error(f"{arguments.other} is no checkout: it has no folder core")
    from core import PRESETS  # not above: where arrays are written, core is that of either checkout

    print("| mesh | preset | arrays | different | only here | only there |\n" + "| --- " * 6 + "|")
    same = True
    for path in arguments.meshes:
        for preset in arguments.preset or PRESETS:
            here, there = (decomposed(checkout, path, preset) for checkout in (packages.ROOT, arguments.other))
            both = sorted(here.keys() & there.keys())
            different = [name for name in both if not equal(here[name], there[name])]
            print(f"| {path.stem} | {preset} | {len(both)} | {', '.join(different) or 'none'} | "
                  f"{only(here, there)} | {only(there, here)} |", flush=True)
            same &= bool(both) and not different
    return 0 if same else 1


def decomposed(checkout: Path, path: Path, preset: str) -> dict[str, np.ndarray]:
    """The arrays that a checkout makes of a mesh, in a process of its own."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "arrays.npz"
        command = [sys.executable, __file__, str(checkout), str(path), "--preset", preset, "--write", str(file)]
        subprocess.run(command, check=True)
        with np.load(file) as stored:
            return dict(stored)


def write(checkout: Path, path: Path, preset: str, file: Path) -> None:
    """Decompose with the core of a checkout and store the arrays."""
    sys.path.insert(0, str(checkout.resolve()))
    from core import Parameters, decompose

    result = decompose(*load_mesh(path), Parameters.preset(preset))
    found = arrays(result)
    for name in ("hierarchy", "graph"):
        found |= {f"{name}.{key}": value for key, value in arrays(getattr(result, name)).items()}
    for detail in DETAILS:
        found |= {f"parts.{key} at {detail}": value for key, value in arrays(result.parts(detail)).items()}
    np.savez(file, **found)


def arrays(value: object) -> dict[str, np.ndarray]:
    """The public attributes of an object that are arrays, computed ones included."""
    public = {name: getattr(value, name) for name in dir(value) if not name.startswith("_")}
    return {name: part for name, part in public.items() if isinstance(part, np.ndarray)}


def only(one: dict, other: dict) -> str:
    """The names that the other has not, each once."""
    return ", ".join(sorted({name.split(" at ")[0] for name in one.keys() - other.keys()})) or "none"


def equal(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether two arrays have the same type, shape and bytes."""
    return one.dtype == other.dtype and one.shape == other.shape and one.tobytes() == other.tobytes()


if __name__ == "__main__":
    sys.exit(main())
