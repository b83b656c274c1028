"""Handles of models, links and joints of a running simulation.

    robot = sim["rp2w"]
    robot.joint("camera_base_camera").command_position(0.3)
    robot.link("chassis").apply_wrench(Wrench(force=(0, 15, 0)), duration_s=10)

A handle belongs to the thread that owns the simulation.
"""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from trundle.base.arguments import number_of, pose_of, twist_of, vector_of, wrench_of
from trundle.base.diagnostics import UsageError, no_such
from trundle.base.documented import documented
from trundle.robots.model import Link, Model, World
from trundle.spatial import ZERO, Pose, Twist, Wrench, cross, subtract

from .handle import Handle
from .joint_handle import JointHandle
from .joint_space import JointSpace
from .world_edits import with_model_at

if TYPE_CHECKING:
    from trundle.base.arguments import PoseLike, TwistLike, WrenchLike
    from trundle.sim.physics import LinkGrip

    from .runtime import Runtime


@documented("name index is_valid pose twist set_pose set_twist apply_wrench applied_wrench add_wrench")
class LinkHandle(Handle):
    """Handle of a link."""

    __module__ = "trundle"

    KIND = "link"

    def __init__(self, simulation: "Runtime", link: Link, index: int) -> None:
        super().__init__(simulation, index)
        self.link = link

    @property
    def name(self) -> str:
        """Name as in the file."""
        return self.link.name

    def __repr__(self) -> str:
        return f"<LinkHandle {self.name!r}{_position(self.pose) if self.is_valid else ' of a deleted model'}>"

    @property
    def pose(self) -> Pose:
        """Pose of the link's frame in the world."""
        x, y, z, qw, qx, qy, qz = self._simulation.engine.reader.link_poses()[self.index].tolist()
        return Pose((x, y, z), (qw, qx, qy, qz))

    @property
    def twist(self) -> Twist:
        """Velocity of the frame's origin and angular velocity, world axes."""
        vx, vy, vz, wx, wy, wz = self._simulation.engine.reader.link_twists()[self.index].tolist()
        return Twist((vx, vy, vz), (wx, wy, wz))

    def set_pose(self, pose: "PoseLike") -> None:
        """Teleport the link with its tree; velocities stay.

        Args:
            pose: pose of the link's frame in the world: `Pose`, or 3, 6 or 7 numbers (x, y, z [m]; roll, pitch, yaw
                [rad] or qw, qx, qy, qz); 3 set it upright.

        Raises:
            UsageError: the link has a parent joint or is fixed, or it is no pose.
        """
        self._simulation.engine.writer.set_tree_pose(self.index, pose_of(pose))

    def set_twist(self, twist: "TwistLike") -> None:
        """Set the velocity of the link's origin and its angular velocity once, world axes.

        Args:
            twist: `Twist`, or 3 or 6 numbers: linear [m/s], angular [rad/s]; 3 set the angular velocity to zero.

        Raises:
            UsageError: the link has a parent joint or is fixed, or it is no twist.
        """
        self._simulation.engine.writer.set_tree_twist(self.index, twist_of(twist))

    def apply_wrench(self, wrench: "WrenchLike", *, duration_s: float | None = None) -> None:
        """Apply a wrench at the link's centre of mass, world axes.

        Args:
            wrench: wrench in place of the previous one: `Wrench`, or 3 or 6 numbers: force [N], torque [N·m].
            duration_s: simulation time [s], at least one step; None: until the next call.

        Raises:
            UsageError: it is no wrench, or the duration is negative.
        """
        if duration_s is not None:
            duration_s = number_of(duration_s, "duration_s [s]", minimum=0.0)
        self._simulation.loads.set_wrench(self.index, wrench_of(wrench), duration_s=duration_s)

    @property
    def applied_wrench(self) -> tuple[Wrench, float | None]:
        """Wrench of `apply_wrench`, and its remaining duration [s]; None: until the next call."""
        return self._simulation.engine.wrench(self.index), self._simulation.loads.wrench_left_s(self.index)

    def add_wrench(self, wrench: "WrenchLike", *, at: "ArrayLike | None" = None) -> None:
        """Add a wrench until the next hook, for forces computed at every step, such as wind, buoyancy and drag.

        Args:
            wrench: wrench in world axes: `Wrench`, or 3 or 6 numbers: force [N], torque [N·m].
            at: point of application in the world (3) [m]; None: the centre of mass.

        Raises:
            UsageError: it is no wrench, or the point is not 3 numbers.
        """
        wrench = wrench_of(wrench)
        if at is not None:
            point = vector_of(at, "at [m]")
            com = self.pose @ self.link.inertial.link_from_com
            wrench = wrench + Wrench(torque=cross(subtract(point, com.position), wrench.force))
        self._simulation.loads.add_wrench(self.index, wrench)

    def set_surface_motion(self, motion: "LinkGrip | None") -> None:
        """Set the motion and slip of the link's surface at its contacts.

        Args:
            motion: motion and slip; None: ordinary contacts.
        """
        self._simulation.loads.set_surface_motion(self.index, motion)


_Named = TypeVar("_Named", LinkHandle, JointHandle)


@documented(
    "name model links joints base pose twist set_pose set_twist reset link joint apply_wrench joint_names "
    "joint_positions joint_velocities jacobian mass_matrix bias_forces inverse_dynamics"
)
class ModelHandle:
    """Handle of a model."""

    __module__ = "trundle"

    def __init__(self, simulation: "Runtime", model: Model, *, first_link: int, first_joint: int) -> None:
        self._simulation = simulation
        self.model = model
        self.links = [LinkHandle(simulation, link, first_link + i) for i, link in enumerate(model.links)]
        """In file order."""
        self.joints = [JointHandle(simulation, joint, first_joint + i) for i, joint in enumerate(model.joints)]
        """In file order."""

    @property
    def name(self) -> str:
        """Name as in the file."""
        return self.model.name

    def __repr__(self) -> str:
        if not all(link.is_valid for link in self.links):
            return f"<ModelHandle {self.name!r}, deleted>"
        links, joints = (", ".join(repr(part.name) for part in parts) for parts in (self.links, self.joints))
        return (
            f"<ModelHandle {self.name!r}{_position(self.pose)}; links: {links or 'none'}; joints: {joints or 'none'}>"
        )

    @property
    def pose(self) -> Pose:
        """Pose of the model's frame in the world, fixed to the canonical link."""
        if not self.links:
            return self.model.world_from_model
        base = self.base
        return base.pose @ base.link.model_from_link.inverse()

    @property
    def twist(self) -> Twist:
        """Velocity of the model frame's origin and angular velocity, world axes; zero without a link."""
        if not self.links:
            return Twist()
        (vx, vy, vz), spin = self.base.twist.linear, self.base.twist.angular
        x, y, z = (p - b for p, b in zip(self.pose.position, self.base.pose.position, strict=True))
        cx, cy, cz = cross(spin, (x, y, z))
        return Twist((vx + cx, vy + cy, vz + cz), spin)

    @property
    def base(self) -> LinkHandle:
        """Canonical link, or the first link if the file names none.

        Raises:
            UsageError: the model has no link.
        """
        if not self.links:
            raise UsageError(f"model {self.name!r} has no link")
        named = self.model.canonical_link
        return next((link for link in self.links if link.name == named), self.links[0])

    def set_pose(self, pose: "PoseLike") -> None:
        """Teleport the model; velocities stay. A model fixed to the world is recompiled at the new pose.

        Args:
            pose: pose of the model's frame in the world: `Pose`, or 3, 6 or 7 numbers (x, y, z [m]; roll, pitch, yaw
                [rad] or qw, qx, qy, qz); 3 set it upright.

        Raises:
            UsageError: it is no pose.
        """
        moved = pose_of(pose) @ self.pose.inverse()
        free = [link for link in self.links if self._simulation.engine.writer.is_free(link.index)]
        if not free:
            simulation = self._simulation
            simulation.edit(with_model_at(simulation.world, self.name, moved @ self.model.world_from_model))
        for link, target in [(link, moved @ link.pose) for link in free]:
            link.set_pose(target)

    def reset(self) -> None:
        """Reset the model and its joints to the state after loading or spawning: at rest, with motors off and no loads.

        Its plugins are reset afterwards, as in Gazebo's Model::Reset.
        """
        self._simulation.engine.writer.reset_links([link.index for link in self.links])
        for link in self.links:
            link.apply_wrench(Wrench())
        for joint in self.joints:
            for axis in range(len(joint.axes)):
                joint.command_effort(0.0, axis=axis)
        self._simulation.resets.finish(self)

    def set_twist(self, twist: "TwistLike") -> None:
        """Set the model's twist on its free trees once, world axes.

        Args:
            twist: `Twist`, or 3 or 6 numbers: linear [m/s] at the origin of the model's frame, angular [rad/s].

        Raises:
            UsageError: it is no twist.
        """
        twist = twist_of(twist)
        (vx, vy, vz), (wx, wy, wz) = twist.linear, twist.angular
        x0, y0, z0 = self.pose.position
        for link in self.links:
            if self._simulation.engine.writer.is_free(link.index):
                x, y, z = (p - p0 for p, p0 in zip(link.pose.position, (x0, y0, z0), strict=True))
                linear = (vx + wy * z - wz * y, vy + wz * x - wx * z, vz + wx * y - wy * x)
                link.set_twist(Twist(linear, twist.angular))

    def set_link_twists(self, twist: "TwistLike") -> None:
        """Set the velocity of each free link's origin and its angular velocity once, world axes.

        As Gazebo's SetLinearVel and SetAngularVel of a model: links away from the model's origin get no velocity from
        the rotation.
        """
        for link in self.links:
            if self._simulation.engine.writer.is_free(link.index):
                link.set_twist(twist)

    def update_description(self, model: Model) -> None:
        """Replace the description by an edited one with the same links and joints; for the simulation only."""
        self.model = model
        for handle, link in zip(self.links, model.links, strict=True):
            handle.link = link
        for handle, joint in zip(self.joints, model.joints, strict=True):
            handle.joint = joint

    def rebind(self, first_link: int | None, first_joint: int | None) -> None:
        """Set new indices, or None after deletion; for the simulation only."""
        for i, link in enumerate(self.links):
            link.rebind(None if first_link is None else first_link + i)
        for i, joint in enumerate(self.joints):
            joint.rebind(None if first_joint is None else first_joint + i)

    def link(self, name: str) -> LinkHandle:
        """Return a link by name.

        Raises:
            UsageError: no such link; the message lists the links.
        """
        return _find_by_name(name, self.links, f"model {self.name!r} has no link")

    def joint(self, name: str) -> JointHandle:
        """Return a joint by name.

        Raises:
            UsageError: no such joint; the message lists the joints.
        """
        return _find_by_name(name, self.joints, f"model {self.name!r} has no joint")

    # -- all joints at once

    @property
    def _joint_space(self) -> JointSpace:
        links = [link.index for link in self.links]
        return JointSpace(self._simulation.engine, self.name, links=links, joints=self.joints)

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Joint name of each axis, in file order, which is the order of all arrays here.

        A fixed joint has none, a universal joint two, a ball joint three.
        """
        return self._joint_space.names

    @property
    def joint_positions(self) -> NDArray[np.float64]:
        """Positions (axes,) [rad or m] in the order of `joint_names`; a ball joint's three are its rotation vector.

        Reading returns a read-only copy; assigning an array sets the state at once, keeps velocities, and switches no
        motor.

        Raises:
            UsageError: the assigned array has another shape, or a number that is not finite.
        """
        return self._joint_space.positions()

    @joint_positions.setter
    def joint_positions(self, positions: ArrayLike) -> None:
        self._joint_space.set_positions(positions)

    @property
    def joint_velocities(self) -> NDArray[np.float64]:
        """Velocities (axes,) [rad/s or m/s] in the order of `joint_names`; a ball joint's three are along its child's
        axes.

        Reading returns a read-only copy; assigning an array sets the state once.

        Raises:
            UsageError: the assigned array has another shape, or a number that is not finite.
        """
        return self._joint_space.velocities()

    @joint_velocities.setter
    def joint_velocities(self, velocities: ArrayLike) -> None:
        self._joint_space.set_velocities(velocities)

    # -- equations of motion: M(q) a + h(q, v) = τ + Jᵀ f
    #
    # Generalized velocities have n entries: 6 for each free link of the model, usually its base: the velocity of the
    # link's origin [m/s] and its angular velocity [rad/s], world axes; then `joint_names`' axes.

    def jacobian(self, link: str | LinkHandle, point: "ArrayLike" = ZERO) -> NDArray[np.float64]:
        """Return the Jacobian of a point of a link in the model's current state.

        Args:
            link: link of this model.
            point: point in the link's frame (3) [m].

        Returns:
            (6, n): velocity of the point [m/s] in rows 0 to 2, angular velocity of the link [rad/s] in rows 3 to 5,
            world axes. The n columns are 6 of each free link (linear, angular; world axes), then `joint_names`.

        Raises:
            UsageError: there is no such link, or the point is not 3 numbers.
        """
        handle = link if isinstance(link, LinkHandle) else self.link(link)
        return self._joint_space.jacobian(handle.index, vector_of(point, "point [m]"))

    def mass_matrix(self) -> NDArray[np.float64]:
        """Return the (n, n) mass matrix M(q) of the current state [kg, kg·m, kg·m²], ordered as
        `jacobian`'s columns.
        """
        return self._joint_space.mass_matrix()

    def bias_forces(self) -> NDArray[np.float64]:
        """Return (n,) h(q, v) of the current state: Coriolis, centrifugal and gravity forces [N·m or N].

        Joint damping, friction, springs, motors and contacts are excluded. Order as `jacobian`'s columns.
        """
        return self._joint_space.bias_forces()

    def inverse_dynamics(self, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> NDArray[np.float64]:
        """Return the (n,) forces τ = M(q) a + h(q, v) for accelerations [N·m or N]; for a free link force and torque at
        its origin, world axes.

        The world does not change; free links have their current pose.

        Args:
            q: (axes,) joint positions [rad or m], as `joint_positions`.
            v: (n,) velocities, in the order of `jacobian`'s columns.
            a: (n,) time derivatives of `v`.

        Raises:
            UsageError: an array has another shape, or a number that is not finite.
        """
        return self._joint_space.inverse_dynamics(q, v, a)

    def apply_wrench(self, wrench: "WrenchLike", *, duration_s: float | None = None) -> None:
        """Apply a wrench [N, N·m] at the canonical link's centre of mass, world axes; see `LinkHandle.apply_wrench`."""
        self.base.apply_wrench(wrench, duration_s=duration_s)


def _position(pose: Pose) -> str:
    x, y, z = pose.position
    return f" at ({x:.3f}, {y:.3f}, {z:.3f}) m"


def _find_by_name(name: str, parts: Sequence[_Named], problem: str) -> _Named:
    for part in parts:
        if part.name == name:
            return part
    raise UsageError(no_such(problem, name, [part.name for part in parts]))


def handles_of(simulation: "Runtime", world: World, existing: Mapping[str, ModelHandle]) -> list[ModelHandle]:
    """Return a handle per model, in order; existing ones are rebound to their new indices."""
    handles: list[ModelHandle] = []
    link, joint = 0, 0
    for model in world.models:
        handle = existing.get(model.name)
        if handle is None:
            handle = ModelHandle(simulation, model, first_link=link, first_joint=joint)
        else:
            handle.update_description(model)
            handle.rebind(link, joint)
        handles.append(handle)
        link += len(model.links)
        joint += len(model.joints)
    return handles


def world_joints_of(simulation: "Runtime", world: World, existing: Mapping[str, JointHandle]) -> list[JointHandle]:
    """Return a handle per joint between models, in order; existing ones are rebound to their new indices."""
    unused = dict(existing)
    first = sum(len(model.joints) for model in world.models)
    handles: list[JointHandle] = []
    for i, joint in enumerate(world.joints, first):
        handle = unused.pop(joint.name, None) or JointHandle(simulation, joint, i)
        handle.joint = joint
        handle.rebind(i)
        handles.append(handle)
    for handle in unused.values():
        handle.rebind(None)
    return handles
