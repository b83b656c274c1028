"""Plotted values of a simulation."""

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
from trundle.sim.sensors.imu import ImuSensor
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


def test_a_resting_box_has_pose_and_contact_values(
    simulation: Simulation, sampled: tuple[SeriesSampler, FakeServer]
) -> None:
    """Names may contain dots; a model has the values of its first link."""
    sampler, server = sampled
    server.plotted = ("box.pose.x", "box::l.1.contact.force.z", "box::l.1.contact.count", "box::l.1.pose.yaw")
    run(simulation, sampler, 50)

    values = columns(server)
    assert values["time"] == pytest.approx(np.arange(1, 51) * 0.02)
    assert values["box.pose.x"] == pytest.approx(1.0, abs=1e-3)
    assert values["box::l.1.pose.yaw"] == pytest.approx(0.5, abs=1e-3)
    assert values["box::l.1.contact.force.z"][-1] == pytest.approx(2 * 9.8, rel=0.02)
    assert values["box::l.1.contact.count"][-1] >= 3


def test_joints_and_sensors_are_sampled_with_their_units(
    simulation: Simulation, sampled: tuple[SeriesSampler, FakeServer]
) -> None:
    sampler, server = sampled
    server.plotted = ("arm::hinge.position", "arm::hinge.velocity", "box::l.1::imu.linear_acceleration.z")
    run(simulation, sampler, 20)

    values, head = columns(server), server.series[-1][1]
    assert head["units"] == ["rad", "rad/s", "m/s²"]
    change = np.diff(values["arm::hinge.position"])[5:] / 0.02
    middle = (values["arm::hinge.velocity"][1:] + values["arm::hinge.velocity"][:-1])[5:] / 2
    assert change == pytest.approx(middle, rel=0.01)
    assert values["box::l.1::imu.linear_acceleration.z"][-1] == pytest.approx(9.8, abs=0.1)


def test_unknown_values_have_a_reason_with_the_known_ones(
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
    (imu,) = (hook for hook in simulation.hooks if isinstance(hook, ImuSensor))
    server.plotted = ()
    sampler.sample(paused=False)
    count = imu.reading_count
    run(simulation, sampler, 5)

    assert count > 0
    assert imu.reading_count == count
    assert len(server.series) == 1


def test_seeking_back_while_paused_samples_nothing(
    simulation: Simulation, sampled: tuple[SeriesSampler, FakeServer]
) -> None:
    """Seeking back shows recorded rows; running on from there samples again."""
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
