#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole compiles, timed: against rsvg-convert, with one and two threads, with each skip rule off.

Process CPU is the smallest of a few runs that take turns, so that a busy machine hurts all alike. Ratios count, not
seconds. --check: only that no rule changes a byte (exit 1 if one does).
"""

import argparse
import hashlib
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import timing

ROOT = pathlib.Path(__file__).resolve().parents[2]
RULES = ("layers", "outside", "fans", "shared-ends", "certificate", "empty-texels", "direct-sweep", "first-sweep",
         "known-results", "hidden-fills")
SLOW_RULES = ("certificate",)  # minutes on large drawings
CHECK_SIZE = 32


class Bench:
    def __init__(self, fetexc, folder):
        self.fetexc = fetexc
        self.output = pathlib.Path(folder) / "out.fetex"
        self.picture = pathlib.Path(folder) / "out.png"

    def compile(self, drawing, size, jobs=1, off=()):
        rules = [f"--no-skip={r}" for r in off]
        return [self.fetexc, "compile", drawing, "-o", self.output, "--size", size, "-j", jobs, "-q", *rules]

    def rsvg(self, drawing, size):
        return ["rsvg-convert", "-w", size, "-h", size, "--keep-aspect-ratio", drawing, "-o", self.picture]

    def digest(self, command):
        subprocess.run([str(c) for c in command], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return hashlib.sha256(self.output.read_bytes()).hexdigest()

    @staticmethod
    def best(commands, repeat):
        """Smallest (CPU, wall) of each command, taking turns."""
        return [(min(c.cpu for c in costs), min(c.wall for c in costs)) for costs in timing.rounds(commands, repeat)]


def check(bench, drawings):
    """No rule changes a byte. Returns how many do."""
    wrong = 0
    for drawing in drawings:
        expected = bench.digest(bench.compile(drawing, CHECK_SIZE))
        for rule in RULES:
            if bench.digest(bench.compile(drawing, CHECK_SIZE, off=(rule,))) != expected:
                print(f"FAILED  {drawing.name}: --no-skip={rule} changes the bytes")
                wrong += 1
    print(f"{len(drawings)} drawings, {len(RULES)} rules, {wrong} change bytes")
    return wrong


def measure_rules(bench, drawing, size, repeat, rules):
    print(f"\n{drawing.name}, {size} texels, one thread: CPU with a rule off, as a multiple of CPU with all on")
    times = bench.best([bench.compile(drawing, size)] + [bench.compile(drawing, size, off=(r,)) for r in rules], repeat)
    print(f"  {'all on':14} {times[0][0]:8.3f} s")
    for rule, (cpu, _) in zip(rules, times[1:]):
        print(f"  {rule:14} {cpu / times[0][0]:8.2f} x")


def measure_threads(bench, drawing, size, repeat):
    one, two = bench.best([bench.compile(drawing, size, 1), bench.compile(drawing, size, 2)], repeat)
    print(f"  {drawing.name:44} {one[1] / two[1]:5.2f} x   (wall {one[1]:.3f} and {two[1]:.3f} s)")


def measure_rsvg(bench, drawings, size, pixels, repeat):
    print(f"\nCPU of compiling to {size} texels, as a part of rsvg-convert's to {pixels} pixels")
    worst = 0
    rows = []
    for drawing in drawings:
        (ours, _), (theirs, _) = bench.best([bench.compile(drawing, size), bench.rsvg(drawing, pixels)], repeat)
        rows.append((ours / theirs, ours, theirs, drawing.name))
        worst = max(worst, ours / theirs)
    for ratio, ours, theirs, name in sorted(rows, reverse=True)[:10]:
        print(f"  {ratio:6.2f}   {ours:7.3f} {theirs:7.3f} s   {name}")
    print(f"  {len(rows)} drawings, the slowest at {worst:.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fetexc", default=ROOT / "build/release/cli/fetexc", type=pathlib.Path)
    parser.add_argument("--corpus", default=ROOT / "../shared/corpus", type=pathlib.Path)
    parser.add_argument("--size", default=256, type=int)
    parser.add_argument("--repeat", default=5, type=int)
    parser.add_argument("--slow", action="store_true", help="also the rules that take minutes when off")
    parser.add_argument("--all", action="store_true", help="every drawing of the corpus against rsvg-convert")
    parser.add_argument("--check", action="store_true", help="only check that no rule changes a byte, on our own art")
    parser.add_argument("drawings", nargs="*", type=pathlib.Path)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="fetexc-bench-") as folder:
        bench = Bench(args.fetexc, folder)
        if args.check:
            return 1 if check(bench, args.drawings or sorted((ROOT / "tests/art").glob("*.svg"))) else 0
        tiger = args.corpus / "classic/Ghostscript_Tiger.svg"
        if not args.drawings and not tiger.exists():
            print("skipped: no corpus here; name drawings to measure")
            return 77
        drawings = args.drawings or [tiger, args.corpus / "maps/world.coloured.svg"]
        print(f"{os.cpu_count()} cores; two threads against one, wall time")
        for drawing in drawings:
            measure_threads(bench, drawing, args.size, args.repeat)
        for drawing in drawings:
            measure_rules(bench, drawing, args.size, args.repeat, [r for r in RULES if args.slow or r not in SLOW_RULES])
        if shutil.which("rsvg-convert") is None:
            print("\nskipped: no rsvg-convert here")
            return 0
        measure_rsvg(bench, drawings[:1], args.size, 2048, args.repeat)
        if args.all:
            every = sorted(p for p in args.corpus.rglob("*.svg*") if p.suffix in (".svg", ".svgz"))
            measure_rsvg(bench, every, args.size, 4096, 2)
    return 0


if __name__ == "__main__":
    sys.exit(main())
