"""Ctrl-C interrupts once per press."""

import signal
import time
from collections.abc import Iterator

import pytest

from trundle.base.interrupts import ONE_PRESS_S, PRESS, interrupt


@pytest.fixture(autouse=True)
def _interrupt_handler() -> Iterator[None]:
    old_handler = signal.signal(signal.SIGINT, interrupt)
    PRESS.reset()
    yield
    signal.signal(signal.SIGINT, old_handler)


def test_two_signals_of_a_press_interrupt_once() -> None:
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
    signal.raise_signal(signal.SIGINT)


def test_a_later_press_interrupts_again(monkeypatch: pytest.MonkeyPatch) -> None:
    now_s = time.monotonic()
    monkeypatch.setattr(time, "monotonic", lambda: now_s)
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
    now_s += 0.6 * ONE_PRESS_S
    signal.raise_signal(signal.SIGINT)
    now_s += 0.6 * ONE_PRESS_S
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
