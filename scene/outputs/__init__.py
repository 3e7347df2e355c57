# SPDX-License-Identifier: GPL-3.0-or-later
"""What of the parts is written to a mesh, and taken back; one module for each output."""

from .write import palette_colors, remove_outputs, update_colors, update_outputs, write_outputs

__all__ = ["palette_colors", "remove_outputs", "update_colors", "update_outputs", "write_outputs"]
