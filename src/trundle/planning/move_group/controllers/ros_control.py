"""moveit_ros_control_interface: the controllers that a controller manager of ros_control has loaded."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from trundle.robots.parameters import RosParameters
from trundle.ros import Node, RosError

from .controller import Controller
from .follow_joint_trajectory import FollowJointTrajectory
from .gripper_command import GripperCommand

if TYPE_CHECKING:
    from trundle.planning.robot_model import RobotModel

_LIST_S = 5.0
_STRICT = 2
"""Strictness of controller_manager_msgs/SwitchController."""
_TRAJECTORY_TYPES = frozenset(
    f"{kind}/JointTrajectoryController"
    for kind in ("effort_controllers", "pos_vel_controllers", "position_controllers", "velocity_controllers")
)
_GRIPPER_TYPES = frozenset(f"{kind}/GripperActionController" for kind in ("effort_controllers", "position_controllers"))


class RosControlControllers:
    """Controllers of one controller manager, asked for before each execution."""

    def __init__(self, node: Node, parameters: RosParameters, model: "RobotModel") -> None:
        """Take the namespace of the controller manager from ~ros_control_namespace."""
        del model
        self._node = node
        namespace = parameters.text("ros_control_namespace", "/").rstrip("/")
        self._manager = f"{namespace}/controller_manager"
        self._namespace = namespace
        self._known: dict[str, Controller] = {}
        self._states: list[Any] = []

    async def controllers(self) -> Sequence[Controller]:
        """Ask for the loaded controllers; those of trajectories and grippers are returned."""
        try:
            answer = await self._node.call_service(
                f"{self._manager}/list_controllers", "controller_manager_msgs/ListControllers", timeout_s=_LIST_S
            )
        except RosError as error:
            self._node.log.warn(f"Failed to read controllers from {self._manager}/list_controllers: {error}")
            return []
        self._states = list(answer.controller)
        found = [self._controller(state) for state in self._states]
        return [controller for controller in found if controller is not None]

    def _controller(self, state: Any) -> Controller | None:
        name = str(state.name)
        joints = _resources(state)
        is_active = state.state == "running"
        known = self._known.get(name)
        if isinstance(known, FollowJointTrajectory | GripperCommand) and known.joints == tuple(joints):
            known.is_active = is_active
            return known
        action = f"{self._namespace}/{name}"
        if state.type in _TRAJECTORY_TYPES:
            made: Controller = FollowJointTrajectory(
                self._node, name, f"{action}/follow_joint_trajectory", joints, is_default=True, is_active=is_active
            )
        elif state.type in _GRIPPER_TYPES:
            made = GripperCommand(
                self._node, name, f"{action}/gripper_cmd", joints, is_default=True, is_active=is_active
            )
        else:
            return None
        self._known[name] = made
        return made

    async def activate(self, controllers: Sequence[Controller]) -> bool:
        """Start controllers that are not running, and stop the running ones that hold their joints."""
        start = [controller for controller in controllers if not controller.is_active]
        if not start:
            return True
        wanted = {joint for controller in start for joint in controller.joints}
        stop = [
            str(state.name) for state in self._states if state.state == "running" and wanted & set(_resources(state))
        ]
        names = [controller.name for controller in start]
        request = {"start_controllers": names, "stop_controllers": stop, "strictness": _STRICT}
        try:
            answer = await self._node.call_service(
                f"{self._manager}/switch_controller",
                "controller_manager_msgs/SwitchController",
                request,
                timeout_s=_LIST_S,
            )
        except RosError as error:
            self._node.log.error(f"Failed to switch controllers: {error}")
            return False
        if not answer.ok:
            self._node.log.error(f"Failed to start {', '.join(names)}")
        return bool(answer.ok)


def _resources(state: Any) -> list[str]:
    """Return the joints that a controller claims, in its order."""
    joints = [str(name) for claimed in state.claimed_resources for name in claimed.resources]
    return list(dict.fromkeys(joints))
