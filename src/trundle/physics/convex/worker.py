"""A process that cuts hollow parts for another, one after another, until that closes the pipe or dies.

It starts in a quarter of a second: of Trundle it loads what cuts and nothing else.
"""

import os
import pickle
import signal
import sys

_DIE_WITH_PARENT = 1
"""Linux' PR_SET_PDEATHSIG."""


def main() -> None:
    """Read parts from stdin, write their pieces to stdout."""
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # V-HACD lets Python hear of nothing before it is done
    if sys.platform == "linux":
        import ctypes

        ctypes.CDLL(None).prctl(_DIE_WITH_PARENT, signal.SIGKILL)
    parts, answers = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # where V-HACD may print
    from .pieces import decompose_part

    pickle.dump(os.getpid(), answers)
    answers.flush()
    while True:
        try:
            part = pickle.load(parts)
        except EOFError:
            return
        try:
            answer = decompose_part(part)
        except Exception:  # whatever a mesh may be, its hull stands for it
            answer = None
        pickle.dump(answer, answers)
        answers.flush()


if __name__ == "__main__":
    main()
