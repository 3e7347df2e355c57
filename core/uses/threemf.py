# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts as assemblies in a 3MF file, the format of slicers, with names and colors.

After the 3MF Core Specification: a zip with the model as XML, a list of content types and a list of relationships.
"""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from ..arrays.indexing import renumbered

_CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'
_MODEL = "3D/3dmodel.model"
_TYPES = (f'{_HEAD}<Types xmlns="{_PACKAGE}/content-types">'
          '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
          '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>'
          '</Types>\n')
_RELATIONS = (f'{_HEAD}<Relationships xmlns="{_PACKAGE}/relationships"><Relationship Id="rel0" Target="/{_MODEL}" '
              f'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>\n')
# So many rows are turned into text at once.
_ROWS = 100_000
# What XML 1.0 cannot hold.
_NO_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


@dataclass(frozen=True, eq=False)
class ColoredMesh:
    """One piece of an assembly.

    Attributes
    ----------
    name : str
    color : tuple of 3 float
        sRGB, 0..1.
    vertices : (n, 3) float64
        In millimeters.
    triangles : (m, 3) int64
        Counterclockwise seen from outside.
    """

    name: str
    color: Sequence[float]
    vertices: np.ndarray
    triangles: np.ndarray


@dataclass(frozen=True, eq=False)
class Assembly:
    """Bodies that belong together and stay in place to each other.

    Attributes
    ----------
    name : str
    bodies : tuple of ColoredMesh
    """

    name: str
    bodies: tuple[ColoredMesh, ...]


def write_3mf(path: Path, assemblies: Iterable[Assembly]) -> None:
    """Write assemblies, which stand on the plate: the lowest corner of all is the origin of the build.

    Each body is an object with a material of its name and color; one more object is made of those of each assembly,
    and this one is built. Triangles without three different vertices are left out, as the format asks for, and so are
    bodies without triangles. The same bodies give the same bytes.

    Parameters
    ----------
    path : Path
    assemblies : iterable of Assembly

    Raises
    ------
    OSError
        The file could not be written.
    """
    cleaned = [Assembly(each.name, tuple(body for body in map(_cleaned, each.bodies) if len(body.triangles)))
               for each in assemblies]
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as package:
        for entry, text in (("[Content_Types].xml", [_TYPES]), ("_rels/.rels", [_RELATIONS]),
                            (_MODEL, _model([each for each in cleaned if each.bodies]))):
            entry_info = zipfile.ZipInfo(entry)  # without the time of day in it
            entry_info.compress_type = zipfile.ZIP_DEFLATED
            with package.open(entry_info, "w", force_zip64=True) as file:
                for piece in text:
                    file.write(piece.encode())


def _cleaned(body: ColoredMesh) -> ColoredMesh:
    """The body without triangles of fewer than three different vertices, and without vertices of no triangle."""
    a, b, c = body.triangles.T
    used, triangles = renumbered(body.triangles[(a != b) & (b != c) & (c != a)])
    return ColoredMesh(body.name, body.color, body.vertices[used], triangles)


def _model(assemblies: list[Assembly]) -> Iterator[str]:
    """The model piece by piece."""
    bodies = [body for assembly in assemblies for body in assembly.bodies]
    title = ", ".join(assembly.name for assembly in assemblies)
    yield (f'{_HEAD}<model unit="millimeter" xml:lang="en-US" xmlns="{_CORE}">\n'
           f'<metadata name="Title">{escape(_plain(title))}</metadata>\n'
           '<metadata name="Application">Reeb Parts</metadata>\n<resources>\n')
    if bodies:
        yield '<basematerials id="1">\n'
        for body in bodies:
            color = "".join(f"{round(255 * min(max(float(value), 0.0), 1.0)):02X}" for value in body.color[:3])
            yield f'<base name={_quoted(body.name)} displaycolor="#{color}"/>\n'
        yield "</basematerials>\n"
    for index, body in enumerate(bodies):
        yield (f'<object id="{index + 2}" type="model" pid="1" pindex="{index}" name={_quoted(body.name)}>\n'
               '<mesh>\n<vertices>\n')
        yield from _rows('<vertex x="%.9g" y="%.9g" z="%.9g"/>\n', body.vertices)
        yield "</vertices>\n<triangles>\n"
        yield from _rows('<triangle v1="%d" v2="%d" v3="%d"/>\n', body.triangles)
        yield "</triangles>\n</mesh>\n</object>\n"
    yield from _assembled(assemblies, bodies)


def _assembled(assemblies: list[Assembly], bodies: list[ColoredMesh]) -> Iterator[str]:
    """The objects that are made of bodies, the end of the resources, and the build."""
    low = np.min([body.vertices.min(axis=0) for body in bodies], axis=0) if bodies else np.zeros(3)
    place = " ".join(f"{value:.9g}" for value in (1, 0, 0, 0, 1, 0, 0, 0, 1, *(0.0 - low)))
    first, items = 2, []
    for number, assembly in enumerate(assemblies, len(bodies) + 2):
        yield f'<object id="{number}" type="model" name={_quoted(assembly.name)}>\n<components>\n'
        yield "".join(f'<component objectid="{first + step}"/>\n' for step in range(len(assembly.bodies)))
        yield "</components>\n</object>\n"
        first += len(assembly.bodies)
        items.append(f'<item objectid="{number}" transform="{place}"/>\n')
    yield f"</resources>\n<build>\n{''.join(items)}</build>\n</model>\n"


def _rows(form: str, values: np.ndarray) -> Iterator[str]:
    """Each row of an array by a form, many at once."""
    for start in range(0, len(values), _ROWS):
        rows = values[start : start + _ROWS]
        yield (form * len(rows)) % tuple(rows.ravel().tolist())


def _quoted(text: str) -> str:
    """A text as the value of an attribute."""
    return quoteattr(_plain(text))


def _plain(text: str) -> str:
    """A text without what XML cannot hold."""
    return _NO_XML.sub("", text)
