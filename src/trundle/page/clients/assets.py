"""Files that clients fetch: meshes and textures of robots, confined to the folders of packages and the page."""

import asyncio
import os
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Source
from trundle.robots.packages import Packages

from .connection import Connection
from .protocol import FetchAsset, asset_header

_SCHEMES = ("package://", "model://", "file://")
_KINDS = frozenset(
    (
        ".bin", ".bmp", ".dae", ".dds", ".gif", ".glb", ".gltf", ".hdr", ".jpeg", ".jpg", ".ktx2", ".material", ".mtl",
        ".obj", ".png", ".sdf", ".stl", ".tga", ".tif", ".tiff", ".urdf", ".webp", ".xacro",
    )
)  # fmt: skip
"""Suffixes of meshes, textures, materials and robots: view-only clients must not read the code next to them."""
_DRAIN_S = 60.0
_MAX_BYTES = 128 * 1024 * 1024
_STREAM = "assets"
MAX_IN_FLIGHT = 64
"""Limit of a client's pending requests."""


class Assets:
    """Answers `fetchAsset`; a thread reads the files one after another."""

    def __init__(self, environment: Mapping[str, str], start: Path) -> None:
        """Create it; files around `start` and on the package paths may be read."""
        self._packages = Packages(environment, start=start)
        self._start = start
        self._reader = ThreadPoolExecutor(1, thread_name_prefix="trundle-assets")
        self._waiting: dict[Connection, int] = {}
        self._turns: dict[Connection, asyncio.Lock] = {}
        """Held while a client's file is read and sent: files would fill the queue of a slow client."""
        self._tasks: set[asyncio.Task[None]] = set()

    def fetch(self, client: Connection, request: FetchAsset) -> None:
        """Read a file and send it."""
        if self._waiting.get(client, 0) >= MAX_IN_FLIGHT:
            client.send_binary((asset_header(request.request_id, f"{MAX_IN_FLIGHT} requests for files are pending"),))
            return
        self._waiting[client] = self._waiting.get(client, 0) + 1
        task = asyncio.get_running_loop().create_task(self._send(client, request))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    def forget(self, client: Connection) -> None:
        """Remove a client that has disconnected."""
        self._waiting.pop(client, None)
        self._turns.pop(client, None)

    async def _send(self, client: Connection, request: FetchAsset) -> None:
        async with self._turns.setdefault(client, asyncio.Lock()):
            if client not in self._waiting:
                return
            loop = asyncio.get_running_loop()
            try:
                content = await loop.run_in_executor(self._reader, self._read, request.uri)
            except (DescriptionError, OSError, ValueError) as error:
                client.send_binary((asset_header(request.request_id, _reason(error)),))
            else:
                client.send_binary((asset_header(request.request_id, None), content), _STREAM)
                await client.outbox.drain(_DRAIN_S)
            if client in self._waiting:
                self._waiting[client] -= 1

    def _read(self, uri: str) -> bytes:
        """Read the file of a URI.

        Raises:
            DescriptionError: the file is missing, too large or must not be read.
            OSError: the file cannot be read.
        """
        at = Source("page")
        if not uri.startswith(_SCHEMES):
            raise DescriptionError(at, f"{uri[:200]}: use one of {', '.join(_SCHEMES)}")
        path = self._packages.resolve(uri, folder=self._start, at=at)
        if path.suffix.lower() not in _KINDS and path.is_file():
            raise DescriptionError(at, f"{uri}: only meshes, textures and robots are sent")
        size = os.stat(path).st_size
        if size > _MAX_BYTES:
            raise DescriptionError(at, f"{uri}: {size} bytes exceed the limit of {_MAX_BYTES}")
        return path.read_bytes()


def _reason(error: DescriptionError | OSError | ValueError) -> str:
    if isinstance(error, DescriptionError):
        return error.what
    return str(error.strerror if isinstance(error, OSError) and error.strerror else error)
