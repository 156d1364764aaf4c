#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiles every SVG of a corpus and prints a table: exit, time, bytes, texels by work, diagnostics. Exit 1 when one crashes, takes
over 60 s, fails without a numbered error, or writes something that `fetexc validate` refuses."""

import collections
import concurrent.futures
import pathlib
import subprocess
import sys
import tempfile

import corpus


def run_one(fetexc, folder, path, size, scratch):
    name = str(path.relative_to(folder))
    output = pathlib.Path(scratch) / (name.replace("/", "__") + ".fetex")
    result = corpus.compile_file(fetexc, path, output, size)
    problem = corpus.verdict(result)
    if not problem and result["exit"] == 0:
        checked = subprocess.run([fetexc, "validate", "-q", output], capture_output=True, timeout=corpus.TIME_LIMIT, check=False)
        if checked.returncode != 0:
            problem = "writes an invalid file: " + checked.stdout.decode().splitlines()[0].split(": ", 1)[1]
        output.unlink()
    return name, result, problem


def share(part, whole):
    return f"{100 * part / whole:5.1f}" if whole else "    -"


def row(name, result, problem):
    exit_code = "time" if result["exit"] is None else str(result["exit"])
    cells = [f"{name:<62.62}", f"{exit_code:>4}", f"{1000 * result['seconds']:7.0f}"]
    if result["report"]:
        texels = result["report"]["planar"]["texels"]
        cells.append(f"{result['report']['gpuBytes']:9d}")
        cells += [share(texels[kind], texels["total"]) for kind in ("empty", "simple", "arranged")]
    else:
        cells += [" " * 8 + "-", "    -", "    -", "    -"]
    cells.append(" ".join(corpus.codes(result["messages"])) + ("  FAILED: " + problem if problem else ""))
    return "  ".join(cells)


def print_summary(results):
    exits = collections.Counter("time" if result["exit"] is None else result["exit"] for _, result, _ in results)
    codes = collections.Counter(code for _, result, _ in results for code in corpus.codes(result["messages"]))
    slowest = max(results, key=lambda item: item[1]["seconds"])
    print("exit codes: " + ", ".join(f"{code}: {count}" for code, count in sorted(exits.items(), key=str)))
    print("diagnostics: " + (", ".join(f"{code}: {count}" for code, count in sorted(codes.items())) or "none"))
    print(f"total {sum(result['seconds'] for _, result, _ in results):.0f} s, slowest {slowest[0]}: {slowest[1]['seconds']:.1f} s")


def main():
    parser = corpus.parser(__doc__)
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("-j", "--jobs", type=int, default=2, help="files compiled at a time")
    options = parser.parse_args()
    fetexc = options.build.resolve() / "cli" / "fetexc"
    if not options.corpus.is_dir():
        print(f"skipped: no corpus at {options.corpus} (set FETEXC_CORPUS)")
        return corpus.SKIPPED
    paths = corpus.files(options.corpus, options.only)
    print(f"{'file':<62}  exit       ms  GPU bytes  empty  simple  arr.%  diagnostics")
    with tempfile.TemporaryDirectory(prefix="fetexc-corpus-") as scratch:
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            results = []
            for item in pool.map(lambda path: run_one(fetexc, options.corpus, path, options.size, scratch), paths):
                print(row(*item), flush=True)
                results.append(item)
    if results:
        print_summary(results)
    failed = sum(bool(problem) for _, _, problem in results)
    print(f"{len(results) - failed} passed, {failed} failed")
    return 1 if failed or not results else 0


if __name__ == "__main__":
    sys.exit(main())
