"""Rows run by local processes, which may hang, crash or grow."""

import os
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

from trundle.base.diagnostics import TrundleError
from trundle.base.workers import Job, JobResult, run_rows

MODULE = """\
import os, pathlib, time

def make(folder):
    folder = pathlib.Path(folder)
    folder.joinpath(f"{os.getpid()}.made").touch()
    def run(row):
        if row == 3: time.sleep(1000)
        if row == 5: os._exit(7)
        if row == 6 and not (folder / "once").exists():
            (folder / "once").touch()
            os._exit(8)
        if row == 8:
            held = bytearray(600_000_000)
            held[::4096] = bytes(len(held[::4096]))
            time.sleep(1000)
        print("between the values")
        return row * row
    return run

def fail(): raise RuntimeError("no world")
"""


@pytest.fixture
def module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "squares_of_rows.py").write_text(MODULE)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    return tmp_path


def _make(folder: Path) -> "Callable[[], Callable[[int], int]]":
    import squares_of_rows  # pyright: ignore[reportMissingImports]

    return partial(squares_of_rows.make, str(folder))


def _run(job: Job[int], rows: range, *, workers: int = 2) -> list[JobResult[int]]:
    results = run_rows(job, iter(rows), count=len(rows), workers=workers, is_ending=lambda: False)
    return sorted((result for result in results if result is not None), key=lambda result: result.row)


def test_each_row_has_one_result_and_each_process_makes_its_function_once(module: Path) -> None:
    results = _run(Job(make=_make(module)), range(10, 300))

    assert [(result.row, result.value) for result in results] == [(row, row * row) for row in range(10, 300)]
    assert len(list(module.glob("*.made"))) == 2


@pytest.mark.slow
def test_rows_that_hang_crash_or_grow_fail_and_the_others_succeed(module: Path) -> None:
    job = Job(make=_make(module), time_limit_s=10, memory_limit_bytes=400_000_000)

    results = _run(job, range(12))

    failed = {result.row: (result.failure, result.reason) for result in results if result.failure is not None}
    assert failed == {
        3: ("timeout", "longer than the time limit of 10 s"),
        5: ("lost", "its process ended: exit code 7"),
        8: ("memory", "more than the memory limit of 400 MB"),
    }
    assert {result.row: result.value for result in results if result.failure is None} == {
        row: row * row for row in range(12) if row not in failed
    }


def test_ending_kills_the_workers(module: Path) -> None:
    started = time.monotonic()
    rows = run_rows(Job(make=_make(module)), iter(range(3, 4)), count=1, is_ending=lambda: any(module.glob("*.made")))

    assert not any(rows)
    (pid,) = (int(file.stem) for file in module.glob("*.made"))
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)
    assert time.monotonic() - started < 900, "the row itself sleeps longer"


@pytest.mark.skipif(sys.platform == "win32", reason="the test reads the process's stderr")
def test_a_function_that_cannot_be_made_is_an_error(module: Path, capfd: pytest.CaptureFixture[str]) -> None:
    import squares_of_rows  # pyright: ignore[reportMissingImports]

    with pytest.raises(TrundleError, match="a worker process does not start: exit code 1; its error is above"):
        _run(Job(make=squares_of_rows.fail), range(3), workers=1)
    assert "RuntimeError: no world" in capfd.readouterr().err
