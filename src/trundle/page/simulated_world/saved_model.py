"""Models with their state, to be copied, or restored after they were deleted or reset."""

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
    """Wrench on each link, and the wrench's remaining duration [s]; None: until it is replaced."""
    commands: tuple[tuple[TimedCommand, ...], ...]
    """Commands of each joint's axes."""
    is_held: bool
    """True if the model is held: its base is fixed to the world."""

    def copy(self, name: str, offset: Vector3) -> "SavedModel":
        """Return a copy under another name, translated by an offset [m]."""
        translation = Pose(offset)
        model = replace(self.model, name=name, world_from_model=translation @ self.model.world_from_model)
        return replace(self, model=model, links=tuple((translation @ pose, twist) for pose, twist in self.links))

    def fits(self, model: ModelHandle) -> bool:
        """Tell if a model has the links and joints of this state."""
        links = [link.name for link in model.links]
        joints = [(joint.name, joint.joint.type) for joint in model.joints]
        saved = self.model
        return links == [link.name for link in saved.links] and joints == [(j.name, j.type) for j in saved.joints]

    def apply(self, simulation: Simulation) -> None:
        """Set the state of the simulated model of the same name."""
        model = simulation[self.model.name]
        model.joint_positions = self.positions
        for link, (pose, twist) in zip(model.links, self.links, strict=True):
            if simulation.engine.writer.is_free(link.index):
                link.set_pose(pose)
                link.set_twist(twist)
        model.joint_velocities = self.velocities
        if self.is_held:
            hold(simulation, model, on=True)
        for link, (wrench, remaining_s) in zip(model.links, self.wrenches, strict=True):
            link.apply_wrench(wrench, duration_s=remaining_s)
        for joint, commands in zip(model.joints, self.commands, strict=True):
            joint.repeat(commands)


def saved_model(simulation: Simulation, model: ModelHandle) -> SavedModel:
    """Return a model's description and state."""
    return SavedModel(
        model=model.model,
        links=tuple((link.pose, link.twist) for link in model.links),
        positions=model.joint_positions,
        velocities=model.joint_velocities,
        wrenches=tuple(link.applied_wrench for link in model.links),
        commands=tuple(joint.commands for joint in model.joints),
        is_held=is_held(simulation, model.name),
    )
