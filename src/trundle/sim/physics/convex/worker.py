"""Worker process that decomposes parts until its pipe closes or its parent dies.

It starts in a quarter of a second because it imports only what it needs.
"""

import os
import pickle
import signal
import sys

_DIE_WITH_PARENT = 1
"""Linux' PR_SET_PDEATHSIG."""


def main() -> None:
    """Read parts from stdin and write their pieces to stdout."""
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # at once: V-HACD returns to Python only at its end
    if sys.platform == "linux":
        import ctypes

        ctypes.CDLL(None).prctl(_DIE_WITH_PARENT, signal.SIGKILL)
    parts, results = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # for output of V-HACD
    from .pieces import decompose_part

    pickle.dump(os.getpid(), results)
    results.flush()
    while True:
        try:
            part = pickle.load(parts)
        except EOFError:
            return
        try:
            result = decompose_part(part)
        except Exception:  # any failure falls back to the hull
            result = None
        pickle.dump(result, results)
        results.flush()


if __name__ == "__main__":
    main()
