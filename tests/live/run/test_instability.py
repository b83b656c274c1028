"""Messages and exit codes when the physics becomes unstable."""

import json
import math
import os
import signal
import threading
from pathlib import Path

import pytest

from trundle.app.cli.main import main
from trundle.live.run.run_options import OnInstability, RunOptions
from trundle.live.run.run_world import run
from trundle.sim.physics import SimulationUnstableError

QUIET = ["--headless", "--no-ros", "--speed", "max", "--duration", "3"]


@pytest.fixture
def world(tmp_path: Path) -> Path:
    """Two balls, and a gravity too large for the time step."""
    file = tmp_path / "wild.world"
    ball = '<link name="l"><collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>'
    file.write_text(
        '<sdf version="1.6"><world name="w"><gravity>0 0 -1e10</gravity>'
        f'<model name="ball">{ball}</link></model></world></sdf>'
    )
    return file


def options(on_instability: OnInstability | None) -> RunOptions:
    return RunOptions(headless=True, ros=False, speed=None, duration_s=3.0, on_instability=on_instability)


def test_headless_run_exits_and_names_the_diverging_link(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(world), *QUIET, "--json"]) == 1
    out, err = capsys.readouterr()
    (error,) = json.loads(out)["diagnostics"]
    assert "the physics became unstable after 0.000 s" in error["message"]
    assert "the physics became unstable after 0.000 s: 'ball::l' diverged" in err
    assert "Traceback" not in err


def test_reset_restarts_the_simulation_at_most_ten_times(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(world), *QUIET, "--on-instability", "reset"]) == 1
    assert capsys.readouterr().err.count("the simulation is reset") == 10


def test_pause_keeps_the_last_stable_state_until_interrupted(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    result = run(str(world), options("pause"))
    assert result.interrupted
    assert "the simulation is paused at its last stable state, at 0.000 s" in capsys.readouterr().err
    state = result.as_json()["models"][0]["links"][0]
    assert all(map(math.isfinite, [*state["pose"], *state["twist"]]))


def test_the_error_names_the_diverging_link(world: Path) -> None:
    with pytest.raises(SimulationUnstableError) as caught:
        run(str(world), options(None))
    assert (caught.value.divergence.link, caught.value.divergence.joint) == ("ball::l", None)
