"""Rows on a Ray cluster of two nodes, one of which is killed."""

import importlib
import os
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from trundle.base.diagnostics import UsageError
from trundle.base.workers import Job, run_rows

ROWS = 60


def make(folder: str) -> "Callable[[int], int]":
    """Square rows slowly, and record each start."""
    import time

    def run(row: int) -> int:
        with (Path(folder) / f"{row}").open("ab") as file:
            file.write(b"x")
        time.sleep(0.1)
        return row * row

    return run


@pytest.fixture
def cluster(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    cluster_utils = pytest.importorskip("ray.cluster_utils", reason="Ray, of the extra `ray`, is not installed")
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parent))
    monkeypatch.syspath_prepend(Path(__file__).parent)
    cluster = cluster_utils.Cluster(initialize_head=True, head_node_args={"num_cpus": 1, "include_dashboard": False})
    try:
        yield cluster
    finally:
        cluster.shutdown()


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_a_killed_node_loses_no_row(cluster: Any, tmp_path: Path) -> None:
    node = cluster.add_node(num_cpus=1)
    cluster.wait_for_nodes()
    module = importlib.import_module("test_ray_engine")
    job = Job(make=partial(module.make, str(tmp_path)))

    results: list[tuple[int, int | None]] = []
    is_killed = False
    running = run_rows(job, iter(range(ROWS)), count=ROWS, address=cluster.address, is_ending=lambda: False)
    for result in running:
        if result is not None:
            results.append((result.row, result.value))
        if len(results) == ROWS // 3 and not is_killed:
            is_killed = True
            cluster.remove_node(node, allow_graceful=False)

    assert is_killed
    assert sorted(results) == [(row, row * row) for row in range(ROWS)]
    assert sum(len((tmp_path / str(row)).read_bytes()) for row in range(ROWS)) >= ROWS


@pytest.mark.slow
def test_an_unreachable_cluster_is_an_error() -> None:
    pytest.importorskip("ray", reason="Ray, of the extra `ray`, is not installed")
    job = Job(make=partial(make, os.curdir))
    with pytest.raises(UsageError, match=r"no Ray cluster at '127.0.0.1:1'"):
        list(run_rows(job, iter(range(1)), count=1, address="127.0.0.1:1", is_ending=lambda: False))
