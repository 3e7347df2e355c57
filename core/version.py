# SPDX-License-Identifier: GPL-3.0-or-later
"""The version of the product, which every result carries."""

VERSION = "0.2.0"
