"""Finds and kills the processes of a tree; run as a program, it does so when the process that started it dies.

It reads a line of process groups, again at each change, on standard input, whose other end only the starter holds. Of
the standard library alone: it runs without Trundle's own modules.
"""

import os
import signal
import sys
import time
from collections.abc import Collection

VARIABLE = "TRUNDLE_PROCESS_TREE"
"""Inherited by every process of the tree, with its mark as value; Linux alone shows another process's variables."""
_PROC = "/proc"
_POLL_S = 0.02
_MAX_S = 10.0
"""A process that hangs in the kernel is not waited for."""


def signal_tree(mark: str, groups: Collection[int], number: int) -> bool:
    """Send a signal to every process of the tree, 0: none; tell whether there was one."""
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
    """The processes that live in one of the groups, or inherited the mark."""
    wanted = f"\0{VARIABLE}={mark}\0".encode()
    found: list[int] = []
    for name in filter(str.isdecimal, os.listdir(_PROC)):
        try:
            with open(f"{_PROC}/{name}/stat", "rb") as file:
                state, _, group = file.read().rpartition(b")")[2].split()[:3]
            with open(f"{_PROC}/{name}/environ", "rb") as file:
                is_marked = wanted in b"\0" + file.read() + b"\0"
        except OSError:  # it has ended, or is another user's
            continue
        if state not in b"ZX" and (is_marked or int(group) in groups):
            found.append(int(name))
    return found


def kill_tree(mark: str, groups: Collection[int], number: int, timeout_s: float) -> bool:
    """Send a signal until no process is left or the time is over; tell whether none is."""
    end = time.monotonic() + timeout_s
    is_first = True
    # What a process starts while it is looked for is found by the next look.
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
