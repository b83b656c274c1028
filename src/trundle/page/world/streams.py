"""Messages in the mailboxes between a simulation and the page's server: a small header, then raw arrays."""

import struct
from collections.abc import Mapping
from typing import Literal, TypeAlias

import msgspec
import numpy as np
from numpy.typing import NDArray

SESSION = "trundle/session"
WORLD = "trundle/world"
POSES = "trundle/poses"
JOINTS = "trundle/joints"
STATE = "trundle/state"
LINES = "trundle/lines"
CONTACTS = "trundle/contacts"
RANGES = "trundle/ranges"
SERIES = "trundle/series"
PERFORMANCE = "trundle/performance"
DIFFERENCES = "trundle/differences"
REFERENCE = "trundle/reference"
DROPS = "trundle/drops"
PEOPLE = "trundle/people"
LANES = "trundle/lanes"
TERMINAL = "trundle/terminal/"
"""Prefix of the number of a node's terminal."""

ARRAY_HEADER = struct.Struct("<QII")
"""Time [ns], generation of the world, number of rows; followed by poses, (bodies, 7) f64, joints, (joints, 3) f64, or
contacts, (contacts, 9) f64."""
IMAGE_HEADER = struct.Struct("<QIII")
"""Time [ns], height, width, channels; followed by the pixels."""
SERIES_HEADER = struct.Struct("<QI")
"""Number of the first row, length of the JSON; followed by the JSON and the rows, (rows, 1 + series) f64."""
TERMINAL_HEADER = struct.Struct("<QHH")
"""Number of the output's first byte, columns, rows; followed by the output."""
LINES_HEADER = struct.Struct("<QI")
"""Time [ns] and number of lines."""
LINE_KIND = struct.Struct("<4BII")
"""RGBA, kind, number of points; after the id, followed by the points, (points, 3) f32."""


class TimelineSpan(msgspec.Struct, frozen=True):
    """Extent of a recorded run."""

    start_ns: int
    end_ns: int


class Recording(msgspec.Struct, frozen=True):
    """Running recording."""

    since_ns: int


class ClockState(msgspec.Struct, frozen=True, kw_only=True):
    """Clock and its controls."""

    time_ns: int
    paused: bool
    real_time_factor: float | None = None
    """None: unknown, or paused."""
    speed: float | None = 1.0
    """Requested multiple of real time; None: as fast as possible."""
    timeline: TimelineSpan | msgspec.UnsetType = msgspec.UNSET
    """Unset: no recorded run."""
    recording: Recording | msgspec.UnsetType | None = msgspec.UNSET
    """Unset: the run cannot be recorded; None: it is not being recorded."""


class SeriesHead(msgspec.Struct, frozen=True, kw_only=True):
    """Columns of plotted values, after the time."""

    names: tuple[str, ...]
    units: tuple[str, ...]
    faults: Mapping[str, str]
    """Name → reason why it has no values."""


LineKind: TypeAlias = Literal["strip", "pairs", "points"]
_KINDS: tuple[LineKind, ...] = ("strip", "pairs", "points")
"""Kinds in the order of their numbers on the wire."""


class Line(msgspec.Struct, frozen=True, kw_only=True):
    """Line strip, pairs of points or point cloud."""

    id: str
    rgba: tuple[int, int, int, int]
    """0 to 255."""
    points: NDArray[np.float32]
    """(points, 3) in the world frame [m]."""
    kind: LineKind = "strip"
    """`pairs`: lines from each even point to the next."""


def line_pieces(time_ns: int, lines: tuple[Line, ...]) -> list[bytes]:
    """Encode lines as `trundle.lines`."""
    pieces = [LINES_HEADER.pack(time_ns, len(lines))]
    for line in lines:
        name = line.id.encode()
        points = np.ascontiguousarray(line.points, dtype="<f4")
        kind = LINE_KIND.pack(*line.rgba, _KINDS.index(line.kind), len(points))
        pieces += (len(name).to_bytes(4, "little"), name, kind, points.tobytes())
    return pieces
