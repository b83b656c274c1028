"""Profiles for the page, measured while someone looks."""

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
    """Loop of a run whose clock advances by hand: 20 ms of page, then a stride that takes as long as it simulates."""

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
        """Wall time of the page in each profile that was sent."""
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


def test_nothing_is_measured_while_nobody_looks_or_time_stands_still(loop: Loop) -> None:
    loop.server.watched = set()
    for _ in range(25):
        loop.turn()
        assert loop.sim.profiler is None
    loop.server.watched = {PERFORMANCE}
    for _ in range(25):
        loop.turn(paused=True)
        assert loop.sim.profiler is None

    assert loop.server.profiles == []


def test_flat_out_only_a_second_of_simulation_time_is_measured(loop: Loop) -> None:
    """Ten simulated seconds in each of wall time: each profile has about one."""
    for _ in range(40):
        loop.stream.begin_page()
        loop.now_ns += S // 20
        loop.stream.end_page(paused=False)
        loop.sim.run(0.5)

    assert [profile["simulated_s"] for profile in loop.server.profiles] == pytest.approx([1.0, 1.0])
