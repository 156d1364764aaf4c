# SPDX-License-Identifier: GPL-3.0-or-later
"""Processes with what they took."""

import os
import subprocess
import time
from typing import NamedTuple


class Cost(NamedTuple):
    cpu: float  # seconds, of the process and what it waited for
    wall: float  # seconds
    memory: int  # peak, KiB


def run(command):
    """Runs a command and returns its Cost. CalledProcessError if it fails."""
    command = [str(c) for c in command]
    start = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.monotonic() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise subprocess.CalledProcessError(process.returncode, command)
    return Cost(usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss)


def rounds(commands, repeat):
    """The Costs of each command, which take turns, so that a busy machine hurts all alike."""
    found = [[] for _ in commands]
    for _ in range(repeat):
        for k, command in enumerate(commands):
            found[k].append(run(command))
    return found
