# SPDX-License-Identifier: GPL-3.0-or-later
"""Tools, which are used with the pointer until they are confirmed.

- ``view_tool``: what all of them have in common
- ``colored_tool``: those that show in colors what a part would be
- ``ring_tool``: those that move boundaries ring by ring
- ``knife``: where a part is cut
- ``boundary``: the boundary of a part, to be moved
- ``brush``: paints faces into a part
- ``box``: which parts are seen in a box
"""
