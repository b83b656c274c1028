"""Twist action for a robot with two driven wheels."""

import numpy as np
from gymnasium import spaces
from msgspec import Struct
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.robots.model import Model
from trundle.robots.parameters import TagParameters
from trundle.sim.control import DifferentialDrive

from .actions import Apply
from .states import WorldStates


class _Wheels(Struct, frozen=True):
    joints: tuple[str, str]
    """Left and right joint."""
    drive: DifferentialDrive
    max_effort: float
    """[N·m]"""


class TwistAction:
    """Forward speed [m/s] and yaw rate [rad/s] of a robot with a plugin such as libgazebo_ros_diff_drive.so.

    The plugin's joints, wheel separation, diameter and torque are used, but not its acceleration limit.
    """

    def __init__(self, model: str, *, max_forward: float, max_yaw_rate: float, backward: bool = True) -> None:
        """Drive a model.

        Args:
            model: model's name.
            max_forward: [m/s]
            max_yaw_rate: [rad/s]
            backward: whether backward driving is allowed.
        """
        self.model = model
        self.max_forward = max_forward
        self.max_yaw_rate = max_yaw_rate
        self.backward = backward

    def bind(self, states: WorldStates) -> tuple[spaces.Box, Apply]:
        """See `Action`."""
        wheels = _read_wheels(states.simulation[self.model].model, states)
        left, right = states.axes(*(f"{self.model}::{joint}" for joint in wheels.joints))
        radius, half_separation = wheels.drive.wheel_radius, wheels.drive.separation / 2

        def apply(values: NDArray[np.float64]) -> None:
            forward, yaw_rate = values[:, 0], values[:, 1]
            states.batch.command_velocity(left, (forward - yaw_rate * half_separation) / radius, wheels.max_effort)
            states.batch.command_velocity(right, (forward + yaw_rate * half_separation) / radius, wheels.max_effort)

        high = np.array([self.max_forward, self.max_yaw_rate], dtype=np.float32)
        low = 0.0 - high * np.array([self.backward, 1], dtype=np.float32)
        return spaces.Box(low, high, dtype=np.float32), apply


def _read_wheels(model: Model, states: WorldStates) -> _Wheels:
    """Read the plugin's parameters, with gazebo_ros' defaults."""
    for plugin in model.plugins:
        if "diff_drive" in plugin.filename or "differential_drive" in plugin.filename:
            parameters = TagParameters(plugin.node, states.simulation.report)
            return _Wheels(
                joints=(parameters.text("leftJoint", "left_joint"), parameters.text("rightJoint", "right_joint")),
                drive=DifferentialDrive(
                    separation=parameters.number("wheelSeparation", 0.34),
                    wheel_radius=parameters.number("wheelDiameter", 0.15) / 2,
                ),
                max_effort=parameters.number("wheelTorque", 5.0),
            )
    raise UsageError(
        f"model {model.name!r} has no plugin libgazebo_ros_diff_drive.so; use VelocityAction for its wheels"
    )
