# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh decomposition by the Reeb graph of the average geodesic distance (AGD); needs NumPy and SciPy only.

``decompose`` takes arrays and returns a ``Decomposition``, whose method ``parts`` reads the parts at any level of
detail. ``__all__`` lists what can be imported from the package itself.

The stages, in the order of the method; each imports those before it only:

- ``arrays``: what every stage does with whole arrays
- ``mesh``: from the caller's arrays to a checked mesh, and labels on it
- ``surface``: the mesh repaired and divided in components, and what is measured on it
- ``symmetry``: planes and turns that map the surface onto itself
- ``field``: distances along the surface, and their mean, the AGD
- ``graph``: level sets of the field, and its Reeb graph
- ``cuts``: the methods of cutting; the finest parts, and the order in which they merge
- ``result``: the way back to the caller's faces, parts at any detail, numbers that last, changes by hand
- ``uses``: colors, JSON report, pictures, bones, seams and what else is made of a result

The doors:

- ``pipeline``: runs the stages one after the other
- ``worker``: does so in a process of its own
- ``handover``: what that process and the one that asks hand each other

What all of them, and who calls them, may use:

- ``version``: of the product
- ``parameters``: of a run, and the presets
- ``options``: what commands share: options made from the parameters, how the answer is written, how a command ends
- ``errors``: exceptions whose messages the user reads
- ``sentence``: messages that can be translated
- ``progress``: how far a run is, and how long its stages take
- ``steps``: long work bit by bit
- ``processors``: how many a run keeps busy
- ``second_thread``: work beside the run, which Blender's extension leaves out
- ``memory``: what a process of its own tells its allocator, and how a lack of memory shows
- ``file_names``: such as every file system takes
- ``interruptions``: whether one is being heeded already
- ``atomic_files``: several files that get to their places all or none
- ``fbx_nodes``: whether Blender can read an .fbx without all memory
- ``metrics``: how far two labelings of one mesh are from each other
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # "as", so that a name counts as one of the package for those who check types strictly
    from .cuts.hierarchy import Hierarchy as Hierarchy
    from .errors import Cancelled as Cancelled
    from .errors import EmptyMeshError as EmptyMeshError
    from .errors import MeshError as MeshError
    from .errors import ParameterError as ParameterError
    from .errors import ReebError as ReebError
    from .errors import UnknownParameterError as UnknownParameterError
    from .graph.reeb import ReebGraph as ReebGraph
    from .mesh.triangles import TriMesh as TriMesh
    from .parameters import PRESETS as PRESETS
    from .parameters import Parameters as Parameters
    from .pipeline import decompose as decompose
    from .result.decomposition import Decomposition as Decomposition
    from .result.parts import Parts as Parts
    from .version import VERSION as VERSION

# The module of each name, which is imported when the name is first used: Blender reads the parameters when it starts,
# long before SciPy is needed.
_HOME = {
    "Cancelled": "errors",
    "Decomposition": "result.decomposition",
    "EmptyMeshError": "errors",
    "Hierarchy": "cuts.hierarchy",
    "MeshError": "errors",
    "PRESETS": "parameters",
    "ParameterError": "errors",
    "Parameters": "parameters",
    "Parts": "result.parts",
    "ReebError": "errors",
    "ReebGraph": "graph.reeb",
    "TriMesh": "mesh.triangles",
    "UnknownParameterError": "errors",
    "VERSION": "version",
    "decompose": "pipeline",
}

__all__ = list(_HOME)


def __getattr__(name: str) -> object:
    """Import the module of a name when the name is first used."""
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f".{_HOME[name]}", __name__), name)
    globals()[name] = value
    return value
