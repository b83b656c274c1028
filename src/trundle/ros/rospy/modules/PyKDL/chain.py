"""Serial chain of segments."""

from .frame import Frame
from .joint import NO_NAME, Joint
from .screws import Twist

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from typing import Any


class Segment:
    """A joint and a rigid body from it to the tip, where the next segment starts."""

    def __init__(self, *arguments: "Any") -> None:
        """A copy, or [name], joint, pose of the tip; an inertia has no effect."""
        if len(arguments) == 1 and isinstance(arguments[0], Segment):
            vars(self).update(vars(arguments[0]))
            return
        remaining = list(arguments)
        self._name = remaining.pop(0) if remaining and isinstance(remaining[0], str) else NO_NAME
        self._joint = Joint(remaining.pop(0)) if remaining else Joint()
        tip = Frame(remaining.pop(0)) if remaining else Frame()
        self._tip = self._joint.pose(0.0).Inverse() * tip

    def getName(self) -> str:
        """Name."""
        return self._name

    def getJoint(self) -> Joint:
        """Joint."""
        return self._joint

    def getFrameToTip(self) -> Frame:
        """Pose of the tip at the joint's value 0."""
        return self._joint.pose(0.0) * self._tip

    def pose(self, q: float) -> Frame:
        """Pose of the tip, at the joint's value q."""
        return self._joint.pose(q) * self._tip

    def twist(self, q: float, qdot: float) -> Twist:
        """Velocity of the tip, at the joint's value q and rate qdot."""
        return self._joint.twist(qdot).RefPoint(self._joint.pose(q).M * self._tip.p)


class Chain:
    """Segments, each at the tip of the previous one."""

    def __init__(self, other: "Chain | None" = None) -> None:
        """No segments, or a copy."""
        self._segments: list[Segment] = [] if other is None else list(other._segments)

    def addSegment(self, segment: Segment) -> None:
        """Add a segment at the tip."""
        self._segments.append(Segment(segment))

    def addChain(self, chain: "Chain") -> None:
        """Add another chain's segments at the tip."""
        self._segments.extend(list(chain._segments))

    def getNrOfSegments(self) -> int:
        """Count of segments."""
        return len(self._segments)

    def getNrOfJoints(self) -> int:
        """Count of joints that move."""
        return sum(segment.getJoint().getType() != Joint.Fixed for segment in self._segments)

    def getSegment(self, nr: int) -> Segment:
        """Segment by its number, from 0."""
        return self._segments[nr]
