"""SIGINT, SIGTERM and SIGHUP as a flag that loops poll."""

import signal
import threading
from collections.abc import Generator
from contextlib import contextmanager
from queue import Empty, SimpleQueue
from types import FrameType

from trundle.base.interrupts import PRESS, ending_signals


class StopFlag:
    """Event that a signal handler may set.

    `threading.Event` deadlocks there: a handler that runs while its own thread is inside `wait` waits for that thread's
    lock. `SimpleQueue.put` is reentrant.
    """

    def __init__(self) -> None:
        self._requests: SimpleQueue[None] = SimpleQueue()

    def set(self) -> None:
        """Set the flag; from a signal handler or any thread."""
        self._requests.put(None)

    def is_set(self) -> bool:
        """True if it was ever set."""
        return not self._requests.empty()

    def wait(self, seconds: float) -> bool:
        """Wait for the flag, up to a timeout; return True if it is set."""
        try:
            self._requests.get(timeout=seconds)
        except Empty:
            return False
        self._requests.put(None)
        return True


_blind_waits = 0
"""Nesting depth of `blind_wait` blocks on the main thread, which handles signals."""


@contextmanager
def blind_wait() -> Generator[None]:
    """Let the first signal interrupt a block that cannot poll a `StopFlag`, such as a call to another program."""
    global _blind_waits
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    _blind_waits += 1
    try:
        yield
    finally:
        _blind_waits -= 1


@contextmanager
def stop_flag() -> Generator[StopFlag]:
    """Yield a flag that the first SIGINT, SIGTERM or SIGHUP sets; a second press of Ctrl-C interrupts, and so does any
    signal within a `blind_wait`.
    """
    flag = StopFlag()
    if threading.current_thread() is not threading.main_thread():  # only the main thread may set signal handlers
        yield flag
        return
    is_stopping = False

    def stop(number: int, _frame: FrameType | None) -> None:
        nonlocal is_stopping
        is_new = PRESS.is_new()
        if _blind_waits or (is_new and is_stopping and number == signal.SIGINT):
            raise KeyboardInterrupt
        is_stopping = True
        flag.set()

    old_handlers = {number: signal.signal(number, stop) for number in ending_signals()}
    try:
        yield flag
    finally:
        for number, handler in old_handlers.items():
            signal.signal(number, handler)
