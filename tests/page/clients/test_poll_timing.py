"""Polls of an owner that writes at its own pace, in time that a test counts."""

import itertools

import pytest

from trundle.page.clients.poll_timing import PollTiming

RUN_S = 20.0


def polls(period_s: float) -> tuple[int, list[float]]:
    """Poll an owner that writes every `period_s`; return the number of polls and the age of what each brought [s]."""
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
def test_an_owner_is_polled_soon_after_it_wrote_and_seldom_between(period_s: float) -> None:
    count, ages = polls(period_s)

    assert len(ages) == pytest.approx(RUN_S / period_s, abs=2), "all that was written is read"
    assert count < 1.3 * len(ages)
    assert sum(ages) / len(ages) < 0.008


def test_an_owner_with_nothing_to_say_is_polled_at_its_pace() -> None:
    count, _ = polls(10 * RUN_S)

    assert count == pytest.approx(RUN_S / 0.033, rel=0.02)
