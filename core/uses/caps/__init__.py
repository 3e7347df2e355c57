# SPDX-License-Identifier: GPL-3.0-or-later
"""Caps that close parts where they were cut.

- ``networks``: networks of curves, taken apart where few go across
- ``rims``: rims that lie within each other
- ``surfaces``: surfaces across closed curves
- ``sleeves``: the faces beside a curve, which a cap may follow
- ``maps``: caps in a UV map
"""
