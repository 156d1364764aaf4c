#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""An oracle for the exactly integrated picture (compiler/measure): opaque shapes that share no edges, for which rasterisers are right,
drawn by rsvg-convert too. Coverage may differ by no more than cairo's way of sampling explains, in any pixel, on average and in sum;
and it must add up to the shape's area, by the shoelace formula or pi r^2, to 5e-8 of the canvas. Exit 77 without rsvg-convert."""

import argparse
import math
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "tools"))
import png  # noqa: E402

SKIPPED = 77
SIZE = 128
# cairo puts corners on a grid of 15 lines a pixel, samples these lines (each exact to 1/256), rounds to 1/255, and replaces curves by
# chords up to 0.1 pixel away. So an edge may be off by 1/30 pixel all along, and a pixel that two edges enter or leave by twice 1/15.
CHORD = 0.1
PIXEL_BOUND = 2 / 15 + 2 / 256 + 1 / 255
MEAN_BOUND = 1 / 30  # of the pixels partly covered
SUM_BOUND = 1 / 30  # a pixel partly covered; chords lie inside, by 2/3 of their height on average
AREA_BOUND = 5e-8  # of the canvas: control points move to the lattice, 2^-27 of it at most

def polygon_area(points):
    return abs(sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in zip(points, points[1:] + points[:1]))) / 2


def star(rng, count, centre, low, high):
    return [
        (centre[0] + r * math.cos(a), centre[1] + r * math.sin(a))
        for k in range(count)
        for a, r in [(2 * math.pi * (k + rng.random() * 0.8) / count, rng.uniform(low, high))]
    ]


def path_of(points):
    return "M" + " L".join(f"{x:.9f},{y:.9f}" for x, y in points) + " Z"


def rounded(points):
    return [(round(x, 9), round(y, 9)) for x, y in points]


def shapes(count):
    """(name, SVG element, area, how far its edges may be off in cairo)"""
    rng = random.Random(4)
    for k in range(count):
        points = rounded(star(rng, rng.randint(3, 11), (rng.uniform(40, 60), rng.uniform(40, 60)), 8, 38))
        yield f"star {k}", f'<path d="{path_of(points)}"/>', polygon_area(points), 0
        x, y, r = rng.uniform(35, 65), rng.uniform(35, 65), rng.uniform(2, 33)
        yield f"disc {k}", f'<circle cx="{x}" cy="{y}" r="{r}"/>', math.pi * r * r, CHORD
        outer = rounded(star(rng, 7, (50, 50), 30, 45))
        inner = [(50 + 0.8 * (px - 50), 50 + 0.8 * (py - 50)) for px, py in outer]
        area = polygon_area(outer) - polygon_area(inner)
        path = path_of(outer) + " " + path_of(inner)
        yield f"ring {k}", f'<path fill-rule="evenodd" d="{path}"/>', area, 0


def exact_alpha(program, svg):
    raw = subprocess.run([program, svg, str(SIZE), str(SIZE)], check=True, capture_output=True, timeout=120).stdout
    return [pixel[3] for pixel in struct.iter_unpack("4d", raw)]


def rsvg_alpha(svg, scratch):
    picture = pathlib.Path(scratch) / "rsvg.png"
    subprocess.run(["rsvg-convert", "-w", str(SIZE), "-h", str(SIZE), "-o", picture, svg], check=True, timeout=120)
    width, height, rgba = png.read(picture)
    assert (width, height) == (SIZE, SIZE)
    return [a / 255 for a in rgba[3::4]]


def faults(exact, drawn, area, chord):
    """What is wrong, and the figures."""
    off = [abs(a - b) for a, b in zip(exact, drawn)]
    partly = [error for a, error in zip(exact, off) if 1e-9 < a < 1 - 1e-9]
    figures = {
        "pixel": (max(off), PIXEL_BOUND + chord),
        "mean": (sum(partly) / len(partly), MEAN_BOUND + 2 / 3 * chord),
        "sum": (abs(sum(exact) - sum(drawn)) / len(partly), SUM_BOUND + 2 / 3 * chord),
        "area": (abs(sum(exact) / SIZE**2 - area / 100**2), AREA_BOUND),
    }
    text = ", ".join(f"{name} {value:.2g}" for name, (value, _) in figures.items())
    return [name for name, (value, bound) in figures.items() if value > bound], text


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", type=pathlib.Path, required=True, help="corpus_exact_picture")
    parser.add_argument("--count", type=int, default=8, help="shapes of each kind")
    options = parser.parse_args()
    if shutil.which("rsvg-convert") is None:
        print("skipped: no rsvg-convert on this machine")
        return SKIPPED
    passed = failed = 0
    with tempfile.TemporaryDirectory(prefix="fetexc-coverage-") as scratch:
        for name, element, area, chord in shapes(options.count):
            svg = pathlib.Path(scratch) / "shape.svg"
            svg.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">{element}</svg>')
            found, figures = faults(exact_alpha(options.program, svg), rsvg_alpha(svg, scratch), area, chord)
            print(f"{name:8} {figures}  {'FAILED: ' + ', '.join(found) if found else 'ok'}")
            passed, failed = passed + (not found), failed + bool(found)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
