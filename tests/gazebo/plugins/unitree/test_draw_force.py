"""Unitree's line along the force on a foot, against the foot's weight."""

from pathlib import Path
from typing import Any

import pytest
from tests.gazebo.plugins.plugin_world import BODY, FakeNode, load

from trundle.gazebo.model_plugins import attach_sensor_plugins
from trundle.page.simulated_world.lines import plugin_lines
from trundle.sim.sensors import mount_sensors
from trundle.sim.simulation import Simulation

MASS, G = 2.0, 10.0
BALL = "<geometry><sphere><radius>0.1</radius></sphere></geometry>"
SENSOR = (
    '<sensor name="FR_foot_contact" type="contact"><update_rate>100</update_rate><contact><collision>ball</collision>'
    '</contact><plugin name="p" filename="libunitreeFootContactPlugin.so"/></sensor>'
)
ON_SIDE = "0 0 0.1 1.5707963267948966 0 0"


def plugin_tag(topic: str) -> str:
    return f'<plugin name="drawForcePlugin" filename="libunitreeDrawForcePlugin.so">{topic}</plugin>'


def foot(shape: str = BALL, topic: str = "<topicName>FR_foot_contact</topicName>") -> str:
    visual = f'<visual name="v"><pose>0.05 0 0 0 0 0</pose>{shape}{plugin_tag(topic)}</visual>'
    collision = f'<collision name="ball">{BALL}</collision>'
    return f'<link name="foot"><pose>{ON_SIDE}</pose>{BODY.format(MASS)}{collision}{visual}{SENSOR}</link>'


def ends(sim: Simulation) -> tuple[Any, Any]:
    (line,) = sim.lines.values()
    start, end = line.points
    return pytest.approx(start, abs=1e-3), pytest.approx(end, abs=1e-3)


def test_the_line_of_a_standing_foot_has_the_length_of_its_weight(tmp_path: Path) -> None:
    """20 N on a ball of 0.2 m: 20 N / (20 N/m) · 0.2 = 0.2 m upwards, along the foot's y."""
    node: Any = FakeNode()
    sim = load(tmp_path, foot(), gravity=f"0 0 {-G}", ground=True, node=node)
    sensors = mount_sensors(sim)
    attach_sensor_plugins(sensors, node, sim)
    for sensor in sensors:
        sensor.start(sim)
    sim.lines_are_shown = True
    sim.run(1.0)
    node.receive(
        "/visual/FR_foot_contact/the_force", wrench=node.published["/visual/FR_foot_contact/the_force"][-1].wrench
    )
    sim.run(0.1)

    assert ends(sim) == ((0.05, 0.0, 0.1), (0.05, 0.0, 0.3))
    (line,) = plugin_lines(sim)
    assert line.points.shape == (2, 3)
    assert line.rgba == (255, 0, 255, 255)
    assert sim.report.warnings == []


@pytest.mark.parametrize(
    ("shape", "tip"),
    [
        ("<geometry><box><size>1 2 3</size></box></geometry>", (0.1, 0.4, 0.9)),
        ("<geometry><cylinder><radius>1</radius><length>3</length></cylinder></geometry>", (0.2, 0.4, 0.9)),
        ("<geometry><empty/></geometry>", (0.1, 0.2, 0.3)),
    ],
)
def test_the_line_is_scaled_with_its_visual(tmp_path: Path, shape: str, tip: tuple[float, float, float]) -> None:
    node = FakeNode()
    sim = load(tmp_path, foot(shape, "<topicName>/elsewhere</topicName>"), node=node)
    sim.lines_are_shown = True
    sim.step()
    node.receive("/elsewhere/the_force", wrench={"force": {"x": 2.0, "y": 4.0, "z": 6.0}})
    sim.run(0.1)

    x, y, z = tip
    assert ends(sim) == ((0.05, 0.0, 0.1), (0.05 + x, -z, 0.1 + y))


def test_forces_are_not_subscribed_without_a_viewer(tmp_path: Path) -> None:
    node = FakeNode()
    sim = load(tmp_path, foot(topic=""), node=node)
    sim.run(0.1)
    with pytest.raises(KeyError):
        node.receive("/default_force_draw/the_force")
    sim.lines_are_shown = True
    sim.run(0.1)
    node.receive("/default_force_draw/the_force", wrench={"force": {"z": 1.0}})
