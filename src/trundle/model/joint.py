"""How two links may move relative to one another."""

import math
from dataclasses import dataclass
from enum import Enum

from trundle.diagnostics import Source
from trundle.spatial import Pose, Vector3


class JointType(Enum):
    """SDF's joint types; URDF's others are lowered to these."""

    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"
    FIXED = "fixed"
    BALL = "ball"
    UNIVERSAL = "universal"
    SCREW = "screw"
    REVOLUTE2 = "revolute2"
    GEARBOX = "gearbox"


UNLIMITED = 1e16
"""SDF's own word for no limit; anything this large or larger is none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class JointAxis:
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

    @property
    def is_rigid(self) -> bool:
        """Whether the limits leave no freedom, as the 0..0 of many published robots."""
        return self.lower == self.upper


@dataclass(frozen=True, slots=True, kw_only=True)
class Joint:
    """A joint between a parent and a child link of one model, or with the world."""

    name: str
    type: JointType
    parent: str
    """Link name, or "world"."""
    child: str
    at: Source
    child_from_joint: Pose = Pose()
    axis: JointAxis | None = None
    """None for fixed and ball joints."""
    axis2: JointAxis | None = None
    """Of universal, revolute2 and gearbox joints."""
    thread_pitch: float = 1.0
    """Of screw joints."""
