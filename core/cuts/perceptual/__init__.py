# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts where people cut: from the level sets and the field of a component to candidates, by a learned model.

- ``level_set_patches``: patches that end at level sets only, for cuts that stay on them
- ``measures``: every face and pair of faces measured once
- ``thickness``: the solid under each face, and the space above it
- ``features``: what the model is told of a cut, from sums of measures
- ``merging``: the weakest cuts merged first
- ``coarse_copies``: what dense meshes are cut on, and the way back
- ``method``: runs these steps
"""
