"""Stepping the RP2W: cost of the simulation against the engine's bare loop on the same compiled model.

Times are CPU times of all threads of this process, which vary least with other programs' load.
"""

import contextlib
import io
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import mujoco

import trundle
from bench.table import Row
from trundle.live.run.run_options import RunOptions
from trundle.live.run.run_world import run as launch_run

ROBOT = Path(__file__).parents[1] / "examples/rp2w"
PUBLISHED = ROBOT.parents[2] / "shared/seeds/rp2w"
_STEPS = 20_000
_COMMAND_STEPS = 10 * _STEPS
"""Steps of a `trundle run`: more, because the start time that `command_rate` subtracts varies."""
_PAIRS = 7


def run() -> list[Row]:
    """Alternate simulation and peer, so that a varying machine speed affects both equally."""
    sim = trundle.load(str(ROBOT))
    model = sim.engine.compiled.model
    bare = mujoco.MjData(model)

    def step_simulation() -> None:
        sim.step(_STEPS)

    def step_in_loop() -> None:
        for _ in range(_STEPS):
            mujoco.mj_step(model, bare)

    def step_in_one_call() -> None:
        mujoco.mj_step(model, bare, nstep=_STEPS)

    def command_rate(robot: Path) -> float:
        """Return the rate of `trundle run --headless --speed max --no-sensors` with a ROS graph, without the start."""
        return _COMMAND_STEPS / (_cost(robot, 1.0 + _COMMAND_STEPS / 1000) - _cost(robot, 1.0))

    rows: list[Row] = []
    commands = {"trundle run, RP2W with its Python plugin at 50 Hz": ROBOT}
    if PUBLISHED.is_dir():
        commands = {"trundle run, RP2W as published": PUBLISHED, **commands}
    for name, robot in commands.items():
        pairs = [(command_rate(robot), _rate(step_in_loop)) for _ in range(_PAIRS)]
        value = statistics.median(a for a, _ in pairs)
        rows.append(Row(name, value, "steps/s", "mj_step in a loop", statistics.median(a / b for a, b in pairs)))
    for name, peer in (("mj_step in a loop", step_in_loop), ("mj_step(nstep=…)", step_in_one_call)):
        pairs = [(_rate(step_simulation), _rate(peer)) for _ in range(_PAIRS)]
        value = statistics.median(a for a, _ in pairs)
        ratio = statistics.median(a / b for a, b in pairs)
        rows.append(Row("RP2W at rest, no cameras", value, "steps/s", name, ratio))
    return rows


def _cost(robot: Path, duration_s: float) -> float:
    """Return the CPU time of a run [s]."""
    start = time.process_time()
    options = RunOptions(headless=True, speed=None, sensors=False, duration_s=duration_s)
    with contextlib.redirect_stderr(io.StringIO()):
        launch_run(str(robot), options, {"HOME": str(Path.home())})
    return time.process_time() - start


def _rate(work: Callable[[], None]) -> float:
    start = time.process_time()
    work()
    return _STEPS / (time.process_time() - start)
