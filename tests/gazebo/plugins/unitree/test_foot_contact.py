"""Unitree's foot contacts, against the foot's weight."""

from pathlib import Path
from typing import Any

import pytest
from tests.gazebo.plugins.plugin_world import BODY, FakeNode, load

from trundle.gazebo.model_plugins import attach_sensor_plugins
from trundle.sim.sensors import mount_sensors

MASS, G = 2.0, 10.0
BALL = '<collision name="ball"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>'
SENSOR = (
    '<sensor name="FR_foot_contact" type="contact"><update_rate>100</update_rate><contact><collision>ball</collision>'
    '</contact><plugin name="p" filename="libunitreeFootContactPlugin.so"/></sensor>'
)


def forces(folder: Path, pose: str) -> list[Any]:
    body = f'<link name="foot"><pose>{pose}</pose>{BODY.format(MASS)}{BALL}{SENSOR}</link>'
    sim = load(folder, body, gravity=f"0 0 {-G}", ground=True)
    node: Any = FakeNode()
    sensors = mount_sensors(sim)
    assert attach_sensor_plugins(sensors, node, sim) == []
    for sensor in sensors:
        sensor.start(sim)
    sim.run(1.0)
    assert sim.report.warnings == []
    return node.published["/visual/FR_foot_contact/the_force"]


def test_foot_contact_publishes_the_weight_in_the_axes_of_the_foot(tmp_path: Path) -> None:
    """The foot lies on its side: its y points up."""
    messages = forces(tmp_path, "0 0 0.1 1.5707963 0 0")

    assert len(messages) == 100
    force = messages[-1].wrench.force
    assert (force.x, force.y, force.z) == pytest.approx((0.0, MASS * G, 0.0), abs=0.01)
    assert messages[-1].header.frame_id == "foot"


def test_foot_contact_publishes_zero_in_the_air(tmp_path: Path) -> None:
    messages = forces(tmp_path, "0 0 50 0 0 0")

    assert (messages[-1].wrench.force.x, messages[-1].wrench.force.z) == (0.0, 0.0)
