"""Controller managers by the plugin that ~moveit_controller_manager names."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from trundle.base.diagnostics import no_such
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node

from .controller import ControllerSource
from .fake import FakeControllers
from .ros_control import RosControlControllers
from .simple import SimpleControllers

if TYPE_CHECKING:
    from trundle.planning.robot_model import RobotModel

_Make = Callable[[Node, RosParameters, "RobotModel"], ControllerSource]
MANAGERS: dict[str, _Make] = {
    "moveit_fake_controller_manager/MoveItFakeControllerManager": FakeControllers,
    "moveit_ros_control_interface::MoveItControllerManager": RosControlControllers,
    "moveit_ros_control_interface::MoveItMultiControllerManager": RosControlControllers,
    "moveit_simple_controller_manager/MoveItSimpleControllerManager": SimpleControllers,
}
"""Name of the plugin → its stand-in."""
_EXAMPLE = "moveit_controller_manager_example/MoveItControllerManagerExample"


def read_controllers(node: Node, parameters: RosParameters, model: "RobotModel") -> ControllerSource | None:
    """Return the source that ~moveit_controller_manager names; None with a sentence if it names none.

    Raises:
        ParamError: no such plugin, or its parameters are invalid.
    """
    name = parameters.text("moveit_controller_manager", "")
    if not name:
        if parameters.items("controller_list"):
            node.log.warn(
                "Parameter '~moveit_controller_manager' is not specified but is needed; the simple one is used"
            )
            return SimpleControllers(node, parameters, model)
        node.log.error(
            "Parameter '~moveit_controller_manager' not specified. This is needed to identify the plugin to use for "
            "interacting with controllers. No paths can be executed."
        )
        return None
    if name == _EXAMPLE:
        node.log.warn(f"{name} moves nothing, as the original; plans cannot be executed")
        return None
    make = MANAGERS.get(name.replace("MoveItSimpleControllerManager ", "MoveItSimpleControllerManager").strip())
    if make is None:
        raise ParamError(f"parameter {parameters.namespace}/moveit_controller_manager: {no_such('no', name, MANAGERS)}")
    return make(node, parameters, model)
