"""A time step that changes while the simulation runs."""

import pytest
from msgspec.structs import replace
from tests.sim.simulation.test_hooks import MS, Acts, Looks, Track, empty_world

from trundle.base.diagnostics import Diagnostics
from trundle.robots.description import load
from trundle.robots.packages import Packages
from trundle.sim.simulation import Simulation
from trundle.sim.simulation.step_clock import StepClock
from trundle.spatial import Wrench

_INERTIAL = "<inertial><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>"
_ARM = f"""<sdf version="1.6"><world name="w"><gravity>0 0 0</gravity>
<model name="ball"><link name="link">{_INERTIAL}</link></model>
<model name="arm"><link name="base">{_INERTIAL}</link><link name="rod">{_INERTIAL}</link>
<joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
<joint name="turn" type="revolute"><parent>base</parent><child>rod</child><axis><xyz>0 0 1</xyz></axis></joint>
</model></world></sdf>"""


@pytest.fixture
def sim(tmp_path) -> Simulation:
    (tmp_path / "w.sdf").write_text(_ARM)
    report = Diagnostics()
    return Simulation(load(str(tmp_path / "w.sdf"), report, packages=Packages({}, start=tmp_path)).world, report)


def with_steps_of(sim: Simulation, step_s: float) -> None:
    sim.edit(replace(sim.world, physics=replace(sim.world.physics, max_step_size_s=step_s)))


def test_a_step_clock_converts_steps_and_times() -> None:
    line = StepClock(1 * MS).with_step(4 * MS, since=3)

    assert [line.time_ns(step) for step in (3, 4, 5)] == [3 * MS, 7 * MS, 11 * MS]
    assert [line.step_at(time_ns) for time_ns in (3 * MS, 3 * MS + 1, 7 * MS, 8 * MS)] == [3, 4, 4, 5]
    assert line.with_step(4 * MS, since=9) is line


def test_hooks_keep_their_periods_at_another_step_length() -> None:
    sim, track = empty_world(), Track()
    sim.add_hook(Acts(track), period_ns=10 * MS)
    sim.add_hook(Looks(track), period_ns=0)
    sim.run(0.015)
    del track.calls[:]
    with_steps_of(sim, 0.004)
    sim.run(0.030)

    assert track.times_ns("looks") == [(19 + 4 * i) * MS for i in range(8)]
    assert track.times_ns("acts") == [
        23 * MS,
        31 * MS,
        43 * MS,
    ]  # at the first that reaches 20, 30, 40
    assert sim.time_ns == 47 * MS
    sim.reset()
    assert (sim.time_ns, sim.step_ns) == (0, 4 * MS)


def test_time_and_loads_continue_at_another_step_length(sim: Simulation) -> None:
    """2 N on 2 kg: a metre a second in each second, however long its steps."""
    sim["ball"].links[0].apply_wrench(Wrench(force=(2.0, 0.0, 0.0)), duration_s=0.5)
    sim.run(0.1)
    with_steps_of(sim, 0.005)
    assert sim.time_ns == 100 * MS
    assert sim["ball"].twist.linear[0] == pytest.approx(0.1, abs=1e-9)
    sim.run(0.1)
    assert sim["ball"].twist.linear[0] == pytest.approx(0.2, abs=1e-9)
    with_steps_of(sim, 0.0005)
    sim.run(0.8)

    assert sim.time_ns == 1000 * MS
    assert sim["ball"].twist.linear[0] == pytest.approx(0.5, abs=1e-9)  # the push ended when it would have


@pytest.mark.parametrize("step_s", [0.0002, 0.01])
def test_a_motor_is_as_stiff_as_one_started_at_this_step_length(sim: Simulation, step_s: float) -> None:
    turn = sim["arm"].joint("turn")
    turn.command_velocity(1.0, max_effort=10.0)
    with_steps_of(sim, step_s)
    fresh = Simulation(sim.world, Diagnostics())
    fresh["arm"].joint("turn").command_velocity(1.0, max_effort=10.0)
    for simulation in (sim, fresh):
        simulation.run(0.05)

    assert turn.velocity == pytest.approx(fresh["arm"].joint("turn").velocity, rel=1e-9)


def test_a_saved_state_restores_its_time(sim: Simulation) -> None:
    with_steps_of(sim, 0.003)
    sim.run(0.003)
    with_steps_of(sim, 0.002)
    sim.run(0.004)
    saved = sim.save()
    sim.reset()
    sim.restore(saved)

    assert sim.time_ns == 7 * MS
