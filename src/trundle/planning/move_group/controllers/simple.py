"""moveit_simple_controller_manager: the controllers of ~controller_list, each an action."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from trundle.robots.parameters import RosParameters
from trundle.ros import Node

from .controller import Controller
from .follow_joint_trajectory import FollowJointTrajectory
from .gripper_command import GripperCommand

if TYPE_CHECKING:
    from trundle.planning.robot_model import RobotModel


class SimpleControllers:
    """Controllers by name, joints, action_ns and type."""

    def __init__(self, node: Node, parameters: RosParameters, model: "RobotModel") -> None:
        """Read the list; an invalid entry is left out with a sentence.

        Raises:
            ParamError: the list is none.
        """
        del model
        self._controllers: list[Controller] = []
        if not parameters.items("controller_list"):
            node.log.error("No controller_list specified.")
        for entry in parameters.sections("controller_list"):
            controller = _controller(node, entry)
            if controller is not None:
                self._controllers.append(controller)
        node.log.info(f"Returned {len(self._controllers)} controllers in list")

    async def controllers(self) -> Sequence[Controller]:
        """Return the controllers of the list."""
        return self._controllers

    async def activate(self, controllers: Sequence[Controller]) -> bool:
        """True: drivers start their own."""
        del controllers
        return True


def _controller(node: Node, entry: RosParameters) -> Controller | None:
    """Make a controller of an entry; None if it is incomplete, or of an unknown type."""
    name, kind, joints = entry.text("name", ""), entry.text("type", ""), entry.texts("joints")
    namespace = entry.text("action_ns", "")
    if "name" not in entry or not kind or not joints or not (name or namespace):
        node.log.error(f"{entry.namespace}: name, joints, action_ns, and type must be specified for each controller")
        return None
    action = "/".join(part for part in (name, namespace) if part)
    is_default = entry.flag("default", default=False)
    if kind == "FollowJointTrajectory":
        node.log.info(f"Added FollowJointTrajectory controller for {name}")
        return FollowJointTrajectory(node, name, action, joints, is_default=is_default, settings=entry)
    if kind == "GripperCommand":
        is_parallel = entry.flag("parallel", default=False)
        if is_parallel and len(joints) != 2:
            node.log.error(f"{name}: Parallel Gripper requires exactly two joints, not {len(joints)}")
            return None
        command_joint = entry.text("command_joint", joints[0])
        node.log.info(f"Added GripperCommand controller for {name}")
        return GripperCommand(
            node,
            name,
            action,
            joints,
            command_joints=joints if is_parallel else [command_joint],
            max_effort=entry.number("max_effort", 0.0),
            allow_failure=entry.flag("allow_failure", default=False),
            is_parallel=is_parallel,
            is_default=is_default,
        )
    node.log.error(f"Unknown controller type: {kind}; types: FollowJointTrajectory, GripperCommand")
    return None
