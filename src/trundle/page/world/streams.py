"""Contents of the mailboxes between a simulation and the page's server: raw arrays behind a small header."""

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
DROPS = "trundle/drops"
PEOPLE = "trundle/people"
LANES = "trundle/lanes"
TERMINAL = "trundle/terminal/"
"""Before the number of a node's terminal."""

ARRAY_HEADER = struct.Struct("<QII")
"""Time [ns], generation of the world, rows: before the poses, (bodies, 7) f64, the joints, (joints, 3) f64, and the
contacts, (contacts, 9) f64."""
IMAGE_HEADER = struct.Struct("<QIII")
"""Time [ns], height, width, channels, before the pixels."""
SERIES_HEADER = struct.Struct("<QI")
"""Number of the first row and length of the JSON that follows, before the rows (rows, 1 + series) f64."""
TERMINAL_HEADER = struct.Struct("<QHH")
"""Number of the first byte of the output that follows, columns, rows."""
LINES_HEADER = struct.Struct("<QI")
"""Time [ns] and number of lines."""
LINE_KIND = struct.Struct("<4BII")
"""RGBA, kind, number of points; behind the id, before the points (points, 3) f32."""


class TimelineSpan(msgspec.Struct, frozen=True):
    """Extent of a recorded run."""

    start_ns: int
    end_ns: int


class Recording(msgspec.Struct, frozen=True):
    """A recording that runs."""

    since_ns: int


class ClockState(msgspec.Struct, frozen=True, kw_only=True):
    """The clock and its controls."""

    time_ns: int
    paused: bool
    real_time_factor: float | None = None
    """None: not known, or paused."""
    speed: float | None = 1.0
    """Wanted multiple of real time; None: as fast as possible."""
    timeline: TimelineSpan | msgspec.UnsetType = msgspec.UNSET
    """Given for a recorded run."""
    recording: Recording | msgspec.UnsetType | None = msgspec.UNSET
    """Given where the run can be recorded; None: it is not."""


class SeriesHead(msgspec.Struct, frozen=True, kw_only=True):
    """Columns of plotted values behind their time."""

    names: tuple[str, ...]
    units: tuple[str, ...]
    faults: Mapping[str, str]
    """Name → sentence that says why it has no values."""


LineKind: TypeAlias = Literal["strip", "pairs", "points"]
_KINDS: tuple[LineKind, ...] = ("strip", "pairs", "points")
"""By their number on the wire."""


class Line(msgspec.Struct, frozen=True, kw_only=True):
    """A drawn line, or points."""

    id: str
    rgba: tuple[int, int, int, int]
    """0 to 255."""
    points: NDArray[np.float32]
    """(points, 3) in the world frame [m]."""
    kind: LineKind = "strip"
    """Pairs are lines from each even point to the next."""


def line_pieces(time_ns: int, lines: tuple[Line, ...]) -> list[bytes]:
    """Encode lines as `trundle.lines`."""
    pieces = [LINES_HEADER.pack(time_ns, len(lines))]
    for line in lines:
        name = line.id.encode()
        points = np.ascontiguousarray(line.points, dtype="<f4")
        kind = LINE_KIND.pack(*line.rgba, _KINDS.index(line.kind), len(points))
        pieces += (len(name).to_bytes(4, "little"), name, kind, points.tobytes())
    return pieces
