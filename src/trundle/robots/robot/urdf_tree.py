"""URDF as written: the tree that robot_state_publisher, RobotModel and ros_control use."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from trundle.base.diagnostics import Source
from trundle.spatial import Pose, Vector3

RobotJointType: TypeAlias = Literal["revolute", "continuous", "prismatic", "fixed", "floating", "planar"]
Rgba: TypeAlias = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class RobotBox:
    """Box; full lengths [m]."""

    size: Vector3


@dataclass(frozen=True, slots=True)
class RobotCylinder:
    """Cylinder along z, centred [m]."""

    radius: float
    length: float


@dataclass(frozen=True, slots=True)
class RobotSphere:
    """Sphere [m]."""

    radius: float


@dataclass(frozen=True, slots=True)
class RobotMesh:
    """Triangle mesh from a file; the URI is as written."""

    uri: str
    scale: Vector3 = (1.0, 1.0, 1.0)


RobotGeometry: TypeAlias = RobotBox | RobotCylinder | RobotSphere | RobotMesh


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotInertial:
    """<inertial> with all its elements, which URDF requires."""

    mass: float
    """[kg]"""
    link_from_com: Pose = Pose()
    moments: Vector3 = (0.0, 0.0, 0.0)
    """ixx, iyy, izz [kg·m²]."""
    products: Vector3 = (0.0, 0.0, 0.0)
    """ixy, ixz, iyz [kg·m²]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotShape:
    """A <visual> or <collision>."""

    name: str
    """Empty if unnamed."""
    geometry: RobotGeometry
    at: Source
    link_from_shape: Pose = Pose()
    rgba: Rgba | None = None
    """Color of a visual; None if the file names none."""
    texture: str = ""
    """Texture URI of a visual, as written; tinted by `rgba`."""
    material: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotLink:
    """<link>"""

    name: str
    at: Source
    inertial: RobotInertial | None = None
    visuals: tuple[RobotShape, ...] = ()
    collisions: tuple[RobotShape, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotMimic:
    """<mimic>: this joint follows another by multiplier · leader + offset."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class JointLimit:
    """<limit> [rad, rad/s, N·m] or [m, m/s, N]."""

    lower: float = 0.0
    upper: float = 0.0
    effort: float = 0.0
    velocity: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotSafety:
    """<safety_controller>: limits that planners keep to, within those of <limit> [rad] or [m]."""

    soft_lower_limit: float = 0.0
    soft_upper_limit: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotJoint:
    """<joint>"""

    name: str
    type: RobotJointType
    parent: str
    child: str
    at: Source
    parent_from_joint: Pose = Pose()
    """<origin>: the joint frame, equal to the child link's frame at position zero."""
    axis: Vector3 = (1.0, 0.0, 0.0)
    """Axis in the joint frame, as written."""
    limit: JointLimit | None = None
    damping: float = 0.0
    friction: float = 0.0
    mimic: RobotMimic | None = None
    safety: RobotSafety | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Robot:
    """<robot>: a tree of links."""

    name: str
    at: Source
    root: str
    """Link that is no joint's child."""
    links: tuple[RobotLink, ...]
    """In file order."""
    joints: tuple[RobotJoint, ...]
    """In file order."""
