#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Left a part of an image as bilinear filtering magnifies it, right the same part drawn from its texture.

before_after.py IMAGE DRAWN OUT X Y W H: the part in pixels of the image; DRAWN is a picture of just that part. PNGs of 8 bits.
"""

import pathlib
import struct
import sys
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
import png  # noqa: E402

GAP = 8


class Picture:
    def __init__(self, name):
        self.width, self.height, self.rgba = png.read(name)

    def pixel(self, x, y):
        at = 4 * (y * self.width + x)
        return self.rgba[at : at + 3]


def bilinear(image, x, y):
    """RGB at a place in pixels, the border's beyond it."""
    u = min(max(x - 0.5, 0.0), image.width - 1.0)
    v = min(max(y - 0.5, 0.0), image.height - 1.0)
    i, j = int(u), int(v)
    fx, fy = u - i, v - j
    sums = [0.0, 0.0, 0.0]
    for weight, px, py in (((1 - fx) * (1 - fy), i, j), (fx * (1 - fy), i + 1, j), ((1 - fx) * fy, i, j + 1), (fx * fy, i + 1, j + 1)):
        pixel = image.pixel(min(px, image.width - 1), min(py, image.height - 1))
        sums = [s + weight * c for s, c in zip(sums, pixel)]
    return bytes(int(s + 0.5) for s in sums)


def write_png(path, width, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b""))


def main():
    image, drawn = (Picture(name) for name in sys.argv[1:3])
    x, y, w, h = (float(v) for v in sys.argv[4:8])
    rows = []
    for py in range(drawn.height):
        at = [(x + (px + 0.5) / drawn.width * w, y + (py + 0.5) / drawn.height * h) for px in range(drawn.width)]
        left = b"".join(bilinear(image, *p) for p in at)
        right = b"".join(drawn.pixel(px, py) for px in range(drawn.width))
        rows.append(left + bytes([26] * 3 * GAP) + right)
    write_png(pathlib.Path(sys.argv[3]), 2 * drawn.width + GAP, rows)


if __name__ == "__main__":
    main()
