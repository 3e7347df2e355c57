# SPDX-License-Identifier: GPL-3.0-or-later
"""A run: from the shapes of objects to results that are written to them.

- ``compute``: from shapes to decompositions
- ``jobs``: a computation in a process of its own, watched from Blender's
- ``processes``: that process
- ``results``: written to an object, and removed from it
- ``succession``: a new result for a mesh that had one
"""
