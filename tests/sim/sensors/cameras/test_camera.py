"""Cameras render when due, the state of that time, and only for listeners."""

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
import pytest
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.base.diagnostics import Diagnostics, Source
from trundle.robots.model import CameraOptics, Inertial, Link, Model, Noise, PhysicsSettings, Sensor, World
from trundle.sim.render import Intrinsics, Picture, Scene
from trundle.sim.sensors import CameraReading, CameraSensor, mount_cameras
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

AT = Source("robot.sdf", 9)
OPTICS = CameraOptics(width_px=8, height_px=6, horizontal_fov_rad=1.2, near_m=0.2, far_m=30.0)
MS = 1_000_000


class CountingRenderer:
    """Renderer that draws nothing and records the cameras' poses."""

    def __init__(self) -> None:
        self.updates: list[NDArray[np.float64]] = []
        self.views: list[tuple[Pose, Intrinsics]] = []
        self.calls: list[int] = []
        """Number of pictures of each call."""

    def update(self, poses: NDArray[np.float64]) -> None:
        self.updates.append(poses)

    def set_vertices(self, shape: int, vertices: NDArray[np.float32]) -> None:
        raise AssertionError(f"shape {shape} with {len(vertices)} vertices: the scene has no meshes")

    def render(
        self, views: Sequence[tuple[Pose, Intrinsics]], *, depth: bool = False, segmentation: bool = False
    ) -> list[Picture]:
        assert (depth, segmentation) == (False, False)
        self.calls.append(len(views))
        self.views += views
        return [Picture(np.zeros((lens.height_px, lens.width_px, 3), dtype=np.uint8)) for _, lens in views]


def camera(name: str = "eye", **rest: object) -> Sensor:
    sensor = Sensor(name=name, type="camera", at=AT, cameras=(OPTICS,), update_rate_hz=30.0)
    return replace(sensor, **rest)


def world(*sensors: Sensor) -> World:
    """Two links that float and drift, the second with sensors."""
    still = Inertial(mass=1.0, moments=(0.1, 0.1, 0.1))
    links = (
        Link(name="base", at=AT, inertial=still),
        Link(name="head", at=AT, model_from_link=Pose((0.0, 0.0, 2.0)), inertial=still, sensors=sensors),
    )
    physics = PhysicsSettings(gravity=(0.0, 0.0, -1.0))
    return World(name="w", at=AT, models=(Model(name="m", at=AT, links=links),), physics=physics)


def mounted(*sensors: Sensor) -> tuple[Simulation, list[CameraSensor], CountingRenderer]:
    renderer = CountingRenderer()
    report = Diagnostics(strict=True)
    sim = Simulation(world(*sensors), report)
    cameras = mount_cameras(sim, lambda _: renderer)
    for eye in cameras:
        eye.start(sim)
    return sim, cameras, renderer


def watch(cameras: Sequence[CameraSensor]) -> None:
    for eye in cameras:
        eye.listen(lambda _: None)


def test_a_camera_without_listeners_costs_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    sim, (eye,), renderer = mounted(camera())
    eye.listen(lambda _: pytest.fail("the listener is disabled"), enabled=lambda: False)
    strides: list[int] = []
    step = sim.engine.step

    def counted(count: int, hooks: Any) -> int:
        strides.append(count)
        return step(count, hooks)

    monkeypatch.setattr(sim.engine, "step", counted)
    sim.run(1.0)
    assert (eye.reading_count, renderer.updates, renderer.views) == (0, [], [])
    assert strides == [1000]


def test_an_always_on_camera_counts_readings_without_rendering() -> None:
    sim, (eye,), renderer = mounted(camera(always_on=True))
    eye.listen(lambda _: pytest.fail("the listener is disabled"), enabled=lambda: False)
    sim.run(1.0)
    assert (eye.reading_count, eye.image_count, renderer.updates, renderer.views) == (30, 0, [], [])


def test_images_of_an_always_on_camera_do_not_depend_on_the_start_of_listening() -> None:
    """The same instants, with the same noise."""
    noisy = replace(OPTICS, noise=Noise(stddev=0.1))
    runs: list[list[tuple[int, bytes]]] = []
    for start_s in (0.0, 0.15):
        sim, (eye,), _ = mounted(camera(cameras=(noisy,), update_rate_hz=10.0, always_on=True))
        images: list[tuple[int, bytes]] = []
        eye.listen(
            lambda reading, images=images: images.append((reading.time_ns, reading.rgb.tobytes())),
            enabled=lambda sim=sim, start_s=start_s: sim.time_ns > start_s * 1e9,
        )
        sim.run(0.4)
        runs.append(images)
    assert len(runs[0]) == 4
    assert runs[0][1:] == runs[1]


def test_a_rate_of_30_hz_gives_300_stamped_images_in_ten_seconds() -> None:
    sim, (eye,), renderer = mounted(camera())
    readings: list[CameraReading] = []
    eye.listen(readings.append)
    sim.run(10.0)
    assert len(readings) == eye.image_count == len(renderer.views) == 300
    period_ns = 1e9 / 30
    assert all(0 <= reading.time_ns - (i + 1) * period_ns < 1.001 * MS for i, reading in enumerate(readings))
    assert all(reading.time_ns % MS == 0 for reading in readings)
    assert readings[0].rgb.shape == (6, 8, 3)


def test_cameras_due_together_are_rendered_in_one_batch_and_reported_in_order() -> None:
    """The last one is due at every second time only, and the third has no listener."""
    rates = {"left": 10.0, "right": 10.0, "blind": 10.0, "slow": 5.0}
    sim, cameras, renderer = mounted(*(camera(name, update_rate_hz=rate) for name, rate in rates.items()))
    reports: list[tuple[str, int]] = []
    for eye in cameras:
        note = partial(lambda name, reading: reports.append((name, reading.time_ns // MS)), eye.name)
        eye.listen(note, enabled=partial(str.__ne__, eye.name, "blind"))
    sim.run(0.2)
    assert reports == [("left", 100), ("right", 100), ("left", 200), ("right", 200), ("slow", 200)]
    assert renderer.calls == [2, 3]
    assert len(renderer.updates) == 2


def test_large_images_are_rendered_in_several_batches() -> None:
    """Three of two million pixels each: a call draws two."""
    large = replace(OPTICS, width_px=2048, height_px=1024)
    sim, cameras, renderer = mounted(*(camera(name, cameras=(large,)) for name in "abc"))
    watch(cameras)
    sim.run(0.04)
    assert renderer.calls == [2, 1]
    assert len(renderer.updates) == 1


def test_cameras_of_different_sizes_are_rendered_separately() -> None:
    wide = replace(OPTICS, width_px=9)
    kinds = {"a": OPTICS, "b": wide, "c": OPTICS}
    sim, cameras, renderer = mounted(*(camera(name, cameras=(optics,)) for name, optics in kinds.items()))
    watch(cameras)
    sim.run(0.04)
    assert renderer.calls == [2, 1]


def test_a_single_measurement_renders_one_camera_only() -> None:
    sim, cameras, renderer = mounted(camera("left"), camera("right"))
    sim.step()
    for eye in cameras:
        eye.request(sim.snapshot())
    left, right = (eye.measure(sim.snapshot()) for eye in cameras)
    assert left.rgb.shape == right.rgb.shape == (6, 8, 3)
    assert renderer.calls == [1, 1]


def test_an_update_rate_of_zero_means_30_hz() -> None:
    sim, (eye,), _ = mounted(camera(update_rate_hz=0.0, always_on=True))
    sim.run(1.0)
    assert eye.reading_count == 30


def test_a_camera_renders_only_while_a_listener_is_enabled() -> None:
    sim, (eye,), _ = mounted(camera(update_rate_hz=10.0))
    enabled = [False]
    times_ms: list[int] = []
    eye.listen(lambda reading: times_ms.append(reading.time_ns // MS), enabled=lambda: enabled[0])
    sim.run(1.0)
    enabled[0] = True
    sim.run(0.3)
    enabled[0] = False
    sim.run(1.0)
    assert times_ms == [1100, 1200, 1300]


def test_several_listeners_share_one_image() -> None:
    sim, (eye,), _ = mounted(camera(update_rate_hz=10.0))
    first: list[CameraReading] = []
    second: list[CameraReading] = []
    eye.listen(first.append)
    eye.listen(second.append)
    eye.listen(lambda _: pytest.fail("the listener is disabled"), enabled=lambda: False)
    sim.run(0.5)
    assert len(first) == eye.reading_count == 5
    assert all(a is b for a, b in zip(first, second, strict=True))


def test_the_camera_pose_follows_its_link() -> None:
    tilted = Pose.from_rpy(0.1, 0.0, 0.05, 0.0, 0.3, 0.0)
    optics = replace(OPTICS, sensor_from_camera=Pose((0.0, 0.02, 0.0)))
    sim, (eye,), renderer = mounted(camera(link_from_sensor=tilted, cameras=(optics,), update_rate_hz=10.0))
    watch([eye])
    sim.run(0.1)
    ((view, intrinsics),) = renderer.views
    expected = sim["m"].link("head").pose @ tilted @ Pose((0.0, 0.02, 0.0))
    assert view.position == pytest.approx(expected.position)
    assert view.quaternion == pytest.approx(expected.quaternion)
    assert view.position[2] < 2.05
    assert (intrinsics.width_px, intrinsics.height_px, intrinsics.near_m, intrinsics.far_m) == (8, 6, 0.2, 30.0)
    assert eye.link_index == 1
    assert renderer.updates[0] == pytest.approx(sim.snapshot().poses)


def test_rendering_does_not_change_the_simulation() -> None:
    ends = []
    for is_watched in (False, True):
        sim, cameras, _ = mounted(camera())
        if is_watched:
            watch(cameras)
        sim.run(1.0)
        ends.append(sim.snapshot())
    assert ends[0].poses.tobytes() == ends[1].poses.tobytes()


def test_all_cameras_share_one_renderer_and_no_cameras_need_none() -> None:
    renderers: list[CountingRenderer] = []

    def make(_: Scene) -> CountingRenderer:
        renderers.append(CountingRenderer())
        return renderers[-1]

    assert [eye.name for eye in mount_cameras(Simulation(world(camera("a"), camera("b")), Diagnostics()), make)] == [
        "a",
        "b",
    ]
    assert len(renderers) == 1
    assert mount_cameras(Simulation(world(), Diagnostics()), make) == []
    assert len(renderers) == 1


def test_unsupported_sensor_types_are_reported() -> None:
    report = Diagnostics()
    unknown = Sensor(name="nose", type="smell", at=AT)
    assert mount_cameras(Simulation(world(unknown), report), lambda _: CountingRenderer()) == []
    assert report.warnings == ["robot.sdf:9: warning: sensor 'nose': smell sensors are not simulated yet"]
