# SPDX-License-Identifier: GPL-3.0-or-later
"""What of the parts is written to a mesh, and taken back; one module for each output."""

from .write import keep_places, palette_colors, remove_outputs, update_colors, update_outputs, write_outputs

__all__ = ["keep_places", "palette_colors", "remove_outputs", "update_colors", "update_outputs", "write_outputs"]
