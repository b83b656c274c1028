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
from trundle.sim import sensors
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

    def render(
        self, views: Sequence[tuple[Pose, Intrinsics]], *, depth: bool = False, segmentation: bool = False
    ) -> list[Picture]:
        assert (depth, segmentation) == (False, False)
        self.calls.append(len(views))
        self.views += views
        return [Picture(np.zeros((lens.height_px, lens.width_px, 3), dtype=np.uint8)) for _, lens in views]


def camera(name: str = "eye", **rest: object) -> Sensor:
    made = Sensor(name=name, type="camera", at=AT, cameras=(OPTICS,), update_rate_hz=30.0)
    return replace(made, **rest)


def world(*sensors_: Sensor) -> World:
    """Two links that float and drift, the second with sensors."""
    still = Inertial(mass=1.0, moments=(0.1, 0.1, 0.1))
    links = (
        Link(name="base", at=AT, inertial=still),
        Link(name="head", at=AT, model_from_link=Pose((0.0, 0.0, 2.0)), inertial=still, sensors=sensors_),
    )
    physics = PhysicsSettings(gravity=(0.0, 0.0, -1.0))
    return World(name="w", at=AT, models=(Model(name="m", at=AT, links=links),), physics=physics)


def mounted(*sensors_: Sensor) -> tuple[Simulation, list[CameraSensor], CountingRenderer]:
    made, renderer = world(*sensors_), CountingRenderer()
    report = Diagnostics(strict=True)
    sim = Simulation(made, report)
    cameras = mount_cameras(sim, lambda _: renderer)
    for one in cameras:
        one.start(sim)
    return sim, cameras, renderer


def watch(cameras: Sequence[CameraSensor]) -> None:
    for eye in cameras:
        eye.listen(lambda _: None)


def test_the_front_door_exports_in_order() -> None:
    assert sensors.__all__ == sorted(sensors.__all__)
    assert all(hasattr(sensors, name) for name in sensors.__all__)


def test_a_camera_nobody_looks_at_costs_nothing() -> None:
    sim, (eye,), renderer = mounted(camera())
    eye.listen(lambda _: pytest.fail("the listener is disabled"), enabled=lambda: False)
    strides: list[int] = []
    step = sim.engine.step

    def counted(count: int, each: Any) -> int:
        strides.append(count)
        return step(count, each)

    sim.engine.step = counted
    sim.run(1.0)
    assert (eye.reading_count, renderer.updates, renderer.views) == (0, [], [])
    assert strides == [1000]


def test_a_camera_that_is_always_on_counts_its_instants_and_draws_for_nobody() -> None:
    sim, (eye,), renderer = mounted(camera(always_on=True))
    eye.listen(lambda _: pytest.fail("the listener is disabled"), enabled=lambda: False)
    sim.run(1.0)
    assert (eye.reading_count, eye.image_count, renderer.updates, renderer.views) == (30, 0, [], [])


def test_pictures_of_a_camera_that_is_always_on_do_not_depend_on_when_somebody_began_to_look() -> None:
    """The same instants, with the same noise."""
    noisy = replace(OPTICS, noise=Noise(stddev=0.1))
    seen: list[list[tuple[int, bytes]]] = []
    for start_s in (0.0, 0.15):
        sim, (eye,), _ = mounted(camera(cameras=(noisy,), update_rate_hz=10.0, always_on=True))
        taken: list[tuple[int, bytes]] = []
        eye.listen(
            lambda reading, taken=taken: taken.append((reading.time_ns, reading.rgb.tobytes())),
            enabled=lambda sim=sim, start_s=start_s: sim.time_ns > start_s * 1e9,
        )
        sim.run(0.4)
        seen.append(taken)
    assert len(seen[0]) == 4
    assert seen[0][1:] == seen[1]


def test_thirty_a_second_are_three_hundred_in_ten_seconds_each_stamped_with_its_instant() -> None:
    sim, (eye,), renderer = mounted(camera())
    taken: list[CameraReading] = []
    eye.listen(taken.append)
    sim.run(10.0)
    assert len(taken) == eye.image_count == len(renderer.views) == 300
    period_ns = 1e9 / 30
    assert all(0 <= reading.time_ns - (i + 1) * period_ns < 1.001 * MS for i, reading in enumerate(taken))
    assert all(reading.time_ns % MS == 0 for reading in taken)
    assert taken[0].rgb.shape == (6, 8, 3)


def test_cameras_that_are_due_together_are_drawn_by_one_call_and_told_of_in_their_order() -> None:
    """The last one is due at every second time only, and the third has no listener."""
    rates = {"left": 10.0, "right": 10.0, "blind": 10.0, "slow": 5.0}
    sim, cameras, renderer = mounted(*(camera(name, update_rate_hz=rate) for name, rate in rates.items()))
    told: list[tuple[str, int]] = []
    for eye in cameras:
        note = partial(lambda name, reading: told.append((name, reading.time_ns // MS)), eye.name)
        eye.listen(note, enabled=partial(str.__ne__, eye.name, "blind"))
    sim.run(0.2)
    assert told == [("left", 100), ("right", 100), ("left", 200), ("right", 200), ("slow", 200)]
    assert renderer.calls == [2, 3]
    assert len(renderer.updates) == 2


def test_large_pictures_are_not_all_kept_at_once() -> None:
    """Three of two million pixels each: a call draws two."""
    large = replace(OPTICS, width_px=2048, height_px=1024)
    sim, cameras, renderer = mounted(*(camera(name, cameras=(large,)) for name in "abc"))
    watch(cameras)
    sim.run(0.04)
    assert renderer.calls == [2, 1]
    assert len(renderer.updates) == 1


def test_sizes_are_drawn_apart() -> None:
    wide = replace(OPTICS, width_px=9)
    kinds = {"a": OPTICS, "b": wide, "c": OPTICS}
    sim, cameras, renderer = mounted(*(camera(name, cameras=(each,)) for name, each in kinds.items()))
    watch(cameras)
    sim.run(0.04)
    assert renderer.calls == [2, 1]


def test_a_camera_that_is_asked_by_itself_draws_by_itself() -> None:
    sim, cameras, renderer = mounted(camera("left"), camera("right"))
    sim.step()
    for eye in cameras:
        eye.request(sim.snapshot())
    left, right = (eye.measure(sim.snapshot()) for eye in cameras)
    assert left.rgb.shape == right.rgb.shape == (6, 8, 3)
    assert renderer.calls == [1, 1]


def test_a_rate_of_zero_is_thirty() -> None:
    sim, (eye,), _ = mounted(camera(update_rate_hz=0.0, always_on=True))
    sim.run(1.0)
    assert eye.reading_count == 30


def test_a_camera_wakes_when_somebody_looks_and_sleeps_again() -> None:
    sim, (eye,), _ = mounted(camera(update_rate_hz=10.0))
    looking = [False]
    taken: list[int] = []
    eye.listen(lambda reading: taken.append(reading.time_ns // MS), enabled=lambda: looking[0])
    sim.run(1.0)
    looking[0] = True
    sim.run(0.3)
    looking[0] = False
    sim.run(1.0)
    assert taken == [1100, 1200, 1300]


def test_only_who_wants_a_picture_gets_it_and_it_is_taken_once() -> None:
    sim, (eye,), _ = mounted(camera(update_rate_hz=10.0))
    first: list[CameraReading] = []
    second: list[CameraReading] = []
    eye.listen(first.append)
    eye.listen(second.append)
    eye.listen(lambda _: pytest.fail("the listener is disabled"), enabled=lambda: False)
    sim.run(0.5)
    assert len(first) == eye.reading_count == 5
    assert all(a is b for a, b in zip(first, second, strict=True))


def test_the_camera_is_where_its_link_carries_it_at_that_instant() -> None:
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


def test_taking_pictures_does_not_change_the_world() -> None:
    ends = []
    for is_watched in (False, True):
        sim, cameras, _ = mounted(camera())
        if is_watched:
            watch(cameras)
        sim.run(1.0)
        ends.append(sim.snapshot())
    assert ends[0].poses.tobytes() == ends[1].poses.tobytes()


def test_all_cameras_share_one_renderer_and_a_world_without_makes_none() -> None:
    made: list[CountingRenderer] = []

    def make(_: Scene) -> CountingRenderer:
        made.append(CountingRenderer())
        return made[-1]

    assert [eye.name for eye in mount_cameras(Simulation(world(camera("a"), camera("b")), Diagnostics()), make)] == [
        "a",
        "b",
    ]
    assert len(made) == 1
    assert mount_cameras(Simulation(world(), Diagnostics()), make) == []
    assert len(made) == 1


def test_a_sensor_that_does_not_measure_yet_is_named() -> None:
    report = Diagnostics()
    odd = Sensor(name="nose", type="smell", at=AT)
    assert mount_cameras(Simulation(world(odd), report), lambda _: CountingRenderer()) == []
    assert report.warnings == ["robot.sdf:9: warning: sensor 'nose': smell sensors are not simulated yet"]
