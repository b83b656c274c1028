"""Fixture for users' own tests."""

import subprocess
import sys
from pathlib import Path

MODEL = '<sdf version="1.6"><model name="m"><link name="a"/></model></sdf>'
TEST = """
def test_it_falls(trundle_sim):
    sim = trundle_sim("m.sdf", seed=3)
    sim["m"].links[0].set_pose(sim["m"].pose.__class__((0, 0, 10)))
    sim.run(1.0)
    assert abs(sim["m"].pose.position[2] - (10 - 4.9)) < 0.01
    assert sim.seed == 3
"""


def test_a_users_test_simulates_the_model_beside_it(tmp_path: Path) -> None:
    (tmp_path / "m.sdf").write_text(MODEL)
    (tmp_path / "test_robot.py").write_text(TEST)

    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(tmp_path)],
        capture_output=True,
        text=True,
        cwd="/",
        check=False,
    )

    assert "1 passed" in done.stdout, done.stdout + done.stderr
