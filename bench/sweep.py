"""A sweep of the RP2W with varied mass, friction and push, against the engine's bare loop on the same models.

Times are of CPU, which others on the machine change least. Trundle lets the robot sleep at rest; the peer never does.
"""

import statistics
import tempfile
import time
from pathlib import Path

import mujoco

import trundle
from bench.table import Row
from trundle.bringup.sweep.trial import TrialRunner
from trundle.trials import Rows, read_plan

_RUNS = 1000
"""Rows of the plan; the table is made of all of them."""
_SIMULATED = 16
"""Rows that are simulated against the peer, evenly chosen."""
_DURATION_S = 10.0
_PUSH_S = (1.0, 1.3)
_PLAN = f"""\
world: model://rp2w
duration: {_DURATION_S}
samples: {_RUNS}
design: latin_hypercube
vary:
  models/rp2w/links/chassis/inertial/mass: {{uniform: [2, 5]}}
  mu: {{log_uniform: [0.1, 1]}}
  push: {{uniform: [5, 30]}}
set: {{models/rp2w/links/*/collisions/*/friction: mu}}
events: [{{at: {_PUSH_S[0]}, push: rp2w/chassis, force: [push, 0, 0], for: {_PUSH_S[1] - _PUSH_S[0]:.1f}}}]
measure: {{moved: models.rp2w.x}}
"""


def run() -> list[Row]:
    """Run each chosen row and its peer one after the other."""
    plan = read_plan(_PLAN, file="bench.yaml", folder=Path.cwd())
    rows, runner = Rows(plan), TrialRunner(plan)
    runner.run(rows.row(0))
    pairs: list[tuple[float, float]] = []
    starts: list[float] = []
    for number in range(0, _RUNS, _RUNS // _SIMULATED):
        row = rows.row(number)
        began = time.process_time()
        runner.run(row)
        ours_s = time.process_time() - began
        began = time.process_time()
        with runner.simulation(row) as simulation:
            starts.append(time.process_time() - began)
            model = simulation.engine.compiled.model
            steps = round(_DURATION_S * 1e9 / simulation.step_ns)
            pairs.append((steps / ours_s, steps / _bare_s(model, float(str(row.values["push"])))))
    rate = statistics.median(ours for ours, _ in pairs)
    ratio = statistics.median(ours / bare for ours, bare in pairs)
    return [
        Row(
            "sweep of RP2W, 10 s runs with a push",
            rate,
            "steps/s",
            "mj_step(nstep=…) without sleep, same models",
            ratio,
        ),
        Row("start of a row of a sweep", statistics.median(starts) * 1000, "ms", "", None),
        Row("results of a sweep, 4 measured numbers", _bytes_a_row(), "bytes/row", "", None),
    ]


def _bare_s(model: mujoco.MjModel, push: float) -> float:
    """Return the CPU time of the same run by MuJoCo alone [s]."""
    data, chassis = mujoco.MjData(model), model.body("rp2w::chassis").id
    phases = (_PUSH_S[0], _PUSH_S[1] - _PUSH_S[0], _DURATION_S - _PUSH_S[1])
    began = time.process_time()
    for seconds, force in zip(phases, (0.0, push, 0.0), strict=True):
        data.xfrc_applied[chassis, 0] = force
        mujoco.mj_step(model, data, nstep=round(seconds / model.opt.timestep))
    return time.process_time() - began


def _bytes_a_row() -> float:
    with tempfile.TemporaryDirectory() as folder:
        text = _PLAN.replace(f"duration: {_DURATION_S}", "duration: 0.01")
        plan = Path(folder) / "plan.yaml"
        plan.write_text(text)
        trundle.sweep(plan)
        return (Path(folder) / "plan.sweep/results.parquet").stat().st_size / _RUNS
