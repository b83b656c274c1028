"""Interrupts of the main thread, as by Ctrl-C."""

import signal
import sys
import threading
import time
from types import CodeType, FrameType

ONE_PRESS_S = 0.5
"""Signals that follow one so soon are of the same press of Ctrl-C.

`timeout -s INT` and other starters of programs signal the process and its group, and people press twice: the program
is ending already, and would break off what it closes.
"""
_AGAIN_S = 0.001
"""Wait before a dropped interrupt is repeated, and between looks if it would be dropped once more."""


class _Press:
    """The last press of Ctrl-C; signals are the process's, and so are presses."""

    def __init__(self) -> None:
        self._start_s = -ONE_PRESS_S
        """Monotonic time of its first signal."""

    def is_new(self) -> bool:
        """Tell whether a signal that a handler got begins a press."""
        now_s = time.monotonic()
        if now_s < self._start_s + ONE_PRESS_S:
            return False
        self._start_s = now_s
        return True

    def forget(self) -> None:
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
    """Signals that end a program cleanly; without SIGHUP if ignored, as under `nohup`."""
    ends = [signal.SIGINT, signal.SIGTERM]
    if hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) is not signal.SIG_IGN:  # Windows has none
        ends.append(signal.SIGHUP)
    return ends


def interrupt_main_thread() -> None:
    """Interrupt the main thread, also while it waits for the system."""
    if hasattr(signal, "pthread_kill"):
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)
    else:
        signal.raise_signal(signal.SIGINT)


def keep_interrupts() -> None:
    """Repeat each interrupt that Python would drop because a finalizer or a weak reference's callback was running.

    What these raise is only reported (https://docs.python.org/3/library/sys.html#sys.unraisablehook), KeyboardInterrupt
    included: the program would go on as if Ctrl-C had not been pressed.
    """
    report = sys.unraisablehook

    def hook(dropped: "sys.UnraisableHookArgs") -> None:
        if issubclass(dropped.exc_type, KeyboardInterrupt):
            threading.Thread(target=_interrupt_after, args=(hook.__code__,), daemon=True).start()
        else:
            report(dropped)

    sys.unraisablehook = hook


def _interrupt_after(code: CodeType) -> None:
    """Interrupt the main thread when a function, in which an interrupt is dropped as well, has returned there."""
    time.sleep(_AGAIN_S)
    while _is_running(code):
        time.sleep(_AGAIN_S)
    PRESS.forget()  # it had no effect yet
    interrupt_main_thread()


def _is_running(code: CodeType) -> bool:
    """Tell if the main thread is in a function, or in one that it called."""
    frame = sys._current_frames().get(threading.main_thread().ident or 0)  # pyright: ignore[reportPrivateUsage]
    while frame is not None and frame.f_code is not code:
        frame = frame.f_back
    return frame is not None
