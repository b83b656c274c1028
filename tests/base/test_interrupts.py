"""Ctrl-C interrupts once for each press."""

import signal
import time
from collections.abc import Iterator

import pytest

from trundle.base.interrupts import ONE_PRESS_S, PRESS, interrupt


@pytest.fixture(autouse=True)
def _handled() -> Iterator[None]:
    before = signal.signal(signal.SIGINT, interrupt)
    PRESS.forget()
    yield
    signal.signal(signal.SIGINT, before)


def test_two_signals_of_a_press_interrupt_once() -> None:
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
    signal.raise_signal(signal.SIGINT)


def test_a_press_that_lasts_and_a_later_one_interrupt_again(monkeypatch: pytest.MonkeyPatch) -> None:
    now_s = time.monotonic()
    monkeypatch.setattr(time, "monotonic", lambda: now_s)
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
    now_s += 0.6 * ONE_PRESS_S
    signal.raise_signal(signal.SIGINT)
    now_s += 0.6 * ONE_PRESS_S
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
