# SPDX-License-Identifier: GPL-3.0-or-later
"""What changes a result after its run: the user's hand, sliders, edits of the mesh.

- ``pins``: what all changes by hand share: numbers, locks, pins, both sides
- ``edits``: parts merged, split, grown and shrunk by hand
- ``face_edits``: faces given to parts by hand
- ``reactions``: what a slider or a new name does
- ``settled``: sliders that go back when what they ask for cannot be shown
- ``undo_steps``: undo of properties in Sculpt and Edit Mode
- ``watch``: notices that a mesh was edited or deleted
- ``moved``: the result of a mesh that was moved as a whole goes along
- ``alike``: parts that are alike, and names carried to other models
"""
