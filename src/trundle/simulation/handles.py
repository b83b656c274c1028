"""Models, links and joints of a running simulation, by name.

    robot = sim["rp2w"]
    robot.joint("camera_base_camera").hold(0.3)
    robot.link("chassis").apply_wrench(Wrench(force=(0, 15, 0)), duration_s=10)

A handle belongs to the thread that owns the simulation.
"""

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, TypeVar

from trundle.diagnostics import UsageError
from trundle.model import Joint, Link, Model
from trundle.spatial import Pose, Twist, Wrench

if TYPE_CHECKING:
    from .simulation import Simulation


class LinkHandle:
    """One link."""

    def __init__(self, simulation: "Simulation", link: Link, index: int) -> None:
        self._simulation = simulation
        self.link = link
        self.index = index
        """Into `Snapshot.poses`."""

    @property
    def name(self) -> str:
        """As in the file."""
        return self.link.name

    @property
    def pose(self) -> Pose:
        """The link's frame in the world."""
        x, y, z, qw, qx, qy, qz = self._simulation.engine.link_poses()[self.index].tolist()
        return Pose((x, y, z), (qw, qx, qy, qz))

    @property
    def twist(self) -> Twist:
        """Velocity of the frame's origin and angular velocity, world axes."""
        vx, vy, vz, wx, wy, wz = self._simulation.engine.link_twists()[self.index].tolist()
        return Twist((vx, vy, vz), (wx, wy, wz))

    def apply_wrench(self, wrench: Wrench, *, duration_s: float | None = None) -> None:
        """Push and twist the link at its centre of mass, in world axes.

        Args:
            wrench: replaces whatever was applied to this link before.
            duration_s: simulation time; None: until something else is applied.
        """
        self._simulation.apply_wrench(self.index, wrench, duration_s=duration_s)


class JointHandle:
    """One joint; with one axis of freedom it can be driven."""

    def __init__(self, simulation: "Simulation", joint: Joint, index: int) -> None:
        self._simulation = simulation
        self.joint = joint
        self.index = index
        """Into `Snapshot.joint_positions`."""

    @property
    def name(self) -> str:
        """As in the file."""
        return self.joint.name

    @property
    def position(self) -> float:
        """[rad or m]"""
        return float(self._simulation.engine.joint_positions()[self.index])

    @property
    def velocity(self) -> float:
        """[rad/s or m/s]"""
        return float(self._simulation.engine.joint_velocities()[self.index])

    @property
    def effort(self) -> float:
        """What drives it [N·m or N]."""
        return float(self._simulation.engine.joint_efforts()[self.index])

    @property
    def is_driven(self) -> bool:
        """Whether it has a single axis of freedom, and so can be driven or put somewhere."""
        return self._simulation.engine.compiled.joint_dof[self.index] >= 0

    def set_effort(self, effort: float) -> None:
        """Drive with this effort [N·m or N] until told otherwise."""
        self._simulation.engine.set_effort(self._driven(), effort)

    def set_velocity(self, velocity: float, *, max_effort: float = math.inf) -> None:
        """Keep this speed [rad/s or m/s] with at most so much effort, as Gazebo's SetVelocity with fmax."""
        self._simulation.engine.set_velocity(self._driven(), velocity, max_effort)

    def hold(self, position: float, *, max_effort: float = math.inf) -> None:
        """Go to a position [rad or m] and stay, with at most so much effort; limits are respected."""
        driven, axis = self._driven(), self.joint.axis
        assert axis is not None
        self._simulation.engine.hold(driven, min(max(position, axis.lower), axis.upper), max_effort)

    def set_position(self, position: float) -> None:
        """Put the joint there at once [rad or m], at rest."""
        self._simulation.engine.set_joint_position(self._driven(), position)

    def _driven(self) -> int:
        if not self.is_driven:
            raise UsageError(f"joint {self.name!r} cannot be driven: it has no single axis of freedom")
        return self.index


_Named = TypeVar("_Named", LinkHandle, JointHandle)


class ModelHandle:
    """One model."""

    def __init__(self, simulation: "Simulation", model: Model, *, first_link: int, first_joint: int) -> None:
        self._simulation = simulation
        self.model = model
        self.links = [LinkHandle(simulation, link, first_link + i) for i, link in enumerate(model.links)]
        """In file order."""
        self.joints = [JointHandle(simulation, joint, first_joint + i) for i, joint in enumerate(model.joints)]
        """In file order."""

    @property
    def name(self) -> str:
        """As in the file."""
        return self.model.name

    @property
    def _canonical(self) -> LinkHandle:
        named = (link for link in self.links if link.name == self.model.canonical_link)
        return next(named, self.links[0])

    @property
    def pose(self) -> Pose:
        """The model's frame in the world; it rides on the model's canonical link, as in Gazebo."""
        if not self.links:
            return self.model.world_from_model
        link = self._canonical
        return link.pose @ link.link.model_from_link.inverse()

    def link(self, name: str) -> LinkHandle:
        """The link of that name.

        Raises:
            UsageError: with the names there are.
        """
        return _named(name, self.links, f"model {self.name!r} has no link")

    def joint(self, name: str) -> JointHandle:
        """The joint of that name.

        Raises:
            UsageError: with the names there are.
        """
        return _named(name, self.joints, f"model {self.name!r} has no joint")

    def apply_wrench(self, wrench: Wrench, *, duration_s: float | None = None) -> None:
        """Push and twist the model's canonical link at its centre of mass, in world axes."""
        self._canonical.apply_wrench(wrench, duration_s=duration_s)


def _named(name: str, there: Iterable[_Named], none: str) -> _Named:
    for one in there:
        if one.name == name:
            return one
    raise UsageError(f"{none} {name!r}; there are: {', '.join(repr(one.name) for one in there) or 'none'}")
