"""Batches of states step as the engine does, to the bit."""

import numpy as np
import pytest

import trundle
from trundle.spatial import Pose

ROBOT = """
<robot name="cart">
  <link name="base">
    <inertial><mass value="2"/><inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.3 0.2 0.1"/></geometry></collision>
  </link>
  <link name="arm">
    <inertial><origin xyz="0 0 0.2"/><mass value="0.5"/>
      <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 0 0.2"/><geometry><box size="0.05 0.05 0.4"/></geometry></collision>
  </link>
  <joint name="hinge" type="revolute">
    <origin xyz="0 0 0.05"/><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="1.5" effort="5" velocity="3"/>
  </joint>
</robot>
"""


@pytest.fixture(scope="module")
def robot(tmp_path_factory) -> str:
    file = tmp_path_factory.mktemp("batch") / "cart.urdf"
    file.write_text(ROBOT)
    return str(file)


def _command(handle, batch, kind: str, axis: int, values: np.ndarray, row: int) -> None:
    value = float(values[row])
    if kind == "effort":
        batch.command_effort(axis, values)
        handle.command_effort(value)
    elif kind == "velocity":
        batch.command_velocity(axis, values, 4.0)
        handle.command_velocity(value, max_effort=4.0)
    else:
        batch.command_position(axis, values, np.inf)
        handle.command_position(value)


@pytest.mark.parametrize("kind", ["effort", "velocity", "position"])
@pytest.mark.parametrize("threads", [1, 3])
def test_each_row_equals_the_simulation(robot, kind, threads) -> None:
    sims = [trundle.load(robot) for _ in range(4)]
    batch = sims[0].engine.batch(4, threads=threads)
    for row, sim in enumerate(sims):
        sim["cart"].set_pose(Pose((0.0, 0.0, 0.3 * row)))
        batch.write_row(row, sim.engine.world_row())
    axis = sims[0]["cart"].joint("hinge").axes[0]
    random = np.random.default_rng(0)
    for _ in range(20):
        values = random.uniform(-2.0, 2.0, 4)
        for row, sim in enumerate(sims):
            _command(sim["cart"].joint("hinge"), batch, kind, axis, values, row)
        batch.step(20)
        for sim in sims:
            sim.step(20)

    for row, sim in enumerate(sims):
        assert batch.poses[row].tolist() == sim.engine.reader.link_poses().tolist()
        assert batch.twists[row].tolist() == sim.engine.reader.link_twists().tolist()
        assert batch.positions([axis])[row].tolist() == sim["cart"].joint_positions.tolist()
        assert batch.velocities([axis])[row].tolist() == sim["cart"].joint_velocities.tolist()
        assert batch.time_s[row] == pytest.approx(sim.time_ns / 1e9)
    assert not batch.unstable.any()


def test_an_unstable_row_keeps_its_state_and_does_not_affect_others(robot) -> None:
    sim = trundle.load(robot)
    batch = sim.engine.batch(2, threads=1)
    for row in range(2):
        batch.write_row(row, sim.engine.world_row())
    batch.states[0, 10] = np.nan
    before = batch.states[0].copy()

    batch.step(10)

    assert batch.unstable.tolist() == [True, False]
    assert np.array_equal(batch.states[0], before, equal_nan=True)
    assert batch.time_s[1] == pytest.approx(0.01)


def test_rows_that_are_not_chosen_keep_their_state(robot) -> None:
    sim = trundle.load(robot)
    batch = sim.engine.batch(2, threads=2)
    for row in range(2):
        batch.write_row(row, sim.engine.world_row())

    batch.step(10, chosen=np.array([False, True]))

    assert batch.time_s.tolist() == [0.0, pytest.approx(0.01)]


def test_rows_are_written_at_once_as_one_by_one(robot) -> None:
    sim = trundle.load(robot)
    start = sim.engine.world_row()
    sim["cart"].set_pose(Pose((1.0, 0.0, 0.5)))
    moved = sim.engine.world_row()
    single, together = (sim.engine.batch(3, threads=2) for _ in range(2))
    single.write_row(2, moved)
    single.write_row(0, start)

    together.write_rows([2, 0], [moved, start])

    assert np.array_equal(together.states, single.states)
    assert np.array_equal(together.poses, single.poses)
    assert together.poses[2, 0, :3].tolist() == [1.0, 0.0, 0.5]
    assert not together.poses[1].any()
