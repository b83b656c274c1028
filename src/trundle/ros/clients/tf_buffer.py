"""tf buffer: ten seconds of transforms per frame, interpolated."""

import math
from bisect import bisect_left, insort
from dataclasses import dataclass

from trundle.spatial import IDENTITY_QUATERNION, NS_PER_S, ZERO, Pose, Quaternion, Vector3, slerp

from ..errors import TransformError

_MAX_DEPTH = 1000
"""Limit of a frame's ancestors, to detect loops; the same in tf2."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Transform:
    """Pose of `child` in `parent` at one time."""

    parent: str
    child: str
    stamp_ns: int = 0
    """ROS time [ns]; 0 in a lookup's result if the whole chain is static."""
    translation: Vector3 = ZERO
    """[m], in `parent`."""
    rotation: Quaternion = IDENTITY_QUATERNION
    """(w, x, y, z)."""

    @property
    def pose(self) -> Pose:
        """`parent_from_child`."""
        return Pose(self.translation, self.rotation)


class TransformBuffer:
    """Transform history with lookup between any two frames.

    Leading slashes of frame names are stripped, as in tf2.
    """

    def __init__(self, cache_s: float = 10.0) -> None:
        self._cache_ns = round(cache_s * NS_PER_S)
        self._static: dict[str, Transform] = {}
        self._moving: dict[str, list[Transform]] = {}
        """Child → its transforms, oldest first."""

    def set_transform(self, transform: Transform, *, static: bool = False) -> bool:
        """Add a transform; False if rejected (older than the cache, not finite, or parent equals child)."""
        parent, child = frame_name(transform.parent), frame_name(transform.child)
        norm = math.hypot(*transform.rotation)
        if not parent or not child or parent == child or not math.isfinite(norm + sum(transform.translation)):
            return False
        # Normalize float32 quaternions; all zeros, as some publishers send, mean the identity.
        rotation = tuple(v / norm for v in transform.rotation) if norm > 0 else IDENTITY_QUATERNION
        clean = Transform(
            parent=parent,
            child=child,
            stamp_ns=transform.stamp_ns,
            translation=transform.translation,
            rotation=(rotation[0], rotation[1], rotation[2], rotation[3]),
        )
        if static:
            self._moving.pop(child, None)
            self._static[child] = clean
            return True
        history = self._moving.setdefault(child, [])
        if history and clean.stamp_ns < history[-1].stamp_ns - self._cache_ns:
            return False
        at = bisect_left(history, clean.stamp_ns, key=_stamp)
        if at < len(history) and history[at].stamp_ns == clean.stamp_ns:
            history[at] = clean
        else:
            insort(history, clean, key=_stamp)
        self._static.pop(child, None)
        expired = bisect_left(history, history[-1].stamp_ns - self._cache_ns, key=_stamp)
        del history[:expired]
        return True

    def lookup_transform(self, target: str, source: str, stamp_ns: int = 0) -> Transform:
        """Return the transform with parent `target` and child `source`.

        Args:
            target: parent frame of the result.
            source: child frame of the result.
            stamp_ns: time [ns]; 0: latest common time of the chain.

        Raises:
            TransformError: a frame is unknown, the two are not connected, or the time is outside the history.
        """
        target, source = frame_name(target), frame_name(source)
        up_target, up_source, common = self._paths_to_common_ancestor(target, source)
        below = [*up_source[: up_source.index(common)], *up_target[: up_target.index(common)]]
        if stamp_ns == 0:
            stamp_ns = min((self._moving[frame][-1].stamp_ns for frame in below if frame in self._moving), default=0)
        common_from_source = self._compose(source, common, stamp_ns)
        common_from_target = self._compose(target, common, stamp_ns)
        found = common_from_target.inverse() @ common_from_source
        return Transform(
            parent=target, child=source, stamp_ns=stamp_ns, translation=found.position, rotation=found.quaternion
        )

    def path(self, target: str, source: str) -> list[str]:
        """List the frames from `target` to `source`, inclusive.

        Raises:
            TransformError: a frame is unknown, or the two are not connected.
        """
        target, source = frame_name(target), frame_name(source)
        up_target, up_source, common = self._paths_to_common_ancestor(target, source)
        down = up_source[: up_source.index(common)]
        return [*up_target[: up_target.index(common) + 1], *reversed(down)]

    def can_transform(self, target: str, source: str, stamp_ns: int = 0) -> bool:
        """True if a lookup would succeed."""
        try:
            self.lookup_transform(target, source, stamp_ns)
        except TransformError:
            return False
        return True

    def frames(self) -> dict[str, str | None]:
        """All frames → parent; None for roots."""
        parents: dict[str, str | None] = {child: history[-1].parent for child, history in self._moving.items()}
        parents.update({child: transform.parent for child, transform in self._static.items()})
        for parent in list(parents.values()):
            if parent is not None:
                parents.setdefault(parent, None)
        return parents

    def latest(self, child: str) -> Transform | None:
        """Newest transform of a frame in its parent."""
        name = frame_name(child)
        history = self._moving.get(name)
        return history[-1] if history else self._static.get(name)

    def is_static(self, child: str) -> bool:
        """True if the frame's transform is static."""
        return frame_name(child) in self._static

    def clear(self) -> None:
        """Drop all but static transforms, as when time jumps back; static ones are sent only once."""
        self._moving.clear()

    def _paths_to_common_ancestor(self, target: str, source: str) -> tuple[list[str], list[str], str]:
        """Chains of both frames up to their roots, and the first common ancestor."""
        up_target, up_source = self._chain(target, "target"), self._chain(source, "source")
        common = next((frame for frame in up_source if frame in up_target), None)
        if common is None:
            raise TransformError(
                f"Could not find a connection between '{target}' and '{source}' because they are not part of the "
                f"same tree.Tf has two or more unconnected trees."
            )
        return up_target, up_source, common

    def _chain(self, frame: str, argument: str) -> list[str]:
        """Frame and ancestors up to the root; `argument` names the frame in errors."""
        parents = self._parent
        if parents(frame) is None and not self._is_parent(frame):
            raise TransformError(f'"{frame}" passed to lookupTransform argument {argument}_frame does not exist. ')
        chain = [frame]
        while (parent := parents(chain[-1])) is not None:
            chain.append(parent)
            if len(chain) > _MAX_DEPTH:
                raise TransformError(f"The tf tree is invalid because it contains a loop through '{frame}'.")
        return chain

    def _parent(self, frame: str) -> str | None:
        transform = self.latest(frame)
        return transform.parent if transform is not None else None

    def _is_parent(self, frame: str) -> bool:
        return frame in self.frames()

    def _compose(self, frame: str, ancestor: str, stamp_ns: int) -> Pose:
        """Pose of a frame in an ancestor of now; the parents at that time may have been others."""
        pose = Pose()
        for _ in range(_MAX_DEPTH):
            if frame == ancestor:
                return pose
            step = self._static.get(frame) or self._transform_at(frame, stamp_ns)
            pose = step.pose @ pose
            frame = step.parent
        raise TransformError(f"The tf tree is invalid because it contains a loop through '{frame}'.")

    def _transform_at(self, frame: str, stamp_ns: int) -> Transform:
        history = self._moving.get(frame)
        if history is None:
            raise TransformError(f"At time {stamp_ns / NS_PER_S:.9f} '{frame}' had no parent")
        at = bisect_left(history, stamp_ns, key=_stamp)
        if at < len(history) and history[at].stamp_ns == stamp_ns:
            return history[at]
        if at == 0 or at == len(history):
            first, last = history[0].stamp_ns / NS_PER_S, history[-1].stamp_ns / NS_PER_S
            where = "past" if at == 0 else "future"
            raise TransformError(
                f"Lookup would require extrapolation into the {where}. Requested time {stamp_ns / NS_PER_S:.9f} but "
                f"the data of '{frame}' is from {first:.9f} to {last:.9f}"
            )
        before, after = history[at - 1], history[at]
        if before.parent != after.parent:
            return before
        share = (stamp_ns - before.stamp_ns) / (after.stamp_ns - before.stamp_ns)
        return _interpolate(before, after, share, stamp_ns)


def frame_name(name: str) -> str:
    """Strip the leading slash allowed in tf1."""
    return name.removeprefix("/")


def _stamp(transform: Transform) -> int:
    return transform.stamp_ns


def _interpolate(a: Transform, b: Transform, share: float, stamp_ns: int) -> Transform:
    position = tuple(x + (y - x) * share for x, y in zip(a.translation, b.translation, strict=True))
    return Transform(
        parent=a.parent,
        child=a.child,
        stamp_ns=stamp_ns,
        translation=(position[0], position[1], position[2]),
        rotation=slerp(a.rotation, b.rotation, share),
    )
