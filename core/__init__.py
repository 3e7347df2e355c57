# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh decomposition by the Reeb graph of the average geodesic distance; numpy and scipy only.

========================  ===============================================================
``decompose``             arrays in, a ``Decomposition`` out: the one door
``Parameters``            what can be asked for; ``PRESETS`` by name
``Decomposition.parts``   parts at any level of detail, or of any exact number
``ReebError``             base of all errors; the message is the sentence for the user
========================  ===============================================================
"""

from importlib import import_module

# Loaded on first use: Blender reads the parameters when it starts, long before SciPy is needed.
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
    "VERSION": "result.decomposition",
    "decompose": "pipeline",
}

__all__ = list(_HOME)


def __getattr__(name):
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f".{_HOME[name]}", __name__), name)
    globals()[name] = value
    return value
