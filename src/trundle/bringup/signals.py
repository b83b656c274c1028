"""Ctrl-C and SIGTERM as a flag that a loop looks at."""

import signal
import threading
from collections.abc import Generator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def stop_flag() -> Generator[threading.Event]:
    """Yield an event that the first SIGINT or SIGTERM sets; a second SIGINT ends the process as usual."""
    flag = threading.Event()
    if threading.current_thread() is not threading.main_thread():  # signals are the main thread's affair
        yield flag
        return
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}

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
