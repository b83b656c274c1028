"""Publish timer in simulation time."""

import random

import pytest

from trundle.gazebo.plugins.ros_control.controller import PublishTimer

_STEP_NS = 1_000_000


@pytest.mark.parametrize("rate_hz", [7.3, 30.0, 50.0, 333.0, 700.0, 1000.0])
def test_polling_only_when_due_gives_the_times_of_polling_every_step(rate_hz: float) -> None:
    """Also after an interval without subscribers, in which the timer is not polled."""
    random_ = random.Random(3)
    polled_every_step, polled_when_due = PublishTimer(rate_hz), PublishTimer(rate_hz)
    for timer in (polled_every_step, polled_when_due):
        timer.restart(0)
    expected: list[int] = []
    times: list[int] = []
    next_ns, has_subscribers = 0.0, True
    for time_ns in range(_STEP_NS, 3000 * _STEP_NS, _STEP_NS):
        if time_ns >= next_ns:
            has_subscribers = random_.random() < 0.8
        if polled_every_step.due(time_ns) and has_subscribers:
            expected.append(time_ns)
        if time_ns >= next_ns:
            polled_when_due.skip(time_ns, 1e-9 * _STEP_NS)
            if polled_when_due.due(time_ns) and has_subscribers:
                times.append(time_ns)
            next_ns = polled_when_due.next_ns if has_subscribers else time_ns + random_.randrange(1, 200) * _STEP_NS

    assert len(times) > 5
    assert times == expected


def test_a_timer_that_was_never_started_is_due_at_once() -> None:
    timer = PublishTimer(50.0)
    timer.skip(7 * _STEP_NS, 0.001)
    assert timer.due(7 * _STEP_NS)
