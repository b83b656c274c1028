"""Schedule of sensors: at their rate to the step, and only with listeners."""

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import trundle
from trundle.sim.render import Intrinsics, Picture, Scene
from trundle.sim.sensors import SIMULATED_CAMERAS, mount_cameras, mount_sensors
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

MS = 1_000_000
BODY = "<inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>"
ON_JOINTS = ("force_torque",)
TRANSMITTING = ("rfidtag", "wireless_transmitter")
"""Sensors that publish nothing: others detect them."""


class Blank:
    """Renderer that draws nothing and counts the calls."""

    def __init__(self, scene: Scene) -> None:
        del scene
        self.updates = 0
        self.calls = 0
        self.renders = 0

    def update(self, poses: Any) -> None:
        del poses
        self.updates += 1

    def set_vertices(self, shape: int, vertices: NDArray[np.float32]) -> None:
        raise AssertionError(f"shape {shape} with {len(vertices)} vertices: the scene has no meshes")

    def render(
        self, views: Sequence[tuple[Pose, Intrinsics]], *, depth: bool = False, segmentation: bool = False
    ) -> list[Picture]:
        self.calls += 1
        self.renders += len(views)
        size = (views[0][1].height_px, views[0][1].width_px)
        picture = Picture(
            np.zeros((*size, 3), dtype=np.uint8),
            np.ones(size, dtype=np.float32) if depth else None,
            np.full(size, -1, dtype=np.int32) if segmentation else None,
        )
        return [picture] * len(views)


def sensor(type_: str, *, rate: float, more: str = "", name: str = "s") -> str:
    small = "<camera><image><width>8</width><height>6</height></image></camera>"
    scan = "<ray><scan><horizontal><samples>3</samples></horizontal></scan><range><max>5</max></range></ray>"
    inside = scan if type_ in ("ray", "gpu_ray", "lidar", "gpu_lidar") else ""
    inside = small if "camera" in type_ or type_ in _SEEING else inside
    inside = "" if type_ == "logical_camera" else inside
    return f'<sensor name="{name}" type="{type_}"><update_rate>{rate}</update_rate>{more}{inside}</sensor>'


_SEEING = ("depth", "rgbd", "segmentation", "boundingbox", "thermal")


def robot(sensors: str, *, on_joint: str = "") -> str:
    joint = f'<joint name="j" type="fixed"><parent>world</parent><child>l</child>{on_joint}</joint>'
    return f'<model name="m"><link name="l">{BODY}{sensors}</link>{joint}</model>'


@pytest.fixture
def load(tmp_path: Any) -> Any:
    """Read the content of a <world> and mount its sensors."""

    def load(inside: str) -> tuple[Simulation, list[Any]]:
        file = tmp_path / "w.sdf"
        file.write_text(f'<sdf version="1.6"><world name="w">{inside}</world></sdf>')
        sim = trundle.load(str(file))
        mounted = [*mount_cameras(sim, Blank), *mount_sensors(sim)]
        for sensor in mounted:
            sensor.start(sim)
        return sim, mounted

    return load


def of_type(type_: str, *, rate: float = 50.0, more: str = "") -> str:
    element = sensor(type_, rate=rate, more=more)
    return robot("", on_joint=element) if type_ in ON_JOINTS else robot(element)


@pytest.mark.parametrize("rate", [1, 7, 30, 59.94, 60, 144])
def test_readings_come_at_exact_multiples_of_the_period(load: Any, rate: float) -> None:
    """Each at the first step that is not before its time; a period rounded to nanoseconds is late after a second."""
    sim, (imu,) = load(of_type("imu", rate=rate))
    stamps: list[int] = []
    imu.listen(lambda reading: stamps.append(reading.time_ns))
    sim.run(20.0)

    exact = Fraction(str(rate))
    assert stamps == [-(-1000 * k // exact) * MS for k in range(1, int(20 * exact) + 1)]


@pytest.mark.parametrize("type_", sorted(SIMULATED_CAMERAS - set(TRANSMITTING)))
def test_a_sensor_without_listeners_measures_nothing_and_shortens_no_stride(load: Any, type_: str) -> None:
    sim, (mounted,) = load(of_type(type_))
    mounted.listen(lambda _: pytest.fail("the sensor has no listener"), enabled=lambda: False)
    mounted.measure = lambda _: pytest.fail("the sensor has no listener")
    strides: list[int] = []
    step = sim.engine.step
    sim.engine.step = lambda count, hooks: (strides.append(count), step(count, hooks))[1]
    sim.run(0.5)

    assert strides == [500]


@pytest.mark.parametrize("type_", sorted(SIMULATED_CAMERAS - set(TRANSMITTING)))
def test_an_always_on_sensor_keeps_its_schedule_and_measures_if_it_has_history(load: Any, type_: str) -> None:
    sim, (mounted,) = load(of_type(type_, more="<always_on>1</always_on>"))
    times_ms: list[int] = []
    measure = mounted.measure
    mounted.listen(lambda _: None, enabled=lambda: sim.time_ns > 70 * MS)

    def counted(snapshot: Any) -> Any:
        times_ms.append(snapshot.time_ns // MS)
        return measure(snapshot)

    mounted.measure = counted
    sim.run(0.1)

    assert times_ms == ([20, 40, 60, 80, 100] if mounted.has_history else [80, 100])
    assert mounted.reading_count == 5


@pytest.mark.parametrize("type_", TRANSMITTING)
def test_transmitters_and_tags_are_not_sensors(load: Any, type_: str) -> None:
    _, mounted = load(of_type(type_))
    assert mounted == []


def test_a_reading_measures_the_state_at_its_stamp(load: Any) -> None:
    """A barometer in free fall reads the pressure at its current height."""
    sim, (barometer,) = load(f'<model name="m"><link name="l">{BODY}{sensor("air_pressure", rate=30)}</link></model>')
    readings: list[Any] = []
    barometer.listen(readings.append)
    sim.run(1.0)

    for reading in readings:
        drop = 0.5 * 9.8 * (reading.time_ns / 1e9) ** 2
        assert reading.pressure == pytest.approx(101325.0 + 12.013 * drop, abs=0.6)
    assert len(readings) == 30


def test_many_cameras_render_in_one_call_with_one_update(load: Any) -> None:
    """24 cameras on one robot: 24 pictures an instant, one update, one call; half of them cost half."""
    small = "<camera><image><width>160</width><height>120</height></image></camera>"
    eyes = "".join(
        f'<sensor name="e{i}" type="camera"><update_rate>10</update_rate>{small}</sensor>' for i in range(24)
    )
    work: Counter[int] = Counter()
    for looked_at in (24, 12):
        sim, cameras = load(robot(eyes))
        for camera in cameras[:looked_at]:
            camera.listen(lambda _: None)
        renderer = cameras[0].scene._renderer
        sim.run(1.0)
        assert renderer.updates == renderer.calls == 10
        work[looked_at] = renderer.renders
    assert work == {24: 240, 12: 120}


def test_a_triggered_camera_renders_one_image_per_trigger(load: Any) -> None:
    """At the next due time, 10 times a second; several triggers before it give one image."""
    sim, (camera,) = load(robot('<sensor name="s" type="camera"><update_rate>10</update_rate></sensor>'))
    stamps: list[int] = []
    camera.listen(lambda reading: stamps.append(reading.time_ns))
    trigger = camera.await_trigger()
    sim.run(0.25)
    trigger()
    trigger()
    sim.run(0.3)
    trigger()
    sim.run(0.3)

    assert stamps == [300_000_000, 600_000_000]


@pytest.mark.parametrize("rate", ["-5", "nan", "inf"])
def test_an_invalid_rate_is_replaced_with_a_warning(load: Any, rate: str) -> None:
    element = f'<sensor name="s" type="camera"><update_rate>{rate}</update_rate></sensor>'
    sim, (camera,) = load(robot(element))

    assert camera.period_ns == Fraction(10**9, 30)
    assert any("w.sdf:1: warning: " in warning and "0" in warning for warning in sim.report.warnings)


@pytest.mark.parametrize("rate", [1e-9, 1e300])
def test_extreme_rates_are_limited(load: Any, rate: float) -> None:
    sim, (imu,) = load(of_type("imu", rate=rate, more="<always_on>1</always_on>"))
    stamps: list[int] = []
    imu.listen(lambda reading: stamps.append(reading.time_ns))
    sim.run(0.01)

    assert len(stamps) == (0 if rate < 1 else 10)
