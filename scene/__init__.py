# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's data, read and written: meshes as arrays, results stored with their meshes, and what is made of them.

The way of a mesh:

- ``bridge``: the shape of an object as arrays for core
- ``reading``: what else is read of objects and their meshes
- ``properties``: what a run, and what is made of its parts, can be told
- ``settings``: what of it the scene says
- ``former_names``: parameters by their names of version 0.1.0
- ``defaults``: what the preferences say
- ``runs``: a run, in a process of its own, and what becomes of its result
- ``store``: the result, kept with its mesh
- ``result``: what the file stores beside it, and the names and the list of its parts
- ``changes``: what changes a result: the user's hand, a slider, an edit of the mesh

What is made of parts:

- ``outputs``: what of them is written to a mesh
- ``graph``: the graph as objects
- ``showing``: what is shown, hidden and selected
- ``pieces``: parts as objects
- ``joints``: pegs and such, which join these
- ``moving``: parts that move: bones, rigid bodies, hulls
- ``saving``: what leaves Blender as files
- ``ours``: what is ours, and whether the user has worked on it

What every operator needs:

- ``reporting``: operators that tell what is wrong
- ``stepped``: operators whose work can be long
- ``running``: operators that go on in the window
- ``another_window``: where they go on when the user closes it
- ``targets``: which objects can be worked on
- ``errors``: what users are told, and the way into core
- ``transaction``: all or nothing
- ``snapshots``: what a transaction keeps
- ``renaming``: many data blocks get other names
- ``property_updates``: whether it is the user who writes a property
- ``modes``: leaves a mode, and returns to it; what one does not show
- ``temporary``: data that is there for a while only
- ``handlers``: functions that Blender calls
- ``redraw``: lets windows draw again
"""

from __future__ import annotations

from . import defaults, running, store
from .changes import undo_steps, watch
from .outputs import vertex_groups
from .reading import fingerprints, mesh_arrays
from .result import part_places, schema
from .runs import compute


def register() -> None:
    schema.register()
    defaults.register()
    watch.register()
    undo_steps.register()
    running.register()


def unregister() -> None:
    running.unregister()
    undo_steps.unregister()
    watch.unregister()
    defaults.unregister()
    schema.unregister()
    for module in (fingerprints, mesh_arrays, vertex_groups, part_places, compute, store):
        module.forget()
