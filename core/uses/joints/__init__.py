# SPDX-License-Identifier: GPL-3.0-or-later
"""What holds two pieces together.

- ``places``: where two pieces can be joined
- ``shapes``: the solids of pegs, keys and dowels
"""
