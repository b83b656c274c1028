"""Ctrl-C, SIGTERM and the end of the terminal as a flag that a loop looks at."""

import signal
import threading
from collections.abc import Generator
from contextlib import contextmanager
from queue import Empty, SimpleQueue
from types import FrameType

_HANG_UP = getattr(signal, "SIGHUP", signal.SIGTERM)
"""Windows has none."""
_ENDS = (signal.SIGINT, signal.SIGTERM, _HANG_UP)


class StopFlag:
    """An event that a signal handler may set.

    `threading.Event` may not: a handler that runs while its own thread is inside `wait` waits for that thread's lock
    for ever. A SimpleQueue's `put` is made to be called from anywhere.
    """

    def __init__(self) -> None:
        self._asked: SimpleQueue[None] = SimpleQueue()

    def set(self) -> None:
        """From a signal handler or any thread."""
        self._asked.put(None)

    def is_set(self) -> bool:
        """Whether it was set, ever."""
        return not self._asked.empty()

    def wait(self, seconds: float) -> bool:
        """Return whether it is set, at once when it is, else after so many seconds."""
        try:
            self._asked.get(timeout=seconds)
        except Empty:
            return False
        self._asked.put(None)
        return True


@contextmanager
def stop_flag() -> Generator[StopFlag]:
    """Yield a flag that the first SIGINT, SIGTERM or SIGHUP sets; a second SIGINT ends the process as usual."""
    flag = StopFlag()
    if threading.current_thread() is not threading.main_thread():  # signals are the main thread's affair
        yield flag
        return
    before = {number: signal.getsignal(number) for number in _ENDS}
    if before.get(_HANG_UP) == signal.SIG_IGN:  # `nohup` wants it so
        del before[_HANG_UP]

    def ask_to_stop(_number: int, _frame: FrameType | None) -> None:
        flag.set()
        signal.signal(signal.SIGINT, before[signal.SIGINT])

    for number in before:
        signal.signal(number, ask_to_stop)
    try:
        yield flag
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
