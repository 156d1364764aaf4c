#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the exact bytes of our own art as .fetex, for one thread and for several, against golden.sha256."""

import argparse
import hashlib
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
LIST = HERE / "golden.sha256"
SIZES = (64, 128)  # texels of FBTs
BYTES = (768, 3072)  # of bi-level textures, mip levels included
CELL_BITS = (8, 16)  # of silhouette maps
CLUSTERS = 32  # of pinchmaps
JOBS = (1, 2)
TIME_LIMIT = 300  # seconds for one drawing


def compile_digest(fetexc, drawing, how, jobs, folder):
    output = pathlib.Path(folder) / "out.fetex"
    args = [fetexc, "compile", drawing, "-o", output, *how, "-j", str(jobs), "-q"]
    subprocess.run(args, check=True, timeout=TIME_LIMIT, stdout=subprocess.DEVNULL)
    return hashlib.sha256(output.read_bytes()).hexdigest()


def assets(art):
    """Yields (name, drawing, options): all drawings as FBTs and silhouette maps, those of two colours as bi-level
    textures and pinchmaps, networks as textures with feature curves."""
    for drawing in sorted(art.glob("*.svg")):
        for size in SIZES:
            yield f"{drawing.stem}.{size}.fbt", drawing, ["--size", str(size)]
        for bits in CELL_BITS:
            options = ["--repr", "silmap", "--mips", "--size", str(SIZES[0]), "--cell-bits", str(bits)]
            yield f"{drawing.stem}.{bits}.silmap", drawing, options
    for drawing in sorted((art / "alternatives").glob("*.svg")):
        for size in BYTES:
            options = ["--repr", "bilevel", "--mips", "--max-bytes", str(size)]
            yield f"alternatives/{drawing.stem}.{size}.bilevel", drawing, options
        options = ["--repr", "pinchmap", "--mips", "--size", str(CLUSTERS)]
        yield f"alternatives/{drawing.stem}.pinchmap", drawing, options
    for network in sorted((art / "network").glob("*.json")):
        for form in ("linear", "curved"):
            options = ["--repr", "curves", "--mips", "--size", str(SIZES[0])] + (["--linear"] if form == "linear" else [])
            yield f"network/{network.stem}.{form}.curves", network, options


def digests(fetexc, art):
    """Yields (name, digest, problem)."""
    with tempfile.TemporaryDirectory(prefix="fetexc-golden-") as folder:
        for name, drawing, how in assets(art):
            found = {compile_digest(fetexc, drawing, how, jobs, folder) for jobs in JOBS}
            problem = "" if len(found) == 1 else f"-j {JOBS[0]} and -j {JOBS[1]} give different bytes"
            yield name, min(found), problem


def read_list():
    lines = LIST.read_text(encoding="ascii").splitlines() if LIST.exists() else []
    return {name: digest for digest, name in (line.split() for line in lines)}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fetexc", required=True, type=pathlib.Path)
    parser.add_argument("--art", default=HERE.parent / "art", type=pathlib.Path)
    parser.add_argument("--update", action="store_true", help="rewrite the list; say in the commit why the bytes changed")
    options = parser.parse_args()
    expected, found, passed, failed = read_list(), {}, 0, 0
    for name, digest, problem in digests(options.fetexc.resolve(), options.art):
        found[name] = digest
        if not problem and expected.get(name) != digest and not options.update:
            problem = "not in the list" if name not in expected else "the bytes changed"
        if options.update and expected.get(name) != digest:
            print(f"updated {name}")
        passed, failed = passed + (not problem), failed + bool(problem)
        if problem:
            print(f"FAILED  {name}: {problem}")
    for name in expected.keys() - found.keys():
        if not options.update:
            failed += 1
            print(f"FAILED  {name}: in the list, but there is no such drawing")
    if options.update and not failed:
        LIST.write_text("".join(f"{found[name]}  {name}\n" for name in sorted(found)), encoding="ascii")
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
