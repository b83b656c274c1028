"""`trundle dataset` and `trundle.dataset`: all pictures of a plan."""

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import yaml

from trundle.datasets import (
    DatasetFolder,
    DatasetPlan,
    format_of,
    load_dataset_plan,
    read_dataset_plan,
    shown_pictures,
    write_contact_sheet,
)
from trundle.trials import lock_folder

from ..signals import stop_flag
from .dataset_world import picture_maker


@dataclass(frozen=True, slots=True, kw_only=True)
class DatasetResult:
    """Pictures of a dataset."""

    folder: Path
    done: int
    total: int
    """Pictures of the plan."""
    interrupted: bool
    """True after Ctrl-C; the same call goes on where it was."""

    def summary(self) -> str:
        """Return what is there, in one line."""
        return f"{self.done} of {self.total} pictures"


def dataset_folder(plan: DatasetPlan, output: Path | None) -> Path:
    """Return the folder of a plan's pictures: beside its file, or as asked for."""
    return output or Path(plan.file).with_suffix(".dataset")


def make_dataset(plan: DatasetPlan, *, output: Path | None = None) -> DatasetResult:
    """Make the pictures of a plan that are not there yet, then the files of the whole dataset.

    Raises:
        TrundleError: the plan cannot be drawn, or its pictures not be written.
    """
    path = dataset_folder(plan, output)
    write = picture_writer(plan, path)
    with lock_folder(path), stop_flag() as stop:
        folder = DatasetFolder(path)
        folder.open(plan)
        missing = sorted(set(range(plan.count)) - folder.done())
        for number in missing:
            if stop.is_set():
                break
            write(number)
        done = plan.count - len(set(range(plan.count)) - folder.done())
        if done == plan.count:
            for name in plan.formats:
                format_of(name).finish(plan, path, lambda: folder.read(range(plan.count)))
            write_contact_sheet(plan, path, list(folder.read(shown_pictures(plan.count))))
        return DatasetResult(folder=path, done=done, total=plan.count, interrupted=stop.is_set())


def picture_writer(plan: DatasetPlan, path: Path) -> Callable[[int], None]:
    """Return the function that makes and writes the picture of a number."""
    maker, folder = picture_maker(plan), DatasetFolder(path)
    formats = [format_of(name) for name in plan.formats]

    def write(number: int) -> None:
        picture = maker.make(number)
        folder.write(picture)
        for each in formats:
            each.write(plan, path, picture)
        folder.add(picture.annotation)

    return write


def make_planned(plan: "str | os.PathLike[str] | Mapping[str, object]", *, output: Path | None) -> DatasetResult:
    """See `trundle.dataset`."""
    if isinstance(plan, str | os.PathLike):
        read = load_dataset_plan(Path(plan))
    else:
        text = yaml.safe_dump(dict(plan), sort_keys=False)
        read = read_dataset_plan(text, file="plan", folder=Path.cwd())
    result = make_dataset(read, output=output)
    if result.interrupted:
        raise KeyboardInterrupt
    return result
