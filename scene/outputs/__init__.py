# SPDX-License-Identifier: GPL-3.0-or-later
"""What of the parts is written to a mesh, and taken back."""
