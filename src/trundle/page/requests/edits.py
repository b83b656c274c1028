"""Requests that change a simulated world while it runs; numbers are bounded to protect the simulation's state."""

from types import UnionType
from typing import Annotated, ClassVar, TypeAlias

import msgspec

from .answers import Answer, Done

_Number: TypeAlias = Annotated[float, msgspec.Meta(ge=-1e6, le=1e6)]
_ColorValue: TypeAlias = Annotated[float, msgspec.Meta(ge=0, le=1)]
_Friction: TypeAlias = Annotated[float, msgspec.Meta(ge=0, le=1e6)]
Name: TypeAlias = Annotated[str, msgspec.Meta(max_length=500)]
Triple: TypeAlias = tuple[_Number, _Number, _Number]


class Action(msgspec.Struct, frozen=True, tag_field="request", tag=str.lower):
    """Base of all requests."""

    answer: ClassVar[type[Answer] | UnionType] = Done
    """Types of the answers."""


class MoveJoint(Action, frozen=True, tag="joint"):
    """Command a joint by exactly one of position, velocity and effort."""

    model: Name
    joint: Name
    position: _Number | None = None
    """[rad or m]"""
    velocity: _Number | None = None
    """[rad/s or m/s]"""
    effort: _Number | None = None
    """[N·m or N]"""

    def __post_init__(self) -> None:
        """Check that exactly one is set."""
        if [self.position, self.velocity, self.effort].count(None) != 2:
            raise ValueError("give one of 'position', 'velocity' and 'effort'")


Quaternion: TypeAlias = tuple[_Number, _Number, _Number, _Number]


def check_direction(quaternion: Quaternion) -> None:
    """Check that a quaternion is not zero."""
    if sum(part * part for part in quaternion) < 1e-12:
        raise ValueError("the quaternion of an orientation must not be zero")


class SetPose(Action, frozen=True, tag="pose"):
    """Move a model so that one of its links has this pose."""

    model: Name
    link: Name
    position: Triple
    """In the world [m]."""
    orientation: Quaternion
    """Quaternion wxyz of any length except zero."""

    def __post_init__(self) -> None:
        """Check that the quaternion is not zero."""
        check_direction(self.orientation)


class Carry(SetPose, frozen=True, tag="carry"):
    """Keep a model at rest with one of its links at this pose, until `let_go` or a second without such a request."""


class Pull(Action, frozen=True, tag="pull"):
    """Pull a point of a link to a target by a spring, until `let_go` or a second without such a request."""

    model: Name
    link: Name
    point: Triple
    """In the link's frame [m]."""
    target: Triple
    """In the world [m]."""


class LetGo(Action, frozen=True, tag="let_go"):
    """Stop carrying or pulling a model."""

    model: Name


class HoldModel(Action, frozen=True, tag="hold"):
    """Fix a model's base at its current pose, even in the air, or free it again."""

    model: Name
    on: bool


class PlaceJoint(Action, frozen=True, tag="place_joint"):
    """Set the position of a joint at once; its velocity and motor commands stay."""

    model: Name
    joint: Name
    position: _Number
    """[rad or m]"""


class SetTwist(Action, frozen=True, tag="twist"):
    """Set the velocity of a model once, in world axes."""

    model: Name
    linear: Triple
    """[m/s]"""
    angular: Triple
    """[rad/s]"""


class SetMass(Action, frozen=True, tag="mass"):
    """Set the mass of a link and scale its moments of inertia."""

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
    """Set the color and intensity of a light."""

    light: Name
    """`name`, or `model::link::name` for a link's light."""
    diffuse: tuple[_ColorValue, _ColorValue, _ColorValue]
    intensity: Annotated[float, msgspec.Meta(ge=0, le=1e6)]


class PlaceLight(Action, frozen=True, tag="place_light"):
    """Move a light that belongs to the world, not to a link."""

    light: Name
    position: Triple
    """In the world [m]."""
    orientation: Quaternion
    """Quaternion wxyz of any length except zero."""

    def __post_init__(self) -> None:
        """Check that the quaternion is not zero."""
        check_direction(self.orientation)


class SetPhysics(Action, frozen=True, tag="physics"):
    """Set gravity, wind or time step; None: unchanged."""

    gravity: Triple | None = None
    """[m/s²]"""
    wind: Triple | None = None
    """[m/s]"""
    step: Annotated[float, msgspec.Meta(ge=1e-6, le=1.0)] | None = None
    """[s]"""


class ApplyWrench(Action, frozen=True, tag="wrench"):
    """Apply a wrench to a link at its centre of mass, in world axes."""

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
