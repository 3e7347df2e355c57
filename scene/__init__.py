# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads and writes Blender's data: the stored result, its outputs, and what is made of parts."""
