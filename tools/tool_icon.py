# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw the icon of the tool in the toolbar, ui/parts.dat: a body with three limbs, one of them chosen.

    python3 tools/tool_icon.py

Blender's icons of tools are triangles whose corners are bytes: "VCO", the size of the square, then three corners of
each triangle, then their colors. On light themes Blender itself inverts how light the colors are.
"""

from __future__ import annotations

import struct
from math import cos, pi, sin

from environments import ROOT

WHITE, CHOSEN = (0xE5, 0xE5, 0xE5, 0xFF), (0xFF, 0xB0, 0x2B, 0xFF)  # those of Blender's tools that select
MIDDLE, BODY = (128, 112), 38  # y counts upwards
NEAR, FAR, WIDE = 50, 78, 28  # where a limb begins and its round end is, and half of its width
STEPS = 10  # of half a round

Point = tuple[float, float]


def main() -> None:
    """Write the file."""
    shapes = [([_at(2 * pi * step / 24, BODY) for step in range(24)], WHITE)]
    for place, angle in enumerate((pi / 2, pi * 7 / 6, pi * 11 / 6)):
        shapes.append((_limb(angle), WHITE if place else CHOSEN))
    corners, colors = bytearray(), bytearray()
    for outline, color in shapes:
        for one, other in zip(outline[1:], outline[2:], strict=False):  # each shape is convex
            for x, y in (outline[0], one, other):
                corners += struct.pack("BB", round(x), round(y))
                colors += bytes(color)
    (ROOT / "ui" / "parts.dat").write_bytes(b"VCO\0\xff\xff\0\0" + corners + colors)


def _at(angle: float, away: float, middle: Point = MIDDLE) -> Point:
    return middle[0] + away * cos(angle), middle[1] + away * sin(angle)


def _limb(angle: float) -> list[Point]:
    """A strip with a round end, its near end straight."""
    end = _at(angle, FAR)
    round_end = [_at(angle - pi / 2 + pi * step / STEPS, WIDE, end) for step in range(STEPS + 1)]
    near = _at(angle, NEAR)
    return [*round_end, _at(angle + pi / 2, WIDE, near), _at(angle - pi / 2, WIDE, near)]


if __name__ == "__main__":
    main()
