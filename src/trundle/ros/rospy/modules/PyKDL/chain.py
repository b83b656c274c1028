"""Serial chain of segments."""

from .frame import Frame
from .joint import NO_NAME, Joint


class Segment:
    """A joint, and a rigid body from it to the tip, on which the next segment stands."""

    def __init__(self, *arguments):
        """A copy, or [name], joint, pose of the tip; an inertia has no effect."""
        if len(arguments) == 1 and isinstance(arguments[0], Segment):
            vars(self).update(vars(arguments[0]))
            return
        given = list(arguments)
        self._name = given.pop(0) if given and isinstance(given[0], str) else NO_NAME
        self._joint = Joint(given.pop(0)) if given else Joint()
        tip = Frame(given.pop(0)) if given else Frame()
        self._tip = self._joint.pose(0.0).Inverse() * tip

    def getName(self):
        """Name."""
        return self._name

    def getJoint(self):
        """Joint."""
        return self._joint

    def getFrameToTip(self):
        """Pose of the tip at the joint's value 0."""
        return self._joint.pose(0.0) * self._tip

    def pose(self, q):
        """Pose of the tip, at the joint's value q."""
        return self._joint.pose(q) * self._tip

    def twist(self, q, qdot):
        """Velocity of the tip, at the joint's value q and rate qdot."""
        return self._joint.twist(qdot).RefPoint(self._joint.pose(q).M * self._tip.p)


class Chain:
    """Segments, each on the tip of the one before."""

    def __init__(self, other=None):
        """No segments, or a copy."""
        self._segments = [] if other is None else list(other._segments)

    def addSegment(self, segment):
        """Add a segment at the tip."""
        self._segments.append(Segment(segment))

    def addChain(self, chain):
        """Add another chain's segments at the tip."""
        self._segments.extend(list(chain._segments))

    def getNrOfSegments(self):
        """Count of segments."""
        return len(self._segments)

    def getNrOfJoints(self):
        """Count of joints that move."""
        return sum(segment.getJoint().getType() != Joint.Fixed for segment in self._segments)

    def getSegment(self, nr):
        """Segment by its number, from 0."""
        return self._segments[nr]
