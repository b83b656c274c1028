"""octomap's files: .bt (free or occupied) and .ot (log-odds)."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError
from trundle.base.files import read_file

from ._octomaps import OccupancyTree

_BINARY, _FULL = "# Octomap OcTree binary file", "# Octomap OcTree file"
_MAX_BYTES = 512 * 1024 * 1024
_MAX_HEADER = 4096
_NODE_SIZES = {"OcTree": 5, "ColorOcTree": 8}
"""Bytes of a node of a full tree; colors are left out."""


def write_octomap(file: Path, data: NDArray[np.uint8], *, kind: str, resolution: float, binary: bool) -> None:
    """Write the stream of an octomap_msgs/Octomap as .bt or .ot.

    Raises:
        UsageError: the file cannot be written.
    """
    first, size = (_BINARY, 2) if binary else (_FULL, _NODE_SIZES.get(kind, 5))
    header = (
        f"{first}\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
        f"id {kind}\nsize {len(data) // size}\nres {resolution:g}\ndata\n"
    )
    write_atomically(file, header.encode() + data.tobytes())


def read_resolution(file: Path) -> float:
    """Return the length of a file's cubes [m].

    Raises:
        UsageError: it is no octomap.
    """
    return _read(file)[1]


def load_octomap(file: Path, tree: OccupancyTree) -> None:
    """Put a file's cubes into a tree of its resolution.

    Raises:
        UsageError: it is no octomap, or damaged or too large.
    """
    binary, _, kind, data = _read(file)
    if not tree.read(data, binary=binary, node_size=_NODE_SIZES[kind]):
        raise UsageError(f"octomap {file}: its data of {len(data)} bytes end inside a node, or have too many cubes")


def _read(file: Path) -> tuple[bool, float, str, NDArray[np.uint8]]:
    """Return whether a file is binary, its resolution [m], kind and stream."""
    try:
        content = read_file(file, max_bytes=_MAX_BYTES)
    except OSError as error:
        raise UsageError(f"octomap {file}: {error.strerror or error}") from None
    head, found, data = content.partition(b"\ndata\n")
    if not found or len(head) > _MAX_HEADER or not head.startswith((_BINARY.encode(), _FULL.encode())):
        raise UsageError(f"octomap {file}: not a file of octomap, which begins with '{_BINARY}' or '{_FULL}'")
    lines = [line.split() for line in head.decode("latin-1").splitlines() if not line.startswith("#")]
    fields = {words[0]: words[1] for words in lines if len(words) == 2}
    kind = fields.get("id", "")
    if kind not in _NODE_SIZES:
        raise UsageError(f"octomap {file}: a tree of type '{kind}'; read are: {', '.join(_NODE_SIZES)}")
    try:
        resolution = float(fields.get("res", ""))
    except ValueError:
        resolution = 0.0
    if not 1e-4 < resolution < 1e3:
        raise UsageError(f"octomap {file}: 'res' must be a length [m], got '{fields.get('res', '')}'")
    return head.startswith(_BINARY.encode()), resolution, kind, np.frombuffer(data, dtype=np.uint8)
