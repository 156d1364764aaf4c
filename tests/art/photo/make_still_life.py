#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws still_life.png, a picture as a camera would take it, and still_life_edges.svg, the outlines in it.

Everything is a formula in the picture's own pixels (192 x 128): soft shading, grain, a soft shadow, and crisp outlines that
the pixels, each a mean over 1.5 x 1.5 pixels, blur. The vein of the leaf fades out: its feature ends inside the leaf.
Python's standard library only; the same bytes on every machine.
"""

import math
import pathlib
import struct
import zlib

WIDTH, HEIGHT = 192, 128
SAMPLES, FOOTPRINT = 6, 1.5
HERE = pathlib.Path(__file__).resolve().parent

LEAF = [((92, 50), (108, 22), (142, 12), (172, 30)), ((172, 30), (152, 54), (116, 66), (92, 50))]
VEIN = ((92, 50), (114, 42), (134, 35), (150, 32.5))
ORANGE = (62.0, 74.0, 33.0)
BOX = {"top": [(112, 78), (146, 66), (178, 76), (146, 90)], "left": [(112, 78), (146, 90), (146, 120), (112, 104)],
       "right": [(146, 90), (178, 76), (178, 102), (146, 120)]}
BOX_OUTLINE = [(112, 78), (146, 66), (178, 76), (178, 102), (146, 120), (112, 104)]


def table_edge(x):
    return 90 - x / 32


def cubic(p, t):
    s = 1 - t
    w = (s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t)
    return (sum(a * q[0] for a, q in zip(w, p)), sum(a * q[1] for a, q in zip(w, p)))


def inside(polygon, x, y):
    odd = False
    for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1]):
        if (ay > y) != (by > y) and x < ax + (y - ay) * (bx - ax) / (by - ay):
            odd = not odd
    return odd


LEAF_POLYGON = [cubic(c, k / 64) for c in LEAF for k in range(64)]
VEIN_POINTS = [cubic(VEIN, k / 96) for k in range(97)]


def grain(x, y, scale):
    """Smooth noise, -1 … 1: products of waves whose lengths have no common measure."""
    u, v = x / scale, y / scale
    return (math.sin(u * 2.39 + 1.3 * math.sin(v * 1.71)) + math.sin(v * 2.83 + 1.7 * math.sin(u * 1.37 + 0.5))
            + math.sin((u + v) * 1.93 + 1.1 * math.sin((u - v) * 2.21))) / 3


def background(x, y):
    if y < table_edge(x):
        light = 0.62 + 0.22 * (x / WIDTH) - 0.15 * (y / HEIGHT) + 0.02 * grain(x, y, 5)
        return (0.80 * light, 0.86 * light, 0.95 * light)
    depth = (y - table_edge(x)) / (HEIGHT - table_edge(x))
    wood = 0.50 + 0.18 * depth + 0.05 * math.sin(0.16 * x + 2.2 * math.sin(0.05 * y) + 5 * depth * depth) + 0.02 * grain(x, y, 3)
    shadow = 0.45 * math.exp(-(((x - 82) / 34) ** 2 + ((y - 106) / 9) ** 2)) + 0.4 * math.exp(-(((x - 168) / 22) ** 2 + ((y - 114) / 8) ** 2))
    wood *= 1 - shadow
    return (wood, 0.72 * wood, 0.46 * wood)


def orange(x, y):
    u, v = (x - ORANGE[0]) / ORANGE[2], (y - ORANGE[1]) / ORANGE[2]
    z = math.sqrt(max(0.0, 1 - u * u - v * v))
    bump = 0.05 * grain(x, y, 1.6)
    light = max(0.0, -0.5 * u - 0.62 * v + 0.6 * z)
    shine = 0.55 * max(0.0, -0.3 * u - 0.45 * v + 0.84 * z) ** 24
    shade = 0.2 + 0.85 * light + bump
    return (min(1.0, 1.02 * shade + shine), min(1.0, 0.52 * shade + shine), min(1.0, 0.10 * shade + 0.9 * shine))


def leaf(x, y):
    px, py = min(VEIN_POINTS, key=lambda p: (p[0] - x) ** 2 + (p[1] - y) ** 2)
    along = (px - 92) / 58
    fade = max(0.0, 1 - along) ** 0.7 if x <= VEIN_POINTS[-1][0] else 0.0
    side = -1 if y < py else 1
    light = 0.5 + 0.12 * math.sin(0.21 * x + 0.1 * y) + 0.2 * (x - 92) / 80 - 0.17 * side * fade + 0.03 * grain(x, y, 2.2)
    return (0.42 * light, 0.88 * light, 0.30 * light)


def box(x, y):
    if inside(BOX["top"], x, y):
        light = 0.92 - 0.003 * (x - 112) + 0.015 * grain(x, y, 4)
        return (light, 0.95 * light, 0.86 * light)
    if inside(BOX["left"], x, y):
        light = 0.66 - 0.006 * (y - 78) + 0.015 * grain(x, y, 4)
        return (0.80 * light, 0.30 * light, 0.32 * light)
    light = 0.42 - 0.004 * (y - 76) + 0.003 * (x - 146) + 0.015 * grain(x, y, 4)
    return (0.78 * light, 0.28 * light, 0.34 * light)


def color(x, y):
    if inside(LEAF_POLYGON, x, y):
        return leaf(x, y)
    if (x - ORANGE[0]) ** 2 + (y - ORANGE[1]) ** 2 < ORANGE[2] ** 2:
        return orange(x, y)
    if inside(BOX_OUTLINE, x, y):
        return box(x, y)
    return background(x, y)


def pixel(i, j):
    total = [0.0, 0.0, 0.0]
    for v in range(SAMPLES):
        for u in range(SAMPLES):
            at = [(k + 0.5) / SAMPLES * FOOTPRINT - 0.5 * FOOTPRINT for k in (u, v)]
            c = color(i + 0.5 + at[0], j + 0.5 + at[1])
            total = [t + q for t, q in zip(total, c)]
    return bytes(min(255, max(0, math.floor(t / SAMPLES ** 2 * 255 + 0.5))) for t in total)


def write_png(path, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b""))


def on_circle_from_table(sign):
    """x where the table's edge meets the orange."""
    a, b, r = ORANGE
    # |(x − a, 90 − x/32 − b)| = r
    k = 1 / 32
    qa, qb, qc = 1 + k * k, -2 * (a + k * (90 - b)), a * a + (90 - b) ** 2 - r * r
    return (-qb + sign * math.sqrt(qb * qb - 4 * qa * qc)) / (2 * qa)


def number(v):
    return f"{v:.4f}".rstrip("0").rstrip(".")


def path_of(points, closed=False):
    return "M" + " L".join(f"{number(x)},{number(y)}" for x, y in points) + (" Z" if closed else "")


def curve_of(cubics):
    first = cubics[0][0]
    rest = " ".join("C" + " ".join(f"{number(x)},{number(y)}" for x, y in c[1:]) for c in cubics)
    return f"M{number(first[0])},{number(first[1])} {rest}"


def edges():
    left, right = on_circle_from_table(-1), on_circle_from_table(1)
    # Ends of the table's edge reach a twentieth of a pixel into what hides it.
    table = [path_of([(0, table_edge(0)), (left + 0.05, table_edge(left + 0.05))]),
             path_of([(right - 0.05, table_edge(right - 0.05)), (112.05, table_edge(112.05))]),
             path_of([(177.95, table_edge(177.95)), (WIDTH, table_edge(WIDTH))])]
    lines = ['<!-- Made by make_still_life.py. -->',
             f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" fill="none" stroke="#000">',
             f'  <circle id="orange" cx="{number(ORANGE[0])}" cy="{number(ORANGE[1])}" r="{number(ORANGE[2])}"/>',
             f'  <path id="leaf" d="{curve_of(LEAF)} Z"/>',
             f'  <path id="vein" d="{curve_of([VEIN])}"/>',
             f'  <path id="box" d="{path_of(BOX_OUTLINE, True)}"/>',
             f'  <path id="box-edges" d="{path_of([(112, 78), (146, 90), (178, 76)])} {path_of([(146, 90), (146, 120)])}"/>']
    lines += [f'  <path id="table-{k + 1}" d="{d}"/>' for k, d in enumerate(table)]
    return "\n".join(lines + ["</svg>", ""])


def main():
    (HERE / "still_life_edges.svg").write_text(edges(), encoding="utf-8")
    write_png(HERE / "still_life.png", [b"".join(pixel(i, j) for i in range(WIDTH)) for j in range(HEIGHT)])


if __name__ == "__main__":
    main()
