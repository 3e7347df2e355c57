# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh decomposition by the Reeb graph of the average geodesic distance; numpy and scipy only.

========================  ===============================================================
``decompose``             arrays in, a ``Decomposition`` out: the one door
``Parameters``            what can be asked for; ``PRESETS`` by name
``Decomposition.parts``   parts at any level of detail, or of any exact number
``ReebError``             base of all errors; the message is the sentence for the user
========================  ===============================================================
"""

from .decomposition import VERSION, Decomposition, Parts
from .errors import Cancelled, EmptyMeshError, MeshError, ParameterError, ReebError
from .hierarchy import Hierarchy
from .mesh import TriMesh
from .parameters import PRESETS, Parameters
from .pipeline import decompose
from .reeb import ReebGraph

__all__ = [
    "PRESETS", "VERSION", "Cancelled", "Decomposition", "EmptyMeshError", "Hierarchy", "MeshError",
    "ParameterError", "Parameters", "Parts", "ReebError", "ReebGraph", "TriMesh", "decompose",
]
