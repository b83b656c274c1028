"""Base of formats."""

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TypeAlias

from ..annotation import PictureAnnotation
from ..picture import AnnotatedPicture
from ..plan import DatasetPlan

ReadAll: TypeAlias = Callable[[], Iterable[PictureAnnotation]]
"""Reads the annotations of all pictures in the order of their numbers."""


class DatasetFormat:
    """Writer of one format: of files per picture, of files for the whole dataset, or both."""

    def write(self, plan: DatasetPlan, folder: Path, picture: AnnotatedPicture) -> None:
        """Write the files of one picture; called in any process, and again after an interruption."""

    def finish(self, plan: DatasetPlan, folder: Path, read: ReadAll) -> None:
        """Write the files of the whole dataset, after the last picture."""
