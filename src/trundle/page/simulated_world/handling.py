"""Models that a user of the page carries, pulls or holds in the air."""

import math

import numpy as np

from trundle.base.diagnostics import UsageError
from trundle.robots.model import Joint, JointType
from trundle.sim.simulation import LinkHandle, ModelHandle, Simulation
from trundle.spatial import NS_PER_S, Pose, Twist, Vector3, Wrench, cross

_STIFFNESS = 40.0
"""Stiffness of the pulling spring per mass of the model [1/s²]: its weight stretches it by a quarter of a metre."""
_MAX_STRETCH = 5.0
"""Stretch of the pulling spring beyond which the force does not grow [m]."""
_MAX_RATE = 0.5
"""Limit of the natural frequency of spring and link times the time step; the spring is unstable above 2."""


class CarriedModel:
    """Hook that keeps a carried model at its pose, at rest."""

    def __init__(self, model: ModelHandle, pose: Pose) -> None:
        self.model = model
        self.pose = pose

    def before_step(self, simulation: Simulation) -> None:
        """Restore the model's pose."""
        if self.model in simulation.models:
            self.model.set_pose(self.pose)
            self.model.set_twist(Twist())


class PulledLink:
    """Hook that pulls a point of a link by a damped spring, as MuJoCo's viewer does."""

    def __init__(self, model: ModelHandle, link: LinkHandle, point: Vector3, step_s: float) -> None:
        """Choose stiffness and damping by the effective mass of the point.

        Args:
            model: the link's model.
            link: pulled link.
            point: pulled point in the link's frame [m].
            step_s: time step [s].

        Raises:
            UsageError: the link cannot move.
        """
        self.model, self.link, self.point = model, link, point
        self.target = link.pose.transform_point(point)
        """In the world [m]."""
        mass = _effective_mass(model, link, point)
        total = sum(part.link.inertial.mass for part in model.links)
        self._stiffness = min(_STIFFNESS * total, mass * (_MAX_RATE / step_s) ** 2)
        self._damping = 2.0 * math.sqrt(self._stiffness * mass)

    def before_step(self, simulation: Simulation) -> None:
        """Apply the spring's force for the coming step."""
        if self.model not in simulation.models:
            return
        link = self.link
        at, origin = link.pose.transform_point(self.point), link.pose.position
        (vx, vy, vz), spin = link.twist.linear, link.twist.angular
        wx, wy, wz = cross(spin, (at[0] - origin[0], at[1] - origin[1], at[2] - origin[2]))
        stretch = [target - now for target, now in zip(self.target, at, strict=True)]
        stiffness = min(1.0, _MAX_STRETCH / max(math.hypot(*stretch), 1e-9)) * self._stiffness
        velocity = (vx + wx, vy + wy, vz + wz)
        fx, fy, fz = (stiffness * d - self._damping * v for d, v in zip(stretch, velocity, strict=True))
        link.add_wrench(Wrench((fx, fy, fz)), at=at)


def _effective_mass(model: ModelHandle, link: LinkHandle, point: Vector3) -> float:
    """Return the effective mass of the model at a point of a link, averaged over all directions [kg]."""
    jacobian = model.jacobian(link, point)[:3]
    mobility = float(np.trace(jacobian @ np.linalg.solve(model.mass_matrix(), jacobian.T))) if jacobian.size else 0.0
    if mobility < 1e-9:
        raise UsageError(f"link {link.name!r} is fixed to the world and cannot be pulled")
    return 3.0 / mobility


def handled_models(simulation: Simulation) -> list[str]:
    """Return the names of the models that are carried or pulled."""
    return [hook.model.name for hook in simulation.hooks if isinstance(hook, CarriedModel | PulledLink)]


def carry(simulation: Simulation, model: ModelHandle, pose: Pose) -> None:
    """Move a model to a pose and keep it there, at rest, until it is let go; a fixed model is only moved."""
    hook = next((h for h in simulation.hooks if isinstance(h, CarriedModel) and h.model is model), None)
    if hook is not None:
        hook.pose = pose
    move_model(simulation, model, pose)
    if not any(simulation.engine.writer.is_free(link.index) for link in model.links):
        return
    model.set_twist(Twist())
    if hook is None:
        simulation.add_hook(CarriedModel(model, pose))


def pull(simulation: Simulation, model: ModelHandle, link: LinkHandle, *, point: Vector3, target: Vector3) -> None:
    """Pull a point of a link [m, link frame] to a target [m, world frame] until its model is let go."""
    hook = next((h for h in simulation.hooks if isinstance(h, PulledLink) and (h.link, h.point) == (link, point)), None)
    if hook is None:
        let_go(simulation, model.name)
        hook = PulledLink(model, link, point, simulation.step_ns / NS_PER_S)
        simulation.add_hook(hook)
    hook.target = target


def let_go(simulation: Simulation, name: str) -> None:
    """Stop carrying or pulling a model."""
    for hook in simulation.hooks:
        if isinstance(hook, CarriedModel | PulledLink) and hook.model.name == name:
            simulation.remove_hook(hook)


def is_held(simulation: Simulation, name: str) -> bool:
    """Tell if a model is held in the air."""
    return any(joint.name == _hold_joint(name) for joint in simulation.joints)


def hold(simulation: Simulation, model: ModelHandle, *, on: bool) -> None:
    """Fix a model's base to the world at its current pose, or free it again.

    Raises:
        UsageError: the model cannot move anyway.
    """
    if is_held(simulation, model.name) == on:
        return
    if not on:
        simulation.detach(_hold_joint(model.name))
        return
    if not simulation.engine.writer.is_free(model.base.index):
        raise UsageError(f"model {model.name!r} is fixed already")
    child = f"{model.name}::{model.base.name}"
    model.set_twist(Twist())
    simulation.attach(
        Joint(name=_hold_joint(model.name), type=JointType.FIXED, parent="world", child=child, at=model.model.at)
    )


def move_model(simulation: Simulation, model: ModelHandle, pose: Pose) -> None:
    """Move a model as a whole, with the joints that fix it to the world.

    Raises:
        UsageError: the model is fixed to another one and moves with it, as in Gazebo.
    """
    joints = (joint for joint in simulation.world.joints if joint.child.startswith(f"{model.name}::"))
    fixing = next((joint for joint in joints if joint.parent != "world"), None)
    if fixing is not None and not any(simulation.engine.writer.is_free(link.index) for link in model.links):
        raise UsageError(
            f"model {model.name!r} is fixed to {fixing.parent!r} by joint {fixing.name!r}: move that model"
        )
    model.set_pose(pose)


def _hold_joint(model: str) -> str:
    return f"hold of {model}"
