"""What a written description calls the files it needs."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

UriOf: TypeAlias = Callable[[Path | None, str], str]
"""The URI to write for a mesh, terrain or texture: of where it is, and of what its author called it."""


def written_uri(path: Path | None, uri: str) -> str:
    """The author's own URI where it holds anywhere, else the file's full path."""
    if path is None or uri.startswith(("package://", "model://")):
        return uri
    return f"file://{path.resolve()}"
