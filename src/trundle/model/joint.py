"""How two links may move relative to one another."""

import math
from enum import Enum
from typing import TYPE_CHECKING

from msgspec import Struct

from trundle.diagnostics import Source
from trundle.spatial import Pose, Vector3

if TYPE_CHECKING:
    from .sensor import Sensor


class JointType(Enum):
    """SDF's joint types, and URDF's planar one; its others are lowered to these."""

    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"
    FIXED = "fixed"
    BALL = "ball"
    UNIVERSAL = "universal"
    SCREW = "screw"
    REVOLUTE2 = "revolute2"
    GEARBOX = "gearbox"
    PLANAR = "planar"
    """Slides both ways across its axis, and turns about it."""


UNLIMITED = 1e16
"""SDF's own word for no limit; anything this large or larger is none."""


class Mimic(Struct, frozen=True, kw_only=True):
    """A joint axis that follows another: multiplier · (leader − reference) + offset."""

    joint: str
    axis: int = 0
    """Which axis of the leader: 0 or 1."""
    multiplier: float = 1.0
    offset: float = 0.0
    """[rad] or [m]"""
    reference: float = 0.0
    """[rad] or [m]"""


class JointAxis(Struct, frozen=True, kw_only=True):
    """One degree of freedom: its direction, limits and passive forces."""

    direction: Vector3
    """Unit, in the model frame with every joint at zero."""
    lower: float = -math.inf
    """[rad] or [m]; lower == upper leaves no freedom."""
    upper: float = math.inf
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
    """Of its limits [N·m/rad] or [N/m]."""
    stop_dissipation: float = 1.0
    """Of its limits [N·m·s/rad] or [N·s/m]."""
    initial_position: float = 0.0
    """Where it starts [rad] or [m]; of SDF 1.6 to 1.8, and not heeded by Gazebo."""
    mimic: Mimic | None = None

    @property
    def is_rigid(self) -> bool:
        """Whether the limits leave no freedom, as the 0..0 of many published robots."""
        return self.lower == self.upper


class Joint(Struct, frozen=True, kw_only=True):
    """A joint between a parent and a child link of one model, or with the world."""

    name: str
    type: JointType
    parent: str
    """Link name, or "world"; links of nested models by `model::link`."""
    child: str
    """Likewise."""
    at: Source
    parent_frame: str | None = None
    """The frame that the file names where a link is wanted; None: the link itself."""
    child_frame: str | None = None
    """Likewise."""
    child_from_joint: Pose = Pose()
    """In the child link's frame."""
    parent_from_child: Pose | None = None
    """Where a fixed joint holds the child link, in the parent's frame; None: as they lie with every joint at zero."""
    axis: JointAxis | None = None
    """None for fixed and ball joints."""
    axis2: JointAxis | None = None
    """Of universal, revolute2 and gearbox joints."""
    thread_pitch: float = 1.0
    """Of screw joints, as Gazebo has it [rad/m], the sign opposite to a right-hand thread."""
    gearbox_ratio: float = 1.0
    gearbox_reference_body: str | None = None
    sensors: tuple["Sensor", ...] = ()
