"""4,096 RP2Ws and 4,096 differential robots on a GPU, and environments, against the CPU cores of the same machine.

Times are wall times; steps of all worlds count. Without a GPU the rows say so.
"""

import os
import statistics
import time
from pathlib import Path

import numpy as np

import trundle
from bench.table import Row
from trundle.assets import ASSETS
from trundle.gym import make_vec
from trundle.gym.ready_tasks import READY
from trundle.sim.physics import Batch, NoGpuError, find_gpu

_WORLDS = 4096
_STEPS = 100
_PAIRS = 5
_ENVIRONMENTS = (4096, 16384)
_ENVIRONMENT_PAIRS = 3
_ROBOTS = {
    "RP2W": (Path(__file__).parents[1] / "examples/rp2w", ("chassis_left_wheel", "chassis_right_wheel")),
    "differential robots": (
        ASSETS / "worlds/drive_to_goal.world",
        ("left_joint", "right_joint"),
    ),
}
_SPEED = 2.0
"""Speed of driven wheels [rad/s]."""


def run() -> list[Row]:
    """Alternate GPU and CPU."""
    try:
        gpu = find_gpu()
    except NoGpuError as error:
        return [Row(f"{_WORLDS:,} {name} on a GPU", None, f"no GPU here: {error}", "", None) for name in _ROBOTS]
    rows: list[Row] = []
    for name, (file, wheels) in _ROBOTS.items():
        batches = [_rolling_batch(file, wheels, device) for device in (gpu, None)]
        pairs = [[_rate(batch) for batch in batches] for _ in range(_PAIRS)]
        value = statistics.median(gpu_rate for gpu_rate, _ in pairs)
        ratio = statistics.median(gpu_rate / cpu_rate for gpu_rate, cpu_rate in pairs)
        peer = f"{os.cpu_count()} CPU cores"
        rows.append(Row(f"{_WORLDS:,} {name} on a GPU", value, "worlds × steps/s", peer, ratio))
    return rows + [_environments(worlds) for worlds in _ENVIRONMENTS]


def _environments(worlds: int) -> Row:
    """Measure the drive to a goal, with its lidar, rewards and resets."""
    file, task = READY["Trundle/DriveToGoal-v0"]
    cores = os.cpu_count() or 1
    both = [make_vec(file, num_envs=worlds, threads=cores, device=device, **task) for device in ("cuda", "cpu")]
    for envs in both:
        envs.reset(seed=0)
    both[0].action_space.seed(0)
    pairs: list[list[float]] = []
    for _ in range(1 + _ENVIRONMENT_PAIRS):
        actions, times = both[0].action_space.sample(), list[float]()
        for envs in both:
            start = time.perf_counter()
            envs.step(actions)
            times.append(time.perf_counter() - start)
        pairs.append(times)
    rate = worlds / statistics.median(gpu_s for gpu_s, _ in pairs[1:])
    ratio = statistics.median(cpu_s / gpu_s for gpu_s, cpu_s in pairs[1:])
    return Row(f"{worlds:,} environments on a GPU", rate, "environment steps/s", f"{cores} CPU cores", ratio)


def _rolling_batch(file: Path, wheels: tuple[str, str], device: str | None) -> Batch:
    sim = trundle.load(str(file))
    batch = sim.engine.batch(_WORLDS, threads=os.cpu_count() or 1, gpu=device)
    start = sim.engine.world_row()
    for row in range(_WORLDS):
        batch.write_row(row, start)
    names = sim.engine.compiled.joint_names
    for wheel in wheels:
        joint = next(i for i, name in enumerate(names) if name.endswith(f"::{wheel}"))
        (axis,) = sim.engine.compiled.joint_axes[joint]
        batch.command_velocity(axis, np.full(_WORLDS, _SPEED), 2.0)
    batch.step(_STEPS)
    return batch


def _rate(batch: Batch) -> float:
    start = time.perf_counter()
    batch.step(_STEPS)
    return _WORLDS * _STEPS / (time.perf_counter() - start)
