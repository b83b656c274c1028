"""`trundle dataset` and `trundle.dataset`: all pictures of a plan."""

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from trundle.base.diagnostics import TrundleError
from trundle.base.signals import stop_flag
from trundle.base.workers import Job, JobResult, Progress, check_workers, run_job
from trundle.studies.datasets import (
    DatasetFolder,
    DatasetPlan,
    format_of,
    load_dataset_plan,
    shown_pictures,
    write_contact_sheet,
)
from trundle.studies.plan_files.lock import lock_folder

from .dataset_digest import dataset_digest
from .dataset_world import picture_maker


@dataclass(frozen=True, slots=True, kw_only=True)
class DatasetResult:
    """Pictures of a dataset."""

    __module__ = "trundle"

    folder: Path
    done: int
    total: int
    """Number of pictures of the plan."""
    rate: float
    """Pictures made per second of wall time in this call [1/s]."""
    failed: Mapping[int, str]
    """Number of a failed picture → reason; if any failed, files of the whole dataset are not written."""
    interrupted: bool
    """True after Ctrl-C; the same call resumes the run."""

    def summary(self) -> str:
        """Return a summary in one line."""
        return f"{self.done} of {self.total} pictures"


def make_dataset(
    plan: DatasetPlan, *, output: Path | None = None, workers: int | None = None, address: str | None = None
) -> DatasetResult:
    """Make the missing pictures of a plan, then the files of the whole dataset.

    Args:
        plan: plan of the dataset.
        output: folder of the dataset; None: next to the plan.
        workers: number of processes; None: one per processor.
        address: address of a Ray cluster whose nodes share the folder; None: this machine, without Ray.

    Raises:
        TrundleError: the pictures cannot be made or written.
    """
    check_workers(workers)
    maker = picture_maker(plan)  # reading it here refuses an invalid plan once, not in each process
    plan, digest = maker.plan, dataset_digest(maker)
    path = (output or Path(plan.file).with_suffix(".dataset")).resolve()
    job = Job(make=partial(_picture_writer, plan, path))
    with lock_folder(path), stop_flag() as stop:
        folder = DatasetFolder(path)
        folder.open(plan, digest)
        missing = sorted(set(range(plan.count)) - folder.done())
        progress = Progress(plan.count, plan.count - len(missing), what="pictures")
        failed: dict[int, str] = {}

        def add_result(result: JobResult[str]) -> bool:
            reason = result.reason if result.failure is not None else result.value
            if reason:
                failed[result.row] = reason
            return not reason

        run_job(
            job,
            iter(missing),
            add_result,
            count=len(missing),
            progress=progress,
            workers=workers,
            address=address,
            is_ending=stop.is_set,
        )
        left = set(range(plan.count)) - folder.done()
        if not left:
            for name in plan.formats:
                format_of(name).finish(plan, path, lambda: folder.read(range(plan.count)))
            write_contact_sheet(plan, path, list(folder.read(shown_pictures(plan.count))))
        return DatasetResult(
            folder=output or Path(plan.file).with_suffix(".dataset"),
            done=plan.count - len(left),
            total=plan.count,
            rate=progress.rate,
            failed=failed,
            interrupted=stop.is_set(),
        )


def _picture_writer(plan: DatasetPlan, path: Path) -> Callable[[int], str]:
    """Return a function that makes and writes the picture of a number and returns an error message, or ""."""
    maker, folder = picture_maker(plan), DatasetFolder(path)
    formats = [format_of(name) for name in plan.formats]

    def write(number: int) -> str:
        try:
            picture = maker.make(number)
            folder.write(picture)
            for format_ in formats:
                format_.write(plan, path, picture)
            folder.add(picture.annotation)
        except TrundleError as error:
            return str(error)
        except OSError as error:
            return f"{error.filename or path}: {error.strerror}"  # errors of `write` may have no file name
        return ""

    return write


def dataset(
    plan: "str | os.PathLike[str] | Mapping[str, object]",
    *,
    output: "str | os.PathLike[str] | None" = None,
    workers: int | None = None,
    address: str | None = None,
) -> DatasetResult:
    """Make annotated pictures of a varied world, to train computer vision.

    A call with the same plan continues the interrupted one.

    Args:
        plan: plan file, or its content as a dictionary, with paths relative to the working directory.
        output: folder of the dataset; None: next to the plan's file, or `plan.dataset` in the working directory.
        workers: number of processes; None: one for each processor.
        address: address of a Ray cluster whose nodes share the folder; None: only this machine.

    Raises:
        TrundleError: one sentence with file and line.
        KeyboardInterrupt: Ctrl-C; finished pictures are kept.
    """
    folder = None if output is None else Path(output)
    result = make_dataset(load_dataset_plan(plan), output=folder, workers=workers, address=address)
    if result.interrupted:
        raise KeyboardInterrupt
    return result
