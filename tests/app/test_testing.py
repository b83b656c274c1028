"""pytest fixtures for users' tests."""

import subprocess
import sys
from pathlib import Path

import pytest

MODEL = '<sdf version="1.6"><model name="m"><link name="a"/></model></sdf>'
TEST = """
def test_it_falls(trundle_sim):
    sim = trundle_sim("m.sdf", seed=3)
    sim["m"].links[0].set_pose(sim["m"].pose.__class__((0, 0, 10)))
    sim.run(1.0)
    assert abs(sim["m"].pose.position[2] - (10 - 4.9)) < 0.01
    assert sim.seed == 3
"""


def test_trundle_sim_loads_a_model_next_to_the_test(tmp_path: Path) -> None:
    (tmp_path / "m.sdf").write_text(MODEL)
    (tmp_path / "test_robot.py").write_text(TEST)

    process = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(tmp_path)],
        capture_output=True,
        text=True,
        cwd="/",
        check=False,
    )

    assert "1 passed" in process.stdout, process.stdout + process.stderr


SWEEP_TEST = """
def test_it_falls_in_all(trundle_sweep):
    assert trundle_sweep("falls.yaml").counts == {"ok": 4}

def test_it_rises(trundle_sweep):
    trundle_sweep("rises.yaml")
"""
PLAN = """\
world: m.sdf
duration: 0.1
vary: {models/m/pose/z: [10, 20, 30, 40]}
measure: {z: models.m.z}
pass: [z < 40]
"""


@pytest.mark.slow
def test_trundle_sweep_runs_a_plan_next_to_the_test(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow", reason="pyarrow, of the extra `sweep`, is not installed")
    (tmp_path / "m.sdf").write_text(MODEL)
    (tmp_path / "falls.yaml").write_text(PLAN)
    (tmp_path / "rises.yaml").write_text(PLAN.replace("z < 40", "z > 30"))
    (tmp_path / "test_robot.py").write_text(SWEEP_TEST)

    process = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(tmp_path)],
        capture_output=True,
        text=True,
        cwd="/",
        check=False,
    )

    assert "1 failed, 1 passed" in process.stdout, process.stdout + process.stderr
    assert "rises.yaml: ok in 1 of 4 variations" in process.stdout
    assert "  row 0: not z > 30: z = 9.95" in process.stdout
