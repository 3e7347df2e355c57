# SPDX-License-Identifier: GPL-3.0-or-later
"""Make docs/artists.md and its pictures anew: twenty models as artists make them, in parts.

    python3 tools/gallery.py FOLDER [--before CHECKOUT]

FOLDER has labelled/ and materials/, whose NAME.npz hold ``vertices`` (n, 3) and ``faces`` (m, 3) of models by
Quaternius, CC0; they are not part of this repository. CHECKOUT is an older one, of which pictures are made, too.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

import environments
import numpy as np
from environments import ROOT, say
from pictures import decompose_and_picture

IMAGES = ROOT / "docs" / "images" / "artists"
PAGE = ROOT / "docs" / "artists.md"
SIZE = "320x240"
COUNTS = {"labelled": 12, "materials": 8}  # models of each folder, at equal steps through their names


def main() -> None:
    """Decompose and render each model, write the page."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, metavar="FOLDER")
    parser.add_argument("--before", type=Path, metavar="CHECKOUT")
    arguments = parser.parse_args()
    python = environments.prepare(environments.BLENDER_52)
    IMAGES.mkdir(parents=True, exist_ok=True)
    rows = []
    with tempfile.TemporaryDirectory() as made:
        for path in _chosen(arguments.folder):
            say(path.stem)
            model = _as_obj(path, Path(made) / f"{path.stem}.obj")
            cells = [path.stem.split(".", 1)[1].replace("_", " ")]
            for name, checkout in (("before", arguments.before), ("now", ROOT)):
                image = IMAGES / f"{path.stem}_{name}.png"
                if checkout is not None:
                    objects = decompose_and_picture(python, checkout, model, image, SIZE)
                    n_parts = sum(len(entry["parts"]) for entry in objects)
                    parts = "1 part" if n_parts == 1 else f"{n_parts} parts"
                    cells.append(f"![{cells[0]} {name}]({image.relative_to(PAGE.parent)})<br>{parts}")
            rows.append(cells)
    PAGE.write_text(_page(rows), encoding="utf-8")


def _chosen(folder: Path) -> list[Path]:
    """Models at equal steps through the names in each folder."""
    chosen = []
    for name, count in COUNTS.items():
        files = sorted((folder / name).glob("*.npz"))
        chosen += [files[round(k)] for k in np.linspace(0, len(files) - 1, count)]
    return chosen


def _as_obj(path: Path, target: Path) -> Path:
    """Write a model as .obj."""
    with np.load(path) as stored:
        vertices, faces = stored["vertices"], stored["faces"]
    lines = [f"v {x} {y} {z}" for x, y, z in vertices.tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (faces + 1).tolist()]
    target.write_text("\n".join(lines) + "\n")
    return target


def _page(rows: list[list[str]]) -> str:
    """The page as Markdown."""
    titles = ["model", "version 0.1.0", "now"] if len(rows[0]) == 3 else ["model", "now"]
    lines = [
        "# Twenty models as artists make them", "",
        "Models by Quaternius (CC0), at equal steps through a collection, none chosen for its looks: rigged figures, "
        "then furniture, tools, plants, ships. Made by `tools/gallery.py` with the default preset and no number of "
        "parts.",
        "",
        f"| {' | '.join(titles)} |", "|" + " --- |" * len(titles),
        *(f"| {' | '.join(cells)} |" for cells in rows),
    ]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()
