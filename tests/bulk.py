# SPDX-License-Identifier: GPL-3.0-or-later
"""Reading Blender's collections in bulk."""

import numpy as np


def read(items, key, kind=np.float32, width=1):
    """A property of all items of a collection, (k,) or, of several values each, (k, width)."""
    values = np.empty(width * len(items), kind)
    items.foreach_get(key, values)
    return values if width == 1 else values.reshape(-1, width)
