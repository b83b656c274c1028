"""Parameters that all drive controllers share."""

import math

from trundle.robots.model import Cylinder, Sphere, model_from_joint
from trundle.robots.parameters import ParamError, RosParameters
from trundle.sim.control import SpeedLimit
from trundle.spatial import Vector3

from .controller import ControllerContext
from .hardware import JointHardware


def joint_names(settings: RosParameters, name: str) -> list[str]:
    """Return the names in a parameter that is one joint or a list."""
    try:
        return [settings.text(name)]
    except ParamError:
        names = settings.texts(name)
        if not names:
            raise
        return names


def speed_limit(settings: RosParameters) -> SpeedLimit:
    """Read has_…_limits, max_… and min_…; min defaults to −max."""

    def bounds(quantity: str) -> tuple[float, float]:
        if not settings.flag(f"has_{quantity}_limits", default=False):
            return -math.inf, math.inf
        maximum = settings.number(f"max_{quantity}")
        return settings.number(f"min_{quantity}", -maximum), maximum

    min_velocity, max_velocity = bounds("velocity")
    min_acceleration, max_acceleration = bounds("acceleration")
    min_jerk, max_jerk = bounds("jerk")
    return SpeedLimit(
        min_velocity=min_velocity,
        max_velocity=max_velocity,
        min_acceleration=min_acceleration,
        max_acceleration=max_acceleration,
        min_jerk=min_jerk,
        max_jerk=max_jerk,
    )


def covariance(settings: RosParameters, name: str) -> list[float]:
    """Return the row-major 6×6 covariance for the diagonal in a parameter; default zero."""
    values = settings.numbers(name, 6, (0.0,) * 6)
    return [values[row] if row == column else 0.0 for row in range(6) for column in range(6)]


def length(context: ControllerContext, name: str, default: float | None) -> float:
    """Return a length [m]: the parameter, else the default (None: required).

    Raises:
        ParamError: neither exists, or it is not > 0.
    """
    value = context.settings.number(name, default)
    if value <= 0.0:
        raise ParamError(f"parameter {context.name}/{name} must be > 0 m, got {value:g}")
    return value


def origin(context: ControllerContext, joint: JointHardware) -> Vector3:
    """Return a joint's origin in the model's frame with all joints at zero [m]."""
    return model_from_joint(context.model.model, joint.handle.joint).position


def wheel_radius(context: ControllerContext, wheel: JointHardware) -> float:
    """Return the parameter wheel_radius, else the radius of the wheel's collision [m].

    Raises:
        ParamError: neither exists, or it is not > 0.
    """
    link = context.model.link(wheel.handle.joint.child).link
    round_shapes = (
        collision.geometry for collision in link.collisions if isinstance(collision.geometry, Cylinder | Sphere)
    )
    radius = next((geometry.radius for geometry in round_shapes), None)
    if radius is None and "wheel_radius" not in context.settings:
        raise ParamError(
            f"parameter {context.name}/wheel_radius is not set, and link {link.name!r} has neither a cylinder nor "
            "a sphere to measure"
        )
    return length(context, "wheel_radius", radius)
