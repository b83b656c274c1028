"""Reference frames of IMU orientations."""

import math

from trundle.robots.model import OrientationReference
from trundle.spatial import Pose, Quaternion, Vector3, cross, normalized, quaternion_from_rpy

_QUARTER = math.pi / 2


def reference_from_world(
    reference: OrientationReference | None, *, at_start: Pose, gravity: Vector3, heading_rad: float
) -> Pose:
    """Return the rotation from the world to the reference frame of an IMU's orientation.

    Args:
        reference: reference in the file; None: the sensor's initial frame, as in Gazebo.
        at_start: initial world_from_sensor.
        gravity: gravity of the world [m/s²].
        heading_rad: angle from east to the world's x axis.
    """
    start = Pose(quaternion=at_start.quaternion)
    if reference is None:
        return start.inverse()
    east_north_up = Pose(quaternion=quaternion_from_rpy(0.0, 0.0, heading_rad))
    match reference.localization:
        case "ENU":
            return east_north_up
        case "NED":
            return Pose(quaternion=quaternion_from_rpy(math.pi, 0.0, _QUARTER)) @ east_north_up
        case "NWU":
            return Pose(quaternion=quaternion_from_rpy(0.0, 0.0, -_QUARTER)) @ east_north_up
        case "GRAV_UP" | "GRAV_DOWN":
            parent = Pose() if reference.gravity_parent_frame == "world" else start
            x, y, z = normalized(gravity) or (0.0, 0.0, -1.0)
            along = (x, y, z) if reference.localization == "GRAV_DOWN" else (-x, -y, -z)
            return Pose(quaternion=_with_z(along, parent.transform_vector(reference.gravity_x))).inverse()
        case _:
            parent = Pose() if reference.parent_frame == "world" else start
            return (parent @ Pose(quaternion=quaternion_from_rpy(*reference.custom_rpy))).inverse()


def _with_z(up: Vector3, ahead: Vector3) -> Quaternion:
    """Return world_from_axes with z along `up` and x as close as possible to `ahead`."""
    left = normalized(cross(up, ahead)) or normalized(cross(up, (0.0, 1.0, 0.0))) or (0.0, 1.0, 0.0)
    x = cross(left, up)
    yaw = math.atan2(x[1], x[0])
    pitch = math.atan2(-x[2], math.hypot(x[0], x[1]))
    roll = math.atan2(left[2], up[2])
    return quaternion_from_rpy(roll, pitch, yaw)
