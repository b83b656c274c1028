"""What a written description calls the files it needs."""

from collections.abc import Callable
from typing import TypeAlias

from trundle.model import Heightmap, MeshFile

UriOf: TypeAlias = Callable[[MeshFile | Heightmap], str]
"""The URI to write for a file."""


def written_uri(shape: MeshFile | Heightmap) -> str:
    """The author's own URI where it holds anywhere, else the file's full path."""
    if shape.path is None or shape.uri.startswith(("package://", "model://")):
        return shape.uri
    return f"file://{shape.path.resolve()}"
