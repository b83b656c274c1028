"""Protocol of a format."""

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Protocol, TypeAlias

from ..annotation import PictureAnnotation
from ..picture import AnnotatedPicture
from ..plan import DatasetPlan

ReadAll: TypeAlias = Callable[[], Iterable[PictureAnnotation]]
"""Reads the annotations of all pictures in the order of their numbers."""


class DatasetFormat(Protocol):
    """Writer of one format."""

    def write(self, plan: DatasetPlan, folder: Path, picture: AnnotatedPicture) -> None:
        """Write the files of one picture; called in any process, and again after a kill."""
        ...

    def finish(self, plan: DatasetPlan, folder: Path, read: ReadAll) -> None:
        """Write the files of the whole dataset, once every picture is there."""
        ...
