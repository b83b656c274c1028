"""Transforms of one frame over time, interpolated as in tf2."""

from bisect import bisect_left

from msgspec import Struct

from trundle.spatial import IDENTITY_QUATERNION, NS_PER_S, ZERO, Pose, Quaternion, Vector3, slerp

from ..errors import ExtrapolationError


class Transform(Struct, frozen=True, kw_only=True):
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


class TransformHistory:
    """Transforms of a moving frame, of the last `cache_ns`."""

    def __init__(self, cache_ns: int) -> None:
        self._cache_ns = cache_ns
        self._stamps: list[int] = []
        self._transforms: list[Transform] = []
        """Oldest first, each stamp once."""

    def add(self, transform: Transform) -> bool:
        """Insert a transform; False if it is older than the cache, or its stamp is a duplicate."""
        stamps, transforms = self._stamps, self._transforms
        stamp = transform.stamp_ns
        if not stamps or stamp > stamps[-1]:
            stamps.append(stamp)
            transforms.append(transform)
        else:
            index = bisect_left(stamps, stamp)
            if stamp + self._cache_ns < stamps[-1] or stamps[index] == stamp:
                return False
            stamps.insert(index, stamp)
            transforms.insert(index, transform)
        expired = bisect_left(stamps, stamps[-1] - self._cache_ns)
        if expired:
            del stamps[:expired], transforms[:expired]
        return True

    def transform_at(self, stamp_ns: int) -> Transform | None:
        """Interpolated transform at a time [ns], 0 for the latest; None if the history is empty.

        Raises:
            ExtrapolationError: the time is outside the history.
        """
        stamps, transforms = self._stamps, self._transforms
        if not stamps:
            return None
        if stamp_ns in (0, stamps[-1]):
            return transforms[-1]
        if len(stamps) == 1:
            raise ExtrapolationError(
                f"Lookup would require extrapolation at time {_seconds(stamp_ns)}, "
                f"but only time {_seconds(stamps[0])} is in the buffer"
            )
        if stamp_ns > stamps[-1]:
            raise _outside(stamp_ns, stamps[-1], "future", "latest")
        if stamp_ns < stamps[0]:
            raise _outside(stamp_ns, stamps[0], "past", "earliest")
        index = bisect_left(stamps, stamp_ns)
        if stamps[index] == stamp_ns:
            return transforms[index]
        before, after = transforms[index - 1], transforms[index]
        return before if before.parent != after.parent else _interpolate(before, after, stamp_ns)

    @property
    def latest(self) -> Transform | None:
        """Newest transform."""
        return self._transforms[-1] if self._transforms else None

    @property
    def newest_stamp(self) -> int:
        """[ns]; 0 if the history is empty."""
        return self._stamps[-1] if self._stamps else 0

    @property
    def oldest_stamp(self) -> int:
        """[ns]; 0 if the history is empty."""
        return self._stamps[0] if self._stamps else 0

    def __len__(self) -> int:
        """Return the number of transforms."""
        return len(self._stamps)

    def clear(self) -> None:
        """Drop all transforms."""
        self._stamps.clear()
        self._transforms.clear()


class StaticTransform:
    """History of a static frame: one transform, valid at every time."""

    newest_stamp = 0
    """A static frame does not bound a common time."""
    oldest_stamp = 0

    def __init__(self) -> None:
        self.latest: Transform | None = None

    def add(self, transform: Transform) -> bool:
        """Replace the transform; always True."""
        self.latest = transform
        return True

    def transform_at(self, stamp_ns: int) -> Transform | None:
        """Return the transform, with its own stamp."""
        del stamp_ns
        return self.latest

    def __len__(self) -> int:
        """Return 1 once the transform is set."""
        return int(self.latest is not None)

    def clear(self) -> None:
        """Keep the transform: static ones are sent only once."""


def _interpolate(before: Transform, after: Transform, stamp_ns: int) -> Transform:
    """Linear in translation, spherical in rotation."""
    ratio = (stamp_ns - before.stamp_ns) / (after.stamp_ns - before.stamp_ns)
    (ax, ay, az), (bx, by, bz) = before.translation, after.translation
    return Transform(
        parent=before.parent,
        child=before.child,
        stamp_ns=stamp_ns,
        translation=(ax + (bx - ax) * ratio, ay + (by - ay) * ratio, az + (bz - az) * ratio),
        rotation=slerp(before.rotation, after.rotation, ratio),
    )


def _outside(stamp_ns: int, bound_ns: int, direction: str, bound: str) -> ExtrapolationError:
    return ExtrapolationError(
        f"Lookup would require extrapolation {_seconds(abs(stamp_ns - bound_ns))}s into the {direction}.  "
        f"Requested time {_seconds(stamp_ns)} but the {bound} data is at time {_seconds(bound_ns)}"
    )


def _seconds(stamp_ns: int) -> str:
    """Format a time to the nanosecond."""
    sign = "-" if stamp_ns < 0 else ""
    return f"{sign}{abs(stamp_ns) // NS_PER_S}.{abs(stamp_ns) % NS_PER_S:09d}"
