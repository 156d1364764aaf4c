#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the error figures of our own art against the baselines here, exactly. README.md"""

import argparse
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ART = HERE.parent / "art"
# Baseline -> folder and names of drawings or networks.
SETS = {"art": (ART, "*.svg"), "two_colors": (ART / "alternatives", "*.svg"), "networks": (ART / "network", "*.json")}
SIZES, OUTPUT = "16,64", "128"
KEYS = 4  # columns that say which texture a line is about
TIME_LIMIT = 300  # seconds for one set
SHOWN = 20  # differences


def figures(fetexc, folder, names):
    """The CSV of a folder's drawings or networks, as text."""
    drawings = sorted(path.name for path in folder.glob(names))
    command = [
        fetexc, "bench", *drawings, "--size", SIZES, "--output-size", OUTPUT, "--no-timing", "--no-equal-bitmap", "-q",
        "--csv", "-",
    ]  # fmt: skip
    done = subprocess.run(command, cwd=folder, check=True, timeout=TIME_LIMIT, stdout=subprocess.PIPE)
    return done.stdout.decode("utf-8")


def table(text):
    """Header and a dictionary from key to cells. No cell of these files needs quotes but those of the header."""
    header, *lines = text.splitlines()
    cells = [line.split(",") for line in lines]
    return header.split(","), {tuple(row[:KEYS]): row for row in cells}


def differences(expected, found):
    """Yields a line of text for each figure that differs."""
    (header, old), (new_header, new) = table(expected), table(found)
    if header != new_header:
        yield "the columns changed"
        return
    for key in sorted(old.keys() | new.keys()):
        name = ", ".join(part for part in key if part)
        if key not in new:
            yield f"{name}: no longer there"
        elif key not in old:
            yield f"{name}: not in the baseline"
        else:
            for column, was, now in zip(header, old[key], new[key]):
                if was != now:
                    yield f"{name}: {column}: {was or 'nothing'} -> {now or 'nothing'}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fetexc", required=True, type=pathlib.Path)
    parser.add_argument("--update", action="store_true", help="rewrite the baselines; say in the commit why figures changed")
    options = parser.parse_args()
    passed = failed = 0
    for name, (folder, names) in SETS.items():
        baseline = HERE / f"{name}.csv"
        expected = baseline.read_text(encoding="utf-8") if baseline.exists() else ""
        found = figures(options.fetexc.resolve(), folder, names)
        problems = list(differences(expected, found)) if expected else ["no baseline"]
        if options.update:
            baseline.write_text(found, encoding="utf-8")
        for line in problems[:SHOWN]:
            print(f"{'updated' if options.update else 'FAILED '} {name}: {line}")
        if len(problems) > SHOWN:
            print(f"        {name}: {len(problems) - SHOWN} more")
        good = options.update or not problems
        passed, failed = passed + good, failed + (not good)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
