# SPDX-License-Identifier: GPL-3.0-or-later
"""The result of a run, and work on it by hand: from candidates to parts with numbers that last.

``assemble`` brings what was found on the components back to the caller's faces, ``decomposition`` is the result and
reads parts from it, ``splits`` and ``numbering`` give parts numbers, ``editing`` changes parts by hand.
"""
