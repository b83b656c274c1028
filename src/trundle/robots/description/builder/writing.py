"""Writer of built worlds and models as SDF."""

from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import Diagnostics
from trundle.robots import model

from ..writing import write_sdf, written_uri


def sdf_of(world: model.World, *, is_world: bool) -> str:
    """Return an SDF document.

    Raises:
        DescriptionError: a part cannot be written.
    """
    return write_sdf(world, is_world=is_world, uri_of=written_uri, report=Diagnostics(strict=True))


def save(text: str, file: str | Path) -> None:
    """Write a document.

    Raises:
        UsageError: it cannot be written.
    """
    write_atomically(Path(file).expanduser(), text)
