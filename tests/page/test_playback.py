"""Playback of a recording."""

from typing import Any

import numpy as np
import pytest

from trundle.base.diagnostics import UsageError
from trundle.page import MoveJoint, Pause, Play, Playback, Reset, Seek, SetSpeed, Step, TimelineSpan

S = 1_000_000_000


def playback(*, speed: float = 1.0, paused: bool = False) -> Playback:
    """Return a playback of samples at 2.0, 2.5, … 4.0 s."""
    return Playback(np.arange(2 * S, 4 * S + 1, S // 2), speed=speed, paused=paused)


def test_playback_runs_at_its_speed_and_restarts_at_the_end() -> None:
    played = playback(speed=0.5)
    assert (played.time_ns, played.sample) == (2 * S, 0)

    played.advance(1.2)
    assert (played.time_ns, played.sample) == (2 * S + 6 * S // 10, 1)

    played.advance(10.0)
    assert played.time_ns == 2 * S


def test_the_state_has_the_extent_of_the_recording() -> None:
    state = playback().state

    assert state.timeline == TimelineSpan(2 * S, 4 * S)
    assert (state.paused, state.real_time_factor, state.speed) == (False, 1.0, 1.0)


@pytest.mark.parametrize(("to_ns", "time_ns"), [(3 * S, 3 * S), (0, 2 * S), (9 * S, 4 * S)])
def test_seek_stays_within_the_recording(to_ns: int, time_ns: int) -> None:
    played = playback(paused=True)

    played.handle(Seek(to_ns))
    played.advance(1.0)

    assert played.time_ns == time_ns


def test_a_step_goes_to_the_next_sample_and_pauses() -> None:
    played = playback()
    played.advance(0.7)

    played.handle(Step(2))

    assert played.time_ns == 3 * S + S // 2
    assert played.state.paused
    played.handle(Step(100))
    assert played.time_ns == 4 * S


@pytest.mark.parametrize(("action", "paused"), [(Pause(), True), (Play(), False)])
def test_pause_and_play(action: Any, paused: bool) -> None:
    played = playback(paused=not paused)

    played.handle(action)
    played.advance(1.0)

    assert played.time_ns == (2 * S if paused else 3 * S)
    assert (played.state.real_time_factor is None) is paused


def test_reset_goes_to_the_start_and_the_speed_can_be_unlimited() -> None:
    played = playback()
    played.advance(1.0)
    played.handle(Reset())
    assert played.time_ns == 2 * S

    played.handle(SetSpeed(None))
    played.advance(0.01)

    assert played.state.speed is None
    assert played.time_ns == 3 * S


def test_requests_to_move_joints_are_refused() -> None:
    with pytest.raises(UsageError, match="a recording does not support this request"):
        playback().handle(MoveJoint(model="m", joint="j", position=1.0))


def test_playback_stays_within_the_recording_at_any_speed() -> None:
    played = playback()
    for factor in (1e308, 1e-308):
        played.handle(SetSpeed(factor))
        played.advance(0.1)
        assert 2 * S <= played.time_ns <= 4 * S
