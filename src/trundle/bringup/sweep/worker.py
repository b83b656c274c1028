"""Process that runs rows: a pickled plan and then row numbers on stdin, a pickled result for each on stdout."""

import gc
import os
import pickle
import signal
import sys
from contextlib import suppress
from typing import BinaryIO

from trundle.trials import Plan, Rows

from .trial import TrialRunner


def main() -> None:
    """Run rows until stdin ends, as it does when the sweep is over or killed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the sweep ends its workers itself
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a plan's functions print must not come between the results
    with suppress(EOFError, BrokenPipeError):
        _run_rows(sys.stdin.buffer, output)


def _run_rows(requests: BinaryIO, output: BinaryIO) -> None:
    plan: Plan = pickle.load(requests)
    rows, runner = Rows(plan), TrialRunner(plan)
    gc.freeze()
    _send(output, None)
    while True:
        number: int = pickle.load(requests)
        _send(output, runner.run(rows.row(number)))


def _send(output: BinaryIO, what: object) -> None:
    pickle.dump(what, output, protocol=5)
    output.flush()


if __name__ == "__main__":
    main()
