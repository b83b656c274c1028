"""Parameters that all drive controllers share."""

import math

from trundle.robots.model import Cylinder, Sphere, model_from_joint
from trundle.robots.parameters import ParamError, RosParameters
from trundle.sim.control import SpeedLimit
from trundle.spatial import Vector3

from .controller import ControllerContext
from .hardware import JointHardware


def joint_names(settings: RosParameters, name: str) -> list[str]:
    """Names of a parameter that is one joint or a list."""
    try:
        return [settings.text(name)]
    except ParamError:
        names = settings.texts(name)
        if not names:
            raise
        return names


def speed_limit(settings: RosParameters) -> SpeedLimit:
    """Read has_…_limits, max_… and min_…; min defaults to −max."""

    def bounds(what: str) -> tuple[float, float]:
        if not settings.flag(f"has_{what}_limits", default=False):
            return -math.inf, math.inf
        largest = settings.number(f"max_{what}")
        return settings.number(f"min_{what}", -largest), largest

    slowest, fastest = bounds("velocity")
    braking, speeding = bounds("acceleration")
    lowest, highest = bounds("jerk")
    return SpeedLimit(
        min_velocity=slowest,
        max_velocity=fastest,
        min_acceleration=braking,
        max_acceleration=speeding,
        min_jerk=lowest,
        max_jerk=highest,
    )


def covariance(settings: RosParameters, name: str) -> list[float]:
    """Row-major 6×6 covariance from its diagonal; default zero."""
    values = settings.numbers(name, 6, (0.0,) * 6)
    return [values[row] if row == column else 0.0 for row in range(6) for column in range(6)]


def length(context: ControllerContext, name: str, otherwise: float | None) -> float:
    """Length [m]: the parameter, else that of the model (None: unknown).

    Raises:
        ParamError: neither is known, or it is not > 0.
    """
    value = context.settings.number(name, otherwise)
    if value <= 0.0:
        raise ParamError(f"parameter {context.name}/{name} must be > 0 m, got {value:g}")
    return value


def origin(context: ControllerContext, joint: JointHardware) -> Vector3:
    """Origin of a joint in the model's frame with all joints at zero [m]."""
    return model_from_joint(context.model.model, joint.handle.joint).position


def wheel_radius(context: ControllerContext, wheel: JointHardware) -> float:
    """Parameter wheel_radius, else the radius of the wheel's collision [m].

    Raises:
        ParamError: neither is there, or it is not > 0.
    """
    link = context.model.link(wheel.handle.joint.child).link
    round_ones = (each.geometry for each in link.collisions if isinstance(each.geometry, Cylinder | Sphere))
    found = next((geometry.radius for geometry in round_ones), None)
    if found is None and "wheel_radius" not in context.settings:
        raise ParamError(
            f"parameter {context.name}/wheel_radius is not set, and link {link.name!r} has neither a cylinder nor "
            "a sphere to measure"
        )
    return length(context, "wheel_radius", found)
