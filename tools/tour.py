# SPDX-License-Identifier: GPL-3.0-or-later
"""Make docs/images/tour.png, the animated picture at the top of the README, of the frames of tests/window/tour.py.

    .venv/unit-newest/bin/python tools/tour.py FOLDER [--out FILE]

An animated PNG of 255 colors for all frames: of each frame only the rectangle that differs from the one before is
stored, and in it what is the same is transparent. The pointer, which no picture of a window shows, is drawn.
"""

from __future__ import annotations

import argparse
import json
import struct
import zlib
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
COLORS = 255  # and one that is transparent
ARROW = ("X           ", "XX          ", "X.X         ", "X..X        ", "X...X       ", "X....X      ", "X.....X     ",
         "X......X    ", "X.......X   ", "X........X  ", "X.....XXXXX ", "X..X..X     ", "X.X X..X    ", "XX  X..X    ",
         "X    X..X   ", "     X..X   ", "      XX    ")


def main() -> None:
    """Read the frames, choose colors, write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "images" / "tour.png")
    arguments = parser.parse_args()
    listed = json.loads((arguments.folder / "frames.json").read_text(encoding="utf-8"))
    pictures = []
    for name, _, place, pressed in listed:
        picture = read_ppm(arguments.folder / name)
        draw_pointer(picture, place, pressed)
        pictures.append(picture)
    colors = palette(pictures)
    frames = [nearest(picture, colors) for picture in pictures]
    milliseconds = [round(1000 * seconds) for _, seconds, _, _ in listed]
    arguments.out.write_bytes(animated_png(frames, milliseconds, colors))
    print(f"{arguments.out}: {len(frames)} frames, {sum(milliseconds) / 1000:.0f} s, "
          f"{arguments.out.stat().st_size / 1e6:.2f} MB")


def read_ppm(path: Path) -> np.ndarray:
    """A binary picture, (height, width, 3) uint8."""
    kind, width, height, most, pixels = path.read_bytes().split(maxsplit=4)
    assert (kind, most) == (b"P6", b"255")
    return np.frombuffer(pixels, np.uint8).reshape(int(height), int(width), 3).copy()


def draw_pointer(picture: np.ndarray, place: tuple[int, int], pressed: bool) -> None:
    """An arrow, and a ring around its tip while the button is pressed."""
    x, y = place
    height, width = picture.shape[:2]
    if pressed:
        rows, columns = np.ogrid[:height, :width]
        away = np.hypot(rows - y, columns - x)
        picture[(away > 9) & (away < 12)] = (255, 200, 60)
    for row, line in enumerate(ARROW):
        for column, mark in enumerate(line):
            if mark != " " and 0 <= y + row < height and 0 <= x + column < width:
                picture[y + row, x + column] = 0 if mark == "X" else 255


def palette(pictures: list[np.ndarray]) -> np.ndarray:
    """Colors for all pictures, (COLORS, 3) uint8: boxes of colors are halved where they spread most."""
    seen = np.concatenate([picture.reshape(-1, 3)[::7] for picture in pictures])
    packed = (seen.astype(np.int64) >> 1) @ (1 << 14, 1 << 7, 1)
    values, counts = np.unique(packed, return_counts=True)
    colors = 2.0 * np.stack([values >> 14, values >> 7 & 127, values & 127], axis=1)
    # Large even areas must not take all colors.
    weight = counts**0.6
    boxes = [np.arange(len(colors))]
    while len(boxes) < COLORS:
        spread = [_spread(colors[box], weight[box]) for box in boxes]
        worst = max(range(len(boxes)), key=lambda i: spread[i][0])
        axis, box = spread[worst][1], boxes.pop(worst)
        box = box[np.argsort(colors[box, axis], kind="stable")]
        total = np.cumsum(weight[box])
        half = int(np.clip(np.searchsorted(total, total[-1] / 2), 1, len(box) - 1))
        boxes += [box[:half], box[half:]]
    return np.array([np.average(colors[box], axis=0, weights=weight[box]) for box in boxes]).round().astype(np.uint8)


def _spread(colors: np.ndarray, weight: np.ndarray) -> tuple[float, int]:
    """How much a box of colors spreads, and along which channel most."""
    if len(colors) < 2:
        return 0.0, 0
    deviation = weight @ (colors - np.average(colors, axis=0, weights=weight)) ** 2
    return float(deviation.max()), int(deviation.argmax())


def nearest(picture: np.ndarray, colors: np.ndarray) -> np.ndarray:
    """The color for each pixel, (height, width) uint8."""
    packed = picture.reshape(-1, 3).astype(np.int64) @ (1 << 16, 1 << 8, 1)
    values, index = np.unique(packed, return_inverse=True)
    own = np.stack([values >> 16, values >> 8 & 255, values & 255], axis=1).astype(np.float32)
    table = colors.astype(np.float32)
    found = [np.square(some[:, None] - table).sum(axis=2).argmin(axis=1)
             for some in np.array_split(own, 1 + len(own) // 4096)]
    return np.concatenate(found).astype(np.uint8)[index.reshape(-1)].reshape(picture.shape[:2])


def animated_png(frames: list[np.ndarray], milliseconds: list[int], colors: np.ndarray) -> bytes:
    """The file; it starts again after the last frame."""
    height, width = frames[0].shape
    found = [b"\x89PNG\r\n\x1a\n", _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)),
             _chunk(b"acTL", struct.pack(">II", len(frames), 0)),
             _chunk(b"PLTE", colors.tobytes() + b"\0\0\0"), _chunk(b"tRNS", b"\xff" * len(colors) + b"\0")]
    number = 0
    before = None
    for frame, shown in zip(frames, milliseconds, strict=True):
        top, left, part = _changed(before, frame, len(colors))
        place = (part.shape[1], part.shape[0], left, top)
        # Over the frame before, but for the first.
        found.append(_chunk(b"fcTL", struct.pack(">IIIIIHHBB", number, *place, shown, 1000, 0, before is not None)))
        number += 1
        # Each row starts with the number of its filter: none.
        data = zlib.compress(np.pad(part, ((0, 0), (1, 0))).tobytes(), 9)
        if before is None:
            found.append(_chunk(b"IDAT", data))
        else:
            found.append(_chunk(b"fdAT", struct.pack(">I", number) + data))
            number += 1
        before = frame
    return b"".join([*found, _chunk(b"IEND", b"")])


def _changed(before: np.ndarray | None, frame: np.ndarray, clear: int) -> tuple[int, int, np.ndarray]:
    """The top, the left and the pixels of the rectangle that differs; ``clear`` where a pixel is as before."""
    if before is None:
        return 0, 0, frame
    rows, columns = np.nonzero(before != frame)
    if not len(rows):
        return 0, 0, np.full((1, 1), clear, np.uint8)
    box = slice(rows.min(), rows.max() + 1), slice(columns.min(), columns.max() + 1)
    return int(rows.min()), int(columns.min()), np.where(before[box] == frame[box], clear, frame[box]).astype(np.uint8)


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


if __name__ == "__main__":
    main()
