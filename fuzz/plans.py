"""Plans of sweeps and datasets, with the values of a sweep's first rows."""

from collections.abc import Callable, Generator
from contextlib import contextmanager
from itertools import islice
from pathlib import Path

from trundle.studies.datasets import load_dataset_plan
from trundle.studies.sweep.plan_reader import load_plan
from trundle.studies.sweep.rows import Rows

from .seeds import seed
from .target import Execute, Open, Target, write_file

_WORDS = (
    b"uniform: [0, 1]", b"normal: [0, 1]", b"log_uniform: [1, 2]", b"range: [0, 1e9, 1e-9]", b"values: [1]",
    b"with: mass", b"sobol", b"t > 1", b"'a' * 10**9", b"9**9**9", b"function: a.py:f", b"&a", b"*a",
    b"launch: l.launch", b"? a", b"null", b"median", b"any", b"seeds: [1, 2]",
)  # fmt: skip


def _plans(read: Callable[[Path], object]) -> Open:
    @contextmanager
    def opened(folder: Path) -> Generator[Execute]:
        file = folder / "plan.yaml"
        for name in ("model.sdf", "cup.sdf"):
            (folder / name).write_bytes(seed("model.sdf"))

        def execute(data: bytes) -> None:
            write_file(file, data)
            read(file)

        yield execute

    return opened


def _read_sweep(file: Path) -> None:
    rows = Rows(load_plan(file))
    len(rows)
    list(islice(rows, 3))


TARGETS = {
    "sweep": Target(open=_plans(_read_sweep), seeds=lambda: [seed("sweep.yaml")], words=_WORDS),
    "dataset": Target(open=_plans(load_dataset_plan), seeds=lambda: [seed("dataset.yaml")], words=_WORDS),
}
