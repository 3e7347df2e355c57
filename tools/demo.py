# SPDX-License-Identifier: GPL-3.0-or-later
"""Set everything up, cut a model into its parts and leave the results in a folder.

    ./demo                          on the bundled model, a cow called Spot
    ./demo MODEL [MODEL ...]        on your own: .obj .ply .stl .glb .fbx .usd .abc, or a .blend scene

For each model, out/ then holds NAME.blend to open in Blender, NAME.json with the parts and the Reeb graph
as data, and NAME.png, a picture of both.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import tempfile
from pathlib import Path

import environments
from environments import ROOT, fail, say

SUFFIXES = (".obj", ".ply", ".stl", ".glb", ".gltf", ".fbx", ".usd", ".usda", ".usdc", ".usdz", ".abc", ".blend")
#: Spot looks the other way than most models do.
SPOT, SPOT_TURN = ROOT / "models" / "spot.obj", 180.0


def main() -> None:
    """Make the environment and run the command on each model in it."""
    parser = argparse.ArgumentParser(
        prog="./demo", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("models", nargs="*", type=Path, metavar="MODEL", help="default: models/spot.obj")
    parser.add_argument("--out", type=Path, default=Path("out"), metavar="DIR", help="default: out/ here")
    parser.add_argument("--detail", metavar="D", help="0 for few parts, 1 for as many as there are")
    parser.add_argument("--turn", type=float, metavar="DEGREES", help="turn the picture's camera around the model")
    arguments = parser.parse_args()
    models = arguments.models or [SPOT]
    for model in models:
        if not model.is_file():
            fail(f"{model} does not exist.")
        if model.suffix.lower() not in SUFFIXES:
            fail(f"{model} is of no kind that can be read; there are: {' '.join(SUFFIXES)}")
    if len({model.stem for model in models}) < len(models):
        fail("two of the models have the same name, so their results would overwrite each other.")

    environment = environments.any_blender()
    say(f"setting up {environment.packages[0].replace('==', ' ')}, the Blender of Python {environment.python}")
    python = environments.prepare(environment)
    arguments.out.mkdir(parents=True, exist_ok=True)
    failed = 0
    for number, model in enumerate(models, 1):
        say(f"model {number} of {len(models)}: {model}")
        failed += _run(python, model, arguments)
    if failed:
        fail(f"{failed} of {len(models)} models failed, see above.")
    say(f"done; look into {arguments.out.resolve()}")


def _run(python: Path, model: Path, arguments: argparse.Namespace) -> bool:
    """Decompose one model in a process of its own; whether that failed."""
    stem = arguments.out / model.stem
    turn = arguments.turn if arguments.turn is not None else SPOT_TURN * (model.resolve() == SPOT)
    command = [
        str(python), str(ROOT / "tools" / "in_blender.py"), str(model), "--save", f"{stem}.blend",
        "--json", f"{stem}.json", "--picture", f"{stem}.png", "--picture-turn", str(turn),
        *(["--detail", arguments.detail] if arguments.detail else []),
    ]
    with tempfile.TemporaryDirectory() as settings:
        variables = {**os.environ, "BLENDER_USER_RESOURCES": settings}
        # Its one JSON object on standard output is in the file as well.
        run = subprocess.run(command, env=variables, stdout=subprocess.DEVNULL, check=False)
    if run.returncode:
        return True
    for suffix in (".blend", ".json", ".png"):
        path = Path(f"{stem}{suffix}")  # the stem may have a dot
        say(f"wrote {path} ({path.stat().st_size / 1e3:.0f} kB)")
    return False


if __name__ == "__main__":
    main()
