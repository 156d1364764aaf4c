#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the command line cases of a JSON file, each in a folder of its own. README.md describes the file."""

import argparse
import json
import os
import pathlib
import pty
import re
import shutil
import subprocess
import sys
import tempfile
import threading

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "tools"))
import json_schema  # noqa: E402
import png  # noqa: E402

TIME_LIMIT = 120  # seconds for one command

KNOWN = {
    "name", "files", "setup", "patch", "args", "stdin", "exit", "stdout", "stderr", "stdout_not", "stderr_not",
    "stdout_empty", "stderr_empty", "exists", "absent", "unchanged", "same_bytes", "different_bytes", "text", "png",
    "schema", "stderr_tty", "links", "modes", "stdout_to", "pixels",
}  # fmt: skip


def write_files(folder, files, art):
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if content is None:
            path.mkdir(exist_ok=True)
        elif content.startswith("@"):
            shutil.copy(art / content[1:], path)
        else:
            path.write_text(content, encoding="utf-8")


def apply_patch(folder, patch):
    path = folder / patch["file"]
    data = bytearray(path.read_bytes())
    if "truncate" in patch:
        data = data[: patch["truncate"]]
    if "xor" in patch:
        data[patch["offset"]] ^= patch["xor"]
    if "append" in patch:
        data += patch["append"].encode()
    path.write_bytes(data)


class NoTerminal(Exception):
    """This machine has no pseudo-terminals (a container without /dev/pts)."""


class Terminal:
    """A pseudo-terminal to run stderr on; what was drawn is read in a thread until the program closes its end."""

    def __init__(self):
        try:
            self.master, self.slave = pty.openpty()
        except OSError as error:
            raise NoTerminal(str(error)) from error
        self.drawn = b""
        self.thread = threading.Thread(target=self.read)

    def read(self):
        while True:
            try:
                block = os.read(self.master, 65536)
            except OSError:  # EIO: every slave end is closed
                return
            if not block:
                return
            self.drawn += block

    def finish(self):
        os.close(self.slave)
        self.thread.join()
        os.close(self.master)
        return self.drawn.replace(b"\r\n", b"\n")


def run(fetexc, args, folder, stdin=b"", on_terminal=False, stdout_to=None):
    terminal = Terminal() if on_terminal else None
    if terminal:
        terminal.thread.start()
    stdout = open(stdout_to, "wb") if stdout_to else subprocess.PIPE
    try:
        done = subprocess.run(
            [fetexc, *args], cwd=folder, input=stdin, stdout=stdout,
            stderr=terminal.slave if terminal else subprocess.PIPE, timeout=TIME_LIMIT, check=False,
        )  # fmt: skip
    finally:
        stderr = terminal.finish() if terminal else None
        if stdout_to:
            stdout.close()
    return done.returncode, done.stdout or b"", done.stderr if stderr is None else stderr


def check_stream(case, stream, data, problems):
    text = data.decode("utf-8", "replace")
    for pattern in case.get(stream, []):
        if not re.search(pattern, text, re.MULTILINE):
            problems.append(f"{stream} doesn't match {pattern!r}")
    for pattern in case.get(stream + "_not", []):
        if re.search(pattern, text, re.MULTILINE):
            problems.append(f"{stream} matches {pattern!r}")
    if case.get(stream + "_empty") and data:
        problems.append(f"{stream} isn't empty")


def check_files(case, folder, before, problems):
    for name in case.get("exists", []):
        if not (folder / name).exists():
            problems.append(f"{name} wasn't made")
    for name in case.get("absent", []):
        if list(folder.glob(name)):
            problems.append(f"{name} shouldn't be there")
    for name, data in before.items():
        if (folder / name).read_bytes() != data:
            problems.append(f"{name} was changed")
    for a, b in case.get("same_bytes", []):
        if (folder / a).read_bytes() != (folder / b).read_bytes():
            problems.append(f"{a} and {b} differ")
    for a, b in case.get("different_bytes", []):
        if (folder / a).read_bytes() == (folder / b).read_bytes():
            problems.append(f"{a} and {b} are the same")
    for name, text in case.get("text", {}).items():
        if (folder / name).read_text(encoding="utf-8") != text:
            problems.append(f"{name} holds {(folder / name).read_text(encoding='utf-8')!r}")
    for name, mode in case.get("modes", {}).items():
        if (folder / name).stat().st_mode & 0o777 != int(mode, 8):
            problems.append(f"{name} has mode {(folder / name).stat().st_mode & 0o777:o}")
    if [path for path in folder.rglob("*.tmp")]:
        problems.append("a temporary file was left behind")


def check_pictures(case, folder, problems):
    for name, size in case.get("png", {}).items():
        width, height, _ = png.read(folder / name)
        if [width, height] != size:
            problems.append(f"{name} is {width} x {height}")
    for name, pixels in case.get("pixels", {}).items():
        width, _, rgba = png.read(folder / name)
        for x, y, *colour in pixels:
            found = list(rgba[4 * (y * width + x) : 4 * (y * width + x) + 4])
            if max(abs(a - b) for a, b in zip(found, colour)) > 1:
                problems.append(f"{name} has {found} at {x},{y}, not {colour}")


def check_schema(case, stdout, schemas, problems):
    if "schema" not in case:
        return
    schema = json.loads((schemas / case["schema"]).read_text(encoding="utf-8"))
    problems.extend(json_schema.problems(json.loads(stdout), schema))


def prepare(case, folder, options):
    write_files(folder, case.get("files", {}), options.art)
    for link, target in case.get("links", {}).items():
        (folder / link).symlink_to(target)
    for args in case.get("setup", []):
        code, _, stderr = run(options.fetexc, args, folder)
        if code != 0:
            raise RuntimeError(f"setup {args} failed with {code}: {stderr.decode()}")
    for patch in case.get("patch", []):
        apply_patch(folder, patch)


def run_case(case, options):
    unknown = case.keys() - KNOWN
    if unknown:
        return [f"unknown keys {sorted(unknown)}"]
    problems = []
    with tempfile.TemporaryDirectory(prefix="fetexc-cli-") as name:
        folder = pathlib.Path(name)
        prepare(case, folder, options)
        before = {path: (folder / path).read_bytes() for path in case.get("unchanged", [])}
        stdin = case.get("stdin", "")
        stdin = (folder / stdin[1:]).read_bytes() if stdin.startswith("@") else stdin.encode()
        code, stdout, stderr = run(
            options.fetexc, case["args"], folder, stdin, case.get("stderr_tty", False), case.get("stdout_to")
        )
        if code != case["exit"]:
            problems.append(f"exit code {code}, not {case['exit']}")
        check_stream(case, "stdout", stdout, problems)
        check_stream(case, "stderr", stderr, problems)
        check_files(case, folder, before, problems)
        if not problems:
            check_pictures(case, folder, problems)
            check_schema(case, stdout, options.schemas, problems)
        if problems:
            problems.append("stdout: " + stdout[:2000].decode("utf-8", "replace"))
            problems.append("stderr: " + stderr[:2000].decode("utf-8", "replace"))
    return problems


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fetexc", required=True, type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("--art", default=HERE.parent / "art", type=pathlib.Path)
    parser.add_argument("--schemas", default=HERE.parent.parent / "cli" / "schema", type=pathlib.Path)
    parser.add_argument("--only", default="", help="run the cases whose name contains this")
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    options = parser.parse_args()
    passed = failed = skipped = 0
    for file in options.files:
        for case in json.loads(file.read_text(encoding="utf-8")):
            if options.only not in case["name"]:
                continue
            try:
                problems = run_case(case, options)
            except NoTerminal as error:
                skipped += 1
                print(f"skipped {file.stem}: {case['name']}: {error}")
                continue
            except Exception as error:  # a broken case is a failed case
                problems = [f"{type(error).__name__}: {error}"]
            passed, failed = passed + (not problems), failed + bool(problems)
            print(("ok      " if not problems else "FAILED  ") + f"{file.stem}: {case['name']}")
            for problem in problems:
                print("        " + problem)
    print(f"{passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""))
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
