"""What MoveGroupCommander.plan returns: Noetic's tuple, or the trajectory alone of the distributions before."""

from typing import Any

import rospy

_BEFORE_NOETIC = frozenset({"indigo", "jade", "kinetic", "lunar", "melodic"})


class PlanResult(tuple[bool, Any, float, Any]):
    """(success, trajectory, planning time [s], error code), as in Noetic.

    It has the trajectory's fields as well, so that programs written for Melodic read, publish and execute it.
    """

    __slots__ = ()

    @property
    def joint_trajectory(self) -> Any:
        """The trajectory of the joints."""
        return self[1].joint_trajectory

    @property
    def multi_dof_joint_trajectory(self) -> Any:
        """The trajectory of planar and floating joints."""
        return self[1].multi_dof_joint_trajectory

    def serialize(self, buff: Any) -> None:
        """Serialize the trajectory."""
        self[1].serialize(buff)


def plan_result(*, is_success: bool, trajectory: Any, planning_time_s: float, error_code: Any) -> Any:
    """Return what a program of the graph's distribution expects (parameter /rosdistro; Noetic by default)."""
    if str(rospy.get_param("/rosdistro", "noetic")).strip() in _BEFORE_NOETIC:
        return trajectory
    return PlanResult((is_success, trajectory, planning_time_s, error_code))
