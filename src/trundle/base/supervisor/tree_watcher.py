"""Finds and kills the processes of a tree; as a program, does so when its parent dies.

The parent writes a line of process groups to its standard input after each change. Uses only the standard
library, since it runs without Trundle's modules.
"""

import os
import signal
import sys
import time
from collections.abc import Collection

VARIABLE = "TRUNDLE_PROCESS_TREE"
"""Environment variable with the tree's mark in all its processes; other processes can read it on Linux only."""
_PROC = "/proc"
_POLL_S = 0.02
_MAX_S = 10.0
"""Time limit, for processes that hang in the kernel."""


def signal_tree(mark: str, groups: Collection[int], number: int) -> bool:
    """Send a signal to all processes of the tree (0: only check); return True if there were any."""
    sent = False
    send, targets = (os.kill, _members(mark, groups)) if sys.platform == "linux" else (os.killpg, list(groups))
    for target in targets:
        try:
            send(target, number)
        except (ProcessLookupError, PermissionError):
            continue
        sent = True
    return sent


def _members(mark: str, groups: Collection[int]) -> list[int]:
    """IDs of processes in one of the groups, or with the mark."""
    entry = f"\0{VARIABLE}={mark}\0".encode()
    ids: list[int] = []
    for name in filter(str.isdecimal, os.listdir(_PROC)):
        try:
            with open(f"{_PROC}/{name}/stat", "rb") as file:
                state, _, group = file.read().rpartition(b")")[2].split()[:3]
            with open(f"{_PROC}/{name}/environ", "rb") as file:
                is_marked = entry in b"\0" + file.read() + b"\0"
        except OSError:  # the process has ended, or belongs to another user
            continue
        if state not in b"ZX" and (is_marked or int(group) in groups):
            ids.append(int(name))
    return ids


def kill_tree(mark: str, groups: Collection[int], number: int, timeout_s: float) -> bool:
    """Send a signal until no process is left, or until the timeout; return True if none is left."""
    end = time.monotonic() + timeout_s
    is_first = True
    # The next pass finds processes started during this one.
    while signal_tree(mark, groups, number if is_first or number == signal.SIGKILL else 0):
        is_first = False
        if time.monotonic() > end:
            return False
        time.sleep(_POLL_S)
    return True


def _main(mark: str) -> None:
    groups: list[int] = []
    for line in sys.stdin:
        groups = [int(word) for word in line.split()]
    kill_tree(mark, groups, signal.SIGKILL, _MAX_S)


if __name__ == "__main__":
    _main(sys.argv[1])
