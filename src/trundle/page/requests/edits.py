"""Requests that change a simulated world while it runs; numbers are bounded, so that none destroys the state."""

from types import UnionType
from typing import Annotated, ClassVar, TypeAlias

import msgspec

from .answers import Answer, Done

_Number: TypeAlias = Annotated[float, msgspec.Meta(ge=-1e6, le=1e6)]
_Share: TypeAlias = Annotated[float, msgspec.Meta(ge=0, le=1)]
_Friction: TypeAlias = Annotated[float, msgspec.Meta(ge=0, le=1e6)]
Name: TypeAlias = Annotated[str, msgspec.Meta(max_length=500)]
Triple: TypeAlias = tuple[_Number, _Number, _Number]


class Action(msgspec.Struct, frozen=True, tag_field="request", tag=str.lower):
    """Base of all requests."""

    answer: ClassVar[type[Answer] | UnionType] = Done
    """Types of the answers."""


class MoveJoint(Action, frozen=True, tag="joint"):
    """Drive a joint of a simulated model: one of position, velocity and effort is given."""

    model: Name
    joint: Name
    position: _Number | None = None
    """[rad or m]"""
    velocity: _Number | None = None
    """[rad/s or m/s]"""
    effort: _Number | None = None
    """[N·m or N]"""

    def __post_init__(self) -> None:
        """Check that one is given."""
        if [self.position, self.velocity, self.effort].count(None) != 2:
            raise ValueError("give one of 'position', 'velocity' and 'effort'")


Quaternion: TypeAlias = tuple[_Number, _Number, _Number, _Number]


def check_direction(quaternion: Quaternion) -> None:
    """Check that a quaternion is not zero."""
    if sum(part * part for part in quaternion) < 1e-12:
        raise ValueError("the quaternion of an orientation is not zero")


class SetPose(Action, frozen=True, tag="pose"):
    """Move a model so that one of its links has this pose."""

    model: Name
    link: Name
    position: Triple
    """In the world [m]."""
    orientation: Quaternion
    """Quaternion wxyz, of any length but zero."""

    def __post_init__(self) -> None:
        """Check that the quaternion has a direction."""
        check_direction(self.orientation)


class Carry(SetPose, frozen=True, tag="carry"):
    """Carry a model, at rest, so that one of its links has this pose; to be renewed within a second, until `let_go`."""


class Pull(Action, frozen=True, tag="pull"):
    """Pull a point of a link to a place by a spring; to be renewed within a second, until `let_go`."""

    model: Name
    link: Name
    point: Triple
    """In the link's frame [m]."""
    target: Triple
    """In the world [m]."""


class LetGo(Action, frozen=True, tag="let_go"):
    """Let a model go that is carried or pulled."""

    model: Name


class HoldModel(Action, frozen=True, tag="hold"):
    """Fix a model's base where it is, in the air too, or free it again."""

    model: Name
    on: bool


class PlaceJoint(Action, frozen=True, tag="place_joint"):
    """Set the position of a joint at once; its velocity stays, and no motor is switched."""

    model: Name
    joint: Name
    position: _Number
    """[rad or m]"""


class SetTwist(Action, frozen=True, tag="twist"):
    """Set the velocity of a model once, world axes."""

    model: Name
    linear: Triple
    """[m/s]"""
    angular: Triple
    """[rad/s]"""


class SetMass(Action, frozen=True, tag="mass"):
    """Set the mass of a link; its moments of inertia change in proportion."""

    model: Name
    link: Name
    mass: Annotated[float, msgspec.Meta(ge=1e-6, le=1e6)]
    """[kg]"""


class SetFriction(Action, frozen=True, tag="friction"):
    """Set the friction of all collisions of a link."""

    model: Name
    link: Name
    mu: _Friction
    mu2: _Friction


class SetLight(Action, frozen=True, tag="light"):
    """Set the colour and intensity of a light."""

    light: Name
    """`name`, or `model::link::name` of one on a link."""
    diffuse: tuple[_Share, _Share, _Share]
    intensity: Annotated[float, msgspec.Meta(ge=0, le=1e6)]


class PlaceLight(Action, frozen=True, tag="place_light"):
    """Move a light of the world itself."""

    light: Name
    position: Triple
    """In the world [m]."""
    orientation: Quaternion
    """Quaternion wxyz, of any length but zero."""

    def __post_init__(self) -> None:
        """Check that the quaternion has a direction."""
        check_direction(self.orientation)


class SetPhysics(Action, frozen=True, tag="physics"):
    """Set what is given of gravity, wind and time step."""

    gravity: Triple | None = None
    """[m/s²]"""
    wind: Triple | None = None
    """[m/s]"""
    step: Annotated[float, msgspec.Meta(ge=1e-6, le=1.0)] | None = None
    """[s]"""


class ApplyWrench(Action, frozen=True, tag="wrench"):
    """Push a link at its centre of mass, world axes."""

    model: Name
    link: Name
    force: Triple
    """[N]"""
    torque: Triple
    """[N·m]"""
    duration: Annotated[float, msgspec.Meta(gt=0, le=1e6)]
    """Simulated time [s]."""


EditAction: TypeAlias = (
    MoveJoint
    | PlaceJoint
    | SetPose
    | Carry
    | Pull
    | LetGo
    | HoldModel
    | SetTwist
    | SetMass
    | SetFriction
    | SetLight
    | PlaceLight
    | SetPhysics
    | ApplyWrench
)
