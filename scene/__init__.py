# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's data, read and written: meshes as arrays, results stored with their meshes, and what is made of them.

Reading:

- ``bridge``: the shape of an object as arrays for core
- ``reading``: objects and their meshes as arrays, and what is read of them

Computing:

- ``runs``: a run, in a process of its own, and what becomes of its result

The result:

- ``store``: kept with its mesh
- ``result``: what is stored of a result, its parts' names and their list
- ``outputs``: what of the parts is written to a mesh
- ``graph``: the graph as objects

Changes:

- ``changes``: what changes a result: the user's hand, a slider, an edit of the mesh
- ``property_updates``: whether it is the user who writes a property

What is made of parts:

- ``pieces``: parts as objects
- ``joints``: pegs and such, which join these
- ``cut_list``: their cuts as a list on the object
- ``cut_curves``: curves that Separate would cut along
- ``by_extent``: modifiers that work by the extent of the whole mesh, and would shape a piece otherwise
- ``moving``: parts that move: bones, rigid bodies, hulls
- ``uv_map``: a UV map with an island for each part
- ``showing``: what is shown, hidden and selected of objects and parts
- ``ours``: what is ours, and whether the user has worked on it
- ``saving``: what leaves Blender as files

Settings:

- ``settings``: what the next run, and what is made of its parts, will be like
- ``defaults``: what the preferences say

What every operator needs:

- ``reporting``: operators that tell what is wrong
- ``stepped``: operators whose work can be long
- ``running``: operators that go on in the window
- ``targets``: which objects can be worked on
- ``errors``: what users are told, and the way into core
- ``transaction``: all or nothing
- ``snapshots``: what a transaction keeps
- ``modes``: leaves a mode, and returns to it
- ``temporary``: data that is there for a while only
- ``handlers``: functions that Blender calls
- ``redraw``: lets windows draw again
"""

from __future__ import annotations

from . import defaults, store
from .changes import sculpt_undo, watch
from .outputs import vertex_groups
from .reading import fingerprints, mesh_arrays
from .result import part_places, schema
from .runs import compute


def register() -> None:
    schema.register()
    defaults.register()
    watch.register()
    sculpt_undo.register()


def unregister() -> None:
    sculpt_undo.unregister()
    watch.unregister()
    defaults.unregister()
    schema.unregister()
    for module in (fingerprints, mesh_arrays, vertex_groups, part_places, compute, store):
        module.forget()
