#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bytes and error of every file of the corpus at 8 pixels a texel, as a Markdown table on stdout.

Compiles each file at --size texels on the longer side and compares the texture with the drawing at 8 pixels a texel (fetexc compare).
A file below 35 dB is marked. Exit 0: every file that compiles reaches 35 dB, 1: some don't or couldn't be measured; 77: no corpus here.
"""

import json
import pathlib
import statistics
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import corpus

LEAST_DB = 35
PIXELS_A_TEXEL = 8
COMPARE_LIMIT = 900  # seconds


def measure(fetexc, path, texels, folder):
    """A row of the table, or why there is none."""
    output = folder / f"{abs(hash(path))}.fetex"
    result = corpus.compile_file(fetexc, path, output, texels, ["-q"])
    if result["exit"] != 0:
        return None, " ".join(corpus.codes(result["messages"])) or f"exit {result['exit']}"
    printed, reason = corpus.output_of([fetexc, "compare", path, output, "--magnification", str(PIXELS_A_TEXEL), "--json", "-q", "-j", "1"],
                                       COMPARE_LIMIT)
    output.unlink(missing_ok=True)
    if printed is None:
        return None, reason
    found = json.loads(printed)["sizes"][0]
    report = result["report"]
    return {"width": report["width"], "height": report["height"], "bytes": report["gpuBytes"], "psnr": found["psnrDb"],
            "ppm": found["misclassified"]["ppm"], "codes": " ".join(corpus.codes(result["messages"]))}, ""


def decibels(value):
    return "exact" if value is None else f"{value:.1f}"


def main():
    parser = corpus.parser(__doc__)
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    if not options.corpus.is_dir():
        print(f"no corpus at {options.corpus}", file=sys.stderr)
        return corpus.SKIPPED
    paths = corpus.files(options.corpus, options.only)
    fetexc = options.build / "cli" / "fetexc"
    with tempfile.TemporaryDirectory(prefix="fetexc-table-") as folder, ThreadPoolExecutor(options.jobs) as pool:
        rows = list(pool.map(lambda path: measure(fetexc, path, options.size, pathlib.Path(folder)), paths))
    print("| file | texels | bytes | dB | wrong area (ppm) | |\n|---|---|---|---|---|---|")
    below = unmeasured = 0
    for path, (row, reason) in zip(paths, rows):
        name = path.relative_to(options.corpus)
        if row is None:
            unmeasured += 1
            print(f"| {name} | | | | | {reason} |")
            continue
        low = row["psnr"] is not None and row["psnr"] < LEAST_DB
        below += low
        print(f"| {name} | {row['width']} x {row['height']} | {row['bytes']} | {decibels(row['psnr'])} | {row['ppm']:.0f} | "
              f"{'below ' + str(LEAST_DB) if low else ''} |")
    figures = [row["psnr"] for row, _ in rows if row and row["psnr"] is not None]
    print(f"\n{len(figures)} files, {below} below {LEAST_DB} dB, {unmeasured} not measured; median {statistics.median(figures):.1f} dB, "
          f"{sum(row['bytes'] for row, _ in rows if row)} bytes in all", flush=True)
    return 0 if below == 0 and unmeasured == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
