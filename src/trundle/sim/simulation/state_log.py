"""State logs: link poses and joint positions over time, in a file that stays readable when truncated.

The file is one line of JSON (the names, the world as SDF), then rows of little-endian float64 of equal length: time
[s], x y z qw qx qy qz of every link in the world, position of every joint's first axis. From Python:

    log = read_state_log("run.log")
    log.poses[-1, log.links.index("rp2w::chassis")]

or, without Trundle, `numpy.fromfile` after the first line.
"""

import contextlib
import json
from pathlib import Path
from typing import IO, TYPE_CHECKING

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.base.diagnostics import DescriptionError, Source
from trundle.base.file_lock import FileLock
from trundle.base.files import open_file

from .state_log_format import FORMAT

if TYPE_CHECKING:  # reading a log needs no physics
    from .snapshot import Snapshot

_ROW = np.dtype("<f8")
_LONGEST_HEADER = 256 * 1024 * 1024
_LARGEST = 1e12
"""Largest number in a log [s, m, rad]; the float32 numbers of glTF hold it and its square."""
_TOLERANCE = 0.01
"""Tolerance of a quaternion's squared length."""
_Array = NDArray[np.float64]


class StateRecorder:
    """Hook that writes a row when it is due."""

    period_ns = 20_000_000

    def __init__(self, path: Path, *, links: tuple[str, ...], joints: tuple[str, ...], sdf: str) -> None:
        """Create the file; an existing one is overwritten.

        Args:
            path: path of the file.
            links: `model::link`, in the order of `Snapshot.poses`.
            joints: `model::joint`, in the order of `Snapshot.joint_positions`.
            sdf: the world, for playback.

        Raises:
            OSError: the file cannot be written, or another program writes it.
        """
        self._path = path
        self._lock = FileLock(path)
        try:
            self._file: IO[bytes] = path.open("wb")
        except OSError:
            self._lock.release()
            raise
        header = {"format": FORMAT, "links": links, "joints": joints, "sdf": sdf}
        self._write(json.dumps(header).encode() + b"\n")

    def after_step(self, snapshot: "Snapshot") -> None:
        """Write a row.

        Raises:
            OSError: the file cannot be written; it is closed.
        """
        time = np.array([snapshot.time_ns / 1e9])
        row = np.concatenate([time, snapshot.poses.reshape(-1), snapshot.joint_positions])
        self._write(row.astype(_ROW).tobytes())

    def close(self) -> None:
        """Close the file."""
        self._file.close()
        self._lock.release()

    def _write(self, data: bytes) -> None:
        try:
            self._file.write(data)
            self._file.flush()
            self._path.stat()  # a deleted file accepts data, which is then lost
        except OSError as error:
            with contextlib.suppress(OSError):  # the flush fails as the write did
                self.close()
            raise OSError(error.errno, error.strerror, str(self._path)) from None


class StateLog(Struct, frozen=True, eq=False, kw_only=True):
    """Contents of a state log."""

    __module__ = "trundle"

    links: tuple[str, ...]
    joints: tuple[str, ...]
    sdf: str
    times_s: _Array
    """(rows,) [s]"""
    poses: _Array
    """(rows, links, 7) x y z [m], qw qx qy qz, in the world."""
    positions: _Array
    """(rows, joints) [rad or m]"""


def read_state_log(file: Path | str) -> StateLog:
    """Read a state log, without an incomplete last row.

    Raises:
        DescriptionError: the file is not a state log, or a row is damaged.
        OSError: the file cannot be read.
    """
    path = Path(file)
    with open_file(path) as stream:
        line = stream.readline(_LONGEST_HEADER)
        start = stream.tell()
    try:
        header = json.loads(line)
        links, joints, sdf = tuple(map(str, header["links"])), tuple(map(str, header["joints"])), str(header["sdf"])
        is_state_log = header["format"] == FORMAT
    except (ValueError, TypeError, KeyError, RecursionError):
        is_state_log, links, joints, sdf = False, (), (), ""
    if not is_state_log:
        raise DescriptionError(Source(str(path), 1), f"not a state log: the file does not begin with {FORMAT!r}")
    width = 1 + 7 * len(links) + len(joints)
    count = (path.stat().st_size - start) // (width * _ROW.itemsize)
    rows = np.fromfile(path, dtype=_ROW, offset=start, count=count * width).reshape(count, width).astype(np.float64)
    poses = rows[:, 1 : 1 + 7 * len(links)].reshape(count, len(links), 7)
    damaged = np.flatnonzero(~_are_states(rows, poses))
    if damaged.size:
        problem = f"row {damaged[0] + 1} of {count} is damaged: it holds no time with poses and positions"
        raise DescriptionError(Source(str(path)), problem)
    return StateLog(
        links=links,
        joints=joints,
        sdf=sdf,
        times_s=rows[:, 0],
        poses=poses,
        positions=rows[:, 1 + 7 * len(links) :],
    )


def _are_states(rows: _Array, poses: _Array) -> NDArray[np.bool_]:
    """Return for each row whether it can be a state of a world: bounded numbers, unit quaternions."""
    bounded = (np.abs(rows) <= _LARGEST).all(axis=1)  # False for NaN, too
    with np.errstate(invalid="ignore"):
        squares = np.square(np.clip(poses[:, :, 3:], -2.0, 2.0)).sum(axis=2)
    return bounded & (np.abs(squares - 1.0) < _TOLERANCE).all(axis=1)
