# SPDX-License-Identifier: GPL-3.0-or-later
"""What is shown, hidden and selected.

- ``explode``: parts that drift apart in the view
- ``hidden``: parts that vanish from it
- ``selection``: what is selected or hidden
- ``visibility``: what is hidden for a while
"""
