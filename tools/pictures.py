# SPDX-License-Identifier: GPL-3.0-or-later
"""Make docs/models.md and its pictures anew: seven models, each cut with every preset.

    python3 tools/pictures.py FOLDER

FOLDER has cow.obj, stanford-bunny.obj, rocker-arm.obj and teapot.obj from the public collection of common 3D
test models; they are not part of this repository. Spot is in models/, Suzanne comes out of Blender, and the
jug with two handles out of tests/shapes.py.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import environments
from environments import ROOT, say

IMAGES = ROOT / "docs" / "images" / "models"
PAGE = ROOT / "docs" / "models.md"
SIZE = "640x360"


@dataclass(frozen=True)
class Model:
    """A model of the page."""

    file: str
    title: str
    origin: str
    turn: int = 0  # degrees that the camera goes around it


MODELS = (
    Model("spot.obj", "Spot", "Keenan Crane, CC0, in models/", 180),
    Model("cow.obj", "Cow", "Viewpoint Animation Engineering", 65),
    Model("stanford-bunny.obj", "Stanford bunny",
          "Stanford, with holes in its base; of its 35,947 vertices Blender reads those of faces"),
    Model("rocker-arm.obj", "Rocker arm", "INRIA, genus 1", 120),
    Model("teapot.obj", "Utah teapot", "Martin Newell, four loose parts with open borders"),
    Model("suzanne.obj", "Suzanne", "Blender's monkey, subdivided; three loose parts", 15),
    Model("genus_two.obj", "Genus two", "made by tests/shapes.py"),
)

MAKE_OWN = """
import sys, bpy
from pathlib import Path
folder = Path(sys.argv[1])
bpy.ops.wm.read_homefile(use_empty=True)
bpy.ops.mesh.primitive_monkey_add()
bpy.context.object.modifiers.new("Subdivision", "SUBSURF").levels = 2
bpy.ops.object.modifier_apply(modifier="Subdivision")
bpy.ops.wm.obj_export(filepath=str(folder / "suzanne.obj"), export_materials=False)
import shapes
vertices, faces = shapes.genus_two()
lines = [f"v {x} {z} {-y}" for x, y, z in vertices.tolist()] + [f"f {a} {b} {c}" for a, b, c in (faces + 1).tolist()]
(folder / "genus_two.obj").write_text("\\n".join(lines) + "\\n")
"""


def main() -> None:
    """Make the models, decompose and render each, write the page."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, metavar="FOLDER")
    parser.add_argument("--only", nargs="+", metavar="FILE", help="only these models; the page stays as it is")
    arguments = parser.parse_args()
    python = environments.prepare(environments.BLENDER_52)
    presets = _presets(python)
    IMAGES.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as own:
        run = [str(python), "-c", MAKE_OWN, own]
        variables = {**os.environ, "PYTHONPATH": str(ROOT / "tests")}
        subprocess.run(run, check=True, stdout=subprocess.DEVNULL, env=variables)
        reports = {}
        for model in MODELS:
            if arguments.only and model.file not in arguments.only:
                continue
            homes = (ROOT / "models", Path(own), arguments.folder)
            path = next(home / model.file for home in homes if (home / model.file).is_file())
            for preset in presets:
                say(f"{model.file}, {preset}")
                reports[model, preset] = _decompose(python, path, model, preset)
    if not arguments.only:
        PAGE.write_text(_page(presets, reports), encoding="utf-8")


def _presets(python: Path) -> list[str]:
    """Names of the presets, the default first."""
    code = "import json, core; print(json.dumps(list(core.PRESETS)))"
    return json.loads(subprocess.run([str(python), "-c", code], cwd=ROOT, check=True, capture_output=True).stdout)


def _image(model: Model, preset: str) -> Path:
    """Where the picture of a model goes."""
    return IMAGES / f"{Path(model.file).stem}_{preset.split()[0].lower()}.png"


def _decompose(python: Path, path: Path, model: Model, preset: str) -> dict:
    """The command's report on one model; its picture is written."""
    image = _image(model, preset)
    return decompose_and_picture(
        python, ROOT, path, image, SIZE, "--preset", preset, "--picture-turn", str(model.turn))


def decompose_and_picture(
    python: Path, checkout: Path, path: Path, image: Path, size: str, *options: str
) -> list[dict]:
    """The report on the objects of one model by the command of a checkout, which writes a picture, too."""
    with tempfile.TemporaryDirectory() as settings:
        command = [
            str(python), str(checkout / "tools" / "in_blender.py"), str(path),
            "--picture", str(image), "--picture-size", size, *options,
        ]
        variables = {**os.environ, "BLENDER_USER_RESOURCES": settings}
        done = subprocess.run(command, check=False, capture_output=True, text=True, env=variables)
    if done.returncode:
        sys.exit(done.stderr)
    return json.loads(done.stdout[done.stdout.index("{") :])["objects"]


def _page(presets: list[str], reports: dict) -> str:
    """The page as Markdown."""
    lines = [
        "# Seven models", "",
        "Made by `tools/pictures.py`, with every preset as it is and no number of parts given. The black lines are "
        "the Reeb graph: black balls are minima of the field (the middle of the body), yellow ones saddles, white "
        "ones maxima (the tips). With another version of SciPy, Liu 2007 may give a part or two more or fewer.",
        "",
    ]
    for model in MODELS:
        lines += [f"## {model.title}", f"{model.origin}.", ""]
        lines += [f"| {' | '.join(presets)} |", "|" + " --- |" * len(presets)]
        cells = [f"![{model.title} in parts]({_image(model, preset).relative_to(PAGE.parent)})" for preset in presets]
        lines += [f"| {' | '.join(cells)} |"]
        cells = [_facts(reports[model, preset]) for preset in presets]
        lines += [f"| {' | '.join(cells)} |", ""]
    return "\n".join(lines).rstrip() + "\n"


def _facts(objects: list[dict]) -> str:
    """Size of a model, its parts and its graph, in words."""
    vertices, faces, parts, nodes, loops = (
        sum(count(entry) for entry in objects)
        for count in (
            lambda entry: entry["vertices"], lambda entry: entry["faces"], lambda entry: len(entry["parts"]),
            lambda entry: len(entry["graph"]["nodes"]), lambda entry: entry["graph"]["loops"],
        )
    )
    loops = f"{loops} loop" + ("" if loops == 1 else "s")
    return f"{vertices:,} vertices, {faces:,} faces: {parts} parts; graph of {nodes} nodes with {loops}"


if __name__ == "__main__":
    main()
