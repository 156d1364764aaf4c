#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the networks of this folder as lit surfaces, 1, 16 and 256 pixels a texel side by side: the pictures in README.md."""

import argparse
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tools"))
import png  # noqa: E402

TEXELS, PANEL, GAP = 240, 240, 4  # of the texture's longer side; pixels
# Name, more options of compile, and where the magnified parts are in the middle of their panel (texture space).
PICTURES = (
    ("crease", ["--base", str(HERE / "bumps.png")], (0.465, 0.4514)),
    ("leaf", [], (0.5268, 0.531)),
    ("tiling", [], (0.4026, 0.4)),
    ("burst", [], (0.7204, 0.2968)),
    ("panel", [], (0.3551, 0.5323)),
)


def panel(fetexc, texture, middle, magnification, size, out):
    part = [PANEL / magnification / side for side in size]
    view = [0, 0, 1, 1] if magnification == 1 else [m - p / 2 for m, p in zip(middle, part)] + part
    pixels = size if magnification == 1 else (PANEL, PANEL)
    subprocess.run([fetexc, "render", texture, "-o", out, "--light=-2,-2,2", f"--view={','.join(map(str, view))}",
                    "--size", f"{pixels[0]}x{pixels[1]}", "-q"], check=True)
    width, height, rgba = png.read(out)
    grey = rgba[::4]
    return [grey[y * width:(y + 1) * width] for y in range(height)]


def write_grey(path, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    raw = bytearray()
    for row in rows:  # each pixel as the difference to the one before
        raw.append(1)
        raw += bytes((v - (row[x - 1] if x > 0 else 0)) & 255 for x, v in enumerate(row))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(bytes(raw), 9)) + chunk(b"IEND", b""))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fetexc", required=True)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/demo"))
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        texture, picture = pathlib.Path(folder) / "t.fetex", pathlib.Path(folder) / "p.png"
        for name, more, middle in PICTURES:
            subprocess.run([options.fetexc, "compile", HERE / f"{name}.json", "-o", texture, "--repr", "curves", "--size",
                            str(TEXELS), "-q", *more], check=True)
            size = (160, TEXELS) if name == "leaf" else (TEXELS, TEXELS)
            panels = [panel(options.fetexc, texture, middle, m, size, picture) for m in (1, 16, 256)]
            rows = [bytes([40] * GAP).join(p[y] for p in panels) for y in range(PANEL)]
            write_grey(options.out / f"curves_{name}.png", rows)


if __name__ == "__main__":
    main()
