#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Base against head: time and peak memory of whole compiles by two builds of fetexc, taking turns.

BASE and HEAD are programs, or git revisions that are built first (once, below build/revisions). For every drawing: the
median over the rounds of head's CPU time divided by base's in the same round, and the ratio of the peaks of memory.
Exit 1 when the geometric mean of the times or of the memory, or a single drawing, is beyond its limit.
"""

import argparse
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

import timing

ROOT = pathlib.Path(__file__).resolve().parents[2]


def built(revision):
    """The program of a git revision."""
    found = subprocess.run(["git", "-C", ROOT, "rev-parse", "--verify", f"{revision}^{{commit}}"],
                           capture_output=True, text=True)
    if found.returncode != 0:
        sys.exit(f"{revision} is neither a program nor a git revision")
    commit = found.stdout.strip()
    source, build = (ROOT / "build/revisions" / f"{commit[:12]}-{part}" for part in ("source", "build"))
    program = build / "cli/fetexc"
    if program.exists():
        return program
    if not source.exists():
        subprocess.run(["git", "-C", ROOT, "worktree", "add", "--detach", source, commit], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    print(f"building {revision} ({commit[:12]})", flush=True)
    configure = ["cmake", "-S", source, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DFETEXC_TESTS=OFF"]
    subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", build, "--target", "fetexc"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["git", "-C", ROOT, "worktree", "remove", "--force", source], check=True)
    return program


def program_of(name):
    path = pathlib.Path(name)
    return path.resolve() if path.is_file() else built(name)


def geometric_mean(values):
    return math.exp(statistics.fmean(math.log(v) for v in values))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("base", help="program or git revision")
    parser.add_argument("head", help="program or git revision")
    parser.add_argument("drawings", nargs="*", type=pathlib.Path, help="default: tests/art")
    parser.add_argument("--size", default=256, type=int)
    parser.add_argument("--rounds", default=11, type=int)
    parser.add_argument("--limit", default=1.05, type=float, help="of both geometric means")
    parser.add_argument("--limit-one", default=1.3, type=float, help="of a single drawing")
    args = parser.parse_intermixed_args()
    programs = [program_of(args.base), program_of(args.head)]
    drawings = args.drawings or sorted((ROOT / "tests/art").glob("*.svg"))
    times, memory = {}, {}
    print(f"head / base, {args.size} texels, one thread, {args.rounds} rounds\n  CPU   memory   head\n  ----- ------ -------")
    with tempfile.TemporaryDirectory(prefix="fetexc-compare-") as folder:
        for drawing in drawings:
            commands = [[p, "compile", drawing, "-o", pathlib.Path(folder) / "out.fetex", "--size", args.size, "-j", 1,
                         "-q"] for p in programs]
            base, head = timing.rounds(commands, args.rounds)
            times[drawing] = statistics.median(h.cpu / b.cpu for h, b in zip(head, base))
            memory[drawing] = min(h.memory for h in head) / min(b.memory for b in base)
            cpu = statistics.median(h.cpu for h in head)
            print(f"  {times[drawing]:5.2f}  {memory[drawing]:5.2f} {cpu:6.3f} s  {drawing.name}", flush=True)
    means = geometric_mean(times.values()), geometric_mean(memory.values())
    print(f"  {means[0]:5.2f}  {means[1]:5.2f}           geometric means")
    slow = [d for d in drawings if max(times[d], memory[d]) > args.limit_one]
    for drawing in slow:
        print(f"FAILED  {drawing.name} is beyond {args.limit_one}")
    if max(means) > args.limit:
        print(f"FAILED  a geometric mean is beyond {args.limit}")
    return 1 if slow or max(means) > args.limit else 0


if __name__ == "__main__":
    sys.exit(main())
