"""An exception in a user's plugin ends a run with a message and the plugin's lines."""

from pathlib import Path

import pytest

from trundle.app.cli.main import main
from trundle.sim.simulation import Simulation

RUN = ["--headless", "--no-ros", "--speed", "max", "--duration", "0.1"]
SDF = """<sdf version="1.6"><model name="m"><link name="a"/><plugin name="arm" filename="libarm.so"/></model></sdf>"""
PLUGIN = """from trundle.gazebo.plugins import Plugin

class Arm(Plugin):
    @classmethod
    def load(cls, sim, model, node, tag):
        return cls()

    def {hook}(self, _):
        self.share(0)

    def share(self, count):
        return 1 / count
"""


@pytest.fixture
def model(tmp_path: Path) -> Path:
    (tmp_path / "model.sdf").write_text(SDF)
    return tmp_path / "model.sdf"


@pytest.mark.parametrize("hook", ["before_step", "after_step"])
def test_the_hook_is_named_above_the_lines_of_the_plugin(
    model: Path, hook: str, capsys: pytest.CaptureFixture[str]
) -> None:
    code = model.parent / "arm.py"
    code.write_text(PLUGIN.format(hook=hook))

    assert main(["run", str(model), *RUN]) == 1

    lines = capsys.readouterr().err.splitlines()
    start = lines.index(f"trundle run: error: plugin arm.py: {hook}: ZeroDivisionError: division by zero")
    files = [line.strip() for line in lines[start + 1 :] if line.lstrip().startswith("File ")]
    assert files == [f'File "{code}", line 9, in {hook}', f'File "{code}", line 12, in share']
    assert "return 1 / count" in lines[-2] + lines[-1]
    assert not any("Traceback" in line for line in lines)


def test_an_exception_outside_plugins_names_no_plugin(model: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (model.parent / "arm.py").write_text(PLUGIN.format(hook="idle"))

    def fail(simulation: Simulation, until_ns: int) -> None:
        raise ZeroDivisionError(f"ours, at {simulation.time_ns} of {until_ns}")

    monkeypatch.setattr(Simulation, "advance", fail)
    with pytest.raises(ZeroDivisionError, match="ours"):
        main(["run", str(model), *RUN])
