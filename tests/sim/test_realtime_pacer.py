"""The pacer, on a wall clock that the test moves."""

import pytest

from trundle.sim.realtime_pacer import RealtimePacer

MS = 1_000_000


class Wall:
    """A wall clock that only sleeping moves."""

    def __init__(self) -> None:
        self.ns = 0

    def now(self) -> int:
        return self.ns

    def sleep(self, seconds: float) -> None:
        self.ns += round(seconds * 1e9)


@pytest.mark.parametrize("speed", [0.5, 1.0, 4.0])
def test_simulation_time_follows_the_wall_clock_at_the_requested_speed(speed: float) -> None:
    wall = Wall()
    pacer = RealtimePacer(speed, wall_ns=wall.now, sleep=wall.sleep)
    time_ns = 0

    while wall.ns < 1000 * MS:
        time_ns = pacer.next_target(time_ns)

    assert time_ns / wall.ns == pytest.approx(speed, rel=0.05)
    assert pacer.real_time_factor == pytest.approx(speed, rel=0.05)


def test_a_flat_out_run_never_sleeps() -> None:
    wall = Wall()
    pacer = RealtimePacer(None, wall_ns=wall.now, sleep=wall.sleep)

    assert pacer.next_target(0) > 0
    assert wall.ns == 0


def test_a_long_stall_is_not_caught_up() -> None:
    """After a laptop's sleep the simulation goes on at its speed and does not catch up."""
    wall = Wall()
    pacer = RealtimePacer(1.0, wall_ns=wall.now, sleep=wall.sleep)
    time_ns = pacer.next_target(pacer.next_target(0))
    wall.ns += 3_600_000 * MS
    start = wall.ns

    time_ns_after = time_ns
    while wall.ns < start + 1000 * MS:
        time_ns_after = pacer.next_target(time_ns_after)

    assert time_ns_after - time_ns == pytest.approx(1000 * MS, rel=0.1)


@pytest.mark.parametrize("speed", [1e308, 1e6, 1e-6, 1e-308])
def test_sleeps_are_short_at_any_speed(speed: float) -> None:
    """A person may ask for any; the next request is to be heard soon."""
    wall = Wall()
    pacer = RealtimePacer(speed, wall_ns=wall.now, sleep=wall.sleep)
    time_ns = 0
    for _ in range(20):
        before_ns, before_wall_ns = time_ns, wall.ns
        target_ns = pacer.next_target(time_ns)
        time_ns = max(time_ns, -(-target_ns // MS) * MS)
        assert time_ns - before_ns <= 1000 * MS
        assert wall.ns - before_wall_ns <= 100 * MS
    assert time_ns >= MS
