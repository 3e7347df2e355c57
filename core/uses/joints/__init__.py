# SPDX-License-Identifier: GPL-3.0-or-later
"""What holds two pieces together.

- ``cap``: what two pieces have in common, along its axis
- ``room``: how much room there is for joints at some places of it
- ``places``: where two pieces can be joined
- ``shapes``: the solids of pegs, keys and dowels
"""
