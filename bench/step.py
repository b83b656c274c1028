"""Stepping the RP2W: cost of the simulation over the engine's bare loop on the same compiled model.

Times are of this process' CPU, all its threads together, which others on the machine change least.
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
"""Longer, as the time of starting is taken off and it varies."""
_PAIRS = 7


def run() -> list[Row]:
    """Alternate the two, so that both see the machine at its fast and slow moments."""
    sim = trundle.load(str(ROBOT))
    model = sim.engine.compiled.model
    bare = mujoco.MjData(model)

    def ours() -> None:
        sim.step(_STEPS)

    def one_by_one() -> None:
        for _ in range(_STEPS):
            mujoco.mj_step(model, bare)

    def in_one_call() -> None:
        mujoco.mj_step(model, bare, nstep=_STEPS)

    def as_the_command(robot: Path) -> float:
        """`trundle run --headless --speed max --no-sensors`, ROS graph on; less the time of starting."""
        return _COMMAND_STEPS / (_cost(robot, 1.0 + _COMMAND_STEPS / 1000) - _cost(robot, 1.0))

    rows: list[Row] = []
    commands = {"trundle run, RP2W with its Python plugin at 50 Hz": ROBOT}
    if PUBLISHED.is_dir():
        commands = {"trundle run, RP2W as published": PUBLISHED, **commands}
    for name, robot in commands.items():
        pairs = [(as_the_command(robot), _rate(one_by_one)) for _ in range(_PAIRS)]
        value = statistics.median(a for a, _ in pairs)
        rows.append(Row(name, value, "steps/s", "mj_step in a loop", statistics.median(a / b for a, b in pairs)))
    for name, peer in (("mj_step in a loop", one_by_one), ("mj_step(nstep=…)", in_one_call)):
        pairs = [(_rate(ours), _rate(peer)) for _ in range(_PAIRS)]
        value = statistics.median(a for a, _ in pairs)
        ratio = statistics.median(a / b for a, b in pairs)
        rows.append(Row("RP2W at rest, no cameras", value, "steps/s", name, ratio))
    return rows


def _cost(robot: Path, duration_s: float) -> float:
    """[CPU s] Of a run."""
    start = time.process_time()
    options = RunOptions(headless=True, speed=None, sensors=False, duration_s=duration_s)
    with contextlib.redirect_stderr(io.StringIO()):
        launch_run(str(robot), options, {"HOME": str(Path.home())})
    return time.process_time() - start


def _rate(work: Callable[[], None]) -> float:
    start = time.process_time()
    work()
    return _STEPS / (time.process_time() - start)
