"""The robot of the parameters robot_description, _semantic and _planning."""

from typing import Any, cast

from trundle.base.diagnostics import Diagnostics, TrundleError
from trundle.planning.robot_model import RobotModel, robot_model
from trundle.ros import Node

_MAX_WARNINGS = 20


class ModelError(TrundleError):
    """A robot that cannot be loaded, with the reason."""


class RobotDescription:
    """The model, with the parameters beside it."""

    def __init__(self, name: str, model: RobotModel, planning: dict[str, Any], kinematics: dict[str, Any]) -> None:
        """Hold what was read."""
        self.name = name
        """Full name of the URDF's parameter."""
        self.model = model
        self.planning = planning
        """Parameters of NAME_planning: joint_limits, cartesian_limits, default factors."""
        self.kinematics = kinematics
        """Parameters of NAME_kinematics: group → kinematics_solver and its settings."""


async def read_robot_description(node: Node, name: str = "robot_description") -> RobotDescription:
    """Read the model from the parameter server; findings go to the log.

    Raises:
        ModelError: a parameter is not set, or its text is no robot.
    """
    full = await node.params.search(name)
    if full is None:
        raise ModelError(
            f"Robot model parameter not found! Did you remap '{name}'? No parameter {node.resolve(name)} is set"
        )
    urdf = await node.params.get(full)
    semantic = await node.params.get(f"{full}_semantic", None)
    if semantic is None:
        raise ModelError(f"Robot semantic description not found. Did you forget to define or remap '{full}_semantic'?")
    planning = _section(await node.params.get(f"{full}_planning", {}))
    kinematics = _section(await node.params.get(f"{full}_kinematics", {}))
    local = _section(await node.params.get("~robot_description_kinematics", {}))
    report = Diagnostics()
    try:
        model = robot_model(str(urdf), str(semantic), _section(planning.get("joint_limits")), report)
    except TrundleError as error:
        raise ModelError(f"Unable to construct robot model. {error}") from error
    for finding in report.findings[:_MAX_WARNINGS]:
        node.log.warn(str(finding.what))
    if len(report.findings) > _MAX_WARNINGS:
        node.log.warn(f"{len(report.findings) - _MAX_WARNINGS} more warnings about the robot; trundle check lists them")
    node.log.info(f"Loading robot model '{model.name}'...")
    return RobotDescription(full, model, planning, {**kinematics, **local})


def _section(value: object) -> dict[str, Any]:
    return dict(cast("dict[str, Any]", value)) if isinstance(value, dict) else {}
