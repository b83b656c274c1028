"""Controllers with the action control_msgs/FollowJointTrajectory."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from trundle.ros import Node
from trundle.spatial import NS_PER_S

from .action_call import ActionCall
from .joint_path import JointPath, path_message
from .outcome import Outcome

if TYPE_CHECKING:
    from trundle.robots.parameters import RosParameters

SUCCEEDED, PREEMPTED = 3, 2
"""States of actionlib_msgs/GoalStatus."""
_ERRORS = {
    -1: "INVALID_GOAL",
    -2: "INVALID_JOINTS",
    -3: "OLD_HEADER_TIMESTAMP",
    -4: "PATH_TOLERANCE_VIOLATED",
    -5: "GOAL_TOLERANCE_VIOLATED",
}
_WAIT_S = 15.0


class FollowJointTrajectory:
    """Sends whole trajectories to a controller."""

    def __init__(
        self,
        node: Node,
        name: str,
        action: str,
        joints: Sequence[str],
        *,
        is_default: bool = False,
        is_active: bool = True,
        settings: "RosParameters | None" = None,
    ) -> None:
        """Make a controller.

        Args:
            node: node of the client.
            name: name of the controller.
            action: action's namespace.
            joints: joints that it moves.
            is_default: True: preferred.
            is_active: True if it takes commands now.
            settings: path_tolerance, goal_tolerance and goal_time_tolerance, as in simple_moveit_controllers.yaml.
        """
        self.name = name
        self.joints = tuple(joints)
        self.is_default = is_default
        self.is_active = is_active
        self._node = node
        self._call = ActionCall(node, action, "control_msgs/FollowJointTrajectory")
        self._tolerances = {} if settings is None else _tolerances(settings)

    async def execute(self, path: JointPath) -> Outcome:
        """Send a path, and await its end."""
        if not await self._call.wait_for_server(_WAIT_S):
            return Outcome.ABORTED
        state, result = await self._call.run({"trajectory": path_message(path), **self._tolerances})
        if state == SUCCEEDED:
            self._node.log.info(f"Controller '{self.name}' successfully finished")
            return Outcome.SUCCEEDED
        code = 0 if result is None else int(result.error_code)
        text = "" if result is None else str(result.error_string)
        reason = _ERRORS.get(code, f"error {code}" if code else "no error code")
        self._node.log.warn(f"Controller '{self.name}' failed with error {reason}: {text}")
        return Outcome.PREEMPTED if state == PREEMPTED else Outcome.ABORTED


def _tolerances(settings: "RosParameters") -> dict[str, Any]:
    goal: dict[str, Any] = {}
    for name in ("path_tolerance", "goal_tolerance"):
        tolerances = [
            {
                "name": entry.text("joint", entry.text("name", "")),
                "position": entry.number("position", 0.0),
                "velocity": entry.number("velocity", 0.0),
                "acceleration": entry.number("acceleration", 0.0),
            }
            for entry in settings.sections(name)
        ]
        if tolerances:
            goal[name] = tolerances
    if "goal_time_tolerance" in settings:
        goal["goal_time_tolerance"] = round(settings.number("goal_time_tolerance", 0.0) * NS_PER_S)
    return goal
