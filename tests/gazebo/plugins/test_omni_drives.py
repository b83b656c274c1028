"""Planar drive plugins with random parameters, compared with the exact motion of a body with the commanded twist."""

import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.gazebo.plugins.plugin_world import FakeNode, load

from trundle.sim.simulation import Simulation

SECONDS = 2.0


def _driven(folder: Path, rng: np.random.Generator, plugin: str) -> tuple[Simulation, tuple[float, float, float]]:
    """Return a robot after two seconds of a random command from a random pose, and the command."""
    mass, moment = 10 ** rng.uniform(0, 2.5), 10 ** rng.uniform(-1, 1)
    moments = "".join(f"<i{axis}>{moment}</i{axis}>" for axis in ("xx", "yy", "zz"))
    inertial = f"<inertial><mass>{mass}</mass><inertia>{moments}</inertia></inertial>"
    body = (
        f'<pose>{rng.uniform(-9, 9)} {rng.uniform(-9, 9)} 1 0 0 {rng.uniform(-3, 3)}</pose><link name="base_footprint">'
    )
    node: Any = FakeNode()
    node.clock = SimpleNamespace(now_ns=lambda: sim.time_ns)
    sim = load(folder, f"{body}{inertial}</link>{plugin}", node=node)
    x, y, yaw_rate = (float(value) for value in rng.uniform((-2, -2, -3), (2, 2, 3)))
    node.receive("/cmd_vel", linear={"x": x, "y": y}, angular={"z": yaw_rate})
    sim.run(SECONDS)
    return sim, (x, y, yaw_rate)


@pytest.mark.parametrize("seed", range(4))
def test_planar_move_drives_arcs(tmp_path: Path, seed: int) -> None:
    rng = np.random.default_rng(seed)
    sim, (x, y, yaw_rate) = _driven(tmp_path, rng, '<plugin name="p" filename="libgazebo_ros_planar_move.so"/>')
    start, end_pose = sim.world.models[0].world_from_model, sim["m"].pose
    along, across = math.sin(yaw_rate * SECONDS) / yaw_rate, (1.0 - math.cos(yaw_rate * SECONDS)) / yaw_rate
    end = start.transform_point((along * x - across * y, across * x + along * y, 0.0))
    assert end_pose.position == pytest.approx(end, abs=2e-3 * math.hypot(x, y) * SECONDS)
    assert math.remainder(end_pose.rpy[2] - start.rpy[2] - yaw_rate * SECONDS, math.tau) == pytest.approx(0.0, abs=1e-4)


@pytest.mark.parametrize("seed", range(4))
def test_force_based_move_follows_the_command_with_its_gains(tmp_path: Path, seed: int) -> None:
    """m (v' + ω × v) = gain (command − v), for gains up to a third of the stability limit of the time step."""
    rng = np.random.default_rng(seed)
    state = rng.bit_generator.state
    mass, moment = 10 ** rng.uniform(0, 2.5), 10 ** rng.uniform(-1, 1)
    rng.bit_generator.state = state
    rates = 10 ** np.random.default_rng(seed + 100).uniform(0, 2, 3)
    gains = rates * (mass, mass, moment)
    tags = "".join(
        f"<{name}_velocity_p_gain>{gain}</{name}_velocity_p_gain>"
        for name, gain in zip(("x", "y", "yaw"), gains, strict=True)
    )
    plugin = f'<plugin name="p" filename="libgazebo_ros_force_based_move.so">{tags}</plugin>'
    sim, command = _driven(tmp_path, rng, plugin)
    start, end_pose = sim.world.models[0].world_from_model, sim["m"].pose

    def motion(_time: float, state: Any) -> Any:
        yaw, vx, vy, yaw_rate = state[2:]
        ax, ay, aw = rates * (np.array(command) - (vx, vy, yaw_rate))
        forward, left = math.cos(yaw) * vx - math.sin(yaw) * vy, math.sin(yaw) * vx + math.cos(yaw) * vy
        return forward, left, yaw_rate, ax + yaw_rate * vy, ay - yaw_rate * vx, aw

    truth = solve_ivp(motion, (0.0, SECONDS), np.zeros(6), method="DOP853", rtol=1e-9, atol=1e-10).y[:, -1]
    end = start.transform_point((float(truth[0]), float(truth[1]), 0.0))
    assert end_pose.position == pytest.approx(end, abs=5e-3)
    assert math.remainder(end_pose.rpy[2] - start.rpy[2] - truth[2], math.tau) == pytest.approx(0.0, abs=5e-3)
