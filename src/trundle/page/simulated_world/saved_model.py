"""Models with their state, to be copied, or put back after they were deleted or reset."""

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.robots.model import Model
from trundle.sim.simulation import ModelHandle, Simulation, TimedCommand
from trundle.spatial import Pose, Twist, Vector3, Wrench

from .handling import hold, is_held


class SavedModel(Struct, frozen=True, kw_only=True, eq=False):
    """Description and state of a model."""

    model: Model
    links: tuple[tuple[Pose, Twist], ...]
    """Pose and velocity of each link, in the world."""
    positions: NDArray[np.float64]
    """Positions of the joints' axes [rad or m]."""
    velocities: NDArray[np.float64]
    wrenches: tuple[tuple[Wrench, float | None], ...]
    """Applied to each link, and for how much longer [s]; None: until another is."""
    commands: tuple[tuple[TimedCommand, ...], ...]
    """Commands of each joint's axes."""
    is_held: bool
    """True if its base is fixed where it is, until it is freed."""

    def copy(self, name: str, offset: Vector3) -> "SavedModel":
        """Return it under another name and at another place."""
        away = Pose(offset)
        model = replace(self.model, name=name, world_from_model=away @ self.model.world_from_model)
        return replace(self, model=model, links=tuple((away @ pose, twist) for pose, twist in self.links))

    def fits(self, model: ModelHandle) -> bool:
        """Tell if a model has the links and joints of this state."""
        links, joints = self.model.links, self.model.joints
        return [each.name for each in model.links] == [each.name for each in links] and [
            (each.name, each.joint.type) for each in model.joints
        ] == [(each.name, each.type) for each in joints]

    def apply(self, simulation: Simulation) -> None:
        """Give the model of its name its state."""
        there = simulation[self.model.name]
        there.joint_positions = self.positions
        for link, (pose, twist) in zip(there.links, self.links, strict=True):
            if simulation.engine.writer.is_free(link.index):
                link.set_pose(pose)
                link.set_twist(twist)
        there.joint_velocities = self.velocities
        if self.is_held:
            hold(simulation, there, on=True)
        for link, (wrench, left_s) in zip(there.links, self.wrenches, strict=True):
            link.apply_wrench(wrench, duration_s=left_s)
        for joint, commands in zip(there.joints, self.commands, strict=True):
            joint.repeat(commands)


def saved_model(simulation: Simulation, model: ModelHandle) -> SavedModel:
    """Return a model with its state."""
    return SavedModel(
        model=model.model,
        links=tuple((link.pose, link.twist) for link in model.links),
        positions=model.joint_positions,
        velocities=model.joint_velocities,
        wrenches=tuple(link.applied_wrench for link in model.links),
        commands=tuple(joint.commands for joint in model.joints),
        is_held=is_held(simulation, model.name),
    )
