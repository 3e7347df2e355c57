# SPDX-License-Identifier: GPL-3.0-or-later
"""Reeb Parts: cuts a mesh into the parts a person would name, by the Reeb graph of the average geodesic distance.

>>> import trimesh, reeb_parts
>>> mesh = trimesh.load_mesh("spot.obj", process=False)
>>> result = reeb_parts.decompose(mesh)              # or decompose(vertices, faces)
>>> parts = result.parts()                           # parts.labels: the part of each face
>>> result.parts(detail=0.2), result.parts(n_parts=9)  # instantly, from the same result
>>> mesh.visual.face_colors = reeb_parts.face_colors(parts)

``decompose`` takes what is a mesh, or arrays; ``read_model`` reads a file. But for these and ``face_colors``, the names
are those of ``reeb_parts.core``, which the extension for Blender runs as well and which has the modules of every stage.
The command ``reeb-parts`` does all of it without Python.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from . import core

if TYPE_CHECKING:
    from .core import (
        PRESETS,
        VERSION,
        Cancelled,
        Decomposition,
        EmptyMeshError,
        Hierarchy,
        MeshError,
        ParameterError,
        Parameters,
        Parts,
        ReebError,
        ReebGraph,
        TriMesh,
        UnknownParameterError,
    )
    from .meshes import decompose, face_colors
    from .model_files import Model, ModelFileError, read_model

    __version__ = VERSION

__all__ = [
    "PRESETS",
    "VERSION",
    "Cancelled",
    "Decomposition",
    "EmptyMeshError",
    "Hierarchy",
    "MeshError",
    "Model",
    "ModelFileError",
    "ParameterError",
    "Parameters",
    "Parts",
    "ReebError",
    "ReebGraph",
    "TriMesh",
    "UnknownParameterError",
    "decompose",
    "face_colors",
    "read_model",
]

# The module of each name that core does not have as it is. All are imported when a name is first used: the command has
# to hear Ctrl+C long before SciPy is there.
_HOME = {
    "Model": "model_files",
    "ModelFileError": "model_files",
    "decompose": "meshes",
    "face_colors": "meshes",
    "read_model": "model_files",
}


def __getattr__(name: str) -> object:
    """Import the module of a name when the name is first used."""
    if name == "__version__":
        value = core.VERSION
    elif name in __all__:
        value = getattr(import_module(f".{_HOME[name]}", __name__) if name in _HOME else core, name)
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """All names, those that have not been used, too."""
    return sorted({*globals(), *__all__, "__version__"})
