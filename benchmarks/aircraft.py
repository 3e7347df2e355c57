# SPDX-License-Identifier: GPL-3.0-or-later
"""Aircraft of FlightGear as labelled meshes: their parts are what the names of their objects say.

    python3 benchmarks/aircraft.py FOLDER OUT

FOLDER holds models of FlightGear in AC3D's format (.ac): AI/Aircraft and Models of its data 2020.3.16. OUT gets
PACK.NAME.npz with ``vertices``, ``faces`` and ``human``: fuselage, each wing, each tailplane, the fin, and each engine,
propeller and leg of the undercarriage. A pack is an aircraft. Left out is what is not solid (a propeller's blur, the
cones of lights) and what is within (seats, panels), and aircraft whose objects have few names or names that say little.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import packages

packages.need("numpy", "scipy", "tqdm")

import numpy as np
from meshes import joined_alone, some, source_and_target, stacked, write_labelled
from scipy.sparse.csgraph import connected_components
from tqdm import tqdm

from core.mesh.triangles import TriMesh

#: What the name of an object, in English, French or Spanish, says it is: the first that has one of the words.
WORDS = {name: re.compile(words, re.IGNORECASE) for name, words in {
    "none": "blur|prop.?dis|disque|disk|flame|cone.?tex|light|lamp|shadow|beacon|strobe|glow|smoke|burner|wake|rope|"
            "logo|flash|nav|led$|text|decal|panel|gauge|instrument|seat|pilot|throttle|mixture|pedestal|cockpit|siege|"
            "interior|yoke|stick|pedal|chute|hose|drogue|gear_open",
    "wing": r"ai?l[ei]r?on|flap|slat|spoiler|elevon|volet|winglet|wing|aile|alas|aubans",
    "propeller": r"prop|prplr|helice|spinner|rotor|blade|boss|hub|bol[dg]?\b|bol$",
    "gear": r"gear|wheel|strut|tyre|tire|roue|axe|axle|train|oleo|porte[adg][bhdg]?\d?|bogey|damper|uc[-_]|bequille|"
            r"cacheroue|[rln]mg|ndoor|scissor|carenage|jambe|amort|rgdoor",
    "engine": "eng|moteur|nacelle|pylon|exhaust|echap|intake|inlet|nozz|nozl|turbine|reverser|motor|cowl|capot|"
              "tailpipe|compress|fan",
    "tail": "stab|fin(?!g)|rudder|tail|derive|direction|profondeur|elevator|timon|cola|empennage|gouv",
    "fuselage": "fus|body|hull|cabin|nose|canopy|glass|vitre|window|door|porte|verriere|cuerpo|tour|hublot|roof|trous|"
                "antenn|pito|airs?$|radome|dome|windshield|vent",
}.items()}
EACH = ("engine", "propeller", "gear")  # of which an aircraft has several
MIDDLE = 0.05  # share of half the span within which an object is on neither side
NEAR = 0.015  # share of the diagonal: pieces of one engine, propeller or leg are no farther apart
LEAST_NAMED, LEAST_FUSELAGE, LEAST_WING = 0.85, 0.1, 0.08  # shares of the area
LEAST_FACES, MOST_FACES = 300, 40_000
SAME = 1e-6  # share of the diagonal within which vertices are one


@dataclass(frozen=True, eq=False)
class Piece:
    """An object of a model: what it is, vertices (n, 3) and triangles (m, 3)."""

    kind: str
    vertices: np.ndarray
    faces: np.ndarray


# AC3D's format. Of the libraries that read it none that pip installs takes files with lines beside polygons. ----------


def read(path: Path) -> list[Piece]:
    """The objects of a model that have polygons; x is backwards, y upwards, z to the left."""
    blocks = re.split(r"^OBJECT +", path.read_text(errors="replace"), flags=re.MULTILINE)[1:]
    return list(_pieces(iter(blocks), np.eye(4), "", 1))


def _pieces(blocks: Iterator[str], place: np.ndarray, above: str, count: int) -> Iterator[Piece]:
    """So many objects and those below them; above : what the object is that they belong to."""
    for _, block in zip(range(count), blocks, strict=False):  # some files end before all are there
        kind, here = kind_of(_words(block, "name")) or above, place @ _placement(block)
        vertices = _vertices(block)
        if faces := list(_triangles(block)):
            yield Piece(kind, vertices @ here[:3, :3].T + here[:3, 3], np.array(faces))
        yield from _pieces(blocks, here, kind, int(_words(block, "kids") or 0))


def _words(block: str, key: str) -> str:
    """What stands behind a key of an object."""
    found = re.search(rf"^{key} +(.*)$", block, re.MULTILINE)
    return found[1].strip().strip('"') if found else ""


def _placement(block: str) -> np.ndarray:
    """(4, 4), of an object in the one that it belongs to."""
    place = np.eye(4)
    if turned := _words(block, "rot"):
        place[:3, :3] = np.array(turned.split(), float).reshape(3, 3).T
    if moved := _words(block, "loc"):
        place[:3, 3] = np.array(moved.split(), float)
    return place


def _vertices(block: str) -> np.ndarray:
    """(n, 3), of an object in its own frame; normals may stand behind them."""
    found = re.search(r"^numvert \d+\n((?:[-+.\d].*\n)*)", block, re.MULTILINE)
    return np.array([line.split()[:3] for line in found[1].splitlines()] if found else [], float).reshape(-1, 3)


def _triangles(block: str) -> Iterator[tuple[int, int, int]]:
    """The polygons of an object as fans; lines are left out."""
    for flags, rows in re.findall(r"^SURF +(\S+) *\n(?:mat .*\n)?refs \d+ *\n((?:\d.*\n)*)", block, re.MULTILINE):
        corners = [int(row.split()[0]) for row in rows.splitlines()]
        if int(flags, 16) & 15 == 0:
            yield from ((corners[0], *two) for two in zip(corners[1:], corners[2:], strict=False))


# Parts ----------------------------------------------------------------------------------------------------------------


def kind_of(name: str) -> str:
    """What an object of that name is; nothing if the name does not say."""
    return next((kind for kind, words in WORDS.items() if words.search(name)), "")


def labelled(pieces: list[Piece]) -> dict[str, np.ndarray]:
    """Vertices, faces and labels, ``human`` (1, m), of an aircraft; nothing if it is not to be learned from."""
    pieces = [piece for piece in pieces if piece.kind != "none"]
    if not pieces:
        return {}
    vertices, faces, piece = stacked([p.vertices for p in pieces], [p.faces for p in pieces])
    diagonal = np.linalg.norm(np.ptp(vertices[faces].reshape(-1, 3), axis=0))
    vertices, faces, whole = joined_alone(vertices, faces, SAME * diagonal)
    corners, kind = vertices[faces], np.array([p.kind for p in pieces])[piece[whole]]
    area = TriMesh(vertices, faces).face_area
    share = {name: area[kind == name].sum() / area.sum() for name in ("", "fuselage", "wing")}
    named = 1 - share[""] >= LEAST_NAMED and share["fuselage"] >= LEAST_FUSELAGE and share["wing"] >= LEAST_WING
    if not (named and LEAST_FACES <= len(faces) <= MOST_FACES):
        return {}
    part = parts(corners, kind, piece[whole], NEAR * diagonal)
    return {"vertices": vertices, "faces": faces, "human": np.unique(part, return_inverse=True)[1][None]}


def parts(corners: np.ndarray, kind: np.ndarray, piece: np.ndarray, near: float) -> np.ndarray:
    """Name of the part of each face, (m,) of str.

    corners : (m, 3, 3) float64. kind : (m,) of str, what each is. piece : (m,), the object of each.
    """
    beside = corners[:, :, 2].mean(axis=1)
    side = np.where(np.abs(beside) < MIDDLE * np.abs(beside).max(), 0, np.sign(beside)).astype(int)
    part = np.full(len(kind), "fuselage", dtype="<U20")
    part[kind == "wing"] = np.char.add("wing ", np.where(beside[kind == "wing"] < 0, "right", "left"))
    part[kind == "tail"] = np.array(["fin", "tailplane left", "tailplane right"])[side[kind == "tail"]]
    for name in EACH:
        of = np.flatnonzero(kind == name)
        _, unit = np.unique(np.stack([piece[of], side[of]], axis=1), axis=0, return_inverse=True)
        unit = unit.reshape(-1)
        low, high = np.full((2, unit.max(initial=-1) + 1, 3), [[[np.inf]], [[-np.inf]]])
        np.minimum.at(low, unit, corners[of].min(axis=1))
        np.maximum.at(high, unit, corners[of].max(axis=1))
        gap = np.maximum(low[:, None] - high, low - high[:, None]).clip(0)  # between the boxes around them
        _, group = connected_components(np.linalg.norm(gap, axis=2) <= near)
        part[of] = np.char.add(f"{name} ", group[unit].astype(str))
    return part


def main() -> None:
    folder, out = source_and_target(__doc__)
    seen = set()
    for path in tqdm(some(sorted(folder.rglob("*.ac")), folder)):
        arrays = labelled(read(path))
        if arrays and (painted := arrays["vertices"].tobytes()) not in seen:  # some are there in several paints
            seen.add(painted)
            pack = path.parent.parent.name if path.parent.name.startswith("Model") else path.parent.name
            write_labelled(out / f"{pack}.{path.stem}.npz", **arrays)


if __name__ == "__main__":
    main()
