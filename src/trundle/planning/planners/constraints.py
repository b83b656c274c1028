"""Constraints of goals and paths, as those of moveit_msgs."""

from typing import Literal, TypeAlias

from msgspec import Struct

from trundle.planning.planning_scene import PlacedShape
from trundle.spatial import IDENTITY_QUATERNION, ZERO, Pose, Quaternion, Vector3

OrientationParameterization: TypeAlias = Literal["xyz_euler_angles", "rotation_vector"]
ViewDirection: TypeAlias = Literal["z", "y", "x"]


class JointConstraint(Struct, frozen=True, kw_only=True):
    """Bounds of a variable."""

    variable: str
    """Joint, or JOINT/VARIABLE."""
    position: float
    """[rad] or [m]"""
    tolerance_above: float = 1e-4
    tolerance_below: float = 1e-4


class PositionConstraint(Struct, frozen=True, kw_only=True):
    """Region of a point of a link."""

    link: str
    frame: str = ""
    """Frame of the region: a link, an object, or the model frame, which is meant by an empty one."""
    offset: Vector3 = ZERO
    """Point in the link's frame [m]."""
    region: tuple[PlacedShape, ...]
    """The point is in one of these shapes, solid, in the frame."""


class OrientationConstraint(Struct, frozen=True, kw_only=True):
    """Bounds of a link's orientation."""

    link: str
    frame: str = ""
    orientation: Quaternion = IDENTITY_QUATERNION
    """frame_from_link (w, x, y, z)."""
    tolerances: Vector3 = (1e-3, 1e-3, 1e-3)
    """Greatest angles [rad] about x, y, z of the wanted orientation; π or more: any."""
    parameterization: OrientationParameterization = "xyz_euler_angles"


class VisibilityConstraint(Struct, frozen=True, kw_only=True):
    """Sight from a sensor to a disc: nothing of the robot is in the cone between them."""

    target_radius: float
    """[m]; 0: always satisfied."""
    target_frame: str = ""
    target_pose: Pose = Pose()
    """The disc's normal is z."""
    cone_sides: int = 4
    sensor_frame: str = ""
    sensor_pose: Pose = Pose()
    max_view_angle: float = 0.0
    """Greatest angle between the disc's normal and the line of sight [rad]; 0: any."""
    max_range_angle: float = 0.0
    """Greatest angle between the sensor's axis and the line of sight [rad]; 0: any."""
    sensor_view_direction: ViewDirection = "z"


class Constraints(Struct, frozen=True, kw_only=True):
    """Constraints that all hold."""

    name: str = ""
    joints: tuple[JointConstraint, ...] = ()
    positions: tuple[PositionConstraint, ...] = ()
    orientations: tuple[OrientationConstraint, ...] = ()
    visibilities: tuple[VisibilityConstraint, ...] = ()

    @property
    def is_empty(self) -> bool:
        """True if there are none."""
        return not (self.joints or self.positions or self.orientations or self.visibilities)


def pose_goal(
    link: str,
    pose: Pose,
    *,
    frame: str = "",
    position_tolerance: float = 1e-4,
    orientation_tolerance: float = 1e-3,
) -> Constraints:
    """Return constraints for a link's pose in a frame, as kinematic_constraints::constructGoalConstraints.

    Args:
        link: link whose frame is placed.
        pose: frame_from_link.
        frame: a link, an object, or empty for the model frame.
        position_tolerance: radius of the ball in which the link's origin is [m].
        orientation_tolerance: greatest angle about each axis [rad].
    """
    from trundle.robots.model import Sphere

    region = (PlacedShape(Sphere(position_tolerance), Pose(pose.position)),)
    angle = orientation_tolerance
    return Constraints(
        positions=(PositionConstraint(link=link, frame=frame, region=region),),
        orientations=(
            OrientationConstraint(
                link=link, frame=frame, orientation=pose.quaternion, tolerances=(angle, angle, angle)
            ),
        ),
    )


def joint_goal(positions: dict[str, float], *, tolerance: float = 1e-4) -> Constraints:
    """Return constraints for positions of variables [rad, m]."""
    return Constraints(
        joints=tuple(
            JointConstraint(variable=name, position=value, tolerance_above=tolerance, tolerance_below=tolerance)
            for name, value in positions.items()
        )
    )
