"""The README's statements hold."""

import importlib.util
import textwrap
from itertools import takewhile
from pathlib import Path

import pytest

import trundle

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize("home", ["empty", "of the tutorial"])
def test_its_python_runs_with_the_tutorial_s_model_and_without(
    home: str,
    request: pytest.FixtureRequest,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """The tutorial's model, which goes before the one that comes with Trundle, is called my_robot."""
    if home == "of the tutorial":
        seeds: Path = request.getfixturevalue("shared") / "seeds"
        (tmp_path / ".gazebo/models").mkdir(parents=True)
        (tmp_path / ".gazebo/models/rp2w").symlink_to(seeds / "rp2w")
    monkeypatch.setenv("HOME", str(tmp_path))
    _, _, after = (ROOT / "README.md").read_text().partition("From Python, the same simulator:\n\n")
    lines = list(takewhile(lambda line: not line or line.startswith("    "), after.splitlines()))

    exec(textwrap.dedent("\n".join(lines)), {})

    assert capsys.readouterr().out.startswith("Pose(position=(")


def test_its_table_of_what_runs_is_the_code_s_own() -> None:
    spec = importlib.util.spec_from_file_location("what_runs", ROOT / "docs/what_runs.py")
    assert spec is not None
    assert spec.loader is not None
    what_runs = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(what_runs)
    readme = (ROOT / "README.md").read_text()

    assert what_runs.renewed(readme) == readme, "run make format"


def test_every_room_is_on_its_floor_plan() -> None:
    readme = (ROOT / "README.md").read_text()
    rooms = [path for path in Path(trundle.__file__).parent.iterdir() if (path / "__init__.py").is_file()]

    missing = [room.name for room in rooms if f"`{room.name}`" not in readme]
    assert missing == []
