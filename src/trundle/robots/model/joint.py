"""Joints: type, axes, limits and passive forces."""

import math
from enum import Enum
from typing import TYPE_CHECKING

from msgspec import Struct

from trundle.base.diagnostics import Source
from trundle.spatial import Pose, Vector3

if TYPE_CHECKING:
    from .sensor import Sensor


class JointType(Enum):
    """SDF's joint types, and URDF's planar one; URDF's other types are lowered to these."""

    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"
    FIXED = "fixed"
    BALL = "ball"
    UNIVERSAL = "universal"
    SCREW = "screw"
    REVOLUTE2 = "revolute2"
    GEARBOX = "gearbox"
    PLANAR = "planar"
    """Translation along two axes normal to its axis, and rotation about it."""


UNLIMITED = 1e16
"""SDF's value for no limit; this or larger is unlimited."""


class Mimic(Struct, frozen=True, kw_only=True):
    """Mimic joint axis: multiplier · (leader − reference) + offset."""

    joint: str
    axis: int = 0
    """Axis of the leader: 0 or 1."""
    multiplier: float = 1.0
    offset: float = 0.0
    """[rad] or [m]"""
    reference: float = 0.0
    """[rad] or [m]"""


class JointAxis(Struct, frozen=True, kw_only=True):
    """One degree of freedom: its direction, limits and passive forces."""

    __module__ = "trundle"

    direction: Vector3
    """Unit vector, in the model frame with every joint at zero."""
    lower: float = -math.inf
    """[rad] or [m]; lower == upper leaves no freedom."""
    upper: float = math.inf
    """[rad] or [m]"""
    effort: float = math.inf
    """Largest actuation [N·m] or [N]."""
    velocity: float = math.inf
    """Largest speed [rad/s] or [m/s], as written; engines do not enforce it."""
    damping: float = 0.0
    """[N·m·s/rad] or [N·s/m]"""
    friction: float = 0.0
    """Coulomb friction [N·m] or [N]."""
    spring_reference: float = 0.0
    """[rad] or [m]"""
    spring_stiffness: float = 0.0
    """[N·m/rad] or [N/m]"""
    stop_stiffness: float = 1e8
    """Stiffness of the limits [N·m/rad] or [N/m]."""
    stop_dissipation: float = 1.0
    """Damping of the limits [N·m·s/rad] or [N·s/m]."""
    initial_position: float = 0.0
    """Initial position [rad] or [m]; SDF 1.6 to 1.8, ignored by Gazebo."""
    mimic: Mimic | None = None

    @property
    def is_rigid(self) -> bool:
        """True if the limits leave no freedom, such as the 0..0 of many published robots."""
        return self.lower == self.upper


class Joint(Struct, frozen=True, kw_only=True):
    """Joint between a parent and a child link of one model, or the world."""

    name: str
    type: JointType
    parent: str
    """Link name, or "world"; links of nested models by `model::link`."""
    child: str
    """Link name, or "world"; links of nested models by `model::link`."""
    at: Source
    parent_frame: str | None = None
    """Frame named in place of the parent link; None: the link itself."""
    child_frame: str | None = None
    """Frame named in place of the child link; None: the link itself."""
    child_from_joint: Pose = Pose()
    """Joint frame in the child link's frame."""
    parent_from_child: Pose | None = None
    """Pose in which a fixed joint holds the child link, in the parent's frame; None: the poses with every joint at
    zero.
    """
    axis: JointAxis | None = None
    """None for fixed and ball joints."""
    axis2: JointAxis | None = None
    """Second axis of universal, revolute2 and gearbox joints."""
    thread_pitch: float = 1.0
    """Thread pitch of screw joints in Gazebo's convention [rad/m], of opposite sign to a right-hand thread."""
    gearbox_ratio: float = 1.0
    gearbox_reference_body: str | None = None
    sensors: tuple["Sensor", ...] = ()
