"""Files of the built client."""

import mimetypes
from pathlib import Path

CLIENT = Path(__file__).parents[1] / "client"
REPLAY_FILES = tuple(CLIENT / "replay" / name for name in ("replay.js", "replay.css", "licenses.txt"))
"""Script, style sheet and licences of the viewer in each replay."""
_TYPES = {
    ".glb": "model/gltf-binary",
    ".js": "text/javascript",
    ".svg": "image/svg+xml",
    ".wasm": "application/wasm",
    ".woff2": "font/woff2",
}
MISSING = (
    "<!doctype html><meta charset=utf-8><title>Trundle</title><p>The page's client is not built: run <code>make"
    "</code> in Trundle's repository; Foxglove and Lichtblick can connect to this address."
)


_COMPRESSED = ".gz"
"""Suffix of compressed copies, which aiohttp sends to browsers that accept them."""


class ClientFiles:
    """Files below a folder by URL path."""

    def __init__(self, folder: Path = CLIENT) -> None:
        self._files = {
            file.relative_to(folder).as_posix(): file
            for file in sorted(folder.rglob("*"))
            if file.is_file() and file.suffix != _COMPRESSED
        }

    def find(self, path: str) -> Path | None:
        """Return the file of a URL's path without its first slash; the empty path means the document."""
        return self._files.get(path or "index.html")


def content_type(path: Path) -> str:
    """Return the media type of a file."""
    return _TYPES.get(path.suffix) or mimetypes.guess_type(path.name)[0] or "application/octet-stream"


def is_immutable(path: str) -> bool:
    """True for files whose name contains a hash of their content, which browsers may cache."""
    return path.startswith("assets/")
