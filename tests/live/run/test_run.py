"""World with wind, actors and plugins, from the file to `run`'s summary."""

import json
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.graphs import running_graph

from trundle.app.cli.main import main
from trundle.sim.simulation import Simulation

NS = 1_000_000_000
WORLD = """<sdf version="1.6"><world name="w"><gravity>0 0 0</gravity>
<wind><linear_velocity>3 0 0</linear_velocity></wind><plugin name="wind" filename="libWindPlugin.so">
<force_approximation_scaling_factor>1</force_approximation_scaling_factor></plugin>
<model name="kite"><enable_wind>1</enable_wind><link name="l"/></model>
<actor name="bob"><link name="l"/><script><trajectory id="0" type="walk">
<waypoint><time>0</time><pose>0 3 0 0 0 0</pose></waypoint><waypoint><time>4</time><pose>4 3 0 0 0 0</pose></waypoint>
</trajectory></script></actor></world></sdf>"""


@pytest.fixture(autouse=True)
def _turns() -> Iterator[None]:
    """Restore the interpreter's switch interval."""
    before = sys.getswitchinterval()
    yield
    sys.setswitchinterval(before)


def test_wind_moves_a_model_and_actors_are_in_the_result(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "w.world"
    file.write_text(WORLD)

    assert main(["run", str(file), "--headless", "--no-ros", "--speed", "max", "--duration", "2", "--json"]) == 0

    out, err = capsys.readouterr()
    assert sys.getswitchinterval() < 0.001  # a busy graph must not slow a simulation down
    kite, bob = json.loads(out)["models"]
    assert "plugin 'wind' of the world: Trundle's own libWindPlugin.so" in err
    assert kite["links"][0]["twist"][0] > 1.0
    assert (bob["name"], bob["pose"][:3]) == ("bob", pytest.approx([2.0, 3.0, 0.0], abs=1e-3))


def test_summary_counts_the_time_before_a_reset(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The world is reset after a second, as by the page's button."""
    file = tmp_path / "w.world"
    file.write_text(WORLD)
    advance = Simulation.advance

    def advance_and_reset(simulation: Simulation, until_ns: int) -> None:
        advance(simulation, until_ns)
        if simulation.simulated_ns == NS:
            simulation.reset()

    monkeypatch.setattr(Simulation, "advance", advance_and_reset)
    command = ["run", str(file), "--headless", "--no-ros", "--speed", "max", "--duration", "2"]
    assert main(command) == 0
    line = capsys.readouterr().out.splitlines()[0]
    assert line.startswith("3.000 s simulated in ")
    assert line.endswith("3000 steps, 0 images; the last reset was 2.000 s ago")

    monkeypatch.setattr(Simulation, "advance", advance)
    assert main(command) == 0
    assert capsys.readouterr().out.splitlines()[0].endswith("2000 steps, 0 images")


def test_a_joined_master_is_named_on_the_first_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A forgotten line in ~/.bashrc may name it."""
    file = tmp_path / "w.world"
    file.write_text(WORLD)
    with running_graph() as graph:
        monkeypatch.setenv("ROS_MASTER_URI", graph.core.uri)
        assert main(["run", str(file), "--headless", "--speed", "max", "--duration", "0.1"]) == 0
        first, *rest = capsys.readouterr().err.splitlines()
    assert first == f"ROS master joined: {graph.core.uri}, which ROS_MASTER_URI names: another process started it"
    assert not any(line.startswith("ROS master") for line in rest)
