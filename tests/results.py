# SPDX-License-Identifier: GPL-3.0-or-later
"""Reading and comparing the parts of faces."""

import numpy as np
from bulk import read


def numbers(mesh):
    """Number of the part of each polygon, (p,) int32, as a mesh in Blender stores it."""
    return read(mesh.attributes["reeb_part"].data, "value", np.int32)


def same_partition(one, two):
    """Whether two labelings of the same faces, (m,) int, differ in the names of the labels only."""
    pairs = set(zip(one.tolist(), two.tolist(), strict=True))
    return len(pairs) == len(set(one.tolist())) == len(set(two.tolist()))
