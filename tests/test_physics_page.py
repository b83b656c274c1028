"""Worlds of examples/physics move as docs/physics.md states."""

import json
from pathlib import Path

import pytest
from tests.physics_page import PAGE, WORLDS, Row, measure, read_rows

import trundle
from trundle.app.cli.main import main

ROWS = read_rows()


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.world}-{row.measure}")
def test_worlds_have_the_documented_values(row: Row) -> None:
    assert measure(row) == pytest.approx(row.figure, abs=row.tolerance)


def test_every_world_is_on_the_page() -> None:
    page = PAGE.read_text()
    assert [path.name for path in WORLDS.glob("*.world") if f"`{path.stem}`, " not in page] == ["sensors.world"]
    assert "physics/sensors.world" in page


@pytest.mark.parametrize("world", sorted(WORLDS.glob("*.world")), ids=lambda world: world.stem)
def test_worlds_have_no_warnings(world: Path) -> None:
    assert trundle.load(str(world)).report.warnings == []


def test_the_command_on_the_page_prints_the_documented_value(capsys: pytest.CaptureFixture[str]) -> None:
    command = next(line.split() for line in PAGE.read_text().splitlines() if line.endswith("--json"))
    (row,) = (row for row in ROWS if row.world == "cart")

    assert command[:3] == ["trundle", "run", "physics/cart.world"]
    assert main([*command[1:], "--no-ros"]) == 0
    cart = next(model for model in json.loads(capsys.readouterr().out)["models"] if model["name"] == "cart")
    assert cart["pose"][0] == pytest.approx(row.figure, abs=row.tolerance)
