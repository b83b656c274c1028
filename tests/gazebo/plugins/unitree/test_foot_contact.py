"""Unitree's foot contacts, against the weight that a foot stands under."""

from pathlib import Path
from typing import Any

import pytest
from tests.gazebo.plugins.stage import BODY, Wires, load

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
    wires: Any = Wires()
    sensors = mount_sensors(sim)
    assert attach_sensor_plugins(sensors, wires, sim) == []
    for sensor in sensors:
        sensor.start(sim)
    sim.run(1.0)
    assert sim.report.warnings == []
    return wires.said["/visual/FR_foot_contact/the_force"]


def test_a_foot_tells_its_weight_in_its_own_axes(tmp_path: Path) -> None:
    """The foot lies on its side, so that up is its own y."""
    told = forces(tmp_path, "0 0 0.1 1.5707963 0 0")

    assert len(told) == 100
    force = told[-1].wrench.force
    assert (force.x, force.y, force.z) == pytest.approx((0.0, MASS * G, 0.0), abs=0.01)
    assert told[-1].header.frame_id == "foot"


def test_a_foot_in_the_air_tells_zero(tmp_path: Path) -> None:
    told = forces(tmp_path, "0 0 50 0 0 0")

    assert (told[-1].wrench.force.x, told[-1].wrench.force.z) == (0.0, 0.0)
