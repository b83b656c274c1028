"""Interrupts of the main thread, as by Ctrl-C."""

import signal
import sys
import threading
import time

_AGAIN_S = 0.001
"""Wait before a dropped interrupt is repeated: the callback that dropped it ends in much less."""


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
            threading.Thread(target=_interrupt_again, daemon=True).start()
        else:
            report(dropped)

    sys.unraisablehook = hook


def _interrupt_again() -> None:
    time.sleep(_AGAIN_S)
    interrupt_main_thread()
