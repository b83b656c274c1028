"""Actors on their trajectories."""

import math
from pathlib import Path

import pytest

import trundle
from trundle.base.diagnostics import Source
from trundle.robots.model import Actor, Trajectory, Waypoint
from trundle.sim.simulation import Simulation
from trundle.sim.simulation.actor_script import ActorScript
from trundle.spatial import Pose

SQUARE = ((0, 0), (2, 0), (2, 2), (0, 2), (0, 0))


def points(xy: tuple[tuple[float, float], ...], *, every: float = 1.0) -> tuple[Waypoint, ...]:
    return tuple(Waypoint(time_s=i * every, pose=Pose((x, y, 0.0))) for i, (x, y) in enumerate(xy))


def actor(*trajectories: Trajectory, loop: bool = True, delay: float = 0.0) -> Actor:
    return Actor(name="a", at=Source("t"), trajectories=trajectories, loop=loop, delay_start_s=delay)


def test_a_path_passes_its_waypoints_smoothly() -> None:
    script = ActorScript(actor(Trajectory(id=0, type="w", waypoints=points(SQUARE))))

    for i, (x, y) in enumerate(SQUARE[:-1]):
        assert script.pose_at(float(i)).position == pytest.approx((x, y, 0))
    # A Catmull-Rom spline round a square bulges by an eighth of the neighbours' difference at each side's middle.
    assert script.pose_at(0.5).position == pytest.approx((1.0, -0.25, 0.0))
    before, after = script.twist_at(1.0 - 1e-6, 1e-6), script.twist_at(1.0, 1e-6)
    assert before.linear == pytest.approx(after.linear, abs=1e-4)
    assert before.linear == pytest.approx((1.0, 1.0, 0.0), abs=1e-4)


def test_full_tension_makes_a_path_straight() -> None:
    script = ActorScript(actor(Trajectory(id=0, type="w", tension=1.0, waypoints=points(SQUARE))))

    assert script.pose_at(0.5).position == pytest.approx((1.0, 0.0, 0.0))
    assert script.pose_at(1.25).position[0] == pytest.approx(2.0)


def test_loops_start_after_their_delay_and_a_single_round_stays_at_its_end() -> None:
    out = Trajectory(id=0, type="w", waypoints=points(((0, 0), (1, 0))))
    back = Trajectory(id=1, type="w", waypoints=points(((1, 0), (1, 3)), every=2.0))
    looped, single = (ActorScript(actor(out, back, loop=loop, delay=1.0)) for loop in (True, False))

    assert looped.length_s == 3.0
    for script in (looped, single):
        assert script.pose_at(0.9).position == (0, 0, 0)
        assert script.pose_at(1.5).position == pytest.approx((0.5, 0, 0))
        assert script.pose_at(3.0).position == pytest.approx((1, 1.5, 0))
    assert looped.pose_at(5.5).position == pytest.approx((0.5, 0, 0))
    assert looped.twist_at(3.99, 0.02).linear == (0, 0, 0), "no jump back at 150 m/s"
    assert single.pose_at(9.0).position == pytest.approx((1, 3, 0))


def test_orientations_turn_the_shorter_way() -> None:
    turns = (Pose.from_rpy(0, 0, 0, 0, 0, 3.0), Pose.from_rpy(0, 0, 0, 0, 0, -3.0))
    waypoints = tuple(Waypoint(time_s=float(i), pose=pose) for i, pose in enumerate(turns))
    script = ActorScript(actor(Trajectory(id=0, type="w", waypoints=waypoints), loop=False))

    assert abs(script.pose_at(0.5).rpy[2]) == pytest.approx(math.pi)
    assert script.twist_at(0.2, 0.1).angular[2] == pytest.approx(2 * math.pi - 6)


WORLD = """<sdf version="1.6"><world name="w"><gravity>0 0 -9.8</gravity><actor name="box"><link name="l">
<visual name="v">
<geometry><box><size>.2 .2 .2</size></box></geometry></visual></link><script><trajectory id="0" type="square">
<waypoint><time>0</time><pose>-1 0 1 0 0 0</pose></waypoint><waypoint><time>2</time><pose>3 0 1 0 0 1</pose></waypoint>
</trajectory></script></actor><actor name="walker"><pose>0 0 1.2138 1.5707 0 0</pose><skin><filename>none.dae</filename>
</skin>{plugin}</actor><model name="m"><static>1</static><pose>0 5 0 0 0 0</pose><link name="l"/></model></world>
</sdf>"""


@pytest.fixture
def sim(tmp_path: Path) -> Simulation:
    file = tmp_path / "w.sdf"
    file.write_text(WORLD.format(plugin=""))
    return trundle.load(str(file))


def test_an_actor_is_a_model_that_follows_its_script_again_after_a_reset(sim: Simulation) -> None:
    assert [model.name for model in sim.models] == ["m", "box", "walker"]
    box = sim["box"]
    for _ in range(2):
        assert box.pose.position == pytest.approx((-1, 0, 1))
        sim.run(1.0)
        assert box.pose.position == pytest.approx((1, 0, 1), abs=1e-3)
        assert box.pose.rpy[2] == pytest.approx(0.5, abs=1e-3)
        # In the middle of a straight segment the speed is one and a half times the mean.
        assert box.base.twist.linear[0] == pytest.approx(1.25 * 2.0, rel=0.03)
        sim.reset()
    assert sim["walker"].pose.position == (0, 0, 1.2138)
    sim.delete("box")
    sim.run(0.1)


def test_a_second_simulation_of_a_world_adds_no_actor_twice(sim: Simulation) -> None:
    again = Simulation(sim.world, sim.report)

    assert [model.name for model in again.models] == ["m", "box", "walker"]
    again.run(1.0)
    assert again["box"].pose.position[0] == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize(
    ("script", "at"),
    [
        ("", {1.0: 0.0, 1.99: 1.0, 3.0: 0.0}),
        ("<loop>false</loop>", {1.0: 0.0, 2.5: 1.0}),
        ("<delay_start>1</delay_start>", {0.9: -1.0, 2.0: 0.0, 3.5: -1.0, 5.0: 0.0}),
        ("<auto_start>false</auto_start>", {1.5: 7.0}),
    ],
)
def test_auto_start_loop_and_delay_are_read_from_the_file(tmp_path: Path, script: str, at: dict[float, float]) -> None:
    """From −1 to 1 m in two seconds."""
    points = "".join(f"<waypoint><time>{t}</time><pose>{t - 1} 0 0 0 0 0</pose></waypoint>" for t in (0, 1, 2))
    file = tmp_path / "w.sdf"
    file.write_text(
        '<sdf version="1.6"><world name="w"><actor name="a"><pose>7 0 0 0 0 0</pose><link name="l"/>'
        f'<script>{script}<trajectory id="0" type="w">{points}</trajectory></script></actor></world></sdf>'
    )
    sim = trundle.load(str(file))
    for time_s, x in at.items():
        sim.advance(round(time_s * 1e9))
        assert sim["a"].pose.position[0] == pytest.approx(x, abs=0.02)
