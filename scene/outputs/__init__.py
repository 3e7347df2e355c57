# SPDX-License-Identifier: GPL-3.0-or-later
"""What of the parts is written to a mesh, and taken back; one module for each output.

- ``write``: writes all that is wanted, and lets it follow the parts
- ``face_attribute``: the number of the part of each face
- ``colors``: the color of its part
- ``materials``: a material for each part
- ``former_slots``: which material slots faces have as the user has it
- ``face_sets``: face sets of Sculpt Mode
- ``seams``: UV seams along cuts
- ``vertex_groups``: a group of vertices for each part
- ``field``: the distance field that the parts come from
- ``kept_aside``: what the user had under our names

Made once, when it is asked for:

- ``uv_map``: a UV map with an island for each part
"""

from .write import keep_places, palette_colors, remove_outputs, switch, update_colors, update_outputs, write_outputs

__all__ = ["keep_places", "palette_colors", "remove_outputs", "switch", "update_colors", "update_outputs",
           "write_outputs"]
