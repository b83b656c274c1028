"""Samples of a bag that a page compares with, for its client: poses of frames in their root, and topics' numbers."""

import math
import re
from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.ros import FramePoses, RecordedNumbers, TopicNumbers
from trundle.spatial import compose_rows

from ..world.reference import ReferenceTopic
from .comparison import frame_trajectory

_Array = NDArray[np.float64]
_RATE_HZ = 50.0
_MAX_BYTES = 32 * 1024 * 1024
"""Limits of the number of poses and of topics' numbers; clients get fewer samples of a longer recording."""
_MAX_ELEMENTS = 64
"""Limit of an array's numbers, of which plots show a few at most."""
_ELEMENT = re.compile(r"\[[^\]]*\]$")
_XYZ_XYZW = [0, 1, 2, 4, 5, 6, 3]
"""Order of a pose's numbers on the wire, as indices into x y z qw qx qy qz."""


class ReferenceSamples(Struct, frozen=True, eq=False, kw_only=True):
    """Content of a recording's file for clients, and what is in it."""

    root: str
    """Frame of the poses; empty without frames."""
    frames: tuple[str, ...]
    topics: tuple[ReferenceTopic, ...]
    samples: int
    data: bytes


def reference_samples(recorded: RecordedNumbers) -> ReferenceSamples:
    """Return the samples of a bag; of several trees of frames, the largest one's."""
    parents = {frame.child: frame for frame in recorded.frames}
    roots = {child: _root(child, parents) for child in parents}
    root = max(Counter(roots.values()).items(), key=lambda item: item[1], default=("", 0))[0]
    frames = tuple(child for child, top in roots.items() if top == root) if root else ()
    count = min(round(recorded.duration * _RATE_HZ) + 1, _MAX_BYTES // (28 * max(1, len(frames))))
    times = np.linspace(0.0, recorded.duration, max(1, count))
    poses = _poses_in_root(frames, parents, times, recorded.start)
    topics, numbers = _packed_topics(recorded)
    return ReferenceSamples(
        root=root,
        frames=frames,
        topics=topics,
        samples=len(times),
        data=times.astype("<f8").tobytes() + numbers + poses[..., _XYZ_XYZW].astype("<f4").tobytes(),
    )


def _root(frame: str, parents: Mapping[str, FramePoses]) -> str:
    """Return a frame's root; empty for a loop."""
    for _ in range(len(parents) + 1):
        above = parents.get(frame)
        if above is None:
            return frame
        frame = above.parent
    return ""


def _poses_in_root(
    frames: Sequence[str], parents: Mapping[str, FramePoses], times: _Array, start: float
) -> NDArray[np.float64]:
    """Return (times, frames, 7): poses in the root, held before a frame's first transform and after its last."""
    found: dict[str, _Array] = {}
    for frame in frames:
        chain: list[FramePoses] = []
        while frame in parents and frame not in found:
            chain.append(parents[frame])
            frame = parents[frame].parent
        for step in reversed(chain):
            poses = frame_trajectory(step, start).at(times)[0][:, 0]
            poses[:, 3:] /= np.linalg.norm(poses[:, 3:], axis=1, keepdims=True)
            above = found.get(step.parent)
            found[step.child] = poses if above is None else compose_rows(above, poses)
    return np.stack([found[frame] for frame in frames], axis=1) if frames else np.empty((len(times), 0, 7))


def _packed_topics(recorded: RecordedNumbers) -> tuple[tuple[ReferenceTopic, ...], bytes]:
    """Return the topics that plots can show, and their bytes as `ReferenceInfo.url` describes them."""
    columns = [_plotted(numbers) for numbers in recorded.numbers]
    size = sum(8 * len(numbers.times) * (1 + len(at)) for numbers, at in zip(recorded.numbers, columns, strict=True))
    step = max(1, math.ceil(size / _MAX_BYTES))
    topics: list[ReferenceTopic] = []
    pieces: list[bytes] = []
    for numbers, at in zip(recorded.numbers, columns, strict=True):
        if at:
            times = numbers.times[::step] - recorded.start
            paths = tuple(numbers.layout.paths[column] for column in at)
            topics.append(ReferenceTopic(topic=numbers.topic, samples=len(times), paths=paths))
            pieces += (times.astype("<f8").tobytes(), numbers.values[::step, at].astype("<f8").tobytes())
    return tuple(topics), b"".join(pieces)


def _plotted(numbers: TopicNumbers) -> list[int]:
    """Return the columns of a topic's numbers, without those of long arrays."""
    arrays = [_ELEMENT.sub("[]", path) for path in numbers.layout.paths]
    lengths = Counter(arrays)
    return [at for at, name in enumerate(arrays) if not name.endswith("[]") or lengths[name] <= _MAX_ELEMENTS]
