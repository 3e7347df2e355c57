# SPDX-License-Identifier: GPL-3.0-or-later
"""The result of a run, and work on it by hand: from candidates to parts with numbers that last.

From the components to the result:

- ``component_results``: what the stages found on the components
- ``bodies``: contacts, which make bodies of pieces, and what links these bodies
- ``votes``: which candidate each of the caller's faces gets
- ``within_faces``: symmetry within the caller's faces, where these are too large to be mirrored
- ``slivers``: what is left of parts where cuts moved or sides were mirrored
- ``junctions``: boundaries at edges where more than two faces meet
- ``assemble``: brings all of it back to the caller's faces
- ``half``: the result of a half model, from that of the whole
- ``on_ground``: the result of a mesh with grounds, from that of what stands on them

The result itself:

- ``decomposition``: the result, from which parts are read
- ``parts``: the parts at one level of detail
- ``stored``: the result as bytes, and back
- ``levels``: at which detail there are so many parts
- ``splits``: in which order parts come apart as the detail rises
- ``births``: which number is born with each of them
- ``numbering``: numbers of parts that last
- ``whole``: the parts of a half model together with their images

Changes by hand:

- ``editing``: where a part splits, what it takes or gives, on one side or on both
"""
