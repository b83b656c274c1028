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
        self._asked: SimpleQueue[None] = SimpleQueue()

    def set(self) -> None:
        """Set the flag; from a signal handler or any thread."""
        self._asked.put(None)

    def is_set(self) -> bool:
        """True if it was ever set."""
        return not self._asked.empty()

    def wait(self, seconds: float) -> bool:
        """Wait for the flag for at most so many seconds; return True if it is set."""
        try:
            self._asked.get(timeout=seconds)
        except Empty:
            return False
        self._asked.put(None)
        return True


_blind_waits = 0
"""Number of blocks of the main thread, which handles signals, that wait and cannot poll a flag."""


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
    """Yield a flag that the first SIGINT, SIGTERM or SIGHUP sets; a SIGINT of another press interrupts, and any signal
    within a `blind_wait`.
    """
    flag = StopFlag()
    if threading.current_thread() is not threading.main_thread():  # only the main thread may set signal handlers
        yield flag
        return
    was_asked = False

    def ask_to_stop(number: int, _frame: FrameType | None) -> None:
        nonlocal was_asked
        is_new = PRESS.is_new()
        if _blind_waits or (is_new and was_asked and number == signal.SIGINT):
            raise KeyboardInterrupt
        was_asked = True
        flag.set()

    before = {number: signal.signal(number, ask_to_stop) for number in ending_signals()}
    try:
        yield flag
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
