"""librobotnik_force_based_move.so: hector's force-based move, which holds its pose when commands end."""

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import Twist

from .hector_gazebo.force_based_move import ForceBasedMove


class RobotnikForceBasedMove(ForceBasedMove):
    """Holds the model's pose from <commandWatchdog> (2 [s]) after the last command until the next.

    Meanwhile no force is applied and no odometry is published, as in the original.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        super().__init__(sim, model, node, parameters)
        self._watchdog_s = parameters.number("commandWatchdog", 2.0)
        self._held_pose = model.pose

    def before_step(self, sim: Simulation) -> None:
        """Apply the force and torque, or hold the pose."""
        if self._expired(sim.time_ns):
            self.model.set_twist(Twist())
            self.model.set_pose(self._held_pose)
            return
        self._held_pose = self.model.pose
        super().before_step(sim)

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish odometry, unless the pose is held."""
        if not self._expired(snapshot.time_ns):
            super().after_step(snapshot)

    def reset(self) -> None:
        """Hold the model's current pose."""
        super().reset()
        self._held_pose = self.model.pose

    def _expired(self, time_ns: int) -> bool:
        return (time_ns - self.command.stamp_ns) / 1e9 > self._watchdog_s
