# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts changed by hand: cut, grown, moved at their boundary, on one side of a plane of symmetry or on both.

- ``changes``: where a part splits, what it takes or gives
- ``finer_candidates``: candidates cut along given faces, where they are not fine enough for that
- ``contour_cut``: contours of the field to cut a part along
- ``remainders``: small pieces that a change cuts off
- ``mirrored``: changes made on both sides of a plane of symmetry
"""
