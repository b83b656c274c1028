"""Small worlds with their sensors."""

from pathlib import Path
from typing import Any

import trundle
from trundle.sim.render import NativeRenderer
from trundle.sim.sensors import mount_cameras, mount_sensors
from trundle.sim.simulation import Simulation

CAMERA = """<sensor name="cam" type="camera"><pose>0.5 0 0 0 0 1</pose><update_rate>5</update_rate>
<camera><horizontal_fov>1</horizontal_fov><image><width>8</width><height>6</height></image></camera></sensor>"""
BOX = '<visual name="v"><geometry><box><size>1 1 1</size></box></geometry></visual>'


def lidar() -> str:
    """Return a lidar whose rays are shown."""
    return """<sensor name="scan" type="ray"><visualize>1</visualize><update_rate>10</update_rate><ray>
<scan><horizontal><samples>3</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan>
<range><min>0.1</min><max>9</max></range></ray></sensor>"""


def model(name: str, inside: str = "", *, static: bool = True) -> str:
    """Return a model of one link."""
    return f'<model name="{name}"><static>{int(static)}</static><link name="l">{inside}</link></model>'


def world(inside: str) -> str:
    """Return an SDF file."""
    return f'<sdf version="1.6"><world name="w">{inside}</world></sdf>'


def loaded(folder: Path, inside: str) -> tuple[Simulation, list[Any]]:
    """Return a simulation and its running sensors."""
    (folder / "w.sdf").write_text(world(inside))
    sim = trundle.load(str(folder / "w.sdf"))
    sensors = [*mount_cameras(sim, NativeRenderer), *mount_sensors(sim)]
    for sensor in sensors:
        sensor.start(sim)
    return sim, sensors
