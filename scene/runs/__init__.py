# SPDX-License-Identifier: GPL-3.0-or-later
"""A run: from the shapes of objects to results that are written to them.

- ``compute``: from shapes to decompositions
- ``jobs``: a computation in processes of its own, watched from Blender's
- ``processes``: such a process
- ``results``: written to an object, and removed from it
- ``spreading``: which process computes which shapes
- ``succession``: a new result for a mesh that had one
"""
