"""The README says what is true."""

import importlib.util
from pathlib import Path

import trundle

ROOT = Path(__file__).parents[1]


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
