#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws hood.png, the normal map of a bent sheet with creases, and hood_creases.svg, where the creases are.

A crease begins in the middle of the sheet, where its two sides have one slope, and gets sharper towards the right border; a
button has one all around. Normals are exact at pixel centres: x right, y up, z out of the picture, stored as (n + 1) / 2.
Python's standard library only; the same bytes on every machine.
"""

import math
import pathlib
import struct
import zlib

SIDE = 256
HERE = pathlib.Path(__file__).resolve().parent
BUTTON = (-0.45, 0.4, 0.26)  # u, v, radius; the picture is [-1,1] x [-1,1], v down
BEGIN = -0.5  # u of the crease's open end


def crease_line(u):
    """v of the crease, and its slope."""
    return 0.28 * math.sin(1.7 * u) - 0.12, 0.476 * math.cos(1.7 * u)


def sharpness(u):
    """Of the crease, and its slope: 0 up to BEGIN, then growing."""
    t = min(max((u - BEGIN) / 1.3, 0), 1)
    return 0.75 * t * t * (3 - 2 * t), 0.75 * 6 * t * (1 - t) / 1.3


def slopes(u, v):
    """Of the height, along u and v."""
    line, bend = crease_line(u)
    amount, growth = sharpness(u)
    off = v - line
    fall = math.exp(-((off / 0.5) ** 2))
    profile = -abs(off) * fall
    change = -math.copysign(1, off) * fall * (1 - 2 * (off / 0.5) ** 2)
    hu, hv = -0.35 * u + growth * profile - amount * change * bend, -0.35 * v + amount * change
    bu, bv, radius = BUTTON
    if math.hypot(u - bu, v - bv) < radius:
        hu, hv = hu - 0.8 * (u - bu) / radius, hv - 0.8 * (v - bv) / radius
    return hu, hv


def pixel(x, y):
    hu, hv = slopes((x + 0.5) / SIDE * 2 - 1, (y + 0.5) / SIDE * 2 - 1)
    length = math.sqrt(hu * hu + hv * hv + 1)
    return [round((n / length + 1) / 2 * 255) for n in (-hu, hv, 1)]


def png(rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    head = struct.pack(">IIBBBBB", SIDE, SIDE, 8, 2, 0, 0, 0)
    data = b"".join(b"\0" + bytes(row) for row in rows)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b"")


def svg():
    def place(u, v):
        return f"{(u + 1) / 2 * SIDE:.3f},{(v + 1) / 2 * SIDE:.3f}"

    points = [BEGIN + (1 - BEGIN) * k / 48 for k in range(49)]
    crease = " L".join(place(u, crease_line(u)[0]) for u in points)
    bu, bv, radius = BUTTON
    return (
        "<!-- Made by make_hood.py. -->\n"
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {SIDE} {SIDE}" fill="none" stroke="#000">\n'
        f'  <path id="crease" d="M{crease}"/>\n'
        f'  <circle id="button" cx="{(bu + 1) / 2 * SIDE:g}" cy="{(bv + 1) / 2 * SIDE:g}" r="{radius / 2 * SIDE:g}"/>\n'
        "</svg>\n"
    )


def main():
    rows = [[c for x in range(SIDE) for c in pixel(x, y)] for y in range(SIDE)]
    (HERE / "hood.png").write_bytes(png(rows))
    (HERE / "hood_creases.svg").write_text(svg(), encoding="ascii")


if __name__ == "__main__":
    main()
