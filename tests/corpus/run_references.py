#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares what we draw with the reference pictures of the resvg files: 300 px wide, a pixel differs when a channel (premultiplied) is off
by more than 64, a file passes with at most 0.4% of its pixels different. At least 95% of the files without filters, patterns or
text must pass; the others are shown too."""

import concurrent.futures
import pathlib
import re
import subprocess
import sys
import tempfile

import corpus

sys.path.insert(0, str(corpus.ROOT / "tests" / "tools"))
import png  # noqa: E402

CHANNEL_LIMIT = 64
PIXEL_LIMIT = 0.004
PASS_RATE = 0.95
TEXELS = 128
SET_ASIDE = re.compile(r"<(filter|pattern|text|image)\b")


def premultiplied(rgba):
    out = bytearray(rgba)
    for i in range(0, len(out), 4):
        alpha = out[i + 3]
        if alpha != 255:
            for channel in range(i, i + 3):
                out[channel] = (out[channel] * alpha + 127) // 255
    return out


def different_pixels(a, b):
    count = 0
    for i in range(0, len(a), 4):
        if a[i : i + 4] != b[i : i + 4] and max(abs(a[i + k] - b[i + k]) for k in range(4)) > CHANNEL_LIMIT:
            count += 1
    return count


def reference_for(svg):
    """The pictures' names keep '=' and the drawings' have '_' instead."""
    wanted = svg.stem.replace("=", "_")
    return next((path for path in svg.parent.glob("*.png") if path.stem.replace("=", "_") == wanted), None)


def compare(fetexc, svg, reference, scratch, backend):
    base = pathlib.Path(scratch) / "__".join(svg.parts[-3:])
    texture, picture = base.with_suffix(".fetex"), base.with_suffix(".png")
    result = corpus.compile_file(fetexc, svg, texture, TEXELS)
    width, height, expected = png.read(reference)
    if result["exit"] != 0:
        return None, " ".join(corpus.codes(result["messages"])) or f"exit {result['exit']}"
    args = ["render", texture, "-o", picture, "--size", f"{width}x{height}", "--backend", backend]
    subprocess.run([fetexc, *args], check=True, capture_output=True, timeout=corpus.TIME_LIMIT)
    _, _, drawn = png.read(picture)
    share = different_pixels(premultiplied(drawn), premultiplied(expected)) / (width * height)
    return share, " ".join(corpus.codes(result["messages"]))


def main():
    parser = corpus.parser(__doc__)
    parser.add_argument("--backend", default="cpu")
    parser.add_argument("--keep", type=pathlib.Path, help="keep textures and pictures in this folder")
    options = parser.parse_args()
    fetexc = options.build.resolve() / "cli" / "fetexc"
    folder = options.corpus / "resvg"
    if not folder.is_dir():
        print(f"skipped: no reference pictures at {folder} (set FETEXC_CORPUS)")
        return corpus.SKIPPED
    pairs = [(svg, reference_for(svg)) for svg in corpus.files(folder, options.only)]
    pairs = [(svg, reference) for svg, reference in pairs if reference]
    with tempfile.TemporaryDirectory(prefix="fetexc-references-") as temporary:
        scratch = options.keep or temporary
        pathlib.Path(scratch).mkdir(parents=True, exist_ok=True)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            outcomes = list(pool.map(lambda pair: compare(fetexc, *pair, scratch, options.backend), pairs))
    counted = passed = 0
    for (svg, _), (share, note) in zip(pairs, outcomes):
        aside = bool(SET_ASIDE.search(svg.read_text(encoding="utf-8")))
        good = share is not None and share <= PIXEL_LIMIT
        counted, passed = counted + (not aside), passed + (good and not aside)
        figure = "     - " if share is None else f"{100 * share:6.2f}%"
        word = "ok    " if good else "differs"
        print(f"{str(svg.relative_to(folder)):<80} {figure} {word} {'(set aside) ' if aside else ''}{note}")
    print(f"{passed} of {counted} counted files match their reference ({100 * passed / max(counted, 1):.1f}%, at least {100 * PASS_RATE:.0f}% asked)")
    enough = counted > 0 and passed >= PASS_RATE * counted
    print(f"{int(enough)} passed, {int(not enough)} failed")
    return 0 if enough else 1


if __name__ == "__main__":
    sys.exit(main())
