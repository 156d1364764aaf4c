#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Are minified pictures right? Mip chains of files of every folder against exact areas, at 1/2, 1/4, 1/8, 1/16 pixel a texel.

Takes a few files of each folder of the corpus (--per-folder), compiles them at 128 texels with a chain (mip_errors.cpp) and
asks for 45 dB. Exit 0: all are, 1: some aren't, or a file failed; 77: no corpus here.
"""

import sys

import corpus

LEAST_DB = 45
TEXELS = 128


def chosen(folder, per_folder, only):
    """Evenly spread over each folder's files."""
    by_folder = {}
    for path in corpus.files(folder, only):
        by_folder.setdefault(path.relative_to(folder).parts[0], []).append(path)
    for paths in by_folder.values():
        yield from paths[:: max(1, -(-len(paths) // per_folder))]


def measure(program, path):
    """The four PSNRs, or why there are none."""
    printed, reason = corpus.output_of([program, path, str(TEXELS)], corpus.TIME_LIMIT * 2)
    return [float(value) for value in printed.split("\t")[5:9]] if printed else None, reason


def main():
    parser = corpus.parser(__doc__)
    parser.add_argument("--per-folder", type=int, default=2)
    options = parser.parse_args()
    if not options.corpus.is_dir():
        print(f"no corpus at {options.corpus}")
        return corpus.SKIPPED
    passed = failed = 0
    for path in chosen(options.corpus, options.per_folder, options.only):
        figures, reason = measure(options.build / "tests" / "corpus_mip_errors", path)
        good = figures is not None and min(figures) >= LEAST_DB
        passed, failed = passed + good, failed + (not good)
        text = " ".join(f"{value:5.1f}" for value in figures) if figures else reason
        print(f"{'ok  ' if good else 'FAIL'} {text}  {path.relative_to(options.corpus)}")
    print(f"{passed} passed, {failed} failed")
    return 0 if passed > 0 and failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
