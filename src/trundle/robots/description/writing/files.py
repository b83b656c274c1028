"""File URIs in written descriptions."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

UriOf: TypeAlias = Callable[[Path | None, str], str]
"""Function that returns the URI to write for a mesh, terrain or texture, from its path and original URI."""


def written_uri(path: Path | None, uri: str) -> str:
    """Return the original URI if it is portable, else the file's absolute path."""
    if path is None or uri.startswith(("package://", "model://")):
        return uri
    return f"file://{path.resolve()}"
