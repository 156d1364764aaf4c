#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the program says without its modules, or with wrong ones, and that `cmake --install` puts them where it looks."""

import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
DRAWING = HERE.parent / "art" / "alternatives" / "star.svg"
PICTURE = HERE.parent / "art" / "photo" / "still_life.png"
MODULES = ("libfetexc_png.so", "libfetexc_ceres.so")
BILEVEL = ("compile", DRAWING, "--repr", "bilevel", "--size", "16", "-o", "b.fetex")
FBT = ("compile", DRAWING, "--size", "16", "-o", "f.fetex")
RENDER = ("render", "f.fetex", "-o", "f.png", "--size", "16")
IMAGE = ("compile", "--image", PICTURE, "--repr", "bilevel", "-o", "i.fetex")
TIME_LIMIT = 120  # seconds


class Tried:
    def __init__(self, program, folder):
        self.program, self.folder, self.problems = program, folder, []

    def run(self, args, exit_code=0, says="", output=""):
        done = subprocess.run([self.program, *args], cwd=self.folder, capture_output=True, text=True, timeout=TIME_LIMIT)
        command = " ".join(str(a) for a in args)
        if done.returncode != exit_code:
            self.problems.append(f"{command}: exit {done.returncode}, expected {exit_code}; {done.stderr}")
        if says not in done.stderr or (not says and done.stderr):
            self.problems.append(f"{command}: says {done.stderr!r}, expected {says!r}")
        if output and (self.folder / output).exists() != (exit_code == 0):
            self.problems.append(f"{command}: {output} is {'missing' if exit_code == 0 else 'there'}")


def no_modules(program, folder):
    tried = Tried(shutil.copy(program, folder), folder)
    tried.run(FBT, output="f.fetex")
    tried.run(("info", "f.fetex"))
    tried.run(BILEVEL, 4, f"error E8053: {DRAWING}: no libfetexc_ceres.so beside the program", "b.fetex")
    tried.run(RENDER, 4, "error E8031: f.png: can't encode the PNG: no libfetexc_png.so beside the program", "f.png")
    tried.run(IMAGE, 4, f"error E8053: {PICTURE}: no libfetexc_png.so beside the program", "i.fetex")
    return tried.problems


def damaged_modules(program, folder):
    for name in MODULES:
        (folder / name).write_text("not a library")
    tried = Tried(shutil.copy(program, folder), folder)
    tried.run(FBT, output="f.fetex")
    tried.run(BILEVEL, 4, f"error E8053: {DRAWING}: can't load ", "b.fetex")
    tried.run(RENDER, 4, "can't encode the PNG: can't load ", "f.png")
    return tried.problems


def other_modules(program, folder):
    """Each has the other's name: libraries that load, but lack the functions."""
    shutil.copy(program.parent / MODULES[0], folder / MODULES[1])
    shutil.copy(program.parent / MODULES[1], folder / MODULES[0])
    tried = Tried(shutil.copy(program, folder), folder)
    tried.run(FBT, output="f.fetex")
    tried.run(BILEVEL, 4, "libfetexc_ceres.so is of another version: it lacks fetexc_solver_", "b.fetex")
    tried.run(RENDER, 4, "libfetexc_png.so is of another version: it lacks fetexc_encode_png", "f.png")
    return tried.problems


def beside(program, folder):
    for name in MODULES:
        shutil.copy(program.parent / name, folder)
    tried = Tried(shutil.copy(program, folder), folder)
    for args, output in ((FBT, "f.fetex"), (BILEVEL, "b.fetex"), (RENDER, "f.png")):
        tried.run(args, output=output)
    return tried.problems


def installed(program, folder):
    build = program.parent.parent
    command = ["cmake", "--install", build, "--prefix", folder / "prefix"]
    subprocess.run(command, check=True, timeout=TIME_LIMIT, stdout=subprocess.DEVNULL)
    tried = Tried(folder / "prefix" / "bin" / program.name, folder)
    for args, output in ((FBT, "f.fetex"), (BILEVEL, "b.fetex"), (RENDER, "f.png")):
        tried.run(args, output=output)
    if any((folder / "prefix" / "bin" / name).exists() for name in MODULES):
        tried.problems.append("modules lie among the programs")
    return tried.problems


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fetexc", required=True, type=lambda p: pathlib.Path(p).resolve(), help="in its build folder")
    options = parser.parse_args()
    failed = 0
    for case in (no_modules, damaged_modules, other_modules, beside, installed):
        with tempfile.TemporaryDirectory(prefix="fetexc-modules-") as folder:
            problems = case(options.fetexc, pathlib.Path(folder))
        failed += bool(problems)
        print(("ok      " if not problems else "FAILED  ") + case.__name__.replace("_", " "))
        for problem in problems:
            print("        " + problem)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
