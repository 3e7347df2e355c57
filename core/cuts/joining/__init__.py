# SPDX-License-Identifier: GPL-3.0-or-later
"""Which parts of different pieces belong together: pairs are judged, then joined, surest first."""
