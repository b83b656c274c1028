"""Forward kinematics of a chain."""

from collections.abc import Generator

from .chain import Chain, Segment
from .frame import Frame
from .joint import Joint
from .joint_arrays import Jacobian, JntArray

_SIZE_MISMATCH, _OUT_OF_RANGE = -4, -6
"""KDL's error codes."""


class _Solver:
    def __init__(self, chain: Chain) -> None:
        self._chain = chain

    def updateInternalDataStructures(self) -> None:
        """Do nothing: each call reads the chain."""

    def _posed(self, q: JntArray, count: int) -> Generator[tuple[Segment, bool, float]]:
        """Segments, each with the value of its joint; 0 for a fixed joint."""
        used = 0
        for number in range(count):
            segment = self._chain.getSegment(number)
            is_moving = segment.getJoint().getType() != Joint.Fixed
            yield segment, is_moving, q[used] if is_moving else 0.0
            used += is_moving

    def _fault(self, q: JntArray, count: int) -> int:
        """Error code; 0 if there is none."""
        if q.rows() != self._chain.getNrOfJoints():
            return _SIZE_MISMATCH
        return _OUT_OF_RANGE if count > self._chain.getNrOfSegments() else 0


class ChainFkSolverPos_recursive(_Solver):
    """Pose of the tip, or of another segment."""

    def JntToCart(self, q_in: JntArray, p_out: Frame | list[Frame], segmentNr: int = -1) -> int:
        """Write the pose after a count of segments into `p_out`, a Frame or a list of Frames; all segments with -1.

        Returns:
            0, or the negative number of an error.
        """
        count = self._chain.getNrOfSegments() if segmentNr < 0 else segmentNr
        if fault := self._fault(q_in, count):
            return fault
        pose, poses = Frame(), list[Frame]()
        for segment, _, value in self._posed(q_in, count):
            pose = pose * segment.pose(value)
            poses.append(pose)
        if isinstance(p_out, list):
            p_out[:] = poses
        else:
            p_out.M, p_out.p = pose.M, pose.p
        return 0


class ChainJntToJacSolver(_Solver):
    """Jacobian of the tip, in the axes of the chain's base."""

    def JntToJac(self, q_in: JntArray, jac: Jacobian, seg_nr: int = -1) -> int:
        """Write the Jacobian after a count of segments; all segments with -1.

        Returns:
            0, or the negative number of an error.
        """
        count = self._chain.getNrOfSegments() if seg_nr < 0 else seg_nr
        if (fault := self._fault(q_in, count)) or jac.columns() != self._chain.getNrOfJoints():
            return fault or _SIZE_MISMATCH
        pose, column = Frame(), 0
        for segment, is_moving, value in self._posed(q_in, count):
            tip = pose * segment.pose(value)
            jac.changeRefPoint(tip.p - pose.p)
            if is_moving:
                jac.setColumn(column, pose.M * segment.twist(value, 1.0))
                column += 1
            pose = tip
        return 0
