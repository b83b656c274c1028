"""Profiles for the page, measured while they are watched."""

from pathlib import Path
from typing import cast

import pytest
from tests.page.simulated_world.fake_server import FakeServer
from tests.page.simulated_world.worlds import loaded, model

from trundle.page import PERFORMANCE, PageServer
from trundle.page.simulated_world.performance import PerformanceStream
from trundle.sim.simulation import Simulation

S = 1_000_000_000


class Loop:
    """Loop of a run with a simulated wall clock: 20 ms of page, then a stride in real time."""

    def __init__(self, folder: Path) -> None:
        self.now_ns = 0
        self.server = FakeServer()
        self.server.watched = {PERFORMANCE}
        self.sim: Simulation = loaded(folder, model("m"))[0]
        self.stream = PerformanceStream(cast(PageServer, self.server), wall_ns=lambda: self.now_ns)
        self.stream.show(self.sim, None)

    def turn(self, *, stride_s: float = 0.08, paused: bool = False) -> None:
        self.stream.begin_page()
        self.now_ns += S // 50
        self.stream.end_page(paused=paused)
        self.now_ns += round(stride_s * S)
        if not paused:
            self.sim.run(stride_s)

    def page_s(self) -> list[float]:
        """Return the page's wall time in each sent profile."""
        return [
            next(part["wall_s"] for part in profile["parts"] if part["group"] == "page")
            for profile in self.server.profiles
        ]


@pytest.fixture
def loop(tmp_path: Path) -> Loop:
    return Loop(tmp_path)


def test_a_profile_of_each_second_is_sent(loop: Loop) -> None:
    for _ in range(25):
        loop.turn()

    assert loop.page_s() == pytest.approx([0.2, 0.2], abs=1e-6)
    assert [profile["simulated_s"] for profile in loop.server.profiles] == pytest.approx([0.8, 0.8])
    assert [profile["wall_s"] for profile in loop.server.profiles] == pytest.approx([1.0, 1.0])


def test_nothing_is_measured_while_unwatched_or_paused(loop: Loop) -> None:
    loop.server.watched = set()
    for _ in range(25):
        loop.turn()
        assert loop.sim.profiler is None
    loop.server.watched = {PERFORMANCE}
    for _ in range(25):
        loop.turn(paused=True)
        assert loop.sim.profiler is None

    assert loop.server.profiles == []


def test_at_full_speed_only_a_second_of_simulation_time_is_measured(loop: Loop) -> None:
    """At ten simulated seconds per second of wall time, each profile has about one simulated second."""
    for _ in range(40):
        loop.stream.begin_page()
        loop.now_ns += S // 20
        loop.stream.end_page(paused=False)
        loop.sim.run(0.5)

    assert [profile["simulated_s"] for profile in loop.server.profiles] == pytest.approx([1.0, 1.0])
