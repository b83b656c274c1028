"""Periodic hooks over simulation time."""

from dataclasses import dataclass, field
from typing import Any

import pytest

from trundle.base.diagnostics import Diagnostics, Source
from trundle.gazebo.plugins import Plugin
from trundle.robots.model import PhysicsSettings, World
from trundle.sim.simulation import Simulation, Snapshot

MS = 1_000_000


def empty_world(step_s: float = 0.001) -> Simulation:
    settings = PhysicsSettings(max_step_size_s=step_s)
    return Simulation(World(name="w", at=Source("w.sdf"), physics=settings), Diagnostics(strict=True))


@dataclass
class Track:
    """Calls in order: (time [ns], hook)."""

    calls: list[tuple[int, str]] = field(default_factory=list)

    def times_ns(self, name: str) -> list[int]:
        return [time for time, called in self.calls if called == name]


@dataclass
class Acts:
    """Hook with only `before_step`."""

    track: Track
    name: str = "acts"

    def before_step(self, sim: Simulation) -> None:
        self.track.calls.append((sim.time_ns, self.name))


@dataclass
class Looks:
    """Hook with only `after_step`."""

    track: Track
    name: str = "looks"

    def after_step(self, snapshot: Snapshot) -> None:
        self.track.calls.append((snapshot.time_ns, self.name))


@dataclass
class Both:
    """Hook with both."""

    track: Track

    def before_step(self, sim: Simulation) -> None:
        self.track.calls.append((sim.time_ns, "acts"))

    def after_step(self, snapshot: Snapshot) -> None:
        self.track.calls.append((snapshot.time_ns, "looks"))


def test_a_hook_acts_at_once_and_then_every_period() -> None:
    sim, track = empty_world(), Track()
    sim.add_hook(Acts(track), period_ns=20 * MS)
    sim.run(0.1)
    assert track.times_ns("acts") == [0, 20 * MS, 40 * MS, 60 * MS, 80 * MS]


def test_an_after_step_hook_is_due_after_each_period_and_at_the_end() -> None:
    sim, track = empty_world(), Track()
    sim.add_hook(Looks(track), period_ns=20 * MS)
    sim.run(0.1)
    assert track.times_ns("looks") == [20 * MS, 40 * MS, 60 * MS, 80 * MS, 100 * MS]


def test_a_rate_of_thirty_hertz_is_exact_over_ten_seconds() -> None:
    sim, track = empty_world(), Track()
    period_ns = round(1e9 / 30)
    sim.add_hook(Looks(track), period_ns=period_ns)
    sim.run(10.0)
    times = track.times_ns("looks")
    assert len(times) == 300
    assert all(0 <= time - (i + 1) * period_ns < MS for i, time in enumerate(times))


def test_the_number_of_calls_does_not_depend_on_stride_lengths() -> None:
    whole, cut = Track(), Track()
    for track, strides in ((whole, [1.0]), (cut, [0.007] * 100 + [0.1] * 3)):
        sim = empty_world()
        sim.add_hook(Both(track), period_ns=round(1e9 / 30))
        for stride in strides:
            sim.run(stride)
    assert whole.calls == cut.calls


def test_a_period_of_zero_is_every_step() -> None:
    sim, track = empty_world(0.002), Track()
    sim.add_hook(Both(track))
    sim.step(3)
    assert track.times_ns("acts") == [0, 2 * MS, 4 * MS]
    assert track.times_ns("looks") == [2 * MS, 4 * MS, 6 * MS]


def test_a_period_shorter_than_a_step_is_every_step() -> None:
    sim, track = empty_world(0.01), Track()
    sim.add_hook(Looks(track), period_ns=3 * MS)
    sim.run(0.05)
    assert track.times_ns("looks") == [10 * MS * i for i in range(1, 6)]


def test_after_step_hooks_come_before_before_step_hooks_in_order_of_registration() -> None:
    sim, track = empty_world(), Track()
    for hook in (Acts(track, "act 1"), Looks(track, "look 1"), Acts(track, "act 2"), Looks(track, "look 2")):
        sim.add_hook(hook, period_ns=10 * MS)
    sim.run(0.015)
    at_ten = [name for time, name in track.calls if time == 10 * MS]
    assert at_ten == ["look 1", "look 2", "act 1", "act 2"]


def test_prepare_is_called_on_all_due_hooks_before_the_first_after_step() -> None:
    @dataclass
    class Shares(Looks):
        def prepare(self, snapshot: Snapshot) -> None:
            self.track.calls.append((snapshot.time_ns, f"before {self.name}"))

    sim, track = empty_world(), Track()
    sim.add_hook(Looks(track, "look 1"), period_ns=10 * MS)
    sim.add_hook(Shares(track, "look 2"), period_ns=10 * MS)
    sim.add_hook(Shares(track, "look 3"), period_ns=20 * MS)
    sim.run(0.02)
    sharing = ["before look 2", "before look 3", "look 1", "look 2", "look 3"]
    assert [name for time, name in track.calls if time == 10 * MS] == ["before look 2", "look 1", "look 2"]
    assert [name for time, name in track.calls if time == 20 * MS] == sharing


def test_hooks_due_together_receive_the_same_snapshot() -> None:
    snapshots: list[Snapshot] = []

    class Keeps:
        def after_step(self, snapshot: Snapshot) -> None:
            snapshots.append(snapshot)

    sim = empty_world()
    sim.add_hook(Keeps(), period_ns=10 * MS)
    sim.add_hook(Keeps(), period_ns=20 * MS)
    sim.run(0.02)
    assert len(snapshots) == 3
    assert snapshots[1] is snapshots[2]


def test_the_period_of_a_hook_starts_at_its_registration() -> None:
    sim, track = empty_world(), Track()
    sim.run(0.005)
    sim.add_hook(Both(track), period_ns=10 * MS)
    sim.run(0.02)
    assert track.times_ns("acts") == [5 * MS, 15 * MS]
    assert track.times_ns("looks") == [15 * MS, 25 * MS]


def test_hooks_restart_after_a_reset() -> None:
    sim, track = empty_world(), Track()
    sim.add_hook(Both(track), period_ns=10 * MS)
    sim.run(0.025)
    first = list(track.calls)
    track.calls.clear()
    sim.reset()
    sim.run(0.025)
    assert track.calls == first


def test_hooks_are_due_equally_after_a_save_and_its_restore() -> None:
    sim, track = empty_world(), Track()
    sim.add_hook(Both(track), period_ns=round(1e9 / 30))
    sim.run(0.05)
    saved = sim.save()
    track.calls.clear()
    sim.run(0.2)
    first = list(track.calls)
    track.calls.clear()
    sim.restore(saved)
    sim.run(0.2)
    assert track.calls == first


def test_an_object_without_hook_methods_is_refused() -> None:
    neither: Any = object()
    with pytest.raises(AssertionError, match="neither before_step nor after_step"):
        empty_world().add_hook(neither)


def test_a_disabled_hook_is_not_called_and_does_not_shorten_strides(monkeypatch: pytest.MonkeyPatch) -> None:
    sim, track, listening = empty_world(), Track(), [False]
    sim.add_hook(Both(track), period_ns=10 * MS, enabled=lambda: listening[0])
    strides: list[int] = []
    step = sim.engine.step

    def counted(count: int, hooks: Any) -> int:
        strides.append(count)
        return step(count, hooks)

    monkeypatch.setattr(sim.engine, "step", counted)
    sim.run(0.1)
    assert (track.calls, strides) == ([], [100])
    listening[0] = True
    sim.run(0.03)
    # Missed calls are not repeated.
    assert track.times_ns("looks") == [110 * MS, 120 * MS, 130 * MS]


def test_a_removed_hook_is_not_called() -> None:
    sim = empty_world()
    calls: list[int] = []

    class Counter:
        def after_step(self, snapshot: Snapshot) -> None:
            calls.append(snapshot.time_ns)

    first, second = Counter(), Counter()
    for hook in (first, second):
        sim.add_hook(hook, period_ns=MS)
    sim.step()
    sim.remove_hook(first)
    sim.step()

    assert calls == [MS, MS, 2 * MS]


def test_an_empty_method_is_not_called_and_does_not_shorten_strides(monkeypatch: pytest.MonkeyPatch) -> None:
    """The inherited `after_step` of a plugin with `before_step` only must not take a snapshot at every step."""

    class Every5(Plugin):
        period_ns = 5 * MS

        def before_step(self, sim: Simulation) -> None:
            strides.append(sim.steps)

    sim, strides = empty_world(), list[int]()
    monkeypatch.setattr(sim, "snapshot", lambda: pytest.fail("no hook reads a snapshot"))
    sim.add_hook(Every5(), period_ns=5 * MS)
    sim.add_hook(Plugin())
    sim.run(0.011)

    assert strides == [0, 5, 10]
    assert len(sim.hooks) == 1
