#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the networks of this folder that are made by formulas, and the normal map that crease.json lies on."""

import json
import math
import pathlib
import struct
import zlib

FOLDER = pathlib.Path(__file__).resolve().parent


def points(*values):
    return [round(v, 3) for v in values]


def write(name, size, profiles, profile, curves):
    network = {"schema": "fetexc-network/1", "width": size[0], "height": size[1], "profiles": profiles,
               "profile": profile}
    lines = json.dumps(network)[:-1] + ', "curves": [\n'
    lines += ",\n".join("  " + json.dumps(curve) for curve in curves) + "\n]}\n"
    (FOLDER / name).write_text(lines, encoding="utf-8")


def leaf():
    """An outline, a midrib, and side veins that bend towards the tip and branch."""
    def rib(t):  # 0 at the stem, 1 at the tip
        return 100 + 10 * math.sin(3 * t) * (1 - t), 285 - 265 * t

    def half_width(t):
        return 78 * math.sin(math.pi * min(1, 0.06 + t) ** 0.8) * (1 - 0.35 * t)

    def edge(t, side):
        x, y = rib(t)
        return x + side * half_width(t), y + 12 * (1 - t)

    steps = 12
    ring = [edge(k / steps, 1) for k in range(1, steps)] + [rib(1)]
    ring += [edge(k / steps, -1) for k in range(steps - 1, 0, -1)]
    start = rib(0)
    segments = []
    for k, (x, y) in enumerate(ring):  # quadratics through the middles of a polygon
        nx, ny = ring[k + 1] if k + 1 < len(ring) else start
        segments.append(points(x, y, (x + nx) / 2, (y + ny) / 2) if k + 1 < len(ring) else points(x, y, nx, ny))
    curves = [{"name": "outline", "closed": True, "start": points(*start), "profile": "rim", "segments": segments}]
    rib_ends = [rib(k / 6) for k in range(7)]
    curves.append({"name": "midrib", "start": points(102, 298),
                   "segments": [points(102, 292, *start)] + [points(*p) for p in rib_ends[1:-1]] +
                               [points(*rib_ends[-1])]})
    for k in range(1, 8):
        for side in (-1, 1):
            t = (k + (0.25 if side > 0 else 0)) / 9
            x, y = rib(t)
            ex, ey = edge(min(t + 0.16, 0.97), side)
            ex = x + 0.94 * (ex - x)
            mx, my = x + 0.55 * (ex - x), y - 0.25 * (y - ey)
            curves.append({"name": f"vein {k}", "start": points(x, y), "segments": [points(mx, my, ex, ey)]})
            bx, by = (x + 2 * mx + ex) / 4, (y + 2 * my + ey) / 4  # the vein's middle
            curves.append({"name": f"branch {k}", "start": points(bx, by),
                           "segments": [points(bx + side * 6, by - 14, bx + side * 4 + 0.2 * (ex - bx), by - 22)]})
    write("leaf.json", (200, 300),
          {"vein": {"preset": "seam", "width": 5, "height": 1.6, "color": [0.75, 0.85, 0.45]},
           "rim": {"preset": "crease", "width": 4, "height": 1.5, "color": [0.3, 0.45, 0.15]}}, "vein", curves)


def tiling():
    """Every edge of a grid of squares is the same wave, turned: all tiles are one shape."""
    cells, side = 5, 48
    curves = []
    for a in range(cells + 1):
        across, down = [], []
        for b in range(cells):
            x, y, bend = side * b, side * a, 17 if (a + b) % 2 == 0 else -17
            across.append(points(x + 16, y - bend, x + 32, y + bend, x + side, y))
            down.append(points(y + bend, x + 16, y - bend, x + 32, y, x + side))
        curves.append({"name": f"row {a}", "start": points(0, side * a), "segments": across})
        curves.append({"name": f"column {a}", "start": points(side * a, 0), "segments": down})
    write("tiling.json", (cells * side, cells * side), {"joint": {"preset": "groove", "width": 5, "height": 2.5}},
          "joint", curves)


def burst():
    """Arms that wind out of one point, as in the paper's Fig. 17, and a ring that they cross."""
    arms, curves = 20, []
    for k in range(arms):
        turn = 2 * math.pi * k / arms

        def at(radius, angle):
            return 100 + radius * math.cos(turn + angle), 100 + radius * math.sin(turn + angle)
        curves.append({"name": f"arm {k}", "start": [100, 100],
                       "segments": [points(*at(34, 0), *at(66, 0.3), *at(94, 0.9))]})
    c = 0.5523 * 60
    curves.append({"name": "ring", "closed": True, "start": [160, 100],
                   "segments": [[160, 100 + c, 100 + c, 160, 100, 160], [100 - c, 160, 40, 100 + c, 40, 100],
                                [40, 100 - c, 100 - c, 40, 100, 40], [100 + c, 40, 160, 100 - c, 160, 100]]})
    curves[-1]["segments"] = [points(*s) for s in curves[-1]["segments"]]
    write("burst.json", (200, 200), {"cut": {"preset": "crease", "width": 4, "height": 2}}, "cut", curves)


def crease():
    """Two folds over the bumps of a smooth normal map; both end in the middle of nowhere."""
    curves = [{"name": "fold", "start": [10, 62], "segments": [[40, 18, 62, 96, 116, 40]]},
              {"name": "short fold", "start": [34, 12], "segments": [[60, 40, 74, 112]]}]
    write("crease.json", (128, 128), {"fold": {"preset": "crease", "width": 9, "height": 4}}, "fold", curves)


def panel():
    """Four profiles: piping around, seams that cross grooves, and folds that run out of a seam."""
    c = 0.5523 * 24
    ring = {"name": "piping", "closed": True, "start": [36, 12], "profile": "piping",
            "segments": [[204, 12], points(204 + c, 12, 228, 36 - c, 228, 36), [228, 204],
                         points(228, 204 + c, 204 + c, 228, 204, 228), [36, 228],
                         points(36 - c, 228, 12, 204 + c, 12, 204), [12, 36], points(12, 36 - c, 36 - c, 12, 36, 12)]}
    curves = [ring]
    for k, y in enumerate((70, 120, 170)):
        curves.append({"name": f"groove {k}", "start": [12, y], "profile": "groove",
                       "segments": [points(84, y + 34, 156, y - 34, 228, y + 9)]})
    for k, x in enumerate((80, 160)):
        curves.append({"name": f"seam {k}", "start": [x, 12], "profile": "seam",
                       "segments": [points(x - 30, 84, x + 40, 150, x - 6, 228)]})
    for k, (x, y) in enumerate(((73, 46), (80, 104), (89, 152), (84, 203), (153, 44), (160, 92), (170, 144), (165, 194))):
        side = -1 if k % 2 == 0 else 1
        curves.append({"name": f"fold {k}", "start": points(x + 3 * side, y), "profile": "fold",
                       "segments": [points(x + 18 * side, y - 4, x + 32 * side, y + 6)]})
    write("panel.json", (240, 240),
          {"piping": {"preset": "ridge", "width": 7, "height": 5, "color": [0.8, 0.6, 0.3]},
           "groove": {"preset": "groove", "width": 5, "height": 2.5, "color": [0.15, 0.2, 0.4]},
           "seam": {"preset": "seam", "width": 9, "height": 2, "color": [0.7, 0.2, 0.2]},
           "fold": {"preset": "crease", "width": 6, "height": 2.5, "color": [0.2, 0.5, 0.3]}}, "seam", curves)


def normal_map(size=64):
    """Bumps, green up."""
    def height(x, y):
        return 3 * math.sin(x / 9) * math.cos(y / 11) + math.sin((x + y) / 7)

    rows = bytearray()
    for y in range(size):
        rows.append(0)
        for x in range(size):
            u, v, h = 128 * (x + 0.5) / size, 128 * (y + 0.5) / size, 0.01
            n = [-(height(u + h, v) - height(u - h, v)) / (2 * h), (height(u, v + h) - height(u, v - h)) / (2 * h), 1]
            length = math.sqrt(sum(c * c for c in n))
            rows += bytes(round(255 * (c / length + 1) / 2) for c in n)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    data = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0))
    data += chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b"")
    (FOLDER / "bumps.png").write_bytes(data)


leaf()
tiling()
burst()
crease()
panel()
normal_map()
