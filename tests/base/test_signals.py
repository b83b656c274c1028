"""`StopFlag`, which Ctrl-C sets."""

import os
import signal
import subprocess
import sys

import pytest

from trundle.base.interrupts import PRESS
from trundle.base.signals import StopFlag, blind_wait, stop_flag

_HAMMERED = """
import signal
from trundle.base.signals import StopFlag
flag, looks = StopFlag(), 0
signal.signal(signal.SIGALRM, lambda *_: flag.set())
signal.setitimer(signal.ITIMER_REAL, 1e-3, 1e-3)
while looks < 3_000:
    flag = StopFlag()
    while not flag.wait(0.001):
        pass
    looks += 1
signal.setitimer(signal.ITIMER_REAL, 0)
print(looks)
"""


def test_the_flag_stays_set() -> None:
    flag = StopFlag()
    assert not flag.is_set()
    assert not flag.wait(0.0)

    flag.set()

    assert flag.wait(0.0)
    assert flag.wait(10.0)
    assert flag.is_set()


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="timers that send signals are POSIX's")
def test_signals_during_waits_do_not_deadlock() -> None:
    """Thousands of signals arrive at every line of a wait."""
    process = subprocess.run([sys.executable, "-c", _HAMMERED], capture_output=True, text=True, timeout=100)
    assert process.stdout == "3000\n", process.stderr


def test_the_first_press_sets_the_flag_and_the_second_interrupts() -> None:
    old_handler = signal.getsignal(signal.SIGINT)
    PRESS.reset()
    with stop_flag() as flag:
        signal.raise_signal(signal.SIGINT)
        assert flag.is_set()
        signal.raise_signal(signal.SIGINT)  # of the same press
        PRESS.reset()  # as after a while
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
    assert signal.getsignal(signal.SIGINT) == old_handler


@pytest.mark.skipif(not hasattr(signal, "SIGHUP"), reason="terminals that hang up are POSIX's")
def test_the_first_signal_interrupts_a_blind_wait() -> None:
    with stop_flag() as stop:
        with pytest.raises(KeyboardInterrupt), blind_wait():
            signal.raise_signal(signal.SIGTERM)
        assert not stop.is_set()
        signal.raise_signal(signal.SIGTERM)
        assert stop.is_set()


@pytest.mark.parametrize("is_default", [True, False])
def test_sighup_sets_the_flag_unless_ignored(is_default: bool) -> None:
    old_handler = signal.signal(signal.SIGHUP, signal.SIG_DFL if is_default else signal.SIG_IGN)
    try:
        with stop_flag() as flag:
            signal.raise_signal(signal.SIGHUP)
            assert flag.is_set() is is_default
    finally:
        signal.signal(signal.SIGHUP, old_handler)
