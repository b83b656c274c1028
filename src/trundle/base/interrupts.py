"""Interrupts of the main thread, as by Ctrl-C."""

import signal
import sys
import threading
import time
from types import CodeType, FrameType

ONE_PRESS_S = 0.5
"""Signals within this time belong to one press of Ctrl-C [s].

`timeout -s INT` and similar programs signal both the process and its group, and people press twice; a second interrupt
would abort the cleanup of the first.
"""
_AGAIN_S = 0.001
"""Delay before a dropped interrupt is repeated, and between checks whether it would be dropped again [s]."""


class _Press:
    """Last press of Ctrl-C; one per process, as signals are."""

    def __init__(self) -> None:
        self._start_s = -ONE_PRESS_S
        """Monotonic time of the press's first signal."""

    def is_new(self) -> bool:
        """True if a received signal begins a new press."""
        now_s = time.monotonic()
        if now_s < self._start_s + ONE_PRESS_S:
            return False
        self._start_s = now_s
        return True

    def reset(self) -> None:
        """Let the next signal begin a press."""
        self._start_s = -ONE_PRESS_S


PRESS = _Press()


def interrupt(_number: int, _frame: FrameType | None) -> None:
    """Handle a signal as Python's own handler does, but once for each press.

    Raises:
        KeyboardInterrupt: it is a new press.
    """
    if PRESS.is_new():
        raise KeyboardInterrupt


def ending_signals() -> list[signal.Signals]:
    """Signals that end a program cleanly; without SIGHUP if it is ignored, as under `nohup`."""
    ends = [signal.SIGINT, signal.SIGTERM]
    if hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) is not signal.SIG_IGN:  # Windows has no SIGHUP
        ends.append(signal.SIGHUP)
    return ends


def interrupt_main_thread() -> None:
    """Interrupt the main thread, also during a blocking system call."""
    if hasattr(signal, "pthread_kill"):
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)
    else:
        signal.raise_signal(signal.SIGINT)


def keep_interrupts() -> None:
    """Repeat each interrupt that Python would drop because a finalizer or a weak reference's callback was running.

    Python only reports exceptions of these (https://docs.python.org/3/library/sys.html#sys.unraisablehook), even a
    KeyboardInterrupt: the program would ignore Ctrl-C.
    """
    report = sys.unraisablehook

    def hook(dropped: "sys.UnraisableHookArgs") -> None:
        if issubclass(dropped.exc_type, KeyboardInterrupt):
            threading.Thread(target=_interrupt_after, args=(hook.__code__,), daemon=True).start()
        else:
            report(dropped)

    sys.unraisablehook = hook


def _interrupt_after(code: CodeType) -> None:
    """Interrupt the main thread once a function has returned there; within it, the interrupt would be dropped again."""
    time.sleep(_AGAIN_S)
    while _is_running(code):
        time.sleep(_AGAIN_S)
    PRESS.reset()  # the interrupt had no effect
    interrupt_main_thread()


def _is_running(code: CodeType) -> bool:
    """True if the main thread is in a function, or in one that it called."""
    frame = sys._current_frames().get(threading.main_thread().ident or 0)  # pyright: ignore[reportPrivateUsage]
    while frame is not None and frame.f_code is not code:
        frame = frame.f_back
    return frame is not None
