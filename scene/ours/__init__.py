# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects, modifiers and data of ours: what a run made, and whether it is still ours to replace.

- ``made_objects``: what we made, replaced by the next run unless the user has worked on it
- ``object_digest``: tells whether somebody has worked on an object
- ``surroundings``: what many objects are in, and what hangs on them
- ``modifiers``: modifiers of ours
- ``orphan_outputs``: what of ours a mesh has without a result
"""
