# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh decomposition by the Reeb graph of the average geodesic distance (AGD); needs NumPy and SciPy only.

``decompose`` takes arrays and returns a ``Decomposition``, whose method ``parts`` reads the parts at any level of
detail. The second column names what can be imported from the package itself, the third what the modules of each stage
add.

=======  ===================================  ====================================================================
stage    from the package                     from the modules
=======  ===================================  ====================================================================
(all)    ``decompose``, ``Parameters``,       ``pipeline``, ``parameters``, ``errors``, ``sentence``, ``progress``
         ``PRESETS``, ``VERSION``,            ``metrics``: how far two labelings of one mesh are from each other
         ``ReebError``, ``MeshError``,
         ``EmptyMeshError``, ``Cancelled``,
         ``ParameterError``,
         ``UnknownParameterError``
surface  ``TriMesh``, a checked mesh          polygons, repair, coarser copies, curvature, labels on faces
field                                         geodesic distances; the AGD, normalized and equalized
graph    ``ReebGraph``, nodes and arcs        level sets, critical points, simplification, contours
cuts     ``Hierarchy``, order of the merges   the methods of cutting, minimum cuts
result   ``Decomposition``, ``Parts``         assembly, numbers that last, changes by hand
uses                                          colors, JSON report, pictures, bones, seams
=======  ===================================  ====================================================================
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
    from .parameters import PRESETS as PRESETS
    from .parameters import Parameters as Parameters
    from .pipeline import decompose as decompose
    from .result.decomposition import Decomposition as Decomposition
    from .result.decomposition import Parts as Parts
    from .surface.mesh import TriMesh as TriMesh
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
    "Parts": "result.decomposition",
    "ReebError": "errors",
    "ReebGraph": "graph.reeb",
    "TriMesh": "surface.mesh",
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
