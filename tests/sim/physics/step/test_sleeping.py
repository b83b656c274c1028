"""Sleeping bodies cost nothing, change nothing, and wake when they are moved."""

import math
from collections.abc import Callable
from pathlib import Path

import mujoco
import numpy as np
import pytest

import trundle
from trundle.sim.physics.step.sleeping import DECISION_PERIOD
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose, Twist, Wrench

Load = Callable[..., Simulation]
FLOOR = (
    '<model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane>'
    "<normal>0 0 1</normal></plane></geometry></collision></link></model>"
)
INERTIA = (
    "<inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz>"
    "</inertia></inertial>"
)


def box(name: str, pose: str, *, sleeps: bool = True, mu: float = 1.0, extra: str = "") -> str:
    return (
        f'<model name="{name}"><allow_auto_disable>{sleeps}</allow_auto_disable><pose>{pose}</pose>'
        f'<link name="l">{INERTIA}<collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry>'
        f"<surface><friction><ode><mu>{mu}</mu><mu2>{mu}</mu2></ode></friction></surface></collision></link>{extra}"
        "</model>"
    )


ARM = (
    f'<link name="arm"><pose>0 0 0.1 0 0 0</pose>{INERTIA}</link><joint name="j" type="revolute"><parent>l</parent>'
    "<child>arm</child><axis><xyz>0 0 1</xyz></axis></joint>"
)


@pytest.fixture
def load(tmp_path: Path) -> Load:
    """Load models on a floor."""

    def load(*models: str, floor: str = FLOOR) -> Simulation:
        file = tmp_path / "w.world"
        file.write_text(f'<sdf version="1.6"><world name="w">{floor}{"".join(models)}</world></sdf>')
        return trundle.load(str(file))

    return load


def asleep(load: Load, *models: str) -> Simulation:
    sim = load(*models)
    sim.run(2.0)
    assert sim.engine.asleep == len(models)
    return sim


def test_sleeping_does_not_change_the_results(load: Load) -> None:
    ends: list[list[float]] = []
    for sleeps in (True, False):
        pile = [box(f"b{i}", f"0 0 {0.1 + 0.2 * i} 0 0 {0.1 * i}", sleeps=sleeps) for i in range(5)]
        sim = load(*pile)
        sim.run(10.0)
        assert sim.engine.asleep == (5 if sleeps else 0)
        ends.append(sim.snapshot().poses.ravel().tolist())
    assert ends[0] == pytest.approx(ends[1], abs=1e-6)


def test_a_push_wakes_a_sleeping_body(load: Load) -> None:
    sim = asleep(load, box("b", "0 0 0.1 0 0 0", mu=0.0))
    sim["b"].apply_wrench(Wrench(force=(1.0, 0.0, 0.0)))
    sim.run(0.5)
    assert sim["b"].pose.position[0] == pytest.approx(0.125, rel=0.01)


def test_a_new_joint_command_wakes_and_its_repetition_does_not(load: Load) -> None:
    sim = asleep(load, box("b", "0 0 0.1 0 0 0", extra=ARM))
    joint = sim["b"].joint("j")
    joint.command_position(0.5)
    sim.run(0.5)
    assert 0.1 < joint.position < 0.5
    sim.run(8.0)
    assert joint.position == pytest.approx(0.5, abs=1e-4)
    assert sim.engine.asleep == 1
    joint.command_position(0.5)
    sim.step(2)
    assert sim.engine.asleep == 1
    joint.command_velocity(1.0)
    sim.run(0.2)
    assert joint.velocity == pytest.approx(1.0, rel=0.01)


def test_a_teleported_body_falls_from_its_new_pose(load: Load) -> None:
    sim = asleep(load, box("b", "0 0 0.1 0 0 0"), box("c", "3 0 0.1 0 0 0"))
    sim["b"].set_pose(Pose((0.0, 0.0, 1.1)))
    sim["c"].set_twist(Twist(linear=(0.0, 0.0, 2.0)))
    sim.run(0.2)
    assert sim["b"].pose.position[2] == pytest.approx(1.1 - 9.8 * 0.02, abs=0.01)
    assert sim["c"].pose.position[2] == pytest.approx(0.1 + 2.0 * 0.2 - 9.8 * 0.02, abs=0.01)


def test_a_hit_wakes_a_body_and_the_body_it_leans_on(load: Load) -> None:
    sim = asleep(load, box("low", "0 0 0.1 0 0 0"), box("high", "0 0 0.3 0 0 0"), box("ram", "-1 0 0.1 0 0 0", mu=0.0))
    sim["ram"].set_twist(Twist(linear=(3.0, 0.0, 0.0)))
    sim.run(1.0)
    assert sim["low"].pose.position[0] > 0.05
    assert math.dist(sim["high"].pose.position, (0.0, 0.0, 0.3)) > 0.01


def test_a_body_about_to_slide_never_sleeps(load: Load) -> None:
    tilt, mu = 0.35, 0.999 * math.tan(0.35)
    slope = FLOOR.replace("<static>", f"<pose>0 0 0 0 {tilt} 0</pose><static>")
    x, z = 0.1 * math.sin(tilt), 0.1 * math.cos(tilt)
    sim = load(box("b", f"{x} 0 {z} 0 {tilt} 0", mu=mu), floor=slope)
    sim.run(2.0)  # it settles with a jerk
    positions: list[float] = []
    for _ in range(3):
        positions.append(sim["b"].pose.position[0] / math.cos(tilt))
        sim.run(1.0)
    first, second, third = positions
    assert third - 2 * second + first == pytest.approx(9.8 * 0.001 * math.sin(tilt), rel=0.01)


def test_a_state_saved_asleep_continues_equally_to_the_bit(load: Load) -> None:
    sim = asleep(load, box("b", "0 0 0.1 0 0 0"), box("c", "0 0 0.3 0 0 0"))
    saved = sim.save()
    ends: list[bytes] = []
    for _ in range(2):
        sim.restore(saved)
        sim.run(0.3)
        sim["c"].apply_wrench(Wrench(force=(5.0, 0.0, 0.0)))
        sim.run(0.7)
        ends.append(sim.snapshot().poses.tobytes())
        sim["c"].apply_wrench(Wrench())
    assert ends[0] == ends[1]


def test_a_world_asleep_as_a_whole_is_not_stepped_and_continues_to_the_bit(
    load: Load, monkeypatch: pytest.MonkeyPatch
) -> None:
    sim = asleep(load, box("b", "0 0 0.1 0 0 0"), box("c", "0 0 0.3 0 0 0", extra=ARM))
    saved, steps, whole = sim.save(), 3 * DECISION_PERIOD, mujoco.mj_step
    ends: list[bytes] = []
    for at_once in (steps, 1):
        step_counts: list[int] = []

        def counted(
            model: mujoco.MjModel, data: mujoco.MjData, nstep: int = 1, step_counts: list[int] = step_counts
        ) -> None:
            step_counts.append(nstep)
            whole(model, data, nstep=nstep)

        monkeypatch.setattr(mujoco, "mj_step", counted)
        sim.restore(saved)
        for _ in range(steps // at_once):
            sim.step(at_once)
        assert sum(step_counts) < 10 if at_once > 1 else sum(step_counts) == steps
        sim["c"].joint("j").command_velocity(1.0)
        sim.step(300)
        data = sim.engine.save().data
        ends.append(np.array([data.time, *data.qpos, *data.qvel]).tobytes())
        sim["c"].joint("j").command_effort(0.0)
    assert ends[0] == ends[1]
    assert sim.time_ns == (2000 + steps + 300) * 1_000_000


def test_sleeping_bodies_have_contacts(load: Load) -> None:
    sim = asleep(load, box("b", "0 0 0.1 0 0 0"))
    before = sim.snapshot().poses.tobytes()
    contacts = sim.contacts()
    assert sum(abs(contact.force.force[2]) for contact in contacts) == pytest.approx(9.8, rel=1e-3)
    assert sim.engine.asleep == 1
    assert sim.snapshot().poses.tobytes() == before


def test_sleeping_is_enabled_only_if_half_of_the_world_is_at_rest(load: Load) -> None:
    """A box that slides straight moves in one of six degrees of freedom, and is not at rest in the other five."""
    sliding = [box(f"s{i}", f"0 {i} 0.1 0 0 0", mu=0.0) for i in range(3)]
    resting = [box(f"b{i}", f"5 {i} 0.1 0 0 0") for i in range(3)]
    rests: list[bool] = []
    for models in (sliding, [*sliding, *resting]):
        sim = load(*models)
        for i in range(3):
            sim[f"s{i}"].set_twist(Twist((1.0, 0.0, 0.0)))
        sim.run(2.0)
        rests.append(sim.engine.asleep > 0)
    assert rests == [False, True]


@pytest.mark.parametrize("drive", ["velocity", "position"])
def test_a_sleeping_motor_that_presses_reports_its_effort(load: Load, drive: str) -> None:
    """A slider stopped by a wall, alone and next to resting bodies."""
    slide = (
        '<joint name="j" type="prismatic"><parent>world</parent><child>l</child><axis><xyz>1 0 0</xyz></axis></joint>'
    )
    wall = '<model name="wall"><static>true</static><pose>0.5 0 1 0 0 0</pose><link name="l"><collision name="c">'
    wall += "<geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link></model>"
    for others in (wall, wall + box("b", "5 5 0.1 0 0 0") + box("c", "7 5 0.1 0 0 0")):
        sim = load(box("slider", "0 0 1 0 0 0", extra=slide), others)
        joint = sim["slider"].joint("j")
        if drive == "velocity":
            joint.command_velocity(0.5, max_effort=20.0)
        else:
            joint.command_position(0.9, max_effort=20.0)
        sim.run(4.0)

        assert sim.engine.asleep >= 1
        assert joint.effort == pytest.approx(20.0, rel=1e-6)
        assert sim.snapshot().joint_efforts[0] == pytest.approx(20.0, rel=1e-6)


def test_a_world_where_nothing_may_sleep_is_stepped_without_islands(load: Load) -> None:
    """They would cost it a tenth of its speed, and save nothing."""
    sim = load(box("a", "0 0 0.1 0 0 0", sleeps=False))

    sim.run(2.0)

    assert not sim.engine.compiled.model.opt.enableflags & int(mujoco.mjtEnableBit.mjENBL_SLEEP)
