"""Pose graphs in files: arrays of NumPy, with their scans."""

import io
import zipfile
import zlib
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError
from trundle.base.files import read_file

from . import _mapping

if TYPE_CHECKING:
    from numpy.lib.npyio import NpzFile

_SUFFIX = ".posegraph"
_MAX_BYTES = 1024**3
_COLUMNS = {
    "poses": 3,
    "constraints": 11,
    "origins": 2,
    "hits": 2,
    "hit_counts": None,
    "misses": 2,
    "miss_counts": None,
}
"""Arrays of a file, in the order of `GraphSlam.restore`, with their columns; None: numbers."""


def write_graph(name: Path, slam: _mapping.GraphSlam) -> Path:
    """Write NAME.posegraph, and return its path.

    Raises:
        UsageError: it cannot be written.
    """
    arrays = dict(zip(_COLUMNS, (slam.poses(), slam.constraints(), *slam.scans()), strict=True))
    stream = io.BytesIO()
    np.savez_compressed(stream, allow_pickle=False, **arrays)
    path = _path(name)
    write_atomically(path, stream.getvalue())
    return path


def read_graph(name: Path, slam: _mapping.GraphSlam) -> None:
    """Restore a graph from NAME.posegraph.

    Raises:
        UsageError: no such file, one of another program, or one that is damaged.
    """
    path = _path(name)
    try:
        content = read_file(path, max_bytes=_MAX_BYTES)
        with zipfile.ZipFile(io.BytesIO(content)) as packed:
            size = sum(entry.file_size for entry in packed.infolist())
        if size > _MAX_BYTES:
            raise ValueError(f"unpacked it has {size} bytes, more than {_MAX_BYTES}")
        with np.load(io.BytesIO(content), allow_pickle=False) as arrays:
            values = [_array(arrays, name, columns) for name, columns in _COLUMNS.items()]
        if not len(values[0]):
            raise ValueError("it has no nodes")
        slam.restore(*values)  # pyright: ignore[reportArgumentType]  # arrays of two types
    except OSError as error:
        raise UsageError(f"{path}: {error.strerror}") from None
    except (zipfile.BadZipFile, zlib.error, NotImplementedError):
        why = "not a pose graph of this program; those of the original slam_toolbox cannot be read"
        raise UsageError(f"{path}: {why}") from None
    except (ValueError, KeyError, EOFError, TypeError, MemoryError) as error:
        raise UsageError(f"{path}: damaged: {error}") from None


def _array(arrays: "NpzFile", name: str, columns: int | None) -> NDArray[np.float64] | NDArray[np.int64]:
    array = arrays[name]
    kind, is_fitting = (
        (np.int64, array.ndim == 1) if columns is None else (np.float64, array.ndim == 2 and array.shape[1] == columns)
    )
    if array.dtype != kind or not is_fitting:
        raise ValueError(f"array {name!r} has type {array.dtype} and shape {array.shape}")
    return np.ascontiguousarray(array)


def _path(name: Path) -> Path:
    return name if name.suffix == _SUFFIX else name.with_name(name.name + _SUFFIX)
