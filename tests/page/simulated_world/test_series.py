"""Values of a simulation that are plotted by name."""

from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest
from tests.page.simulated_world.fake_server import FakeServer

from trundle.base.diagnostics import Diagnostics
from trundle.page import PageServer
from trundle.page.simulated_world.series_sampler import SeriesSampler
from trundle.robots.description import load_text
from trundle.robots.model import flattened
from trundle.robots.packages import Packages
from trundle.sim.sensors import mount_sensors
from trundle.sim.simulation import Simulation

WORLD = """<sdf version="1.6"><world name="w">
<model name="floor"><static>1</static><link name="l"><collision name="c">
<geometry><box><size>9 9 1</size></box></geometry></collision></link></model>
<model name="box"><pose>1 2 0.75 0 0 0.5</pose><link name="l.1"><inertial><mass>2</mass></inertial><collision name="c">
<geometry><box><size>0.5 0.5 0.5</size></box></geometry></collision>
<sensor name="imu" type="imu"><update_rate>100</update_rate></sensor></link></model>
<model name="arm"><pose>5 0 3 0 0 0</pose><link name="rod"><inertial><pose>0.5 0 0 0 0 0</pose></inertial></link>
<joint name="hinge" type="revolute"><parent>world</parent><child>rod</child><axis><xyz>0 1 0</xyz></axis></joint>
</model>
</world></sdf>"""


@pytest.fixture
def simulation(tmp_path: Path) -> Simulation:
    packages = Packages({}, start=tmp_path)
    loaded = load_text(WORLD, name="w.sdf", folder=tmp_path, packages=packages, report=Diagnostics())
    return Simulation(flattened(loaded.world), Diagnostics())


@pytest.fixture
def sampled(simulation: Simulation) -> tuple[SeriesSampler, FakeServer]:
    server = FakeServer()
    sampler = SeriesSampler(cast(PageServer, server))
    sensors = mount_sensors(simulation)
    for sensor in sensors:
        sensor.start(simulation)
    sampler.show(simulation, sensors)
    return sampler, server


def run(simulation: Simulation, sampler: SeriesSampler, strides: int) -> None:
    for _ in range(strides):
        simulation.run(0.02)
        sampler.sample(paused=False)
    sampler.put()


def columns(server: FakeServer) -> dict[str, Any]:
    _, head, rows = server.series[-1]
    return dict(zip(("time", *head["names"]), rows.T, strict=True))


def test_a_box_on_the_floor_is_held_by_its_weight(
    simulation: Simulation, sampled: tuple[SeriesSampler, FakeServer]
) -> None:
    """A name may have a dot of its own; a model has the values of its first link."""
    sampler, server = sampled
    server.plotted = ("box.pose.x", "box::l.1.contact.force.z", "box::l.1.contact.count", "box::l.1.pose.yaw")
    run(simulation, sampler, 50)

    found = columns(server)
    assert found["time"] == pytest.approx(np.arange(1, 51) * 0.02)
    assert found["box.pose.x"] == pytest.approx(1.0, abs=1e-3)
    assert found["box::l.1.pose.yaw"] == pytest.approx(0.5, abs=1e-3)
    assert found["box::l.1.contact.force.z"][-1] == pytest.approx(2 * 9.8, rel=0.02)
    assert found["box::l.1.contact.count"][-1] >= 3


def test_joints_and_sensors_are_sampled_with_their_units(
    simulation: Simulation, sampled: tuple[SeriesSampler, FakeServer]
) -> None:
    sampler, server = sampled
    server.plotted = ("arm::hinge.position", "arm::hinge.velocity", "box::l.1::imu.linear_acceleration.z")
    run(simulation, sampler, 20)

    found, head = columns(server), server.series[-1][1]
    assert head["units"] == ["rad", "rad/s", "m/s²"]
    change = np.diff(found["arm::hinge.position"])[5:] / 0.02
    middle = (found["arm::hinge.velocity"][1:] + found["arm::hinge.velocity"][:-1])[5:] / 2
    assert change == pytest.approx(middle, rel=0.01)
    assert found["box::l.1::imu.linear_acceleration.z"][-1] == pytest.approx(9.8, abs=0.1)


def test_what_is_not_there_is_said_with_what_is(
    simulation: Simulation, sampled: tuple[SeriesSampler, FakeServer]
) -> None:
    sampler, server = sampled
    server.plotted = ("arm::hinge.speed", "arm::hinge.effort", "nobody.pose.x")
    run(simulation, sampler, 1)

    faults = server.series[-1][1]["faults"]
    assert faults["arm::hinge.speed"] == "no value arm::hinge.speed; there are: position, velocity, effort"
    assert faults["nobody.pose.x"] == "no model, link, joint or sensor for nobody.pose.x"
    assert list(columns(server)) == ["time", "arm::hinge.effort"]


def test_nothing_is_measured_while_nothing_is_plotted(
    simulation: Simulation, sampled: tuple[SeriesSampler, FakeServer]
) -> None:
    sampler, server = sampled
    server.plotted = ("box::l.1::imu.orientation.yaw",)
    run(simulation, sampler, 5)
    (imu,) = (hook for hook in simulation.hooks if getattr(hook, "name", "") == "imu")
    server.plotted = ()
    sampler.sample(paused=False)
    count = imu.reading_count
    run(simulation, sampler, 5)

    assert count > 0
    assert imu.reading_count == count
    assert len(server.series) == 1


def test_rows_of_a_past_that_is_looked_at_are_not_sampled_again(
    simulation: Simulation, sampled: tuple[SeriesSampler, FakeServer]
) -> None:
    """Scrubbing back shows what was; going on from there samples again."""
    sampler, server = sampled
    server.plotted = ("arm::hinge.position",)
    saved = simulation.save()
    run(simulation, sampler, 10)
    simulation.restore(saved)
    sampler.sample(paused=True)
    sampler.put()
    assert columns(server)["time"][-1] == pytest.approx(0.2)

    run(simulation, sampler, 1)
    assert columns(server)["time"].tolist() == [0.02]
