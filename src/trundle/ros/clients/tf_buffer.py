"""tf buffer: ten seconds of transforms per frame, looked up by frame and time."""

import math

from trundle.spatial import IDENTITY_QUATERNION, NS_PER_S

from ..errors import TransformError
from .transform_history import StaticTransform, Transform
from .transform_tree import TransformTree


class TransformBuffer:
    """Transform history with lookup between any two frames.

    More lenient than tf2: leading slashes of frame names are stripped, and quaternions of any length normalized.
    """

    def __init__(self, cache_s: float = 10.0) -> None:
        self._tree = TransformTree(round(cache_s * NS_PER_S))

    def set_transform(self, transform: Transform, *, static: bool = False) -> bool:
        """Add a transform; False if it is not finite, parent equals child, or its stamp is too old or a duplicate."""
        parent, child = _frame_name(transform.parent), _frame_name(transform.child)
        norm = math.hypot(*transform.rotation)
        if not parent or not child or parent == child or not math.isfinite(norm + sum(transform.translation)):
            return False
        # Normalize float32 quaternions; all zeros, as some publishers send, mean the identity.
        w, x, y, z = (v / norm for v in transform.rotation) if norm > 0 else IDENTITY_QUATERNION
        return self._tree.add(
            Transform(
                parent=parent,
                child=child,
                stamp_ns=transform.stamp_ns,
                translation=transform.translation,
                rotation=(w, x, y, z),
            ),
            static=static,
        )

    def lookup_transform(self, target: str, source: str, stamp_ns: int = 0) -> Transform:
        """Return the transform with parent `target` and child `source`.

        Args:
            target: parent frame of the result.
            source: child frame of the result.
            stamp_ns: time [ns]; 0: latest common time of the chain.

        Raises:
            TransformError: a frame is unknown, the two are not connected, or the time is outside the history.
        """
        target, source = self._checked(target, source)
        stamp_ns, pose = self._tree.lookup(target, source, stamp_ns)
        return Transform(
            parent=target, child=source, stamp_ns=stamp_ns, translation=pose.position, rotation=pose.quaternion
        )

    def path(self, target: str, source: str) -> list[str]:
        """List the frames from `target` to `source`, inclusive.

        Raises:
            TransformError: a frame is unknown, or the two are not connected.
        """
        target, source = self._checked(target, source)
        return self._tree.chain(source, target, 0)

    def can_transform(self, target: str, source: str, stamp_ns: int = 0) -> bool:
        """True if a lookup would succeed."""
        try:
            self.lookup_transform(target, source, stamp_ns)
        except TransformError:
            return False
        return True

    def frames(self) -> dict[str, str | None]:
        """All frames with transforms → parent; None for roots."""
        latest = [history.latest for history in self._tree.histories.values()]
        parents: dict[str, str | None] = {
            transform.child: transform.parent for transform in latest if transform is not None
        }
        return parents | {parent: None for parent in parents.values() if parent is not None and parent not in parents}

    def latest(self, child: str) -> Transform | None:
        """Newest transform of a frame in its parent."""
        history = self._tree.histories.get(_frame_name(child))
        return None if history is None else history.latest

    def is_static(self, child: str) -> bool:
        """True if the frame's transform is static."""
        return isinstance(self._tree.histories.get(_frame_name(child)), StaticTransform)

    def clear(self) -> None:
        """Drop all but static transforms, as when time jumps back; static ones are sent only once."""
        self._tree.clear()

    def _checked(self, target: str, source: str) -> tuple[str, str]:
        """Strip leading slashes, and check that the frames exist."""
        target, source = _frame_name(target), _frame_name(source)
        self._tree.check_frame(target, "lookupTransform", "target_frame")
        self._tree.check_frame(source, "lookupTransform", "source_frame")
        return target, source


def _frame_name(name: str) -> str:
    """Strip the leading slash allowed in tf1."""
    return name.removeprefix("/")
