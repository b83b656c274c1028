"""Process that runs rows: it reads a pickled job, then row numbers on stdin, and writes pickled values to stdout."""

import gc
import os
import pickle
import signal
import sys
import threading
import traceback
from queue import SimpleQueue
from typing import Any, BinaryIO

from .job import Job


def main() -> None:
    """Run rows until stdin ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the owner's: it ends this process
    output = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # so that output of a row does not mix with the values
    requests: SimpleQueue[Any] = SimpleQueue()
    threading.Thread(target=_read, args=(sys.stdin.buffer, requests), daemon=True).start()
    job: Job[object] = requests.get()
    run = job.make()
    gc.collect()
    gc.freeze()
    _send(output, None)
    while True:
        _send(output, run(requests.get()))


def _read(file: BinaryIO, requests: SimpleQueue[Any]) -> None:
    try:
        while True:
            requests.put(pickle.load(file))
    except EOFError:  # the owner has ended, and needs no result of the running row
        os._exit(0)


def _send(output: BinaryIO, value: object) -> None:
    try:
        pickle.dump(value, output, protocol=5)
        output.flush()
    except BrokenPipeError:
        os._exit(0)


if __name__ == "__main__":
    try:
        main()
    except BaseException:
        traceback.print_exc()
        os._exit(1)  # `sys.exit` would wait for the thread that reads stdin
