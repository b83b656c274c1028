"""Joints of a robot model, with the variables that MoveIt names."""

from typing import NamedTuple

from msgspec import Struct

from trundle.robots.robot import RobotJointType
from trundle.spatial import Pose, Vector3

PLANAR = ("x", "y", "theta")
FLOATING = ("trans_x", "trans_y", "trans_z", "rot_x", "rot_y", "rot_z", "rot_w")
"""MoveIt's names of a joint's variables, after `JOINT/`."""


class MimicModel(NamedTuple):
    """Joint that follows another by multiplier · leader + offset; the leader follows none itself."""

    joint: str
    multiplier: float
    offset: float
    """[rad] or [m]"""


class JointModel(Struct, frozen=True, kw_only=True):
    """Joint between two links, or between the world and the root link."""

    name: str
    type: RobotJointType
    parent_link: str
    """Empty: the world, of the joint that holds the root link."""
    child_link: str
    origin: Pose = Pose()
    """Joint frame in the parent link's frame; equal to the child link's frame at zero."""
    axis: Vector3 = (1.0, 0.0, 0.0)
    """Unit vector in the joint frame."""
    variables: tuple[str, ...] = ()
    """() if fixed; the joint's name; NAME/x, /y, /theta if planar; NAME/trans_x … NAME/rot_w if floating."""
    lower: tuple[float, ...] = ()
    """Per variable [rad] or [m]; −π for one that turns without end, −inf without a limit."""
    upper: tuple[float, ...] = ()
    is_bounded: tuple[bool, ...] = ()
    """Per variable: False if it turns without end, or has no limit."""
    max_velocity: tuple[float | None, ...] = ()
    """Per variable [rad/s] or [m/s]; None: unknown. joint_limits.yaml wins over the URDF."""
    max_acceleration: tuple[float | None, ...] = ()
    """Per variable [rad/s²] or [m/s²]; None: unknown, as URDF has none."""
    mimic: MimicModel | None = None
    passive: bool = False
    """True: nothing measures or drives it."""
    properties: dict[str, str] = {}
    """<joint_property> of the SRDF."""

    @property
    def is_active(self) -> bool:
        """True if it has variables and follows no other joint."""
        return bool(self.variables) and self.mimic is None
