"""Motors that keep a speed with a force up to a limit, against v = F t / I."""

import math
from pathlib import Path

import pytest

from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.robots.description import load
from trundle.robots.packages import Packages
from trundle.sim.simulation import Simulation

_LIGHT = """<sdf version="1.6"><world name="w"><model name="m"><link name="base"/>
<link name="wheel"><inertial><mass>0.1</mass>
<inertia><ixx>0.001</ixx><iyy>0.001</iyy><izz>0.001</izz></inertia></inertial>
</link><joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
<joint name="axle" type="revolute"><parent>base</parent><child>wheel</child><axis><xyz>0 0 1</xyz>
<limit><effort>10</effort></limit></axis></joint></model></world></sdf>"""


def _load(folder: Path, text: str) -> Simulation:
    path = folder / "w.world"
    path.write_text(text)
    report = Diagnostics()
    return Simulation(load(str(path), report, packages=Packages({}, start=folder)).world, report)


@pytest.mark.parametrize("speed", [0.5, 5.0, 50.0])
def test_a_strong_motor_of_a_light_wheel_does_not_chatter(tmp_path, speed: float) -> None:
    """10 N·m on 0.001 kg·m² change the speed by 10 rad/s in a step, past the set point and back."""
    simulation = _load(tmp_path, _LIGHT)
    axle = simulation["m"].joint("axle")
    for _ in range(50):
        axle.command_velocity(speed)
        simulation.step()
    speeds: list[float] = []
    for _ in range(5):
        axle.command_velocity(speed)
        simulation.step()
        speeds.append(axle.velocity)
    assert speeds == pytest.approx([speed] * 5, rel=1e-3)


@pytest.mark.parametrize("inertia", [1e-6, 1e-2, 1e3])
@pytest.mark.parametrize("max_effort", [1e-3, 1.0, 1e6])
def test_a_motor_accelerates_by_its_force_and_keeps_the_speed(tmp_path, inertia: float, max_effort: float) -> None:
    """v = min(target, F t / I) from the first step on, as with ODE's bounded motor, without ripple."""
    simulation = _load(tmp_path, _LIGHT.replace("0.001", f"{inertia}").replace("<effort>10</effort>", ""))
    axle = simulation["m"].joint("axle")
    axle.command_velocity(1.0, max_effort=max_effort)
    for step in range(1, 21):
        simulation.step()
        assert axle.velocity == pytest.approx(min(1.0, max_effort * 1e-3 * step / inertia), rel=0.01)


def test_a_platform_lifts_a_box_without_a_hop(tmp_path) -> None:
    box = """<inertial><mass>{}</mass><inertia><ixx>5</ixx><iyy>5</iyy><izz>5</izz></inertia></inertial>
    <collision name="c"><geometry><box><size>{}</size></box></geometry></collision>"""
    large, small = box.format(200, "2 2 0.1"), box.format(10, "0.2 0.2 0.2")
    models = f"""<model name="lift"><link name="l">{large}</link><joint name="up" type="prismatic"><child>l</child>
    <parent>world</parent><axis><xyz>0 0 1</xyz></axis></joint></model>
    <model name="box"><pose>0 0 0.15 0 0 0</pose><link name="l">{small}</link></model>"""
    simulation = _load(tmp_path, f'<sdf version="1.6"><world name="w">{models}</world></sdf>')
    lift = simulation["lift"].joint("up")
    lift.command_velocity(0.0)
    simulation.step(200)
    lift.command_velocity(0.3, max_effort=1e4)
    heights: list[float] = []
    for _ in range(300):
        simulation.step()
        heights.append(simulation["box"].pose.position[2] - simulation["lift"].link("l").pose.position[2])

    assert lift.velocity == pytest.approx(0.3, rel=1e-3)
    assert lift.effort == pytest.approx(210 * 9.8, rel=1e-2)
    assert heights == pytest.approx([0.15] * 300, abs=5e-4)


@pytest.mark.parametrize("max_effort", [1e6, 2e4, 500.0])
def test_a_belt_that_starts_suddenly_carries_its_box_without_a_hop(tmp_path, max_effort: float) -> None:
    """Coulomb: the box keeps up with 500 N (2.5 m/s²), else it slides for 0.03 s; it hopped by 1.1 mm for as long."""
    box = """<inertial><mass>{}</mass><inertia><ixx>{}</ixx><iyy>{}</iyy><izz>{}</izz></inertia></inertial>
    <collision name="c"><geometry><box><size>{}</size></box></geometry></collision>"""
    large, small = box.format(200, 5, 900, 900, "8 0.5 0.1"), box.format(1, *["0.007"] * 3, "0.2 0.2 0.2")
    models = f"""<model name="belt"><link name="l">{large}</link><joint name="j" type="prismatic"><child>l</child>
    <parent>world</parent><axis><xyz>1 0 0</xyz></axis></joint></model>
    <model name="box"><pose>0 0 0.15 0 0 0</pose><link name="l">{small}</link></model>"""
    simulation = _load(tmp_path, f'<sdf version="1.6"><world name="w">{models}</world></sdf>')
    belt, link = simulation["belt"].joint("j"), simulation["box"].base
    simulation.step(300)
    heights, speeds, rest = list[float](), list[float](), link.pose.position[2]
    belt.command_velocity(0.3, max_effort=max_effort)
    for step in range(1, 401):
        simulation.step()
        heights.append(link.pose.position[2] - rest)
        speeds.append(link.twist.linear[0])
        # The box takes its share of the force while it slides or is carried along.
        assert belt.velocity == pytest.approx(min(0.3, max_effort * 1e-3 * step / 200), rel=0.01)

    assert heights == pytest.approx([0.0] * 400, abs=1e-4)
    fast = next(step for step, speed in enumerate(speeds, 1) if speed > 0.95 * 0.3)
    assert fast == pytest.approx(max(0.3 / 9.8, 0.3 * 201 / max_effort) * 1e3 * 0.95, rel=0.25)
    assert speeds[-1] == pytest.approx(0.3, rel=1e-3)


def test_an_effort_accelerates_up_to_the_velocity_limit_only(tmp_path) -> None:
    simulation = _load(tmp_path, _LIGHT.replace("<effort>10</effort>", "<velocity>2</velocity>"))
    axle = simulation["m"].joint("axle")
    axle.command_effort(0.01)
    simulation.step(100)
    assert axle.velocity == pytest.approx(1.0, rel=1e-2), "0.01 N·m on 0.001 kg·m² for 0.1 s"
    simulation.step(200)
    assert axle.velocity == pytest.approx(2.0, rel=1e-3)
    axle.set_velocity(3.0)
    simulation.step(100)
    assert axle.velocity == pytest.approx(3.0, rel=1e-3), "nothing brakes what is faster"


def test_state_and_commands_are_independent(tmp_path) -> None:
    """Setting state switches no motor; a command has no effect until time passes."""
    simulation = _load(tmp_path, _LIGHT)
    axle = simulation["m"].joint("axle")

    axle.command_velocity(2.0)
    assert (axle.position, axle.velocity) == (0.0, 0.0)
    axle.set_velocity(-1.0)
    axle.set_position(0.5)
    assert (axle.position, axle.velocity) == (0.5, -1.0)
    simulation.run(1.0)
    assert axle.velocity == pytest.approx(2.0, rel=1e-6)
    assert axle.position == pytest.approx(2.5, abs=5e-3)


@pytest.mark.parametrize("order", ["set_position", "set_velocity"])
def test_a_state_that_is_not_finite_is_refused(tmp_path, order: str) -> None:
    axle = _load(tmp_path, _LIGHT)["m"].joint("axle")

    with pytest.raises(UsageError, match="must be a finite number, got nan"):
        getattr(axle, order)(math.nan)
