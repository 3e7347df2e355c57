# SPDX-License-Identifier: GPL-3.0-or-later
"""What is kept of a result with its mesh: what the file stores, and what the user sees and says of its parts.

- ``schema``: what is stored in the file
- ``part_list``: which parts are chosen in the list
- ``part_names``: names and colors of parts, by their numbers
- ``part_places``: where parts are
- ``naming``: names that are suggested
- ``notes``: notes on a mesh
"""
