"""ROS time from a simulation."""

from typing import Any

from tests.ros.conftest import PATIENCE_S

from trundle.ros import SimClock, WallClock


def test_sleepers_wake_when_their_time_has_come(graph: Any) -> None:
    clock = SimClock(graph.loop)
    woken: list[int] = []

    async def sleep_until(ns: int) -> None:
        await clock.sleep_until(ns)
        woken.append(ns)

    for ns in (30, 10, 20):
        graph.loop.spawn(sleep_until(ns))
    graph.loop.flush_deliveries()
    clock.set(5)
    graph.loop.flush_deliveries()
    assert woken == []
    clock.set(20)
    graph.until(lambda: len(woken) == 2)
    assert woken == [10, 20]
    clock.set(1000)
    graph.until(lambda: len(woken) == 3)


def test_a_sleep_before_the_first_tick_starts_with_it(graph: Any) -> None:
    clock = SimClock(graph.loop)
    done = graph.loop.spawn(clock.sleep(1.0))
    graph.loop.flush_deliveries()
    clock.set(50)
    graph.loop.flush_deliveries()
    clock.set(1_000_000_049)
    graph.loop.flush_deliveries()
    assert not done.done()
    clock.set(1_000_000_050)
    done.result(PATIENCE_S)


def test_a_jump_back_wakes_all_sleepers_and_calls_the_listeners(graph: Any) -> None:
    clock = SimClock(graph.loop)
    clock.set(100)
    jumps: list[int] = []
    clock.on_jump(lambda: jumps.append(clock.now_ns()))
    done = graph.loop.spawn(clock.sleep_until(10**12))
    graph.loop.flush_deliveries()
    clock.set(3)
    done.result(PATIENCE_S)
    assert (jumps, clock.jumps) == ([3], 1)


def test_sleeping_until_a_past_time_returns_at_once(graph: Any) -> None:
    clock = SimClock(graph.loop)
    clock.set(100)
    graph.loop.run(clock.sleep_until(100))
    graph.loop.run(WallClock().sleep_until(5))
