"""Sensors go on as models come and go around them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from msgspec.structs import replace

import trundle
from trundle.sim.render import NativeRenderer
from trundle.sim.sensors import SIMULATED_CAMERAS, mount_cameras, mount_sensors
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

from .test_scheduling import TRANSMITTING, of_type

BOX = """<model name="{}"><static>1</static><pose>{} 0 0 0 0 0</pose><link name="l">
<visual name="v"><geometry><box><size>1 1 1</size></box></geometry></visual></link></model>"""


def world(tmp_path: Path, inside: str) -> tuple[Simulation, list[Any]]:
    file = tmp_path / "w.sdf"
    file.write_text(f'<sdf version="1.6"><world name="w">{inside}</world></sdf>')
    sim = trundle.load(str(file))
    mounted = [*mount_cameras(sim, NativeRenderer), *mount_sensors(sim)]
    for sensor in mounted:
        sensor.start(sim)
    return sim, mounted


@pytest.mark.parametrize("type_", sorted(SIMULATED_CAMERAS - set(TRANSMITTING)))
def test_every_sensor_measures_until_its_model_is_deleted(tmp_path: Path, type_: str) -> None:
    """A model before its own is deleted, another spawned, then its own deleted."""
    sim, (sensor,) = world(tmp_path, BOX.format("first", 9) + of_type(type_))
    readings: list[Any] = []
    sensor.listen(readings.append)

    sim.run(0.02)
    sim.delete("first")
    sim.run(0.02)
    sim.spawn(replace(sim["m"].model, name="another", world_from_model=Pose((0.0, 5.0, 0.0))))
    sim.run(0.02)
    assert [reading.time_ns for reading in readings] == [20_000_000, 40_000_000, 60_000_000]

    sim.delete("m")
    sim.run(0.1)
    assert len(readings) == 3


def test_a_camera_sees_spawned_models_from_its_own_link(tmp_path: Path) -> None:
    """Boxes ahead come and go; a model before the camera's own in the world is deleted, too."""
    shape = "<camera><image><width>9</width><height>9</height></image></camera>"
    sensor = f'<sensor name="s" type="depth">{shape}</sensor>'
    eye = f'<model name="m"><static>1</static><link name="l">{sensor}</link></model>'
    sim, (camera,) = world(tmp_path, BOX.format("far", 6) + eye)

    def depth() -> float:
        return float(camera.measure(sim.snapshot()).depth[4, 4])

    assert depth() == pytest.approx(5.5, abs=1e-4)
    sim.spawn(replace(sim["far"].model, name="near", world_from_model=Pose((3.0, 0.0, 0.0))))
    assert depth() == pytest.approx(2.5, abs=1e-4)
    sim.delete("far")
    assert depth() == pytest.approx(2.5, abs=1e-4)
    sim.delete("near")
    assert np.isnan(depth())
