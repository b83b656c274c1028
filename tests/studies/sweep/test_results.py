"""Results on disk: rows in any order, cut short anywhere, make the same table."""

import random
from pathlib import Path

import pytest

from trundle.base.diagnostics import UsageError
from trundle.studies.plan_files.lock import lock_folder
from trundle.studies.sweep.plan_reader import read_plan
from trundle.studies.sweep.results import Results
from trundle.studies.sweep.row_result import RowResult
from trundle.studies.sweep.rows import Rows
from trundle.studies.sweep.table import Table

pytest.importorskip("pyarrow", reason="pyarrow, of the extra `sweep`, is not installed")

TEXT = "world: w.sdf\nduration: 1\nsamples: 25\nvary: {a: {uniform: [0, 1]}, b: [1, 2]}\nmeasure: {x: a, y: b}"


def _open(folder: Path, text: str = TEXT) -> Results:
    plan = read_plan(text, file="plan.yaml", folder=folder)
    rows = Rows(plan)
    return Results(folder / "out", Table.of_plan(plan, rows), rows=len(rows), digest=text, text=text)


def _result(row: int) -> RowResult:
    if row % 7 == 0:
        return RowResult(row, "error", "plan.yaml:9: error: …", 0.5)
    return RowResult(row, time=1.0, measures={"x": row / 3, "y": None})


@pytest.fixture(autouse=True)
def _small_groups(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.studies.sweep.results.GROUP_ROWS", 8)


def test_the_table_does_not_depend_on_the_order_or_on_kills(tmp_path: Path) -> None:
    whole = _open(tmp_path / "a")
    for row in whole.missing():
        whole.add(_result(row))
    whole.close()

    draw = random.Random(1)
    while not (broken := _open(tmp_path / "b")).is_complete:
        rows = list(broken.missing())
        draw.shuffle(rows)
        for row in rows[: draw.randrange(1, 12)]:
            broken.add(_result(row))
        broken.close()
        if rows[12:]:  # killed while the next row is written
            with (tmp_path / "b/out/journal.jsonl").open("ab") as journal:
                journal.write(b'{"row": 3, "stat')

    files = [(tmp_path / name / "out/results.parquet").read_bytes() for name in "ab"]
    assert files[0] == files[1]
    assert sorted(path.name for path in (tmp_path / "b/out").iterdir()) == ["plan.json", "results.parquet"]
    table = _open(tmp_path / "b").read()
    assert table["row"].to_pylist() == list(range(50))
    assert table.slice(0, 2).select(["status", "reason", "time", "b", "x", "y"]).to_pylist() == [
        {"status": "error", "reason": "plan.yaml:9: error: …", "time": 0.5, "b": 1, "x": None, "y": None},
        {"status": "ok", "reason": "", "time": 1.0, "b": 1, "x": 1 / 3, "y": None},
    ]


def test_rows_can_be_read_before_all_are_there(tmp_path: Path) -> None:
    some = _open(tmp_path)
    for row in (40, *range(10)):
        some.add(_result(row))

    some.close()
    assert some.read()["row"].to_pylist() == [*range(10), 40]
    assert some.counts == {"ok": 9, "error": 2}
    assert (tmp_path / "out/groups/000000.parquet").exists()


def test_a_folder_belongs_to_one_plan(tmp_path: Path) -> None:
    _open(tmp_path)
    with pytest.raises(UsageError, match="another plan, or the plan or its world has changed since; give another"):
        _open(tmp_path, TEXT + "\nseed: 1")


def test_two_sweeps_do_not_write_one_folder(tmp_path: Path) -> None:
    with lock_folder(tmp_path), pytest.raises(UsageError, match="writes it: end that"), lock_folder(tmp_path):
        pass
