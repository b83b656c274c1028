"""A weight on soft contact points by the rule of Gazebo's ODE: the reference for kp, kd, max_vel and min_depth."""

GRAVITY = 9.8


def ode_heights(
    mass: float,
    points: int,
    *,
    kp: float,
    kd: float,
    max_vel: float = 0.01,
    min_depth: float = 0.0,
    drop: float,
    h: float = 1e-3,
    seconds: float,
) -> list[float]:
    """Return the heights after each step of a mass [kg] that falls [m] on equal points.

    Source: dxQuickStepper and dxJointContact::getInfo2 in Gazebo 11. Each step is solved twice, with erp and cfm of the
    spring and damper: positions follow the solution whose correction is not capped, velocities the other.
    """
    erp, cfm = h * kp / (h * kp + kd), 1.0 / (h * kp + kd)
    gain = h * points / mass
    height, speed, heights = drop, 0.0, []
    for _ in range(round(seconds / h)):
        free = speed - GRAVITY * h
        moving = speed = free
        if height < 0.0:
            correction = erp * max(-height - min_depth, 0.0) / h
            moving += gain * max((correction - free) / (gain + cfm), 0.0)
            speed += gain * max((min(correction, max_vel) - free) / (gain + cfm), 0.0)
        height += h * moving
        heights.append(height)
    return heights


def ode_rest_depth(load: float, *, kp: float, kd: float, max_vel: float = 0.01, h: float = 1e-3) -> float:
    """Return the depth [m] at which a point rests under a load [N], as docs/physics.md derives it."""
    sinking = max(load / (h * kp + kd) - max_vel, 0.0)
    return load / kp * (1.0 + sinking / (GRAVITY * h))
