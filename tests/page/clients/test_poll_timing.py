"""Times of polls for an owner that writes periodically, with a simulated clock."""

import itertools

import pytest

from trundle.page.clients.poll_timing import PollTiming

RUN_S = 20.0


def polls(period_s: float) -> tuple[int, list[float]]:
    """Poll an owner that writes every `period_s`; return the number of polls, and the age of each new message [s]."""
    timing, now_s, writes, ages = PollTiming(), 0.0, itertools.count(1), list[float]()
    next_s = next(writes) * period_s
    for count in itertools.count():
        if now_s > RUN_S:
            return count, ages
        is_new = next_s <= now_s
        if is_new:
            ages.append(now_s - next_s)
        while next_s <= now_s:
            next_s = next(writes) * period_s
        now_s += timing.wait_s(now_s, is_new=is_new)
    raise AssertionError


@pytest.mark.parametrize("period_s", [0.033, 0.034, 0.04, 0.05])
def test_polls_follow_soon_after_writes_and_are_few(period_s: float) -> None:
    count, ages = polls(period_s)

    assert len(ages) == pytest.approx(RUN_S / period_s, abs=2), "every message is read"
    assert count < 1.3 * len(ages)
    assert sum(ages) / len(ages) < 0.008


def test_an_idle_owner_is_polled_at_its_period() -> None:
    count, _ = polls(10 * RUN_S)

    assert count == pytest.approx(RUN_S / 0.033, rel=0.02)
