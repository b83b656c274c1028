"""Timer of messages in simulation time."""

import random

import pytest

from trundle.gazebo.plugins.ros_control.controller import PublishTimer

_STEP_NS = 1_000_000


@pytest.mark.parametrize("rate_hz", [7.3, 30.0, 50.0, 333.0, 700.0, 1000.0])
def test_one_that_is_asked_when_due_gives_the_times_of_one_that_is_asked_at_every_step(rate_hz: float) -> None:
    """Also after a while in which nobody listened, and it was not asked."""
    random_ = random.Random(3)
    always, sparing = PublishTimer(rate_hz), PublishTimer(rate_hz)
    for timer in (always, sparing):
        timer.restart(0)
    expected: list[int] = []
    times: list[int] = []
    next_ns, listens = 0.0, True
    for time_ns in range(_STEP_NS, 3000 * _STEP_NS, _STEP_NS):
        if time_ns >= next_ns:
            listens = random_.random() < 0.8
        if always.due(time_ns) and listens:
            expected.append(time_ns)
        if time_ns >= next_ns:
            sparing.skip(time_ns, 1e-9 * _STEP_NS)
            if sparing.due(time_ns) and listens:
                times.append(time_ns)
            next_ns = sparing.next_ns if listens else time_ns + random_.randrange(1, 200) * _STEP_NS

    assert len(times) > 5
    assert times == expected


def test_one_that_was_never_started_is_due_at_once() -> None:
    timer = PublishTimer(50.0)
    timer.skip(7 * _STEP_NS, 0.001)
    assert timer.due(7 * _STEP_NS)
