"""Writes what is built as SDF."""

from pathlib import Path

from trundle import model
from trundle.atomic_write import write_atomically
from trundle.diagnostics import Diagnostics

from ..writing import write_sdf, written_uri


def sdf_of(world: model.World, *, is_world: bool) -> str:
    """An SDF document; all that can be built can be written.

    Raises:
        DescriptionError: something could not.
    """
    return write_sdf(world, is_world=is_world, uri_of=written_uri, report=Diagnostics(strict=True))


def save(text: str, file: str | Path) -> None:
    """Write a document.

    Raises:
        UsageError: it cannot be written.
    """
    write_atomically(Path(file).expanduser(), text)
