# SPDX-License-Identifier: GPL-3.0-or-later
"""The corpus of real files: where it lies, what is in it, and how one file is compiled under limits."""

import argparse
import json
import os
import pathlib
import re
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
TIME_LIMIT = 60  # seconds for one file (issue 2)
INTERNAL = {"E1010", "E4001", "E7005", "E8052", "E8053"}  # numbered, but they explain nothing about the file
SKIPPED = 77  # exit code that ctest shows as "skipped"


def default_folder():
    return pathlib.Path(os.environ.get("FETEXC_CORPUS", ROOT.parent / "shared" / "corpus"))


def parser(description):
    """For the arguments that every runner takes."""
    made = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release", help="build folder")
    made.add_argument("--corpus", type=pathlib.Path, default=default_folder(), help="default: $FETEXC_CORPUS or ../shared/corpus")
    made.add_argument("--only", default="", help="files whose path contains this")
    return made


def files(folder, only=""):
    found = sorted(path for kind in ("*.svg", "*.svgz") for path in folder.rglob(kind))
    return [path for path in found if only in str(path.relative_to(folder))]


def compile_file(fetexc, path, output, size, extra=()):
    """Runs the compiler; a dict with exit (None: over the time limit), seconds, report (None on failure) and messages."""
    args = [fetexc, "compile", path, "-o", output, "--repr", "fbt", "--size", str(size), "-j", "1", "--report", "json", *extra]
    start = time.monotonic()
    try:
        done = subprocess.run(args, capture_output=True, timeout=TIME_LIMIT, check=False)
    except subprocess.TimeoutExpired:
        return {"exit": None, "seconds": time.monotonic() - start, "report": None, "messages": "over the time limit"}
    messages = done.stderr.decode("utf-8", "replace")
    report = json.loads(done.stdout)["results"][0] if done.returncode == 0 else None
    return {"exit": done.returncode, "seconds": time.monotonic() - start, "report": report, "messages": messages}


def output_of(args, limit):
    """What a program prints within so many seconds, and "" (None where it fails, and why)."""
    try:
        done = subprocess.run(args, capture_output=True, text=True, timeout=limit, check=False)
    except subprocess.TimeoutExpired:
        return None, f"over {limit} s"
    if done.returncode != 0:
        return None, done.stderr.strip() or f"exit {done.returncode}"
    return done.stdout, ""


def codes(messages):
    """Numbers of the diagnostics, each once, in order: E1203, W2001 …"""
    return list(dict.fromkeys(re.findall(r"\b(?:error|warning|note) ([EWN]\d{4})\b", messages)))


def verdict(result):
    """'' when the outcome is one that the issue allows: exit 0, or a numbered error with its class as exit code."""
    if result["exit"] is None:
        return "over the time limit"
    if result["exit"] < 0 or result["exit"] >= 126:
        return f"crashed (exit {result['exit']})"
    if result["exit"] == 0:
        return ""
    if result["exit"] not in (2, 3, 4, 5) or not any(code.startswith("E") for code in codes(result["messages"])):
        return f"exit {result['exit']} without a numbered error"
    internal = INTERNAL.intersection(codes(result["messages"]))
    if internal:
        return f"our own failure ({', '.join(sorted(internal))}), not the file's"
    return ""
