"""Profile of a simulation, with a wall clock that only its parts advance."""

import time
from pathlib import Path

import pytest
from tests.page.simulated_world.worlds import BOX, CAMERA, loaded, model

import trundle
from trundle.page.profile.stride_profile import StrideProfile
from trundle.page.world.profile import Profile
from trundle.ros import GraphLoop
from trundle.sim.simulation import Simulation, Snapshot

MS = 1_000_000
FALLING = model(
    "box", "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision>", static=False
)
GROUND = """<model name="ground"><static>1</static><link name="l"><collision name="c"><geometry>
<plane><normal>0 0 1</normal></plane></geometry></collision></link></model>"""


class Clock:
    """Wall clock that tests advance."""

    now_ns = 0

    def __call__(self) -> int:
        return self.now_ns


class Work:
    """Hook that takes 2 ms before and 3 ms after a step."""

    def __init__(self, clock: Clock) -> None:
        self._clock = clock

    def before_step(self, sim: Simulation, /) -> None:
        del sim
        self._clock.now_ns += 2 * MS

    def after_step(self, snapshot: Snapshot, /) -> None:
        del snapshot
        self._clock.now_ns += 3 * MS


class Publishes(Work):
    """Hook that also publishes for 5 ms."""

    def __init__(self, clock: Clock, loop: GraphLoop) -> None:
        super().__init__(clock)
        self._loop = loop

    def after_step(self, snapshot: Snapshot, /) -> None:
        super().after_step(snapshot)
        assert self._loop.publish_timer is not None
        with self._loop.publish_timer():
            self._clock.now_ns += 5 * MS


@pytest.fixture
def clock() -> Clock:
    return Clock()


def times_ms(profile: Profile) -> dict[str, float]:
    """Return nonzero wall times [ms] by group and name."""
    return {f"{part.group}: {part.name}": part.wall_s * 1e3 for part in profile.parts if part.wall_s > 0}


def test_each_hook_gets_its_own_time(tmp_path: Path, clock: Clock) -> None:
    sim, _ = loaded(tmp_path, FALLING)
    sim.add_hook(Work(clock), period_ns=100 * MS, name="mine")
    sim.add_hook(Work(clock), period_ns=500 * MS)
    profile = StrideProfile(sim, None, wall_ns=clock)
    profile.start()

    sim.run(1.0)
    read = profile.read()

    assert times_ms(read) == pytest.approx({"other: mine": 10 * 2 + 10 * 3, "other: Work": 2 * 2 + 2 * 3})
    assert (read.wall_s, read.simulated_s, read.steps, read.bodies) == (pytest.approx(0.06), 1.0, 1000, 1)
    assert read.real_time_factor == pytest.approx(1 / 0.06)
    assert "    50.000  other    mine" in str(read)


def test_commands_count_as_callbacks_and_time_between_strides_as_waiting(tmp_path: Path, clock: Clock) -> None:
    sim, _ = loaded(tmp_path, FALLING)
    profile = StrideProfile(sim, None, wall_ns=clock)
    profile.start()
    clock.now_ns += 7 * MS
    sim.post(lambda _: Work(clock).before_step(sim))

    sim.run(0.1)

    assert times_ms(profile.read()) == pytest.approx({"waiting: Waiting": 7, "ros: Callbacks of messages": 2})


def test_sensors_are_named_without_the_time_of_their_listeners(tmp_path: Path, clock: Clock) -> None:
    imu = '<sensor name="imu" type="imu"><update_rate>10</update_rate></sensor>'
    sim, (camera, sensor) = loaded(tmp_path, model("m", BOX + CAMERA + imu))
    camera.listen(list[object]().append)
    sensor.listen(Work(clock).after_step)
    with StrideProfile(sim, None) as profile:  # with the real wall clock: drawing takes time
        sim.run(1.0)
    parts = {(part.group, part.name): part.wall_s for part in profile.read().parts}
    assert parts["cameras", "m::l::cam"] > 0
    assert parts["sensors", "m::l::imu"] > 0

    with StrideProfile(sim, None, wall_ns=clock) as profile:
        sim.run(1.0)
    assert times_ms(profile.read()) == pytest.approx({"ros: Readings sent": 30})


def test_cameras_drawn_together_share_the_time_equally(tmp_path: Path, clock: Clock) -> None:
    sim, _ = loaded(tmp_path, FALLING)
    profile = StrideProfile(sim, None, wall_ns=clock)
    profile.start()
    one, other = Work(clock), Work(clock)
    sim.add_hook(one, period_ns=10 * MS, name="one")
    sim.add_hook(other, period_ns=10 * MS, name="other")
    clock.now_ns += 8 * MS

    profile.lap(one, other)

    assert times_ms(profile.read()) == pytest.approx({"other: one": 4, "other: other": 4})


def test_physics_is_split_by_mujocos_timers(tmp_path: Path) -> None:
    """A box at rest on the ground needs collision detection and constraints."""
    sim, _ = loaded(tmp_path, GROUND + FALLING.replace("<link", "<pose>0 0 0.5 0 0 0</pose><link"))
    with StrideProfile(sim, None) as profile:
        sim.run(0.1)
        sim.run(0.1)
    read = profile.read()

    physics = {part.name: part.wall_s for part in read.parts if part.group == "physics"}
    assert sorted(physics) == ["Collision detection", "Constraint solver", "Dynamics"]
    assert min(physics.values()) > 0
    assert read.contacts == 4
    assert sum(part.wall_s for part in read.parts) == pytest.approx(read.wall_s)


def test_publishing_time_is_not_counted_as_the_plugins(tmp_path: Path, clock: Clock) -> None:
    sim, _ = loaded(tmp_path, FALLING)
    with GraphLoop() as loop:
        sim.add_hook(Publishes(clock, loop), period_ns=500 * MS, name="plugin")
        with StrideProfile(sim, loop, wall_ns=clock) as profile:
            sim.run(1.0)

        assert times_ms(profile.read()) == pytest.approx({"other: plugin": 10, "ros: Messages of plugins": 10})
        assert loop.publish_timer is None
    assert sim.profiler is None


def test_parts_of_a_renamed_model_have_the_new_name(tmp_path: Path, clock: Clock) -> None:
    imu = '<sensor name="imu" type="imu"><update_rate>10</update_rate></sensor>'
    sim, (camera, _) = loaded(tmp_path, model("m", BOX + CAMERA + imu) + model("mm", BOX))
    camera.listen(list[object]().append)
    sim.add_hook(Work(clock), period_ns=100 * MS, name="mm::mine")
    sim.rename("m", "cart")

    with StrideProfile(sim, None) as profile:
        sim.run(0.5)

    names = {part.name for part in profile.read().parts if "::" in part.name}
    assert names >= {"cart::l::cam", "mm::mine"}
    assert not any(name.startswith("m::") for name in names)


def test_the_graphs_thread_is_measured_in_parallel(tmp_path: Path, clock: Clock) -> None:
    sim, _ = loaded(tmp_path, FALLING)
    with GraphLoop() as loop, StrideProfile(sim, loop, wall_ns=clock) as profile:
        loop.run(_busy(0.02))
        sim.run(0.1)
        read = profile.read()

    assert read.graph_s is not None
    assert read.graph_s >= 0.02
    assert "parallel graph's thread" in str(read)


async def _busy(seconds: float) -> None:
    """Compute for a duration of processor time."""
    end = time.thread_time() + seconds
    while time.thread_time() < end:
        pass


def test_the_python_api_has_the_profile_of_a_run(tmp_path: Path) -> None:
    (tmp_path / "w.sdf").write_text(f'<sdf version="1.6"><world name="w">{FALLING}</world></sdf>')
    sim = trundle.load(str(tmp_path / "w.sdf"))

    with sim.profile() as profile:
        sim.run(0.5)
    read = profile.read()

    assert read.simulated_s == 0.5
    assert {part.group for part in read.parts} >= {"physics", "other"}
