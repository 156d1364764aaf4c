#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every file of the corpus against the ground truth: no random point farther than 2^-14 texel from an edge in a wrong region (that of a
raster layer is its outline's), solid colours right to 1/255, GLSL equal to the CPU reference within 1/255 away from edges at 1, 8, 64 and 512
pixels a texel, under every back end asked for."""

import concurrent.futures
import json
import subprocess
import sys

import corpus


def run_one(program, path, options):
    args = [program, path, "--size", str(options.size), "--points", str(options.points)]
    for backend in options.backend:
        args += ["--backend", backend]
    try:
        done = subprocess.run(args, capture_output=True, timeout=options.limit, check=False)
    except subprocess.TimeoutExpired:
        return None, f"over {options.limit} s"
    if done.returncode in (3, 5):
        return None, ""  # refused with a number: run_corpus.py judges that
    if done.returncode != 0:
        return None, f"exit {done.returncode}: " + done.stderr.decode("utf-8", "replace")[-300:].strip()
    return json.loads(done.stdout), ""


def problems(result):
    regions = result["regions"]
    if regions["wrongFar"]:
        yield f"{regions['wrongFar']} points in a wrong region, the worst {regions['worstDistance']:.2e} texel off: {regions['worst']}"
    if regions["colorOff"]:
        yield f"{regions['colorOff']} solid colours off: {regions['worst']}"
    for name, comparison in result["renderers"].items():
        if comparison["error"]:
            yield f"{name}: {comparison['error']}"
        elif comparison["wrong"] or not comparison["pixels"]:
            yield f"{name}: {comparison['wrong']} of {comparison['pixels']} pixels differ, first {comparison['firstWrong']}"


def row(name, result, found):
    if result is None:
        return f"{name:<62.62}  " + ("FAILED: " + found[0] if found else "refused")
    regions = result["regions"]
    cells = [f"{name:<62.62}", "vector" if result["vectorOnly"] else "raster", f"{regions['wrong']:6d}", f"{regions['wrongFar']:5d}"]
    cells.append(f"{regions['worstDistance']:9.1e}")
    for comparison in result["renderers"].values():
        cells.append(f"{comparison['wrong']:6d} ({comparison['onEdge']} on edges)")
    return "  ".join(cells) + ("  FAILED: " + "; ".join(found) if found else "")


def main():
    parser = corpus.parser(__doc__)
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--points", type=int, default=100000)
    parser.add_argument("--backend", action="append", default=[], help="osmesa, egl-surfaceless, egl-device or glfw; several times")
    parser.add_argument("--limit", type=int, default=300, help="seconds for one file")
    options = parser.parse_args()
    if not options.corpus.is_dir():
        print(f"skipped: no corpus at {options.corpus} (set FETEXC_CORPUS)")
        return corpus.SKIPPED
    program = options.build.resolve() / "tests" / "corpus_check_file"
    paths = corpus.files(options.corpus, options.only)
    failed = 0
    print(f"{'file':<62}  kind     wrong    far  worst      " + "  ".join(options.backend))
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for path, (result, error) in zip(paths, pool.map(lambda path: run_one(program, path, options), paths)):
            found = [error] if error else list(problems(result)) if result else []
            failed += bool(found)
            print(row(str(path.relative_to(options.corpus)), result, found), flush=True)
    print(f"{len(paths) - failed} passed, {failed} failed")
    return 1 if failed or not paths else 0


if __name__ == "__main__":
    sys.exit(main())
