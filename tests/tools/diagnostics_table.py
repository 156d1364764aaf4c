#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""README.md must list every diagnostic of compiler/diagnostics.h (and of the runtime); --update rewrites its table."""

import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
README, HEADER = ROOT / "README.md", ROOT / "compiler" / "diagnostics.h"
RUNTIME = ROOT / "runtime_glsl" / "host" / "image.h"
BEGIN, END = "<!-- diagnostics: ./dev docs -->", "<!-- end of diagnostics -->"


def letter(number):
    """2001 … 2099 are warnings, 2101 … notes, 4101 … and 5101 … findings that stop nothing."""
    if 2000 <= number < 2100 or 4100 <= number < 4200 or 5100 <= number < 5200:
        return "W"
    return "N" if 2100 <= number < 3000 else "E"


def rows():
    found = re.findall(r"constexpr int k\w+ = (\d+);\s*///< (.*)", HEADER.read_text(encoding="utf-8"))
    found += re.findall(r"^\s+\w+ = (7\d{3}),\s*///< (.*)", RUNTIME.read_text(encoding="utf-8"), re.MULTILINE)
    for number, text in sorted((int(number), text.strip()) for number, text in found):
        yield f"| {letter(number)}{number} | {text} |"


def table():
    return "\n".join([BEGIN, "", "| number | meaning |", "|---|---|", *rows(), "", END])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()
    text = README.read_text(encoding="utf-8")
    before, rest = text.split(BEGIN, 1)
    wanted = before + table() + rest.split(END, 1)[1]
    if options.update:
        README.write_text(wanted, encoding="utf-8")
    same = wanted == README.read_text(encoding="utf-8")
    if not same:
        print("README.md doesn't list the diagnostics of compiler/diagnostics.h: run ./dev docs")
    print(f"{int(same)} passed, {int(not same)} failed")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
