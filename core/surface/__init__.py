# SPDX-License-Identifier: GPL-3.0-or-later
"""Geometry and labels on it: from the caller's arrays to connected triangle meshes that are ready for a field.

``polygons`` and ``mesh`` check what the caller gave, ``preparation`` repairs a copy of it and cuts out its components,
``coarsening`` makes coarser copies and ``curvature`` measures how a surface bends. ``labels`` moves and cleans labels
of faces, ``corners`` holds the caller's polygons corner by corner, ``arrays`` has the operations that all stages share.
"""
